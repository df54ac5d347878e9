// Figures that more than one part of PathRate goes by.
#pragma once

#include "transport/path_facts.hpp"

#include <chrono>

namespace liena::tasks::path_figures {

using namespace std::chrono_literals;

inline constexpr auto gentlePause = 20ms;      // between two steps near the ceiling
inline constexpr auto longWay = 10ms;          // there and back: from here on round trips vary by milliseconds
inline constexpr auto mostUnrest = 8ms;        // that is taken for one: what is longer is a queue
inline constexpr double settling = 0.002;      // seconds in which the smoothed round trip forgets
inline constexpr double used = 0.7;            // of the rate: less delivered proves nothing
inline constexpr double doubtful = 0.5;        // of the rate: whatever makes it fall further at once is to be seen twice
inline constexpr double mostThatIsSent = 0.85; // by a path that may be long
inline constexpr double inOnePiece = 2896;     // bytes: two packets, which the kernel sends and acknowledges together

inline double secondsOf(std::chrono::nanoseconds time) { return std::chrono::duration<double>(time).count(); }

/// Bytes. Counts the SYN.
inline double underWay(const transport::PathFacts& facts)
{
    return static_cast<double>(facts.bytesSent) - static_cast<double>(facts.bytesAcknowledged);
}

} // namespace liena::tasks::path_figures
