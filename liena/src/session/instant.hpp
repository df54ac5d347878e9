// The two clocks that pure code is told: monotonic for every decision, wall for stamps.
#pragma once

#include "liena/timestamp.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace liena::session {

using Instant = std::chrono::steady_clock::time_point;
using Nanoseconds = std::chrono::nanoseconds;

struct Now {
    Instant mono;
    Timestamp wall;
};

/// later − earlier of two wall clocks. A peer may say any time: beyond 73 years the difference is cut, so that sums of two never overflow.
inline Nanoseconds difference(Timestamp later, Timestamp earlier)
{
    constexpr auto most = std::int64_t{1} << 61U;
    return Nanoseconds(std::clamp(static_cast<std::int64_t>(later.ns - earlier.ns), -most, most));
}

} // namespace liena::session
