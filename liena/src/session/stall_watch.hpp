// Notices that this process itself did not run (protocol section 8, LocalStall).
#pragma once

#include "session/instant.hpp"

#include <optional>

namespace liena::session {

/// Told of every turn of the network thread, before the turn acts on anything it reads. While it watches, a turn comes at least each
/// heartbeat, so a longer gap means that the process was stopped or starved, or the computer suspended: the clock must be one that goes on
/// meanwhile.
class StallWatch {
public:
    /// Nothing is expected to turn until resume().
    void pause() { m_last.reset(); }

    bool isWatching() const { return m_last.has_value(); }

    /// The gap since the last turn; call it once per turn.
    Nanoseconds turn(Instant now)
    {
        const auto gap = m_last ? now - *m_last : Nanoseconds::zero();
        m_last = now;
        return gap;
    }

private:
    std::optional<Instant> m_last;
};

} // namespace liena::session
