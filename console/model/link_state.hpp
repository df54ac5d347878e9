// The state of one link, with one word per state that is used everywhere on the screen.
#pragma once

#include <QString>

#include <chrono>
#include <cstdint>

namespace console {

/// Of a link whose topology says nothing else.
inline constexpr std::chrono::milliseconds usualHeartbeat{20};

/// As the protocol has them (section 8).
enum class LinkState : std::uint8_t { Closed, Opening, Open, Suspect, Reconnecting, StandBy, Reopening, Closing };

/// closed, opening, open, suspect, interrupted, stand-by, re-opening, closing.
QString word(LinkState state);

/// Application messages flow: Open or Suspect.
constexpr bool carriesMessages(LinkState state) { return state == LinkState::Open || state == LinkState::Suspect; }

/// A dialogue with the peer is in hand: neither up nor down.
constexpr bool isChanging(LinkState state)
{
    return state == LinkState::Opening || state == LinkState::Reopening || state == LinkState::Closing;
}

/// Something a person should look at: suspect, interrupted or stand-by.
constexpr bool isTrouble(LinkState state)
{
    return state == LinkState::Suspect || state == LinkState::Reconnecting || state == LinkState::StandBy;
}

/// What a person may ask for in a state.
constexpr bool mayOpen(LinkState state) { return state == LinkState::Closed; }
constexpr bool mayClose(LinkState state)
{
    return state == LinkState::Open || state == LinkState::Suspect || state == LinkState::Reconnecting;
}
constexpr bool mayReopen(LinkState state) { return state == LinkState::StandBy; }

} // namespace console
