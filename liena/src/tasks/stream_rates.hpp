// What each bulk stream can count on of the lanes that several share.
#pragma once

#include "liena/session_event.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace liena::tasks {

struct PlacedStream {
    std::uint16_t number = 0; ///< of its message
    std::size_t place = 0;    ///< of its lane
};

/// Pure. Streams on one lane take even turns; where nothing is known of a lane, its streams have no rate.
inline std::vector<BulkStream> ratesOf(std::span<const PlacedStream> inUse, std::span<const std::optional<double>> lanes)
{
    std::vector<BulkStream> rates;
    for (const auto& stream : inUse) {
        auto rate = lanes[stream.place];
        if (rate)
            *rate /= static_cast<double>(std::ranges::count(inUse, stream.place, &PlacedStream::place));
        rates.push_back({stream.number, rate});
    }
    return rates;
}

} // namespace liena::tasks
