// Rates and sizes of a profile, and how many are under way where as many go as can.
#include "bench_plan.hpp"

#include "line_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace liena::tools {

namespace {

constexpr std::uint32_t mostAtOnce = 1024;    // that a device takes
constexpr std::uint32_t commandsAtOnce = 256; // more are a queue on a narrow line that heartbeats wait behind: 40 kB, 32 ms of 10 Mbit/s

/// 8 MiB, or a second of the rate that the profile asks for: a line of 200 ms shows 42 MB/s, and none is taken for narrow because it is
/// long. The device that sends them has one image in memory, and under a kilobyte for each that waits.
std::uint32_t imagesAtOnce(const LineProfile& profile)
{
    constexpr double leastBytes = 8U << 20U;
    constexpr double fewest = 3;
    const auto limits = profile.limits.find(Figure::ImageRate);
    const double asked = limits != profile.limits.end() ? limits->second.go * 1e6 : 0;
    const double images = std::ceil(std::max(asked, leastBytes) / std::max<double>(1, profile.imageBytes));
    return static_cast<std::uint32_t>(std::clamp<double>(images, fewest, mostAtOnce));
}

} // namespace

MeasurementPlan benchPlan(const LineProfile& profile, std::chrono::seconds whole, std::uint32_t commandBytes)
{
    const auto half = std::chrono::nanoseconds(whole) / 2;
    const ProbeStream paced{profile.commandsPerSecond, 0, commandBytes};
    // As many commands as go come last: on a narrow line some are still on their way when their phase is over, before whatever follows.
    return {{phases::paced, whole, paced, paced, {}},
            {phases::backToBack, half, {0, 1, commandBytes}, {}, {}},
            {phases::besideImages, whole, paced, paced, {profile.framesPerSecond, 0, profile.imageBytes}},
            {phases::images, half, {}, {}, {0, imagesAtOnce(profile), profile.imageBytes}},
            {phases::messages, half, {0, commandsAtOnce, commandBytes}, {}, {}}};
}

std::string liveOrder(DeviceId peer, const LineProfile& profile, std::chrono::seconds whole, std::uint32_t commandBytes)
{
    return fmt::format("measure {} {} {:.10g} {} {:.10g} {}\n", peer.toString(), whole.count(), profile.commandsPerSecond, commandBytes,
                       profile.framesPerSecond, profile.imageBytes);
}

} // namespace liena::tools
