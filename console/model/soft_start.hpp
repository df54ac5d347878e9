// Motion never jumps in: after each engage it grows from a quarter to what was set.
#pragma once

#include "model/hand_state.hpp"
#include "model/instant.hpp"

#include <chrono>

namespace console {

inline constexpr std::chrono::seconds softStartTime{2};
inline constexpr double softStartShare = 0.25;

/// The share of the set motion after `engagedFor`: a quarter at first, all of it after two seconds.
double softStart(Duration engagedFor);

HandMotion scaled(const HandMotion& motion, double factor);

} // namespace console
