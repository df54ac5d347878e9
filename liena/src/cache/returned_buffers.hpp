// The bytes of long messages that the application has let go of, on their way back to the network thread.
#pragma once

#include "cache/inheriting_mutex.hpp"
#include "liena/message.hpp"

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace liena::cache {

/// Bounded: what comes when it is full, and what is short, goes back to the heap. Nothing is allocated or freed under its lock.
class ReturnedBuffers {
public:
    static constexpr std::size_t leastBytes = 16 * 1024;
    static constexpr std::size_t mostBuffers = 8;
    static constexpr std::size_t mostBytes = std::size_t{16} << 20U;

    ReturnedBuffers() { m_used.reserve(mostBuffers); }

    /// Any thread.
    void put(FieldBytes&& used)
    {
        const auto bytes = used.capacity();
        if (bytes < leastBytes)
            return;
        const std::lock_guard lock(m_mutex);
        if (m_used.size() >= mostBuffers || m_bytes + bytes > mostBytes)
            return; // the caller frees it
        m_bytes += bytes;
        m_used.push_back(std::move(used));
    }

    /// Network thread. `used` is empty before; the memory that it has is used for those that come next.
    void take(std::vector<FieldBytes>& used)
    {
        used.reserve(mostBuffers);
        const std::lock_guard lock(m_mutex);
        used.swap(m_used);
        m_bytes = 0;
    }

private:
    InheritingMutex m_mutex;
    std::vector<FieldBytes> m_used;
    std::size_t m_bytes = 0;
};

} // namespace liena::cache
