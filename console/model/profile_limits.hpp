// What a kind of procedure asks of pictures and lines while instruments move: the thresholds that depend on it, in one place.
#pragma once

#include <chrono>
#include <cstdint>

namespace console {

enum class PictureProfile : std::uint8_t { Neuro, Coronary };

/// How old a picture may be, and how long commands may take there and back.
constexpr std::chrono::milliseconds ageLimit(PictureProfile profile)
{
    return profile == PictureProfile::Neuro ? std::chrono::milliseconds(250) : std::chrono::milliseconds(400);
}

/// From here on commands are slow enough to be told, in every profile.
inline constexpr std::chrono::milliseconds roundTripCaution{150};

/// Above the first of each pair the line is told to be bad; it is good again below the second.
struct LineLimits {
    double jitterMs = 0; ///< smoothed, as RFC 3550 section 6.4.1 has it: single heartbeats lie several times as far off
    double jitterGoodMs = 0;
    double lossPercent = 0; ///< of the heartbeats of the last ten seconds
    double lossGoodPercent = 0;
};

/// Our own judgement. Jitter: with a mean of 10 ms one heartbeat in a hundred is off by the 50 ms after which the reference robot refuses a
/// command. Loss: up to 1 in 1000 is what ITU-T Y.1541 has for good lines, and the control path is tested with fifty times as much.
constexpr LineLimits lineLimits(PictureProfile profile)
{
    return profile == PictureProfile::Neuro ? LineLimits{10, 7, 1, 0.5} : LineLimits{15, 10, 1, 0.5};
}

} // namespace console
