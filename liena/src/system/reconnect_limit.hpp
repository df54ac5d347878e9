// How long one attempt to connect a broken lane may take.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

namespace liena::system {

/// TCP and TLS need two round trips before the lane stands: an attempt that is given less never succeeds, however often it is made. On a
/// short way it is short, so that a first packet that was lost in a cut does not hold up what could stand soon after.
inline std::chrono::nanoseconds reconnectLimit(std::optional<std::chrono::nanoseconds> roundTrip)
{
    using namespace std::chrono_literals;
    return std::clamp<std::chrono::nanoseconds>(4 * roundTrip.value_or(0ns), 250ms, 1s);
}

} // namespace liena::system
