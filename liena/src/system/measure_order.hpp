// What `liena bench --live` asks of a running device, as one line of text.
#pragma once

#include "liena/device_id.hpp"
#include "liena/error.hpp"
#include "liena/measurement.hpp"

#include <cstdint>
#include <string_view>

namespace liena::system {

/// `measure 0x00008208 5 500 64 7.5 524288`: peer, seconds of each phase, commands a second, bytes of a command, images a second, bytes of
/// an image.
struct MeasureOrder {
    DeviceId peer;
    std::uint32_t seconds = 0;
    double commandsPerSecond = 0;
    std::uint32_t commandBytes = 0;
    double imagesPerSecond = 0;
    std::uint32_t imageBytes = 0;

    /// Strict: just these words, within their bounds.
    static Result<MeasureOrder> parse(std::string_view line);

    /// Only phases that do not try to fill the line.
    MeasurementPlan plan() const;
};

} // namespace liena::system
