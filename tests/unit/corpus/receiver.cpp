// The order of the checks is that of the library's modules.
#include "receiver.hpp"

#include "protocol/datagram_decoder.hpp"
#include "protocol/information_part.hpp"
#include "protocol/packet.hpp"

#include <stdexcept>

namespace liena::test {

using namespace protocol;

namespace {

constexpr std::uint64_t token = 0x1122334455667788;
const Verdict accepted{"accepted", {}, {}};

std::shared_ptr<const MessageSet> loaded(const char* name)
{
    Findings findings;
    const auto set = MessageSet::load(std::filesystem::path(LIENA_SOURCE_DIR "/tests/corpus/sets") / name, &findings);
    if (!set)
        throw std::runtime_error(set.error().what);
    return set.value();
}

security::DatagramKey knownKey()
{
    security::DatagramKey key;
    for (std::size_t i = 0; i < key.key.size(); ++i)
        key.key[i] = static_cast<std::byte>(i);
    for (std::size_t i = 0; i < key.iv.size(); ++i)
        key.iv[i] = static_cast<std::byte>(0x20 + i);
    return key;
}

/// One whole datagram at the start of the bytes.
struct First {
    DatagramHeader header;
    std::span<const std::byte> body;
};

First firstOf(std::span<const std::byte> bytes)
{
    if (bytes.size() < headerSize)
        throw std::runtime_error("the file holds no whole header");
    const auto header = decodeHeader(bytes.first<headerSize>());
    return {header, bytes.subspan(headerSize, std::min<std::size_t>(header.length, bytes.size() - headerSize))};
}

} // namespace

Receiver::Receiver(std::uint8_t lane, const std::string& state)
    : m_robot(loaded("robot.xml")),
      m_cockpit(loaded("cockpit.xml")),
      m_ends{cockpitId, robotId, m_robot.get(), m_cockpit.get()},
      m_lane(lane),
      m_guard(LinkTiming()),
      m_seal(knownKey()),
      m_reassembler(m_budget)
{
    enter(state);
    const auto now = m_side.now.mono;
    m_guard.raiseEpoch(now - 1s);
    m_guard.sentHeartbeat(1, now - 200ms);
    m_guard.sentHeartbeat(2, now - 60ms);
    m_guard.sentHeartbeat(3, now - 10ms);
    const DatagramHeader header{{cockpitId, 0x0100}, robotId, {}, 16, false};
    SafetyRecord record{2, 5, 3, 0};
    record.crc = safetyCrc(header, record, {});
    if (m_guard.judge(header, record, {}, 50ms, now) != session::ControlFault::None)
        throw std::runtime_error("the command that was delivered before is refused");
    for (std::uint64_t number = 1; number <= 2000; ++number)
        if (number != 975 && number != 976)
            m_window.note(number);
}

void Receiver::enter(const std::string& state)
{
    if (state.empty() || state == "Open")
        m_side.becomeOpen(token);
    else if (state == "Opening")
        m_side.becomeOpening(token);
    else if (state == "Opening-responder")
        m_side.becomeResponder(token);
    else if (state == "Closing") {
        m_side.becomeOpen(token);
        m_side.handle(session::CloseRequested{"done"});
    } else
        throw std::runtime_error("no such state: " + state);
}

Verdict Receiver::onLane(std::span<const std::byte> bytes)
{
    DatagramDecoder decoder;
    if (bytes.size() > decoder.writable().size())
        throw std::runtime_error("the file is longer than one reading");
    std::copy(bytes.begin(), bytes.end(), decoder.writable().begin());
    decoder.commit(bytes.size());
    Verdict verdict{"", "header", "the file holds no whole datagram"};
    std::size_t maximum = 0;
    const auto judge = [&](const DatagramHeader& header) {
        auto judgement = judgeOnLane(m_ends, m_lane, header);
        maximum = judgement.maximum;
        if (judgement.verdict != HeaderVerdict::Take)
            verdict = {judgement.verdict == HeaderVerdict::Skip ? "dropped" : "violation", "header", judgement.why};
        return judgement.verdict == HeaderVerdict::Take ? HeaderVerdict::Take : HeaderVerdict::Refuse;
    };
    decoder.process(judge, [&](const DatagramHeader& header, std::span<const std::byte> body) {
        verdict = take(header, body, maximum);
        return !verdict.isRefusal();
    });
    return verdict;
}

Verdict Receiver::take(const DatagramHeader& header, std::span<const std::byte> body, std::size_t maximum)
{
    const auto outcome = m_reassembler.take(header, body, maximum);
    if (const auto* violation = std::get_if<Reassembler::Violation>(&outcome))
        return {"violation", "segment", violation->what};
    if (const auto* assembled = std::get_if<Reassembler::Assembled>(&outcome))
        return takeMessage(header, {assembled->bytes.data(), assembled->bytes.size()});
    return std::holds_alternative<Reassembler::Whole>(outcome) ? takeMessage(header, body) : accepted;
}

Verdict Receiver::takeMessage(const DatagramHeader& header, std::span<const std::byte> part)
{
    return header.message.isSessionManagement() ? takeSession(header, part) : takeApplication(header, part);
}

session::SessionInput Receiver::inputOf(const SessionMessage& message) const
{
    if (const auto* commit = std::get_if<HandshakeCommit>(&message))
        return session::CommitHeard{*commit, false, 0, session::SetStanding::Held};
    if (const auto* commit = std::get_if<DiagnosisHandshakeCommit>(&message))
        return session::CommitHeard{commit->commit, true, commit->previous, session::SetStanding::Held};
    if (std::holds_alternative<MessageSetAnswer>(message))
        return session::SetHeard{session::SetStanding::Held, {}};
    return session::SessionMessageHeard{message};
}

Verdict Receiver::takeSession(const DatagramHeader& header, std::span<const std::byte> part)
{
    const auto message = decodeSessionMessage(header.message.number, part);
    if (!message)
        return {"malformed", "body", "session message that does not decode"};
    if (header.target.isBroadcast())
        return accepted;
    const auto actions = m_side.handle(inputOf(*message));
    if (const auto* failed = find<session::OpenFailed>(actions); failed != nullptr && failed->reason == RejectReason::ProtocolViolation)
        return {"violation", "state", failed->detail};
    if (const auto* lost = find<session::SessionLost>(actions); lost != nullptr && lost->diagnosis.cause == LossCause::ProtocolViolation)
        return {"violation", "state", lost->diagnosis.detail};
    if (const auto* rejected = findSent<Rejected>(actions); rejected != nullptr && rejected->reason == RejectReason::ProtocolViolation)
        return {"violation", "state", rejected->detail.value};
    return accepted;
}

Verdict Receiver::takeApplication(const DatagramHeader& header, std::span<const std::byte> part)
{
    const auto& definition = *m_ends.definitionOf(header.message.number);
    if (definition.priority == Priority::Control) {
        if (part.size() < safetyRecordSize)
            return {"dropped", "record", "no safety record"};
        const auto record = decodeSafetyRecord(part.first<safetyRecordSize>());
        const auto fault = m_guard.judge(header, record, part.subspan(safetyRecordSize), *definition.maxAge, m_side.now.mono);
        if (fault != session::ControlFault::None)
            return {"dropped", "record", std::string(session::toString(fault))};
    }
    const auto fault = checkFields(definition, part.subspan(definition.recordSize()));
    return fault ? Verdict{"malformed", "body", *fault} : accepted;
}

Verdict Receiver::asAttach(std::span<const std::byte> bytes) const
{
    const auto first = firstOf(bytes);
    if (!isAttachHeader(robotId, cockpitId, first.header))
        return {"closed", "attach", {}};
    return decodeSessionMessage(first.header.message.number, first.body) ? accepted : Verdict{"closed", "attach", {}};
}

Verdict Receiver::asHandshake(std::span<const std::byte> bytes) const
{
    const auto first = firstOf(bytes);
    const Verdict closed{"closed", "handshake", {}};
    if (!isHandshakeHeader(robotId, cockpitId, first.header))
        return closed;
    const auto message = decodeSessionMessage(first.header.message.number, first.body);
    const auto* handshake = message ? std::get_if<Handshake>(&*message) : nullptr;
    return handshake != nullptr && handshake->token == token ? accepted : closed;
}

Verdict Receiver::asPacket(std::span<const std::byte> bytes)
{
    const auto dropped = [](std::string why) { return Verdict{"dropped", "packet", std::move(why)}; };
    const auto prefix = decodePacketPrefix(bytes);
    if (!prefix || prefix->token != token || bytes.size() < packetPrefixSize + packetTagSize)
        return dropped("not sealed: no prefix of this session, or no room for a tag");
    if (!m_window.isNew(prefix->number))
        return dropped("an old number");
    std::vector<std::byte> datagram(bytes.size() - packetPrefixSize - packetTagSize);
    if (!m_seal.open(prefix->number, bytes.first(packetPrefixSize), bytes.subspan(packetPrefixSize), datagram))
        return dropped("not sealed by the peer");
    if (datagram.size() < headerSize)
        return dropped("a UDP packet without a whole header");
    const auto [header, body] = firstOf(datagram);
    const auto judgement = judgeInPacket(m_ends, header, datagram.size() - headerSize);
    if (judgement.verdict == HeaderVerdict::Refuse)
        return {"violation", "packet", judgement.why};
    if (judgement.verdict == HeaderVerdict::Skip)
        return dropped(judgement.why);
    return takeMessage(header, body);
}

} // namespace liena::test
