// From what a procedure asks of a line to the phases in which it is measured.
#pragma once

#include "line_profile.hpp"

#include <liena/device_id.hpp>
#include <liena/measurement.hpp>

#include <chrono>
#include <cstdint>
#include <string>

namespace liena::tools {

/// All phases together stay within what a device grants, MeasuringLimits::longest.
inline constexpr int mostSeconds = 250;

/// Of the paced phases: until there is enough behind each figure that the profile limits, though 7 at least. `inUse`: at the rates that a
/// device in use grants.
std::chrono::seconds enoughFor(const LineProfile& profile, bool inUse);

/// Of devices at rest: all phases of line_verdict.hpp. `whole` is for the paced ones; the others take half of it.
MeasurementPlan benchPlan(const LineProfile& profile, std::chrono::seconds whole, std::uint32_t commandBytes);

/// What a running device is asked for in its session with `peer`, as a line for its status socket: just the rates of the profile.
std::string liveOrder(DeviceId peer, const LineProfile& profile, std::chrono::seconds whole, std::uint32_t commandBytes);

} // namespace liena::tools
