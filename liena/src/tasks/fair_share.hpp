// Sessions whose bulk leaves by one interface come to even rates where it waits in one queue.
#pragma once

#include <vector>

namespace liena::tasks {

class PathRate;

/// Pure. Each lane finds its rate by itself, and two that grow and yield in proportion keep whatever proportion they met in. So
/// whenever one of them meets a queue, the fastest that waits as long gives a part of its excess to those below the mean: the sum stays.
/// Who waits for less or more than the others has a bottleneck of its own, and is left alone. It is the sessions that come to even rates,
/// and within each its lanes: who has four streams gets no more than who has one.
class FairShare {
public:
    /// From now on the lane has something to send. Each call but the first of several changes nothing.
    void enter(PathRate& rate);
    void leave(PathRate& rate);

    /// Nobody but one lane has something to send.
    bool isAlone() const { return m_busy.size() <= 1; }

    /// `met` met a queue and has yielded.
    void even(const PathRate& met);

private:
    double partOf(const PathRate& rate) const;

    std::vector<PathRate*> m_busy;
};

} // namespace liena::tasks
