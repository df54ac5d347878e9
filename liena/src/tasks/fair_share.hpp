// Sessions whose bulk leaves by one interface come to even rates where it waits in one queue.
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

namespace liena::tasks {

class PathRate;

/// Pure. Each lane finds its rate by itself, and two that grow and yield in proportion keep whatever proportion they met in. So
/// whenever one of them meets a queue, the fastest that waits as long gives a part of its excess to those below the mean: the sum stays.
/// Who waits for less or more than the others has a bottleneck of its own, and is left alone. It is the sessions that come to even rates,
/// and within each its lanes: who has four streams gets no more than who has one. Which lanes of a session are in a burst at the moment is
/// known here, too: they share its rate.
class FairShare {
public:
    using Instant = std::chrono::steady_clock::time_point;

    /// From now on the lane has something to send. Each call but the first of several changes nothing.
    void enter(PathRate& rate);

    /// It is a burst: the others of its session make room. From which of those in a burst there is most to learn; null: none is.
    const PathRate* makeRoom(const PathRate& rate, Instant now);

    /// From now on it has nothing, but what its kernel still sends.
    void pause(PathRate& rate, Instant now);
    void leave(PathRate& rate);

    /// Of its session: this one, and who else is in a burst.
    std::size_t lanesOf(const PathRate& rate, Instant now) const;

    /// No other session has something to send.
    bool isAlone(const PathRate& rate) const;

    /// `met` has yielded to a queue, or has seen drain what a standstill left.
    void even(const PathRate& met);

private:
    double partOf(const PathRate& rate) const;
    void tellOthers(const PathRate& rate, Instant now) const;

    std::vector<PathRate*> m_busy;
    std::vector<PathRate*> m_leaving; ///< their kernels still send
};

} // namespace liena::tasks
