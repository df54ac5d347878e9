// The console's clock: points in time for ages, durations for a person.
#pragma once

#include <chrono>

namespace console {

/// Monotonic. Functions of the model take the present as `now`; none of them reads a clock.
using Instant = std::chrono::steady_clock::time_point;
using Duration = std::chrono::nanoseconds;

/// Milliseconds as a number for a figure on the screen.
constexpr double milliseconds(Duration duration) { return std::chrono::duration<double, std::milli>(duration).count(); }
constexpr double seconds(Duration duration) { return std::chrono::duration<double>(duration).count(); }

/// The duration nearest to a number of milliseconds.
constexpr Duration fromMilliseconds(double value) { return Duration(static_cast<Duration::rep>(value * 1e6)); }

} // namespace console
