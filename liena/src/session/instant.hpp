// The two clocks that pure code is told: monotonic for every decision, wall for stamps.
#pragma once

#include "liena/timestamp.hpp"

#include <chrono>

namespace liena::session {

using Instant = std::chrono::steady_clock::time_point;
using Nanoseconds = std::chrono::nanoseconds;

struct Now {
    Instant mono;
    Timestamp wall;
};

} // namespace liena::session
