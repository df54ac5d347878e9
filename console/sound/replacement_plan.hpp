// When a process that does not do its work is replaced by another.
#pragma once

#include "model/instant.hpp"

#include <algorithm>
#include <chrono>

namespace console {

/// Ever more rarely, until one works: what ails them may not be theirs. No clock of its own.
class ReplacementPlan {
public:
    static constexpr std::chrono::seconds first{10};
    static constexpr std::chrono::seconds longest{60};

    void noteStarted(Instant now) { m_well = now; }

    void noteWell(Instant now)
    {
        m_well = now;
        m_patience = first;
    }

    /// Whether it is to be replaced now, to which one answer is given: the next one has twice the time.
    bool isDue(Instant now)
    {
        if (now - m_well < m_patience)
            return false;
        m_patience = std::min<Duration>(2 * m_patience, longest);
        m_well = now;
        return true;
    }

private:
    Instant m_well; ///< the last time that it did its work, or when it was started
    Duration m_patience = first;
};

} // namespace console
