// The library's sessions as the console's values.
#include "link/translate.hpp"

#include <algorithm>

namespace console {

namespace {

double rate(std::uint64_t now, std::uint64_t before, Duration between)
{
    return between > Duration::zero() && now >= before ? static_cast<double>(now - before) / seconds(between) : 0;
}

} // namespace

LinkState linkState(liena::SessionState state)
{
    switch (state) {
    case liena::SessionState::Closed:
        return LinkState::Closed;
    case liena::SessionState::Opening:
        return LinkState::Opening;
    case liena::SessionState::Open:
        return LinkState::Open;
    case liena::SessionState::Suspect:
        return LinkState::Suspect;
    case liena::SessionState::Reconnecting:
        return LinkState::Reconnecting;
    case liena::SessionState::StandBy:
        return LinkState::StandBy;
    case liena::SessionState::Reopening:
        return LinkState::Reopening;
    case liena::SessionState::Closing:
        return LinkState::Closing;
    }
    return LinkState::Closed;
}

LossKind lossKind(liena::LossCause cause)
{
    switch (cause) {
    case liena::LossCause::None:
        return LossKind::None;
    case liena::LossCause::HeartbeatLost:
        return LossKind::HeartbeatLost;
    case liena::LossCause::ConnectionLost:
        return LossKind::ConnectionLost;
    case liena::LossCause::PeerRestarted:
        return LossKind::PeerRestarted;
    case liena::LossCause::ProtocolViolation:
        return LossKind::ProtocolViolation;
    case liena::LossCause::LocalStall:
        return LossKind::LocalStall;
    }
    return LossKind::None;
}

ProbeFinding probeFinding(liena::ProbeResult result)
{
    switch (result) {
    case liena::ProbeResult::NotProbed:
        return ProbeFinding::NotProbed;
    case liena::ProbeResult::InterfaceDown:
        return ProbeFinding::InterfaceDown;
    case liena::ProbeResult::NoRoute:
        return ProbeFinding::NoRoute;
    case liena::ProbeResult::HostUnreachable:
        return ProbeFinding::HostUnreachable;
    case liena::ProbeResult::ConnectionRefused:
        return ProbeFinding::ConnectionRefused;
    case liena::ProbeResult::TlsFailure:
        return ProbeFinding::TlsFailure;
    case liena::ProbeResult::PeerSilent:
        return ProbeFinding::PeerSilent;
    case liena::ProbeResult::Reachable:
        return ProbeFinding::Reachable;
    }
    return ProbeFinding::NotProbed;
}

LinkDiagnosis linkDiagnosis(const liena::Diagnosis& diagnosis)
{
    LinkDiagnosis value;
    value.cause = lossKind(diagnosis.cause);
    value.probe = probeFinding(diagnosis.probe);
    value.probeDetail = text(diagnosis.probeDetail);
    value.silence = diagnosis.silence;
    value.heartbeatsExpected = diagnosis.heartbeatsExpected;
    value.heartbeatsReceived = diagnosis.heartbeatsReceived;
    value.lastRoundTrip = diagnosis.lastRoundTrip;
    value.toPeerConnected = diagnosis.toPeerConnected;
    value.fromPeerConnected = diagnosis.fromPeerConnected;
    value.peerState = linkState(diagnosis.peerState);
    value.detail = text(diagnosis.detail);
    return value;
}

Duration roundTripCarried(const liena::MessageDefinition& command, const liena::LinkTiming& timing)
{
    return std::max<Duration>(command.maxAge.value_or(timing.lost) - timing.heartbeat, Duration::zero());
}

LinkFigures linkFigures(const liena::LinkStatus& status, const liena::LinkStatus* previous, Duration between)
{
    LinkFigures figures;
    figures.lastHeard = status.lastHeard;
    figures.roundTrip = status.roundTrip;
    if (status.heartbeatsReceived > 1)
        figures.jitter = status.jitter;
    figures.clockOffset = status.clockOffset;
    figures.clockUncertainty = status.clockUncertainty;
    figures.heartbeatsReceived = status.heartbeatsReceived;
    figures.heartbeatsMissed = status.heartbeatsMissed;
    figures.heartbeatsOnTime = status.heartbeatsOnTime;
    figures.messagesDropped = status.messagesDropped;
    figures.queuedMessages = status.queuedMessages;
    figures.interruptions = status.interruptions;
    figures.packetsPass = status.packetsHeard > 0 && status.packetsHeardByPeer > 0;
    figures.toPeerConnected = status.toPeerConnected;
    figures.fromPeerConnected = status.fromPeerConnected;
    figures.localAddress = text(status.localAddress);
    figures.remoteAddress = text(status.remoteAddress);
    figures.peerState = linkState(status.peerState);
    if (previous != nullptr) {
        figures.messagesInPerSecond = rate(status.messagesReceived, previous->messagesReceived, between);
        figures.messagesOutPerSecond = rate(status.messagesSent, previous->messagesSent, between);
        figures.bytesInPerSecond = rate(status.bytesReceived, previous->bytesReceived, between);
        figures.bytesOutPerSecond = rate(status.bytesSent, previous->bytesSent, between);
    }
    return figures;
}

SessionModel::Topology topologyValues(const liena::SystemTopology& topology, liena::DeviceId self)
{
    SessionModel::Topology value;
    value.name = text(topology.name());
    value.title = text(topology.title());
    value.version = text(topology.version());
    value.hash = text(topology.hash().toHex());
    value.secured = topology.security() == liena::SecurityMode::Tls;
    for (const auto& device : topology.devices()) {
        DeviceNode node;
        node.id = device.id.value();
        node.name = text(device.name);
        node.title = text(device.title.empty() ? device.name : device.title);
        node.site = text(device.site);
        node.kind = kindOf(node.id);
        node.messageSet = text(device.messageSet);
        node.address = QStringLiteral("%1:%2").arg(text(device.host)).arg(device.port);
        node.onThisComputer = device.onLoopback;
        node.self = device.id == self;
        value.devices.push_back(std::move(node));
    }
    for (const auto& link : topology.links()) {
        value.links.emplace_back(link.a.value(), link.b.value());
        value.heartbeats.emplace_back(link.timing.heartbeat);
    }
    return value;
}

} // namespace console
