// What a device tells those who operate it: events, log, audit file and status.
#include "system/distributed_system_state.hpp"

#include "liena/json_line.hpp"
#include "liena/status.hpp"
#include "system/audit_entries.hpp"
#include "system/measure_order.hpp"
#include "system/status_line.hpp"

#include <fmt/format.h>

namespace liena {

/// Whoever watches asks the board and the audit log, never the network thread. A device works without being watched.
void DistributedSystem::State::offerStatus()
{
    if (settings.status.empty())
        return;
    auto line = std::make_shared<system::StatusLine>(ownTopologyDevice, topology, settings.software, board, audit.get());
    const auto make = [line] { return line->make(std::chrono::steady_clock::now(), std::chrono::system_clock::now()); };
    transport::StatusServer::Requests requests;
    if (settings.measureOnRequest)
        requests = [this](const std::string& request, const transport::StatusServer::Reply& reply) { return measureFor(request, reply); };
    auto opened = transport::StatusServer::open(statusSocket(settings.status, ownTopologyDevice.id), make, std::move(requests));
    if (opened)
        statusServer = std::move(opened.value());
    else
        log(LogLevel::Warning, "no-status", opened.error().what);
}

/// On the status server's thread; `reply` hears that it began, and later the figures.
std::function<void()> DistributedSystem::State::measureFor(const std::string& request, const transport::StatusServer::Reply& reply)
{
    const auto refuse = [&reply](std::string why) {
        Measurement none;
        none.failure = std::move(why);
        reply(JsonLine().put("measurement", toJson(none)).text());
        return std::function<void()>();
    };
    const auto wanted = system::MeasureOrder::parse(request);
    if (!wanted)
        return refuse(wanted.error().what);
    if (const auto linked = linkedPeer(wanted.value().peer); !linked)
        return refuse(linked.error().what);
    record({.event = "measurement-requested", .peer = system::nameIn(topology, wanted.value().peer), .who = ownTopologyDevice.name});
    reply(JsonLine().add("measure", "begun").text());
    auto runs = std::make_shared<bool>(false); // the network thread's: who leaves ends no measurement but its own
    post([this, wanted = wanted.value(), reply, runs] {
        const auto done = [reply, runs](const Measurement& found) {
            *runs = false;
            reply(JsonLine().put("measurement", toJson(found)).text());
        };
        auto* one = module(wanted.peer);
        if (one == nullptr)
            return; // stopped meanwhile, and with it who asked
        *runs = true;
        if (const auto begun = one->measure(wanted.plan(), done); !begun) {
            Measurement none;
            none.failure = begun.error().what;
            done(none);
        }
    });
    return [this, peer = wanted.value().peer, runs] {
        post([this, peer, runs] {
            if (auto* one = module(peer); one != nullptr && *runs)
                one->stopMeasuring();
        });
    };
}

/// The loss of the audit file is an alarm, told once, and so is its end.
void DistributedSystem::State::watchAudit()
{
    if (!audit)
        return;
    const auto status = audit->status(std::chrono::steady_clock::now());
    if (status.lost == auditLost)
        return;
    auditLost = status.lost;
    SessionEvent event;
    event.kind = auditLost ? SessionEvent::Kind::AuditLost : SessionEvent::Kind::AuditRestored;
    event.at = std::chrono::steady_clock::now();
    event.detail = auditLost ? status.detail : std::string();
    log(auditLost ? LogLevel::Error : LogLevel::Info, auditLost ? "audit-lost" : "audit-restored",
        auditLost ? status.detail + "; until then no new session opens" : "the audit file is written again");
    record({.event = auditLost ? "audit-lost" : "audit-restored", .text = event.detail});
    tell(std::move(event));
}

void DistributedSystem::State::identityRefused(DeviceId device, const std::string& cause, const std::string& detail)
{
    const auto count = refusals.count(cause, device.value(), now().mono);
    if (!count)
        return;
    log(LogLevel::Warning, "identity-refused",
        fmt::format("refused {} connection{}, the last from {}", *count, *count == 1 ? "" : "s", printable(detail, 512)));
    SessionEvent event;
    event.count = *count;
    event.kind = SessionEvent::Kind::IdentityRefused;
    event.at = std::chrono::steady_clock::now();
    event.peer = device;
    event.detail = printable(detail, 512);
    tell(std::move(event));
}

void DistributedSystem::State::logIncident(const SessionEvent& event)
{
    const bool hold = event.kind == SessionEvent::Kind::HoldReported; // these come as often as the peers like
    if (!hold || holdsHeard.count({}, event.hold.device.value(), now().mono))
        log(LogLevel::Info, "incident",
            fmt::format("{}: {} - {}", toString(event.kind), event.incident.a.toString(), event.incident.b.toString()));
}

void DistributedSystem::State::tell(SessionEvent event)
{
    if (auto entry = audit ? system::auditEntryOf(event, topology, *ownMessageSet) : std::nullopt)
        record(std::move(*entry));
    for (const auto& handler : eventHandlers)
        handler(event);
    MessageCacheAccess::put(messageCache, std::move(event));
}

/// Of the person at this device, or of the program for them.
void DistributedSystem::State::recordCommand(std::string_view event, std::optional<DeviceId> peer, IncidentId incident,
                                             std::string_view reason)
{
    record({.event = std::string(event),
            .peer = peer ? system::nameIn(topology, *peer) : std::string(),
            .who = ownTopologyDevice.name,
            .incident = incident,
            .text = std::string(reason),
            .often = event == "open-commanded"}); // devices try again every second
}

} // namespace liena
