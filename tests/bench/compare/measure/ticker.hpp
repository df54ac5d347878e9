// A thread that runs a task in a fixed rhythm: the camera of a workload.
#pragma once

#include "measure/stamp.hpp"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace liena::compare {

class Ticker {
public:
    /// `task` hears when it was due.
    Ticker(Nanoseconds period, std::function<void(Instant)> task);
    ~Ticker(); ///< ends the thread

    Ticker(const Ticker&) = delete;
    Ticker& operator=(const Ticker&) = delete;

private:
    void run(Nanoseconds period, const std::function<void(Instant)>& task);

    std::mutex m_mutex;
    std::condition_variable m_wake;
    bool m_ended = false;
    std::thread m_thread;
};

} // namespace liena::compare
