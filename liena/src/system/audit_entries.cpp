// From events to audit entries.
#include "system/audit_entries.hpp"

#include <fmt/format.h>

namespace liena::system {

namespace {

using Kind = SessionEvent::Kind;

std::string milliseconds(std::chrono::nanoseconds duration)
{
    return fmt::format("{} ms", std::chrono::duration_cast<std::chrono::milliseconds>(duration).count());
}

std::string pairOf(const Incident& incident, const SystemTopology& topology)
{
    return fmt::format("{} and {}: {}", nameIn(topology, incident.a), nameIn(topology, incident.b), toString(incident.cause));
}

audit::Entry made(std::string event, std::string text)
{
    audit::Entry entry;
    entry.event = std::move(event);
    entry.text = std::move(text);
    return entry;
}

std::optional<audit::Entry> ofSession(const SessionEvent& event)
{
    switch (event.kind) {
    case Kind::Opened:
        return made("session-opened", milliseconds(event.duration));
    case Kind::OpenFailed:
        return made("open-failed", fmt::format("{}: {}", toString(event.reason), event.detail));
    case Kind::Closed:
        return made("session-closed", event.detail);
    case Kind::Interrupted:
        return made("session-interrupted", milliseconds(event.duration));
    case Kind::Lost:
        return made("session-lost", fmt::format("{}: {}", toString(event.diagnosis.cause), event.diagnosis.detail));
    case Kind::ReOpened:
        return made("session-reopened", milliseconds(event.duration));
    case Kind::IdentityRefused:
        return made("handshake-refused", fmt::format("{}{}", event.detail, event.count > 1 ? fmt::format(" ({} times)", event.count) : ""));
    default:
        return std::nullopt;
    }
}

std::optional<audit::Entry> ofStandBy(const SessionEvent& event, const SystemTopology& topology)
{
    switch (event.kind) {
    case Kind::IncidentRaised:
        return made("incident-raised", pairOf(event.incident, topology));
    case Kind::IncidentEnded: {
        auto entry = made(event.dismissed ? "incident-dismissed" : "incident-ended", pairOf(event.incident, topology));
        entry.who = nameIn(topology, event.peer);
        if (!event.detail.empty())
            entry.text += ": " + event.detail;
        return entry;
    }
    case Kind::HoldReported: {
        auto entry = made("hold-reported", event.hold.holding ? "holds" : "does not hold");
        entry.who = nameIn(topology, event.hold.device);
        return entry;
    }
    case Kind::StandByBegan:
        return made("standby-began", {});
    case Kind::StandByEnded:
        return made("standby-ended", {});
    case Kind::LocalStall:
        return made("local-stall", milliseconds(event.duration));
    default:
        return std::nullopt;
    }
}

} // namespace

std::string nameIn(const SystemTopology& topology, DeviceId device)
{
    const auto* found = topology.find(device);
    return found != nullptr ? found->name : device.isBroadcast() ? std::string("unknown") : device.toString();
}

std::optional<audit::Entry> auditEntryOf(const SessionEvent& event, const SystemTopology& topology, const MessageSet& ownSet)
{
    auto entry = ofSession(event);
    if (entry)
        entry->peer = nameIn(topology, event.peer);
    else
        entry = ofStandBy(event, topology);
    if (event.kind == Kind::MessagesDropped) {
        const auto* definition = ownSet.find(event.message);
        if (definition == nullptr || definition->role != Role::Command)
            return std::nullopt;
        entry = made("command-refused", fmt::format("{} ({}): {}", event.message, event.count, event.detail));
        entry->peer = nameIn(topology, event.peer);
    }
    if (entry) {
        entry->incident = event.incident.id;
        entry->often = event.kind == Kind::OpenFailed; // devices try again every second
    }
    return entry;
}

} // namespace liena::system
