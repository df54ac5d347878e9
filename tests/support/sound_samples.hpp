// What is heard in samples, 16 bit of one channel at 44.1 kHz.
#pragma once

#include "model/instant.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numbers>

namespace console::test {

constexpr int soundRate = 44100;
constexpr double loud = 1000; ///< of some samples, root of the mean square
constexpr int noise = 100;    ///< at most, of one sample

inline bool isSound(std::int16_t sample) { return std::abs(int(sample)) > noise; }

inline Duration durationOf(std::size_t samples) { return std::chrono::nanoseconds(std::llround(double(samples) * 1e9 / soundRate)); }

inline double loudness(const std::int16_t* samples, std::size_t count)
{
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i)
        sum += double(samples[i]) * samples[i];
    return std::sqrt(sum / double(count));
}

/// How much of one frequency is in the samples, after Goertzel.
inline double power(const std::int16_t* samples, std::size_t count, double frequency)
{
    const double turn = 2 * std::cos(2 * std::numbers::pi * frequency / soundRate);
    double last = 0;
    double before = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double next = samples[i] + turn * last - before;
        before = last;
        last = next;
    }
    return last * last + before * before - turn * last * before;
}

} // namespace console::test
