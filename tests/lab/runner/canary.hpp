// How long this machine keeps an idle thread from running: what no device on it can do better than.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

namespace liena::lab {

/// A thread of its own that wakes each millisecond and notes the largest lateness.
class Canary {
public:
    Canary();
    ~Canary();
    Canary(const Canary&) = delete;
    Canary& operator=(const Canary&) = delete;

    /// In ms, since the last call.
    double takeLargest();

private:
    void run();

    std::atomic<std::int64_t> m_largest{0};
    std::atomic<bool> m_stop{false};
    std::thread m_thread;
};

} // namespace liena::lab
