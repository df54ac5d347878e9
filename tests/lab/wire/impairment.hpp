// What one direction between two devices does to a frame: seeded decisions, without I/O or clock.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>

namespace liena::lab {

using Nanoseconds = std::chrono::nanoseconds;
using SteadyTime = std::chrono::steady_clock::time_point;

enum class Protocol : std::uint8_t { Any, Tcp, Udp };

struct Impairment {
    bool cut = false;      ///< nothing passes
    double drop = 0;       ///< probability, each frame by itself
    double burstStart = 0; ///< Gilbert-Elliott: probability that a frame begins a burst in which all frames are lost
    double burstEnd = 1;   ///< probability that a frame is the burst's last: its mean length is 1 / burstEnd
    double duplicate = 0;  ///< probability
    double corrupt = 0;    ///< probability that one bit is turned
    double reorder = 0;    ///< probability that a frame is held back by `reorderBy`, so that later ones pass it
    Nanoseconds reorderBy{};
    Nanoseconds delay{};
    Nanoseconds jitter{};            ///< added, uniform from 0; order is kept
    Nanoseconds ramp{};              ///< growth of the delay per second since the setting
    Nanoseconds rampEnd{};           ///< the growth stops there
    std::size_t largest = 0;         ///< longer frames are lost without a word; 0: none
    Protocol only = Protocol::Any;   ///< what loss of any kind concerns; delays concern everything
    std::optional<SteadyTime> since; ///< of the setting
};

struct Decision {
    bool drop = false;
    bool duplicate = false;
    bool overtaken = false;               ///< held back: does not wait for its order, nor others for it
    std::optional<std::size_t> turnedBit; ///< in the frame
    Nanoseconds delay{};
};

/// The decisions for the frames of one direction. The n-th frame of two runs with one seed and one setting meets the same fate,
/// whenever it comes: each frame draws the same count of numbers.
class ImpairmentDraw {
public:
    explicit ImpairmentDraw(std::uint64_t seed) : m_random(seed) {}

    Decision decide(const Impairment& impairment, Protocol protocol, std::size_t size, SteadyTime now);

private:
    double draw(); ///< uniform in [0, 1)
    bool inBurst(const Impairment& impairment, double begins, double ends);

    std::mt19937_64 m_random;
    bool m_burst = false;
};

} // namespace liena::lab
