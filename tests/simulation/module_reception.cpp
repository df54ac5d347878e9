// What a peer's lanes bring to a simulated module, judged in the order of DistributedModule.
#include "simulated_device.hpp"
#include "simulated_module.hpp"

#include "protocol/crc32c.hpp"
#include "protocol/information_part.hpp"
#include "protocol/message_access.hpp"

namespace liena::simulation {

using protocol::HeaderVerdict;

void SimulatedModule::turned() { m_device.turned(); }

protocol::Ends SimulatedModule::ends() const
{
    return {m_device.surroundings().idOf(m_peer), m_device.settings().id, m_device.settings().set.get(), m_peerSet.get()};
}

Judgement SimulatedModule::violation(const std::string& detail)
{
    handle(session::ViolationFound{detail});
    return {HeaderVerdict::Refuse, 0};
}

void SimulatedModule::drop(std::string_view cause, const protocol::DatagramHeader& header)
{
    m_device.observe(Dropped{m_device.host(), m_peer, nameOf(header), cause});
}

protocol::HeaderJudgement SimulatedModule::judgeHeader(std::uint8_t lane, protocol::DatagramHeader header) const
{
    const auto between = ends();
    if (m_device.settings().mutant == Mutant::OriginNotCompared)
        header.message.origin = between.peer;
    auto judgement = protocol::judgeOnLane(between, lane, header);
    if (m_device.settings().mutant == Mutant::LimitAfterAllocation && judgement.verdict == HeaderVerdict::Take)
        judgement.maximum = std::size_t{1} << 40U;
    return judgement;
}

Judgement SimulatedModule::judge(std::uint8_t lane, const protocol::DatagramHeader& header)
{
    const auto judgement = judgeHeader(lane, header);
    if (judgement.verdict == HeaderVerdict::Refuse)
        return violation(judgement.why);
    if (judgement.verdict == HeaderVerdict::Skip)
        drop("by its header", header);
    else
        handle(session::LifeHeard{lane == 0 ? session::LifePath::LaneZero : session::LifePath::BulkLane});
    return {judgement.verdict, judgement.maximum};
}

void SimulatedModule::received(std::uint8_t lane, const protocol::DatagramHeader& header, std::span<const std::byte> part)
{
    if (header.message.isSessionManagement())
        receivedSession(lane, header, part);
    else
        receivedApplication(header, part);
}

void SimulatedModule::kept(std::uint8_t lane, const protocol::DatagramHeader& header, std::size_t bytes)
{
    m_device.observe(Kept{m_device.host(), m_peer, lane, nameOf(header), bytes});
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
        if (!shares)
            return (void)violation("what cannot be broadcast now");
        m_device.heardBroadcast(m_peer, *message);
    } else if (const auto* abandon = std::get_if<protocol::Abandon>(&*message); abandon != nullptr && shares) {
        if (auto* reception = incoming(lane))
            reception->abandon(abandon->message, Timestamp{abandon->timestamp});
    } else {
        handle(session::SessionMessageHeard{*message});
    }
}

void SimulatedModule::datagramArrived(std::span<const std::byte> packet)
{
    const auto opened = m_datagrams.open(packet, m_device.now().mono);
    if (!opened || opened->size() < protocol::headerSize)
        return;
    const auto header = protocol::decodeHeader(opened->first<protocol::headerSize>());
    const auto part = opened->subspan(protocol::headerSize);
    const bool dialogue = m_machine.state() == SessionState::Opening || m_machine.state() == SessionState::Reopening;
    if (dialogue && header.message.number != protocol::Heartbeat::number)
        return;
    const auto judgement = protocol::judgeInPacket(ends(), header, part.size());
    if (judgement.verdict == HeaderVerdict::Refuse)
        return (void)violation(judgement.why);
    if (judgement.verdict == HeaderVerdict::Skip)
        return drop("by its header", header);
    handle(session::LifeHeard{session::LifePath::Packet});
    received(0, header, part);
}

bool SimulatedModule::isNewest(const MessageDefinition& definition, const protocol::DatagramHeader& header) const
{
    const auto newest = m_newest.find(definition.number);
    return definition.path != liena::Path::Datagram || newest == m_newest.end() || header.timestamp > newest->second;
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
    if (!m_machine.awaitsSet())
        return (void)violation("a message set that nobody asked for");
    if (answer.set != m_machine.announcedSet())
        return handle(session::SetHeard{session::SetStanding::Invalid, "the message set sent is not the one that was announced"});
    m_incoming->pause(); // what follows the set may depend on it
    m_device.post([this, token = m_machine.token(), set = answer.set, heard = m_device.learn(m_peer, answer.set, answer.xml)] {
        setLearnt(token, set, heard);
    });
}

void SimulatedModule::setLearnt(std::uint64_t token, const Sha256& set, const session::SetHeard& heard)
{
    m_device.turned();
    const bool dialogue = m_machine.state() == SessionState::Opening || m_machine.state() == SessionState::Reopening;
    if (!dialogue || token != m_machine.token())
        return;
    if (heard.standing == session::SetStanding::Held)
        m_peerSet = m_device.heldSet(m_peer, set);
    handle(heard);
    if (m_incoming)
        m_incoming->start();
}

void SimulatedModule::receivedApplication(const protocol::DatagramHeader& header, std::span<const std::byte> part)
{
    const auto* definition = ends().definitionOf(header.message.number);
    if (definition == nullptr)
        return drop("unknown message number", header);
    const auto state = m_machine.state();
    const bool control = definition->priority == Priority::Control;
    if (!carriesMessages(state) && (control || (state != SessionState::Reconnecting && state != SessionState::Closing)))
        return drop("session not open", header);
    if (!isNewest(*definition, header))
        return drop("a newer one was delivered before", header);
    if (control && !passesGuard(*definition, header, part))
        return;
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
    const auto now = m_device.now().mono;
    const auto judgeExcess = [&] {
        if (m_machine.guard().isExceeded(now))
            handle(session::ViolationFound{"more than ten control messages refused in one second"});
        return false;
    };
    if (part.size() < protocol::safetyRecordSize) {
        m_machine.guard().noteWithoutRecord(now);
        drop("no safety record", header);
        return judgeExcess();
    }
    auto record = protocol::decodeSafetyRecord(part.first<protocol::safetyRecordSize>());
    const auto fields = part.subspan(protocol::safetyRecordSize);
    if (m_device.settings().mutant == Mutant::SameEpoch && record.epoch == m_firstEpoch) {
        record.epoch = m_machine.guard().epoch();
        record.crc = protocol::safetyCrc(header, record, fields);
    }
    const auto fault = m_machine.guard().judge(header, record, fields, definition.maxAge.value_or(m_timing.lost), now);
    if (fault == session::ControlFault::None || isForgiven(fault))
        return true;
    drop(session::toString(fault), header);
    return judgeExcess();
}

void SimulatedModule::deliver(const MessageDefinition& definition, const protocol::DatagramHeader& header, std::span<const std::byte> part)
{
    const auto now = m_device.now();
    std::optional<Nanoseconds> latency;
    if (const auto offset = m_machine.clock().offset())
        latency = session::difference(now.wall, header.timestamp) + *offset;
    if (definition.lifespan && latency && *latency > *definition.lifespan + m_machine.clock().uncertainty())
        return drop("older than its lifespan", header);
    if (definition.path == liena::Path::Datagram)
        m_newest[definition.number] = header.timestamp;
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

SimulatedReception* SimulatedModule::incoming(std::uint8_t lane) const
{
    if (lane == 0)
        return m_incoming.get();
    const auto found = m_incomingBulk.find(lane);
    return found != m_incomingBulk.end() ? found->second.get() : nullptr;
}

void SimulatedModule::laneLost(std::uint8_t lane, const std::string& detail)
{
    const auto* lost = incoming(lane);
    m_device.turned();
    if (lost == nullptr || incoming(lane) != lost)
        return;
    if (lane == 0) {
        m_device.bury(std::shared_ptr<SimulatedReception>(std::move(m_incoming)));
        handle(session::IncomingLost{detail});
    } else {
        m_device.bury(std::shared_ptr<SimulatedReception>(std::move(m_incomingBulk.at(lane))));
        m_incomingBulk.erase(lane);
    }
}

} // namespace liena::simulation
