// Frames that another thread hands to a transport that waits in poll(), and the order to stop.
#pragma once

#include "measure/stamp.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <atomic>
#include <mutex>
#include <utility>
#include <vector>

namespace liena::compare {

class FramePost {
public:
    FramePost() : m_descriptor(::eventfd(0, EFD_NONBLOCK)) {}
    ~FramePost() { ::close(m_descriptor); }
    FramePost(const FramePost&) = delete;
    FramePost& operator=(const FramePost&) = delete;

    void put(const Stamp& stamp)
    {
        {
            const std::lock_guard lock(m_mutex);
            m_stamps.push_back(stamp);
        }
        ::eventfd_write(m_descriptor, 1);
    }

    void stop()
    {
        m_stopped = true;
        ::eventfd_write(m_descriptor, 1);
    }

    bool isStopped() const { return m_stopped; }
    int descriptor() const { return m_descriptor; } ///< can be read when there is something to take

    std::vector<Stamp> take()
    {
        eventfd_t count = 0;
        ::eventfd_read(m_descriptor, &count);
        const std::lock_guard lock(m_mutex);
        return std::exchange(m_stamps, {});
    }

private:
    int m_descriptor;
    std::atomic<bool> m_stopped = false;
    std::mutex m_mutex;
    std::vector<Stamp> m_stamps;
};

} // namespace liena::compare
