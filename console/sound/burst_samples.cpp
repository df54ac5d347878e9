// The bursts as sound samples.
#include "sound/burst_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace console {

namespace {

constexpr std::array<double, 5> harmonics{1.0, 0.7, 0.5, 0.35, 0.25};
constexpr double loudness = 0.8; ///< of the largest possible sample
constexpr double edge = 0.02;    ///< s, rise and fall

std::size_t samplesIn(std::chrono::milliseconds time) { return static_cast<std::size_t>(time.count()) * sampleRate / 1000; }

double sampleAt(const SoundPulse& pulse, double t)
{
    const double length = static_cast<double>(pulse.length.count()) / 1000;
    const double envelope = std::clamp(std::min(t, length - t) / edge, 0.0, 1.0);
    double value = 0;
    double most = 0;
    for (std::size_t i = 0; i < harmonics.size(); ++i) {
        value += harmonics.at(i) * std::sin(2 * std::numbers::pi * pulse.pitch * static_cast<double>(i + 1) * t);
        most += harmonics.at(i);
    }
    return loudness * envelope * value / most;
}

} // namespace

QByteArray burstSamples(AlarmPriority priority)
{
    std::vector<std::int16_t> samples(samplesIn(burstLength(priority)), 0);
    for (const auto& pulse : burstOf(priority)) {
        const auto first = samplesIn(pulse.start);
        const auto last = std::min(samples.size(), first + samplesIn(pulse.length));
        for (auto i = first; i < last; ++i)
            samples[i] = static_cast<std::int16_t>(32767 * sampleAt(pulse, static_cast<double>(i - first) / sampleRate));
    }
    return {reinterpret_cast<const char*>(samples.data()), static_cast<qsizetype>(samples.size() * sizeof(std::int16_t))};
}

} // namespace console
