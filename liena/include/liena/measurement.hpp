// Measuring the line between two devices inside their session: what is sent, what a device allows, and what was found.
#pragma once

#include "liena/latency_histogram.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace liena {

/// How much of measuring; 0 is no limit.
struct MeasuringLimits {
    std::uint32_t probesPerSecond = 0;    ///< small messages and packets together
    std::uint64_t bulkBytesPerSecond = 0; ///< images
    std::chrono::seconds longest{900};    ///< one measurement; not 0

    friend bool operator==(const MeasuringLimits&, const MeasuringLimits&) = default;
};

/// What a device lets measurements take, its own and those of its peers. It is in use while commands, safety messages or images of its
/// applications were sent or delivered within the last ten seconds, on any of its sessions. A measurement ends when that begins, and
/// while it lasts one line of the device is measured at a time, by whichever end: the budget is not each measurement's.
struct MeasuringBudget {
    bool allowed = true;
    MeasuringLimits atRest;
    MeasuringLimits inUse{200, 4'000'000, std::chrono::seconds(120)};
    double share = 0.1; ///< in use: of the rate that bulk to the peer is known to be carried at
};

/// One kind of what a measurement sends: in a rhythm, or so many on their way at once, at most 1 024; nothing when both are 0. Of a rhythm,
/// too, so many commands are on their way at most, and of images what is due in a second. All images are the same bytes: whoever sends has
/// one in memory, and less than a megabyte for those that wait.
struct ProbeStream {
    double perSecond = 0;
    std::uint32_t atOnce = 0;
    std::uint32_t bytes = 64; ///< of padding: at most 1 024, of an image 8 MiB

    bool isUsed() const { return perSecond > 0 || atOnce > 0; }
};

struct MeasurementPhase {
    std::string name;
    std::chrono::nanoseconds duration = std::chrono::seconds(5);
    ProbeStream prompt{};  ///< on lane 0, as commands travel; behind every real one
    ProbeStream packets{}; ///< by UDP, as heartbeats travel
    ProbeStream images{};  ///< on a bulk lane
};

/// Phases one after another.
using MeasurementPlan = std::vector<MeasurementPhase>;

struct ProbeFigures {
    ProbeStream asked;
    double perSecond = 0;             ///< after the limits; 0: as fast as echoes came
    bool limited = false;             ///< less than asked, because of the budget
    std::uint64_t sent = 0;           ///< accepted for sending
    std::uint64_t withheld = 0;       ///< were due and not sent: too many were under way, or this device stood still for a second
    std::uint64_t heard = 0;          ///< by the peer, as far as an echo said so
    std::uint64_t echoed = 0;         ///< echoes that came back
    std::chrono::nanoseconds spent{}; ///< from the first that was sent to the last echo
    LatencyHistogram roundTrip;       ///< from when it was due, so that what a late sender costs counts as well
};

struct PhaseFigures {
    std::string name;
    ProbeFigures prompt;
    ProbeFigures packets;
    ProbeFigures images;
};

struct Measurement {
    std::string failure;       ///< empty when every phase was measured; else why not
    bool inUse = false;        ///< one of the devices was in use, so the limits were those for that
    bool imagesFlowed = false; ///< of the application, on this session meanwhile: those that measure waited behind them
    MeasuringLimits limits;
    std::optional<double> bulkRate;         ///< bytes per second that the path to the peer carries, as its images found; nothing: not known
    std::chrono::nanoseconds bulkRateAge{}; ///< since they last filled the path
    std::vector<PhaseFigures> phases;       ///< those that ended
};

/// One JSON object on one line; docs/OPERATING.md says what its fields are.
std::string toJson(const Measurement& measurement);

} // namespace liena
