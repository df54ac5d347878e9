// What the three patient-side devices share: implementation.
#include "patient_side.hpp"

#include <algorithm>
#include <random>
#include <utility>

namespace liena::devices {

namespace {

using Kind = SessionEvent::Kind;

std::string nameIn(const SystemTopology& topology, DeviceId device)
{
    const TopologyDevice* found = topology.find(device);
    return found ? found->name : device.toString();
}

std::string pairOf(const Incident& incident, const SystemTopology& topology)
{
    return nameIn(topology, incident.a) + "-" + nameIn(topology, incident.b);
}

std::string milliseconds(std::chrono::nanoseconds duration)
{
    return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(duration).count()) + " ms";
}

std::string withDetail(std::string text, const std::string& detail) { return detail.empty() ? text : text + ": " + printable(detail, 256); }

std::string describeSession(const SessionEvent& event, const std::string& peer)
{
    switch (event.kind) {
    case Kind::OpenFailed:
        return withDetail(peer + ": not opened (" + std::string(toString(event.reason)) + ")", event.detail);
    case Kind::Closed:
        return withDetail(peer + ": closed", event.detail);
    case Kind::Interrupted:
        return peer + ": interrupted for " + milliseconds(event.duration);
    case Kind::Lost:
        return withDetail(peer + ": lost (" + std::string(toString(event.diagnosis.cause)) + ")", event.diagnosis.detail);
    case Kind::Diagnosed:
        return withDetail(peer + ": " + std::string(explain(event.diagnosis.probe)), event.diagnosis.probeDetail);
    case Kind::ReOpened:
        return peer + ": re-opened after " + milliseconds(event.duration);
    case Kind::MessagesDropped:
        return withDetail(peer + ": " + std::to_string(event.count) + " messages dropped" +
                              (event.message.empty() ? "" : ", " + event.message),
                          event.detail);
    case Kind::SendFailed:
        return withDetail(peer + ": " + event.message + " was not sent", event.detail);
    case Kind::IdentityRefused:
        return withDetail(peer + ": identity refused", event.detail);
    case Kind::AuditLost:
        return withDetail("NO AUDIT FILE IS WRITTEN", event.detail);
    default:
        return {};
    }
}

} // namespace

std::string describe(const SessionEvent& event, const SystemTopology& topology)
{
    switch (event.kind) {
    case Kind::StateChanged: // the library's own log has these
    case Kind::Opened:
    case Kind::LocalStall:
    case Kind::DeadlineMissed:
    case Kind::CauseReported:
    case Kind::HoldReported:
        return {};
    case Kind::IncidentRaised:
        return "incident " + pairOf(event.incident, topology) + ": " + std::string(toString(event.incident.cause));
    case Kind::IncidentEnded:
        return "incident " + pairOf(event.incident, topology) + (event.dismissed ? ": given up" : ": re-opened");
    case Kind::StandByBegan:
        return "stand-by begins";
    case Kind::StandByEnded:
        return "stand-by is over; a person has to arm again";
    default:
        return describeSession(event, nameIn(topology, event.peer));
    }
}

PatientSide::PatientSide(DistributedSystem& system, LogSink log, std::vector<DeviceId> keptOpen,
                         std::function<void(std::string_view)> emergencyStop, Arming arming)
    : m_system(system),
      m_log(std::move(log)),
      m_keeper(system.self().id, keptOpen),
      m_emergencyStop(std::move(emergencyStop)),
      m_arming(std::move(arming))
{
    m_system.subscribe([this](const SessionEvent& event) {
        m_keeper.handle(event, std::chrono::steady_clock::now());
        if (event.kind == Kind::Opened || event.kind == Kind::ReOpened || event.kind == Kind::Interrupted)
            m_stop.sessionBegan(event.peer);
        tellEvent(event);
    });
    if (!linked(m_system, DeviceClass::Hand).empty()) {
        const auto subscribed = m_system.subscribe("RobotStatus", [this](const Message& message) {
            m_stop.reported(message.origin(), message.get<std::uint64_t>("emergency_stop_token"));
        });
        m_hearsRobots = subscribed.has_value();
        complain(subscribed);
    }
    m_system.every(std::chrono::milliseconds(100), [this] {
        keepLinks();
        sendStop();
    });
}

std::string PatientSide::nameOf(DeviceId device) const { return nameIn(m_system.topology(), device); }

std::vector<DeviceId> PatientSide::linked(const DistributedSystem& system, DeviceClass deviceClass)
{
    std::vector<DeviceId> devices;
    const DeviceId self = system.self().id;
    for (const TopologyLink* link : system.topology().linksOf(self))
        if (link->otherEnd(self).classNumber() == static_cast<std::uint8_t>(deviceClass))
            devices.push_back(link->otherEnd(self));
    return devices;
}

void PatientSide::stopRobots(std::string_view reason)
{
    auto robots = linked(m_system, DeviceClass::Hand);
    std::set<DeviceId> mute(robots.begin(), robots.end());
    std::erase_if(mute, [this](DeviceId robot) {
        const auto* link = m_system.topology().link(m_system.self().id, robot);
        return m_hearsRobots && link != nullptr && link->carries("RobotStatus", robot);
    });
    std::random_device entropy;
    m_stop.say((std::uint64_t{entropy()} << 32U | entropy()) | 1U, reason, std::move(robots), std::move(mute));
    sendStop();
}

/// A repeat is harmless; a stop that is thrown away while its link is interrupted is not.
void PatientSide::sendStop()
{
    for (const DeviceId robot : m_stop.due()) {
        auto command = m_system.command(robot, "EmergencyStop");
        Result<void> sent = ok();
        if (command) {
            command.value()
                .set("token", m_stop.token())
                .setPrintable("source", m_system.self().name)
                .setPrintable("reason", m_stop.reason());
            sent = m_system.send(robot, std::move(command.value()));
        } else {
            sent = command.error();
        }
        if (sent)
            m_stop.given(robot);
        if (m_stop.isNews(robot, sent ? std::string() : sent.error().what))
            m_log(LogLevel::Error, "EMERGENCY STOP DID NOT LEAVE: " + sent.error().what + "; press the stop on the robot itself");
    }
}

void PatientSide::tellEvent(const SessionEvent& event)
{
    const std::string text = describe(event, m_system.topology());
    if (event.kind == Kind::Opened || event.kind == Kind::ReOpened)
        m_failures.erase(event.peer);
    if (text.empty() || (event.kind == Kind::OpenFailed && std::exchange(m_failures[event.peer], text) == text))
        return;
    const bool good =
        event.kind == Kind::ReOpened || event.kind == Kind::Closed || event.kind == Kind::IncidentEnded || event.kind == Kind::StandByEnded;
    m_log(good ? LogLevel::Info : LogLevel::Warning, text);
}

void PatientSide::keepLinks()
{
    for (const auto& wish : m_keeper.due(std::chrono::steady_clock::now())) {
        if (wish.act == LinkKeeper::Act::Open) {
            if (const auto opened = m_system.openChannel(wish.peer); !opened)
                m_log(LogLevel::Debug, opened.error().what);
            continue;
        }
        m_log(LogLevel::Info, nameOf(wish.peer) + ": re-opening, following the person's command");
        complain(m_system.reopenChannel(wish.peer));
    }
}

void PatientSide::complain(const Result<void>& result) const
{
    if (!result)
        m_log(LogLevel::Warning, result.error().what);
}

void PatientSide::obey(std::string_view line)
{
    if (line.find_first_not_of(" \t\r\n") == std::string_view::npos)
        return;
    const auto command = parsePersonCommand(line);
    if (!command)
        return m_log(LogLevel::Warning, "'" + printable(line) + "' is no command; there are: " + std::string(personCommandHelp));
    m_system.post([this, command = *command] { carryOut(command); });
}

void PatientSide::carryOut(const PersonCommand& command)
{
    switch (command.action) {
    case PersonAction::Status:
        return tellStatus();
    case PersonAction::EmergencyStop:
        return m_emergencyStop(command.reason.empty() ? "stop at the patient's side" : command.reason);
    case PersonAction::ClearToArm:
    case PersonAction::Wait:
        if (!m_arming.clearance)
            return m_log(LogLevel::Warning, "this device is not armed; say so at the robot");
        return m_arming.clearance(command.action == PersonAction::ClearToArm);
    case PersonAction::Dismiss:
        return dismiss(command);
    case PersonAction::Open:
    case PersonAction::ReOpen:
    case PersonAction::Close:
        break;
    }
    const auto device = m_system.topology().device(command.device);
    if (!device)
        return m_log(LogLevel::Warning, device.error().what);
    carryOutOn(command, device.value().id);
}

void PatientSide::carryOutOn(const PersonCommand& command, DeviceId peer)
{
    if (command.action == PersonAction::Close) {
        m_keeper.closedByPerson(peer);
        complain(m_system.closeChannel(peer, "closed at the patient's side"));
    } else if (command.action == PersonAction::ReOpen) {
        complain(m_system.reopenChannel(peer));
    } else {
        m_keeper.openedByPerson(peer, std::chrono::steady_clock::now());
        complain(m_system.openChannel(peer));
    }
}

void PatientSide::dismiss(const PersonCommand& command)
{
    auto incidents = m_system.incidents();
    if (!command.device.empty())
        std::erase_if(incidents, [&](const Incident& incident) {
            return nameOf(incident.a) != command.device && nameOf(incident.b) != command.device;
        });
    if (incidents.empty())
        return m_log(LogLevel::Warning, "no such incident is held");
    if (incidents.size() > 1 && command.device.empty())
        return m_log(LogLevel::Warning, "several incidents are held; name a device: dismiss NAME [REASON]");
    for (const Incident& incident : incidents)
        complain(m_system.dismissIncident(incident.id, command.reason.empty() ? "given up at the patient's side" : command.reason));
}

void PatientSide::tellStatus() const
{
    if (m_arming.status)
        m_log(LogLevel::Info, m_arming.status());
    for (const DeviceId robot : m_stop.robots())
        m_log(LogLevel::Warning, nameOf(robot) + " has not named the stop that was said here (" + printable(m_stop.reason(), 128) +
                                     "): it goes there, also when the channel is opened later");
    for (const LinkStatus& link : m_system.links())
        m_log(LogLevel::Info, nameOf(link.peer) + ": " + std::string(toString(link.state)) + (link.incident != 0 ? ", incident" : "") +
                                  ", " + std::to_string(link.messagesReceived) + " messages in, " + std::to_string(link.messagesSent) +
                                  " out");
    for (const Incident& incident : m_system.incidents())
        m_log(LogLevel::Info, "incident " + pairOf(incident, m_system.topology()) + ": " + std::string(toString(incident.cause)));
}

} // namespace liena::devices
