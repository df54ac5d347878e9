// When a periodic run was due, as it finds out itself: what a late run lost counts as latency of what it sends.
#pragma once

#include "measure/stamp.hpp"

#include <algorithm>

namespace liena::compare {

/// The rule of DistributedSystem::every(), which the other transports follow as well: a run that is late by less than a period does not
/// shift the later ones; a run that is later is not made up for.
class DueGrid {
public:
    explicit DueGrid(Nanoseconds period) : m_period(period) {}

    /// When the run that begins `now` was due.
    Instant due(Instant now)
    {
        const auto due = m_next == Instant{} ? now : std::min(m_next, now);
        m_next = std::max(due + m_period, now);
        return due;
    }

private:
    Nanoseconds m_period;
    Instant m_next{};
};

} // namespace liena::compare
