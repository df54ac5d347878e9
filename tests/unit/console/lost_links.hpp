// An invented system of four devices, and losses of its links.
#pragma once

#include "model/incident_model.hpp"
#include "model/session_model.hpp"

#include <algorithm>
#include <utility>

namespace console::test {

using namespace std::chrono_literals;

inline constexpr quint32 cockpit = 0x40018208;
inline constexpr quint32 robot = 0x00008208;
inline constexpr quint32 xray = 0x20010208;
inline constexpr quint32 arm = 0x60008208;
inline const Instant start = Instant{} + 1h;

inline void fill(SessionModel& sessions)
{
    SessionModel::Topology topology;
    topology.name = QStringLiteral("t");
    const auto add = [&topology](quint32 id, const char* title, const char* site, bool self) {
        DeviceNode node;
        node.id = id;
        node.title = QString::fromLatin1(title);
        node.site = QString::fromLatin1(site);
        node.self = self;
        node.address = id == cockpit ? QStringLiteral("10.0.0.1:1")
                       : id == xray  ? QStringLiteral("10.0.0.3:1")
                                     : QStringLiteral("10.0.0.2:1");
        topology.devices.push_back(node);
    };
    add(cockpit, "Cockpit", "surgeon", true);
    add(robot, "Robot", "patient", false);
    add(arm, "Arm", "patient", false);
    add(xray, "X-ray", "patient", false);
    topology.links = {{robot, cockpit}, {arm, cockpit}, {xray, cockpit}, {robot, arm}};
    sessions.setTopology(topology);
    for (const auto peer : {robot, arm, xray})
        sessions.setLinkState(peer, LinkState::Open, start);
}

inline IncidentRecord lost(quint32 peer)
{
    IncidentRecord record;
    record.id = 11;
    record.a = std::min(peer, cockpit);
    record.b = std::max(peer, cockpit);
    record.peer = peer;
    record.cause = LossKind::HeartbeatLost;
    record.since = start;
    LinkDiagnosis diagnosis;
    diagnosis.heartbeatsExpected = 50;
    diagnosis.heartbeatsReceived = 44;
    diagnosis.lastRoundTrip = 1500us;
    diagnosis.silence = 610ms;
    diagnosis.toPeerConnected = true;
    diagnosis.fromPeerConnected = true;
    record.diagnosis = diagnosis;
    return record;
}

inline IncidentRecord interrupted(quint32 peer)
{
    auto record = lost(peer);
    record.cause = LossKind::None;
    record.diagnosis.reset();
    return record;
}

inline PromptSurroundings around()
{
    PromptSurroundings value;
    value.robot = robot;
    value.lostLinks = 1;
    value.ownLinks = 3;
    return value;
}

} // namespace console::test
