// From what a procedure asks of a line to the phases in which it is measured.
#pragma once

#include "line_profile.hpp"

#include <liena/device_id.hpp>
#include <liena/measurement.hpp>

#include <chrono>
#include <cstdint>
#include <string>

namespace liena::tools {

/// Of devices at rest: all phases of line_verdict.hpp. `whole` is for the paced ones; the others take half of it.
MeasurementPlan benchPlan(const LineProfile& profile, std::chrono::seconds whole, std::uint32_t commandBytes);

/// What a running device is asked for in its session with `peer`, as a line for its status socket: just the rates of the profile.
std::string liveOrder(DeviceId peer, const LineProfile& profile, std::chrono::seconds whole, std::uint32_t commandBytes);

} // namespace liena::tools
