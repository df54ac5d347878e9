// How the bulk lanes of a peer share what its path carries.
#pragma once

#include "tasks/path_rate.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace liena::tasks {

/// What one lane knows; in bytes per second.
struct LaneRate {
    double steady = 0;              ///< at which it would send alone; 0: it is not paced or has no connection
    std::optional<KnownRate> known; ///< that the path carried of its bytes
    bool inUse = true;              ///< by a stream
};

/// Pure. Each lane as much of the limit as it has of what all that are in use would send. Who is not in use takes nothing from them; it has
/// what would be its part, for when it begins. A lane that is not paced or has no connection is not limited, since its rate is not known
/// before it stands.
inline std::vector<std::optional<double>> sharesOf(std::optional<double> limit, std::span<const LaneRate> lanes)
{
    double sum = 0;
    for (const auto& lane : lanes)
        sum += lane.inUse ? lane.steady : 0;
    std::vector<std::optional<double>> shares;
    for (const auto& lane : lanes)
        shares.push_back(limit && lane.steady > 0 ? std::optional(*limit * lane.steady / (lane.inUse ? sum : sum + lane.steady))
                                                  : std::nullopt);
    return shares;
}

/// Pure. That the lanes are carried at together. Those in use share the path. The others had it before or after each other: of them the
/// fastest counts, and only where nothing is known of those in use.
inline std::optional<KnownRate> togetherOf(std::span<const LaneRate> lanes)
{
    std::optional<KnownRate> sum;
    std::optional<KnownRate> fastest;
    for (const auto& lane : lanes) {
        const auto& known = lane.known;
        if (known && lane.inUse)
            sum = sum ? KnownRate{sum->bytesPerSecond + known->bytesPerSecond, std::min(sum->shown, known->shown)} : *known;
        if (known && (!fastest || known->bytesPerSecond > fastest->bytesPerSecond))
            fastest = known;
    }
    return sum ? sum : fastest;
}

/// Pure. At which another lane begins beside so many that are in use: with its part of what they are known to be carried at, and never
/// faster than where nothing is known.
inline double beginningBeside(std::optional<KnownRate> together, std::size_t inUse)
{
    return together ? std::min(together->bytesPerSecond / static_cast<double>(inUse + 1), PathRate::first) : PathRate::first;
}

} // namespace liena::tasks
