// What a measuring program asks of what it measured, and whether that was so.
#pragma once

#include "percentiles.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <vector>

/// How programs end that hold what they measured against limits. A limit that could not be told is one that was not kept.
constexpr int endKept = 0;
constexpr int endNotKept = 1;
constexpr int endWrongCall = 2;
constexpr int endNotMeasured = 3; ///< the run did not go as it should

enum class Bound : std::uint8_t { AtMost, AtLeast };

struct Limit {
    const char* what;
    Bound bound;
    double value;
    const char* unit;
    const char* needs; ///< what it takes to tell
};

/// Prints a line; true when it was kept. Nothing measured: there was too little to tell it from.
inline bool judge(const Limit& limit, std::optional<double> measured)
{
    const char* const word = limit.bound == Bound::AtMost ? "at most" : "at least";
    if (!measured) {
        std::printf("  not told  %s: it takes %s to tell; asked for: %s %.1f %s\n", limit.what, limit.needs, word, limit.value, limit.unit);
        return false;
    }
    const bool kept = limit.bound == Bound::AtMost ? *measured <= limit.value : *measured >= limit.value;
    std::printf("  %s  %s: %.1f %s; asked for: %s %.1f\n", kept ? "kept    " : "NOT KEPT", limit.what, *measured, limit.unit, word,
                limit.value);
    return kept;
}

/// The 99th percentile; nothing of fewer than a hundred values, of which it would be the largest.
inline std::optional<double> p99Of(const std::vector<double>& values)
{
    constexpr std::size_t fewest = 100;
    return values.size() < fewest ? std::nullopt : std::optional(percentileOf(values, 0.99));
}

/// From values[first] to the last one; nothing of fewer than `fewest` values.
inline std::optional<double> growthSince(const std::vector<double>& values, std::size_t first, std::size_t fewest)
{
    return values.size() < fewest || values.size() <= first ? std::nullopt : std::optional(values.back() - values[first]);
}
