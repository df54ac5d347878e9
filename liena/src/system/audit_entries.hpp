// Which events of the sessions belong into the audit file, and with which words.
#pragma once

#include "audit/audit_chain.hpp"
#include "liena/message_set.hpp"
#include "liena/session_event.hpp"
#include "liena/system_topology.hpp"

#include <optional>

namespace liena::system {

/// Nothing for events that decide nothing, such as figures and passing silence. Messages that were dropped count when they are commands of
/// `ownSet`.
std::optional<audit::Entry> auditEntryOf(const SessionEvent& event, const SystemTopology& topology, const MessageSet& ownSet);

/// The device's name, or its id when the topology does not have it.
std::string nameIn(const SystemTopology& topology, DeviceId device);

} // namespace liena::system
