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

/// From here on commands are slow enough to be told, in every profile. Above ageLimit() nobody arms; above the last one motion ends.
inline constexpr std::chrono::milliseconds roundTripCaution{150};
inline constexpr std::chrono::milliseconds roundTripHold{450};

/// Two clocks that are compared less well than this do not tell how old a picture or a report is. Over a line whose round trip may just be
/// armed over they are compared to within half of it: no better is possible there (RFC 5905), and no worse is taken.
template <typename Span>
constexpr Span clockUncertaintyLimit(Span ageLimit)
{
    return ageLimit / 2;
}

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
