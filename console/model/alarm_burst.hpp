// The sound of each priority, as numbers: when its pulses begin and how they sound.
#pragma once

#include "model/alarm_list.hpp"
#include "model/instant.hpp"

#include <chrono>
#include <optional>
#include <vector>

namespace console {

struct SoundPulse {
    std::chrono::milliseconds start; ///< after the burst's beginning
    std::chrono::milliseconds length;
    double pitch = 0; ///< Hz, of the fundamental
};

/// High: two groups of five. Medium: three. Low: two, deeper and slower. Told apart by rhythm alone, by whoever cannot hear the pitch.
std::vector<SoundPulse> burstOf(AlarmPriority priority);

/// From the first pulse's beginning to the last one's end.
std::chrono::milliseconds burstLength(AlarmPriority priority);

/// From one burst's beginning to the next; nothing: it sounds once.
std::optional<std::chrono::milliseconds> burstRepeat(AlarmPriority priority);

} // namespace console
