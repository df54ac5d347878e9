// How long this machine keeps an idle thread from running: what no device on it can do better than.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

namespace liena::lab {

/// A thread on each processor that wakes each millisecond and notes how late it is.
class Canary {
public:
    Canary();
    ~Canary();
    Canary(const Canary&) = delete;
    Canary& operator=(const Canary&) = delete;

    /// In ms, of any processor, since the last call.
    double takeLargest();

    /// In ms, of any processor, between two moments (monotonic ns) of the last minutes.
    double largestBetween(std::int64_t from, std::int64_t to) const;

private:
    struct Stall {
        std::int64_t begin = 0; ///< when the thread should have run
        std::int64_t end = 0;
    };

    void run(unsigned processor);
    void note(Stall stall);

    mutable std::mutex m_mutex;
    std::deque<Stall> m_stalls; ///< of some length
    std::atomic<std::int64_t> m_largest{0};
    std::atomic<bool> m_stop{false};
    std::vector<std::thread> m_threads;
};

} // namespace liena::lab
