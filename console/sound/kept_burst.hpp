// The burst that has not sounded yet, for the player that can.
#pragma once

#include "model/instant.hpp"
#include "sound/player_words.hpp"

#include <chrono>
#include <optional>

namespace console {

/// The newest only. No clock of its own.
class KeptBurst {
public:
    /// Its alarm is over by then, or has been repeated.
    static constexpr std::chrono::seconds longest{30};

    void keep(PlayerOrder burst, Instant now)
    {
        m_burst = burst;
        m_since = now;
    }

    /// It has sounded, or nobody wants it any more.
    void forget() { m_burst.reset(); }

    bool isTooOld(Instant now) const { return m_burst && now - m_since > longest; }
    std::optional<PlayerOrder> at(Instant now) const { return isTooOld(now) ? std::nullopt : m_burst; }

private:
    std::optional<PlayerOrder> m_burst;
    Instant m_since;
};

} // namespace console
