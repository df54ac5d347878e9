// What a peer's lanes bring: judged by the header, by the session's state, by the definition and by the safety record.
#include "protocol/byte_reader.hpp"
#include "protocol/information_part.hpp"
#include "protocol/message_access.hpp"
#include "system/distributed_module.hpp"

#include <fmt/format.h>

#include <utility>

namespace liena::system {

using protocol::HeaderVerdict;

namespace {

session::LifePath pathOf(std::uint8_t lane) { return lane == 0 ? session::LifePath::LaneZero : session::LifePath::BulkLane; }

} // namespace

void DistributedModule::hearFrom(std::shared_ptr<const MessageSet> set)
{
    m_judged = nullptr; // it may be one of the set that goes
    m_peerSet = std::move(set);
    m_ends.peerSet = m_peerSet.get();
}

/// What was judged last is most often what is asked for next.
const MessageDefinition* DistributedModule::definitionOf(std::uint16_t number) const
{
    return m_judged != nullptr && m_judged->number == number ? m_judged : m_ends.definitionOf(number);
}

tasks::Judgement DistributedModule::violation(const std::string& detail)
{
    handle(session::ViolationFound{detail});
    return {HeaderVerdict::Refuse, 0};
}

tasks::Judgement DistributedModule::judge(std::uint8_t lane, const protocol::DatagramHeader& header)
{
    const auto judgement = protocol::judgeOnLane(m_ends, lane, header);
    m_judged = judgement.definition;
    if (judgement.verdict == HeaderVerdict::Refuse)
        return violation(judgement.why);
    if (judgement.verdict == HeaderVerdict::Take && header.message.number == protocol::Probe::number && !admitsProbe(lane, header))
        return {HeaderVerdict::Skip, 0};
    if (judgement.verdict == HeaderVerdict::Skip)
        skip(header, judgement.why);
    else if (header.message.isSessionManagement() || !std::exchange(m_lifeTold, true))
        handle(session::LifeHeard{pathOf(lane)});
    return {judgement.verdict, judgement.maximum};
}

void DistributedModule::skip(const protocol::DatagramHeader& header, const std::string& why)
{
    receivedInVain(header, header.length);
    drop(why, header.message.number);
}

/// A segment of a message that is not put together: the peer would take for a queue what no report counts.
void DistributedModule::receivedInVain(const protocol::DatagramHeader& header, std::size_t bytes)
{
    if (!header.message.isSessionManagement())
        m_books.receivedSegment(bytes, !header.moreSegments);
}

void DistributedModule::received(std::uint8_t lane, const protocol::DatagramHeader& header, std::span<const std::byte> part,
                                 FieldBytes* owned)
{
    if (!header.message.isSessionManagement())
        receivedApplication(header, part, owned);
    else if (!heardMeasurement(lane == 0 ? protocol::ProbeWay::Prompt : protocol::ProbeWay::Image, header, part))
        receivedSession(lane, header, part);
}

void DistributedModule::receivedSession(std::uint8_t lane, const protocol::DatagramHeader& header, std::span<const std::byte> part)
{
    const auto message = protocol::decodeSessionMessage(header.message.number, part);
    if (!message)
        return drop("session message that does not decode", header.message.number);
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
            return (void)violation(fmt::format("{} cannot be broadcast now", protocol::nameOf(*message)));
        m_host.heardBroadcast(m_peer.id, *message);
    } else if (const auto* abandon = std::get_if<protocol::Abandon>(&*message); abandon != nullptr && shares) {
        if (auto* task = incoming(lane))
            task->abandon(abandon->message, Timestamp{abandon->timestamp});
    } else {
        handle(session::SessionMessageHeard{*message});
        if (const auto* report = std::get_if<protocol::LinkReport>(&*message); report != nullptr && carriesMessages(state))
            m_bulk.arrivalsReported(std::chrono::microseconds(report->windowUs), report->receivedBytes,
                                    {m_laneZero.left().bytes, m_books.bytesSentInPackets()},
                                    m_machine.clock().lastDelay().value_or(std::chrono::nanoseconds::zero()));
        if (const auto* request = std::get_if<protocol::MeasureRequest>(&*message); request != nullptr && carriesMessages(state))
            m_measurement.heard(*request);
        else if (const auto* granted = std::get_if<protocol::MeasureAnswer>(&*message); granted != nullptr && carriesMessages(state))
            m_measurement.heard(*granted);
    }
}

void DistributedModule::commitHeard(const protocol::HandshakeCommit& commit, bool diagnosis, std::uint64_t previous)
{
    const auto standing = m_host.standingOf(m_peer.id, commit.set);
    if (standing == session::SetStanding::Held)
        hearFrom(m_host.setOf(m_peer.id, commit.set));
    handle(session::CommitHeard{commit, diagnosis, previous, standing});
}

void DistributedModule::setHeard(const protocol::MessageSetAnswer& answer)
{
    if (!m_machine.awaitsSet())
        return (void)violation("a message set that nobody asked for");
    if (answer.set != m_machine.announcedSet())
        return handle(session::SetHeard{session::SetStanding::Invalid, "the message set sent is not the one that was announced"});
    m_incoming->pause(); // what follows the set may depend on it
    m_host.learn(m_peer.id, answer.set, answer.xml);
}

void DistributedModule::setLearnt(std::uint64_t token, const Sha256& set, const session::SetHeard& heard)
{
    m_host.turned();
    const bool dialogue = m_machine.state() == SessionState::Opening || m_machine.state() == SessionState::Reopening;
    if (!dialogue || token != m_machine.token())
        return;
    if (heard.standing == session::SetStanding::Held)
        hearFrom(m_host.setOf(m_peer.id, set));
    handle(heard);
    if (m_incoming)
        m_incoming->start();
}

void DistributedModule::receivedApplication(const protocol::DatagramHeader& header, std::span<const std::byte> part, FieldBytes* owned)
{
    m_books.received(part.size());
    const auto* definition = definitionOf(header.message.number);
    if (definition == nullptr) // the peer's set changed while the body was awaited
        return drop("unknown message number", header.message.number);
    const auto state = m_machine.state();
    const bool control = definition->priority == Priority::Control;
    if (!carriesMessages(state) && (control || (state != SessionState::Reconnecting && state != SessionState::Closing)))
        return drop("session not open", header.message.number);
    if (!m_link.carries(definition->name, m_peer.id))
        return drop("the topology's flows forbid it", header.message.number);
    if (!isNewest(*definition, header))
        return drop("a newer one was delivered before", header.message.number);
    const auto now = m_host.now(); // reading the clocks is a good part of what a small message costs
    if (control && !passesGuard(*definition, header, part, now.mono))
        return;
    if (!definition->allowedInStandBy && m_host.standsBy())
        return drop("the system stands by", header.message.number);
    const auto fields = part.subspan(definition->recordSize());
    if (const auto fault = protocol::checkFields(*definition, fields))
        return drop("malformed", header.message.number, *fault);
    deliver(*definition, header, fields, owned, now);
}

bool DistributedModule::passesGuard(const MessageDefinition& definition, const protocol::DatagramHeader& header,
                                    std::span<const std::byte> part, session::Instant now)
{
    auto& guard = m_machine.guard();
    const bool hasRecord = part.size() >= protocol::safetyRecordSize;
    auto fault = session::ControlFault::Crc;
    if (hasRecord)
        fault = guard.judge(header, protocol::decodeSafetyRecord(part.first<protocol::safetyRecordSize>()),
                            part.subspan(protocol::safetyRecordSize), definition.maxAge.value_or(m_link.timing.lost), now);
    else
        guard.noteWithoutRecord(now);
    if (fault == session::ControlFault::None)
        return true;
    const auto why = hasRecord ? std::string(session::toString(fault)) : std::string("no safety record");
    drop(why, header.message.number);
    if (guard.isExceeded(now))
        handle(session::ViolationFound{fmt::format("more than ten control messages refused in one second, the last: {}", why)});
    return false;
}

void DistributedModule::deliver(const MessageDefinition& definition, const protocol::DatagramHeader& header,
                                std::span<const std::byte> fields, FieldBytes* owned, session::Now now)
{
    std::optional<std::chrono::nanoseconds> latency;
    if (const auto offset = m_machine.clock().offset())
        latency = session::difference(now.wall, header.timestamp) + *offset;
    if (definition.lifespan && latency && *latency > *definition.lifespan + m_machine.clock().uncertainty()) {
        m_books.late();
        return drop("older than its lifespan", header.message.number);
    }
    if (definition.path == Path::Datagram)
        m_newest[definition.number] = header.timestamp;
    m_deadlines.arrived(definition, now.mono);
    m_books.delivered(latency);
    if (definition.priority != Priority::Status)
        m_usedSince = true;
    const bool owns = owned != nullptr && definition.recordSize() == 0;
    const auto& set = header.message.isCommand() ? m_host.ownSet() : m_peerSet;
    auto message = owns ? MessageAccess::fromFields(set, definition, std::move(*owned)) : MessageAccess::copyOf(set, definition, fields);
    MessageAccess::setMeta(message, header.message.origin, header.target, header.timestamp);
    MessageAccess::setArrival(message, now.mono, latency);
    m_host.deliver(std::move(message));
}

/// The peer's lane of that number; null when it has none.
tasks::ReceptionTask* DistributedModule::incoming(std::uint8_t lane) const
{
    if (lane == 0)
        return m_incoming.get();
    const auto found = m_incomingBulk.find(lane);
    return found != m_incomingBulk.end() ? found->second.get() : nullptr;
}

void DistributedModule::overBudget(const protocol::DatagramHeader& header, const protocol::Reassembler::OverBudget& passed)
{
    receivedInVain(header, passed.bytes);
    if (passed.first)
        drop("the unfinished messages of this process hold too much", header.message.number);
}

void DistributedModule::violated(std::uint8_t /*lane*/, const std::string& detail) { violation(detail); }

void DistributedModule::laneLost(std::uint8_t lane, const std::string& detail)
{
    const auto* lost = incoming(lane);
    m_host.turned();
    // A stall that is noticed only now may have ended the session: then nothing stands in that place, or the lane of the next one.
    if (lost == nullptr || incoming(lane) != lost)
        return;
    settle(*lost);
    if (lane == 0) {
        bury(std::move(m_incoming));
        handle(session::IncomingLost{detail});
    } else {
        bury(std::move(m_incomingBulk.at(lane)));
        m_incomingBulk.erase(lane);
    }
}

void DistributedModule::drop(const std::string& cause, std::uint16_t number, const std::string& detail)
{
    // Numbers that nothing defines share one entry: a peer must not be able to fill the books.
    const auto* definition = definitionOf(number);
    const auto count = m_books.dropped(cause, definition != nullptr ? number : std::uint16_t{0}, m_host.now().mono);
    if (!count)
        return;
    auto event = this->event(SessionEvent::Kind::MessagesDropped);
    event.message = definition != nullptr ? definition->name : number != 0 ? fmt::format("0x{:04x}", number) : std::string();
    event.count = *count;
    event.detail = detail.empty() ? cause : fmt::format("{}: {}", cause, printable(detail, 256));
    say(LogLevel::Warning, "messages-dropped",
        fmt::format("dropped {} of {}: {}", event.message.empty() ? "what came" : event.message, m_peer.name, event.detail));
    m_host.tell(std::move(event));
}

} // namespace liena::system
