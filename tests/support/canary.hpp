// How long this machine keeps an idle thread from running: what no device on it can do better than.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

namespace liena::test {

/// A thread on each processor that wakes in a fixed rhythm and notes how late it is, with the priority of whoever makes it.
class Canary {
public:
    /// Monotonic ns.
    struct Stall {
        std::int64_t begin = 0; ///< when the thread should have run
        std::int64_t end = 0;
    };

    explicit Canary(std::chrono::nanoseconds period = std::chrono::milliseconds(1));
    ~Canary();
    Canary(const Canary&) = delete;
    Canary& operator=(const Canary&) = delete;

    /// In ms, of any processor, since the last call.
    double takeLargest();

    /// In ms, of any processor, between two moments (monotonic ns) of the last minutes.
    double largestBetween(std::int64_t from, std::int64_t to) const;

    /// Of any processor in the last minutes, those of 0.3 ms and more.
    std::vector<Stall> stalls() const;

private:
    void run(unsigned processor);
    void note(Stall stall);

    const std::int64_t m_period;
    mutable std::mutex m_mutex;
    std::deque<Stall> m_stalls;
    std::atomic<std::int64_t> m_largest{0};
    std::atomic<bool> m_stop{false};
    std::vector<std::thread> m_threads;
};

} // namespace liena::test
