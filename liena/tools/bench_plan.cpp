// Rates and sizes of a profile, and how many are under way where as many go as can.
#include "bench_plan.hpp"

#include "line_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace liena::tools {

namespace {

constexpr std::uint32_t mostAtOnce = 1024; // that a device takes

/// More are a queue on a narrow line that heartbeats wait behind: 45 kB are 36 ms of 10 Mbit/s.
std::uint32_t commandsAtOnce(std::uint32_t commandBytes)
{
    constexpr std::uint32_t mostBytes = 45'000;
    constexpr std::uint32_t headers = 110; // of probe, TLS, TCP and IP
    return std::min(256U, mostBytes / (commandBytes + headers));
}

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

std::chrono::seconds enoughFor(const LineProfile& profile, bool inUse)
{
    constexpr double shortest = 7;    // of a line that varies, less tells little
    constexpr double mostInUse = 100; // commands, and as many packets: MeasuringBudget::inUse
    constexpr double reserve = 1.02;  // for what is late
    const double commands = inUse ? std::min(profile.commandsPerSecond, mostInUse) : profile.commandsPerSecond;
    double seconds = shortest;
    const auto need = [&seconds](double count, double perSecond) { seconds = std::max(seconds, reserve * count / perSecond); };
    for (const auto& [figure, limits] : profile.limits)
        switch (figure) {
        case Figure::RoundTrip:
        case Figure::RoundTripBesideImages:
            need(neededFor(99), commands);
            break;
        case Figure::TailBesideImages:
        case Figure::Jitter:
        case Figure::JitterBesideImages:
            need(neededFor(99.9), commands);
            break;
        case Figure::Loss:
            need(neededForLoss(limits.go), 2 * commands); // packets of both phases
            break;
        case Figure::CommandsCarried:
            need(neededFor(limits.go), commands);
            break;
        case Figure::ImagesCarried:
            need(neededFor(limits.go), profile.framesPerSecond);
            break;
        case Figure::ImageDelivery:
            need(neededFor(99), profile.framesPerSecond);
            break;
        case Figure::ImageRate:
            break;
        }
    return std::chrono::seconds(static_cast<int>(std::ceil(std::min<double>(seconds, mostSeconds))));
}

MeasurementPlan benchPlan(const LineProfile& profile, std::chrono::seconds whole, std::uint32_t commandBytes)
{
    const auto half = std::chrono::nanoseconds(whole) / 2;
    const ProbeStream paced{profile.commandsPerSecond, 0, commandBytes};
    // As many commands as go come last: on a narrow line some are still on their way when their phase is over, before whatever follows.
    return {{phases::paced, whole, paced, paced, {}},
            {phases::backToBack, half, {0, 1, commandBytes}, {}, {}},
            {phases::besideImages, whole, paced, paced, {profile.framesPerSecond, 0, profile.imageBytes}},
            {phases::images, half, {}, {}, {0, imagesAtOnce(profile), profile.imageBytes}},
            {phases::messages, half, {0, commandsAtOnce(commandBytes), commandBytes}, {}, {}}};
}

std::string liveOrder(DeviceId peer, const LineProfile& profile, std::chrono::seconds whole, std::uint32_t commandBytes)
{
    return fmt::format("measure {} {} {:.10g} {} {:.10g} {}\n", peer.toString(), whole.count(), profile.commandsPerSecond, commandBytes,
                       profile.framesPerSecond, profile.imageBytes);
}

} // namespace liena::tools
