// What a peer's lanes bring to a simulated module, judged in the order of DistributedModule.
#include "simulated_device.hpp"
#include "simulated_module.hpp"

#include "protocol/crc32c.hpp"
#include "protocol/information_part.hpp"
#include "protocol/message_access.hpp"

namespace liena::simulation {

using protocol::HeaderVerdict;

void SimulatedModule::turned() { m_device.turned(); }

const MessageDefinition* SimulatedModule::definitionOf(std::uint16_t number) const
{
    if (number >= 0x0100 && number <= 0x01FF)
        return m_device.settings().set->find(number);
    return m_peerSet ? m_peerSet->find(number) : nullptr;
}

Judgement SimulatedModule::violation(const std::string& detail)
{
    handle(session::ViolationFound{detail});
    return {HeaderVerdict::Refuse, 0};
}

Judgement SimulatedModule::skip(std::string_view cause, const protocol::DatagramHeader& header)
{
    drop(cause, header);
    return {HeaderVerdict::Skip, 0};
}

void SimulatedModule::drop(std::string_view cause, const protocol::DatagramHeader& header)
{
    m_device.observe(Dropped{m_device.host(), m_peer, nameOf(header), cause});
}

Judgement SimulatedModule::judge(std::uint8_t lane, const protocol::DatagramHeader& header)
{
    const bool believed = m_device.settings().mutant == Mutant::OriginNotCompared;
    if (header.message.origin != m_device.surroundings().idOf(m_peer) && !believed)
        return violation("origin " + header.message.origin.toString() + " on the connection of another");
    if (header.target != m_device.settings().id && !header.target.isBroadcast())
        return skip("target is another device", header);
    if (header.message.number == 0 || header.message.number >= 0x1000)
        return skip("reserved message number", header);
    return header.message.isSessionManagement() ? judgeSession(lane, header) : judgeApplication(lane, header);
}

Judgement SimulatedModule::judgeSession(std::uint8_t lane, const protocol::DatagramHeader& header)
{
    const auto maximum = protocol::maximumSessionBody(header.message.number);
    if (!maximum)
        return skip("unknown session message", header);
    if (lane != 0 && header.message.number != protocol::Abandon::number)
        return violation("session management on a bulk lane");
    if (header.length > *maximum)
        return violation("a session message is longer than it can be");
    handle(session::LifeHeard{lane == 0 ? session::LifePath::LaneZero : session::LifePath::BulkLane});
    return {HeaderVerdict::Take, *maximum};
}

Judgement SimulatedModule::judgeApplication(std::uint8_t lane, const protocol::DatagramHeader& header)
{
    const auto* definition = definitionOf(header.message.number);
    if (definition == nullptr)
        return skip("unknown message number", header);
    if ((definition->priority == Priority::Bulk) != (lane > 0))
        return violation("a message on the wrong kind of lane");
    if (header.target.isBroadcast() && (definition->role == Role::Command || definition->priority == Priority::Control))
        return skip("a command or control message that is broadcast", header);
    const bool unbounded = m_device.settings().mutant == Mutant::LimitAfterAllocation;
    const auto maximum = unbounded ? std::size_t{1} << 40U : definition->maximumSize();
    if (header.length > maximum)
        return violation("a message is longer than its definition allows");
    if (definition->priority == Priority::Control && header.moreSegments)
        return violation("a control message in several segments");
    handle(session::LifeHeard{lane == 0 ? session::LifePath::LaneZero : session::LifePath::BulkLane});
    return {HeaderVerdict::Take, maximum};
}

void SimulatedModule::received(std::uint8_t lane, const protocol::DatagramHeader& header, std::span<const std::byte> part)
{
    if (header.message.isSessionManagement())
        receivedSession(lane, header, part);
    else
        receivedApplication(header, part);
}

void SimulatedModule::receivedSession(std::uint8_t lane, const protocol::DatagramHeader& header, std::span<const std::byte> part)
{
    const auto message = protocol::decodeSessionMessage(header.message.number, part);
    if (!message)
        return drop("session message that does not decode", header);
    const auto state = m_machine.state();
    const bool shares = carriesMessages(state) || state == SessionState::Reconnecting || state == SessionState::Closing;
    if (const auto* commit = std::get_if<protocol::HandshakeCommit>(&*message)) {
        commitHeard(*commit, false, 0);
    } else if (const auto* diagnosis = std::get_if<protocol::DiagnosisHandshakeCommit>(&*message)) {
        commitHeard(diagnosis->commit, true, diagnosis->previous);
    } else if (const auto* answer = std::get_if<protocol::MessageSetAnswer>(&*message)) {
        setHeard(*answer);
    } else if (header.target.isBroadcast()) {
        const bool known =
            std::holds_alternative<protocol::StandBy>(*message) || std::holds_alternative<protocol::StandByReport>(*message) ||
            std::holds_alternative<protocol::IncidentDismissed>(*message) || std::holds_alternative<protocol::ChannelReOpened>(*message);
        if (!known || !shares)
            return (void)violation("what cannot be broadcast now");
        m_device.heardBroadcast(m_peer, *message, header.timestamp);
    } else if (const auto* abandon = std::get_if<protocol::Abandon>(&*message); abandon != nullptr && shares) {
        const auto bulk = m_incomingBulk.find(lane);
        auto* reception = lane == 0 ? m_incoming.get() : bulk != m_incomingBulk.end() ? bulk->second.get() : nullptr;
        if (reception != nullptr)
            reception->abandon(abandon->message, Timestamp{abandon->timestamp});
    } else {
        if (const auto* heartbeat = std::get_if<protocol::Heartbeat>(&*message))
            m_datagrams.peerHears(heartbeat->datagramsHeard);
        handle(session::SessionMessageHeard{*message});
    }
}

void SimulatedModule::datagramArrived(std::span<const std::byte> packet)
{
    const auto state = m_machine.state();
    if (!m_device.settings().datagrams || state == SessionState::Closed || state == SessionState::StandBy)
        return;
    const auto datagram = m_datagrams.open(packet, m_device.network().time().now(), m_timing.heartbeat);
    if (!datagram || datagram->size() < protocol::headerSize)
        return;
    const auto header = protocol::decodeHeader(datagram->first<protocol::headerSize>());
    const auto part = datagram->subspan(protocol::headerSize);
    if (header.message.origin != m_device.surroundings().idOf(m_peer))
        return (void)violation("another origin on the datagram path");
    const bool dialogue = state == SessionState::Opening || state == SessionState::Reopening;
    const bool heartbeat = header.message.number == protocol::Heartbeat::number;
    if (header.moreSegments || header.length != part.size() || header.target != m_device.settings().id || (dialogue && !heartbeat))
        return drop("what does not belong on the datagram path", header);
    const auto* definition = heartbeat ? nullptr : definitionOf(header.message.number);
    if (!heartbeat && (definition == nullptr || definition->path != liena::Path::Datagram))
        return drop("what does not belong on the datagram path", header);
    if (definition != nullptr && header.length > definition->maximumSize())
        return (void)violation("a message is longer than its definition allows");
    handle(session::LifeHeard{session::LifePath::Packet});
    if (!heartbeat)
        return receivedApplication(header, part);
    const auto message = protocol::decodeSessionMessage(header.message.number, part);
    if (!message)
        return drop("session message that does not decode", header);
    m_datagrams.peerHears(std::get<protocol::Heartbeat>(*message).datagramsHeard);
    handle(session::SessionMessageHeard{*message});
}

void SimulatedModule::commitHeard(const protocol::HandshakeCommit& commit, bool diagnosis, std::uint64_t previous)
{
    const auto standing = m_device.standingOf(m_peer, commit.set);
    if (standing == session::SetStanding::Held)
        m_peerSet = m_device.heldSet(m_peer, commit.set);
    handle(session::CommitHeard{commit, diagnosis, previous, standing});
}

void SimulatedModule::setHeard(const protocol::MessageSetAnswer& answer)
{
    const auto state = m_machine.state();
    if (state != SessionState::Opening && state != SessionState::Reopening)
        return (void)violation("a message set outside an opening");
    const auto heard = m_device.learn(m_peer, answer.set, answer.xml);
    if (heard.standing == session::SetStanding::Held)
        m_peerSet = m_device.heldSet(m_peer, answer.set);
    handle(heard);
}

void SimulatedModule::receivedApplication(const protocol::DatagramHeader& header, std::span<const std::byte> part)
{
    const auto* definition = definitionOf(header.message.number);
    const auto state = m_machine.state();
    const bool control = definition->priority == Priority::Control;
    if (!carriesMessages(state) && (control || (state != SessionState::Reconnecting && state != SessionState::Closing)))
        return drop("session not open", header);
    if (control && !passesGuard(*definition, header, part))
        return;
    if (m_device.settings().datagrams && definition->path == liena::Path::Datagram) {
        auto& newest = m_newestByPath[header.message.number];
        if (header.timestamp <= newest)
            return drop("a newer one came on the other path", header);
        newest = header.timestamp;
    }
    if (!definition->allowedInStandBy && m_device.standsBy())
        return drop("the system stands by", header);
    if (const auto fault = protocol::checkFields(*definition, part.subspan(definition->recordSize())))
        return drop("malformed", header);
    deliver(*definition, header, part);
}

bool SimulatedModule::isForgiven(session::ControlFault fault) const
{
    using session::ControlFault;
    switch (m_device.settings().mutant) {
    case Mutant::NoEpochCheck:
        return fault == ControlFault::OldEpoch || fault == ControlFault::WrongEpoch;
    case Mutant::NoSequenceCheck:
        return fault == ControlFault::NotNewer;
    case Mutant::NoAgeCheck:
        return fault == ControlFault::TooOld || fault == ControlFault::UnknownEcho;
    default:
        return false;
    }
}

bool SimulatedModule::passesGuard(const MessageDefinition& definition, const protocol::DatagramHeader& header,
                                  std::span<const std::byte> part)
{
    if (part.size() < protocol::safetyRecordSize) {
        drop("no safety record", header);
        return false;
    }
    auto record = protocol::decodeSafetyRecord(part.first<protocol::safetyRecordSize>());
    const auto fields = part.subspan(protocol::safetyRecordSize);
    if (m_device.settings().mutant == Mutant::SameEpoch && record.epoch == m_firstEpoch) {
        record.epoch = m_machine.guard().epoch();
        record.crc = protocol::safetyCrc(header, record, fields);
    }
    const auto now = m_device.now().mono;
    const auto fault = m_machine.guard().judge(header, record, fields, definition.maxAge.value_or(m_timing.lost), now);
    if (fault == session::ControlFault::None || isForgiven(fault))
        return true;
    drop(session::toString(fault), header);
    if (m_machine.guard().isExceeded(now))
        handle(session::ViolationFound{"more than ten control messages refused in one second"});
    return false;
}

void SimulatedModule::deliver(const MessageDefinition& definition, const protocol::DatagramHeader& header, std::span<const std::byte> part)
{
    const auto now = m_device.now();
    std::optional<Nanoseconds> latency;
    if (const auto offset = m_machine.clock().offset())
        latency = Nanoseconds(static_cast<std::int64_t>(now.wall.ns - header.timestamp.ns)) + *offset;
    if (definition.lifespan && latency && *latency > *definition.lifespan + m_machine.clock().uncertainty())
        return drop("older than its lifespan", header);
    Delivered delivered{m_device.host(), m_peer, nameOf(header)};
    delivered.control = definition.priority == Priority::Control;
    delivered.refusedInStandBy = !definition.allowedInStandBy;
    delivered.forUs = header.target == m_device.settings().id || header.target.isBroadcast();
    if (delivered.control) {
        const auto record = protocol::decodeSafetyRecord(part.first<protocol::safetyRecordSize>());
        delivered.epoch = record.epoch;
        delivered.sequence = record.sequence;
    }
    const auto fields = part.subspan(definition.recordSize());
    delivered.content = protocol::crc32c(fields);
    m_device.observe(delivered);
    auto message = MessageAccess::fromFields(header.message.isCommand() ? m_device.settings().set : m_peerSet, definition,
                                             FieldBytes(fields.begin(), fields.end()));
    MessageAccess::setMeta(message, header.message.origin, header.target, header.timestamp);
    MessageAccess::setArrival(message, now.mono, latency);
    m_device.deliver(m_peer, message);
}

void SimulatedModule::laneLost(std::uint8_t lane, const std::string& detail)
{
    m_device.turned();
    const auto bulk = m_incomingBulk.find(lane);
    if (lane == 0 ? !m_incoming : bulk == m_incomingBulk.end() || !bulk->second)
        return;
    m_device.bury(std::shared_ptr<SimulatedReception>(std::move(lane == 0 ? m_incoming : bulk->second)));
    if (lane == 0)
        handle(session::IncomingLost{detail});
    else
        m_incomingBulk.erase(bulk);
}

} // namespace liena::simulation
