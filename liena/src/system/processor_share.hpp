// How much of a processor a thread of real-time priority may take.
#pragma once

#include <chrono>

namespace liena::system {

/// Pure. Where threads of real-time priority have run on a processor for 950 ms of a second, Linux stops all of them there until the second
/// is over (sched(7), sched_rt_runtime_us): for longer than a command may be old. So a thread that looks for work without sleeping stays
/// below that by itself: it sleeps until work comes for a moment now and then, which costs a message what waking a thread takes.
class ProcessorShare {
public:
    using Instant = std::chrono::steady_clock::time_point;
    using Nanoseconds = std::chrono::nanoseconds;

    static constexpr std::chrono::milliseconds window{100};
    static constexpr std::chrono::milliseconds unjudged{2}; ///< of each window: too short to tell a share

    /// `most`: of all time, 0 … 1.
    explicit ProcessorShare(double most) : m_most(most) {}

    /// Whether it has had its share. `used`: of the thread's processor time until now.
    bool isSpent(Instant now, Nanoseconds used)
    {
        const auto elapsed = now - m_begun;
        if (elapsed > window) {
            m_begun = now;
            m_usedBefore = used;
            return false;
        }
        return elapsed >= unjudged && std::chrono::duration<double>(used - m_usedBefore) > m_most * std::chrono::duration<double>(elapsed);
    }

private:
    double m_most;
    Instant m_begun{};
    Nanoseconds m_usedBefore{};
};

} // namespace liena::system
