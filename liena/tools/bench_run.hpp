// Making a measurement: in a session of our own, between two devices of this program, or inside a device that runs.
#pragma once

#include <liena/distributed_system.hpp>

#include <chrono>
#include <filesystem>
#include <string>

namespace liena::tools {

struct BenchEnds {
    Settings from; ///< of the device whose place is taken
    std::string to;
    std::chrono::seconds openLimit{10};
};

/// Ends early, and closes in order, when this process is told to end (SIGINT, SIGTERM). Blocks.
Result<Measurement> measureAsDevice(const BenchEnds& ends, const MeasurementPlan& plan);

/// Both devices of that link on this computer, with ports, certificates and a topology of their own for the moment.
Result<Measurement> measureLocally(const SystemTopology& topology, const TopologyDevice& from, const TopologyDevice& to,
                                   const std::vector<std::filesystem::path>& registry, const MeasurementPlan& plan);

struct LiveRequest {
    std::filesystem::path socket; ///< of the running device
    std::string device;
    std::string order; ///< liveOrder()
    std::chrono::seconds whole{5};
};

/// Asks a running device of this user to measure inside its own session.
Result<Measurement> measureLive(const LiveRequest& request);

} // namespace liena::tools
