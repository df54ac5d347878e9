// The real message sets of the reference devices, read once.
#pragma once

#include "liena/message_set.hpp"
#include "scenario.hpp"

namespace liena::simulation {

/// Ends the program when a file of resources/devices cannot be read: nothing can be simulated without.
std::shared_ptr<const MessageSet> messageSetOf(DeviceKind kind);

} // namespace liena::simulation
