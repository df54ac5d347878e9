// What every measured message carries: its number and when it was due to leave.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace liena::compare {

using Clock = std::chrono::steady_clock; ///< CLOCK_MONOTONIC: one clock for both ends, since they are on one computer
using Instant = Clock::time_point;
using Nanoseconds = std::chrono::nanoseconds;

inline std::int64_t nowNs() { return std::chrono::duration_cast<Nanoseconds>(Clock::now().time_since_epoch()).count(); }

struct Stamp {
    std::uint64_t number = 0; ///< 0: sent while warming up, not to be counted
    std::int64_t sentNs = 0;
};

/// The number of the last command of a run: the receiver tells what it counted.
inline constexpr std::uint64_t lastNumber = ~std::uint64_t{0};

/// Frames may come in two streams. Their numbers alone say in which, so that each transport carries it; each stream counts by itself.
inline constexpr std::size_t mostStreams = 2;
inline constexpr unsigned streamBit = 63;

constexpr std::uint64_t frameNumber(std::size_t stream, std::uint64_t count) { return std::uint64_t{stream} << streamBit | count; }
constexpr std::size_t streamOf(const Stamp& frame) { return frame.number >> streamBit; }
constexpr std::uint64_t countOf(const Stamp& frame) { return frame.number & ~(std::uint64_t{1} << streamBit); } ///< 0: as of Stamp

/// 64 bytes.
struct Command {
    Stamp stamp;
    std::array<double, 6> values{};
};
static_assert(sizeof(Command) == 64);

} // namespace liena::compare
