// A thread that is let go of without waiting for its end.
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include <pthread.h>

namespace liena::transport {

/// Its stack is small, since whoever locks this program's memory pays for all of it at the start. One thread at a time asks.
class WorkerThread {
public:
    WorkerThread() = default;
    /// Runs that; throws std::system_error when there are no more threads.
    explicit WorkerThread(std::function<void()> life);
    WorkerThread(WorkerThread&& other) noexcept : m_handle(std::exchange(other.m_handle, std::nullopt)) {}
    WorkerThread& operator=(WorkerThread&& other) noexcept
    {
        std::swap(m_handle, other.m_handle);
        return *this;
    }
    ~WorkerThread() { join(); }

    /// It ran to its end, and nothing is left of it.
    bool hasEnded();

    /// Waits for that.
    void join();

private:
    std::optional<pthread_t> m_handle; ///< nothing: not begun, or over
};

} // namespace liena::transport
