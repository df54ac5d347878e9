// The sound of each priority, after the conventions of IEC 60601-1-8.
#include "model/alarm_burst.hpp"

namespace console {

using namespace std::chrono_literals;

namespace {

std::vector<SoundPulse> pulses(const std::vector<std::chrono::milliseconds>& starts, std::chrono::milliseconds length, double pitch)
{
    std::vector<SoundPulse> all;
    all.reserve(starts.size());
    for (const auto start : starts)
        all.push_back({start, length, pitch});
    return all;
}

} // namespace

std::vector<SoundPulse> burstOf(AlarmPriority priority)
{
    switch (priority) {
    case AlarmPriority::High:
        return pulses({0ms, 220ms, 440ms, 780ms, 1000ms, 1620ms, 1840ms, 2060ms, 2400ms, 2620ms}, 120ms, 660);
    case AlarmPriority::Medium:
        return pulses({0ms, 380ms, 760ms}, 180ms, 523);
    case AlarmPriority::Low:
        break;
    }
    return pulses({0ms, 450ms}, 200ms, 392);
}

std::chrono::milliseconds burstLength(AlarmPriority priority)
{
    const auto last = burstOf(priority).back();
    return last.start + last.length;
}

std::optional<std::chrono::milliseconds> burstRepeat(AlarmPriority priority)
{
    switch (priority) {
    case AlarmPriority::High:
        return 5s;
    case AlarmPriority::Medium:
        return 10s;
    case AlarmPriority::Low:
        break;
    }
    return std::nullopt;
}

} // namespace console
