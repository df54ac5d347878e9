// This process's wall clock, which the lab sets back and forth; the host's clock and the monotonic one stay as they are.
#pragma once

#include <chrono>

namespace liena::lab {

/// Adds `step` to what every later reading of the wall clock in this process gives, the library's and OpenSSL's too.
void stepWallClock(std::chrono::milliseconds step);

} // namespace liena::lab
