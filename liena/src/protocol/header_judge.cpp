// The table of section 2, row by row.
#include "protocol/header_judge.hpp"

#include "protocol/probe_words.hpp"
#include "protocol/session_messages.hpp"

#include <fmt/format.h>

#include <utility>

namespace liena::protocol {

namespace {

bool isReserved(std::uint16_t number) { return number == 0 || number >= 0x1000; }

HeaderJudgement skip(std::string why) { return {HeaderVerdict::Skip, 0, std::move(why)}; }
HeaderJudgement refuse(std::string why) { return {HeaderVerdict::Refuse, 0, std::move(why)}; }

bool forbidsBroadcast(const MessageDefinition& definition)
{
    return definition.role == Role::Command || definition.priority == Priority::Control;
}

/// The messages about incidents, which everybody hands on.
bool mayBeBroadcast(std::uint16_t number)
{
    return number == StandBy::number || number == StandByReport::number || number == IncidentDismissed::number ||
           number == ChannelReOpened::number;
}

/// To one device alone they would end where they should be handed on. (A ChannelReOpened to one device opens its session.)
bool mustBeBroadcast(std::uint16_t number) { return mayBeBroadcast(number) && number != ChannelReOpened::number; }

/// An image of a measurement takes the images' way.
bool mayBeOnBulkLane(std::uint16_t number) { return number == Abandon::number || number == Probe::number; }

/// Session management for which a lost segment must not mean a wait, or which finds out about the packets' way.
bool mayTravelByUdp(std::uint16_t number) { return number == Heartbeat::number || number == Probe::number || number == ProbeEcho::number; }

std::string tooLong(const MessageDefinition& definition)
{
    return fmt::format("{} is longer than the {} bytes its definition allows", definition.name, definition.maximumSize());
}

/// What holds on every path; nothing when the header passes.
std::optional<HeaderJudgement> judgeAddress(const Ends& ends, const DatagramHeader& header)
{
    if (header.message.origin != ends.peer)
        return refuse(fmt::format("origin {} on the connection of {}", header.message.origin.toString(), ends.peer.toString()));
    if (header.target != ends.self && !header.target.isBroadcast())
        return skip("target is another device");
    if (isReserved(header.message.number))
        return skip("reserved message number");
    return std::nullopt;
}

HeaderJudgement judgeSession(std::uint8_t lane, const DatagramHeader& header)
{
    const auto maximum = maximumSessionBody(header.message.number);
    if (!maximum)
        return skip("unknown session message");
    if (lane != 0 && !mayBeOnBulkLane(header.message.number))
        return refuse("session management on a bulk lane");
    if (header.target.isBroadcast() && !mayBeBroadcast(header.message.number))
        return refuse(fmt::format("session message 0x{:04x} cannot be broadcast", header.message.number));
    if (!header.target.isBroadcast() && mustBeBroadcast(header.message.number))
        return refuse(fmt::format("session message 0x{:04x} must be broadcast", header.message.number));
    const auto longest = header.message.number == Probe::number && lane == 0 ? probeHeadSize + maximumPromptPadding : *maximum;
    if (header.length > longest)
        return refuse(fmt::format("session message 0x{:04x} is longer than it can be", header.message.number));
    return {HeaderVerdict::Take, longest, {}};
}

HeaderJudgement judgeApplication(const Ends& ends, std::uint8_t lane, const DatagramHeader& header)
{
    const auto* definition = ends.definitionOf(header.message.number);
    if (definition == nullptr)
        return skip("unknown message number");
    if ((definition->priority == Priority::Bulk) != (lane > 0))
        return refuse(fmt::format("{} on the wrong kind of lane", definition->name));
    if (header.target.isBroadcast() && forbidsBroadcast(*definition))
        return skip("a command or control message that is broadcast");
    if (header.length > definition->maximumSize())
        return refuse(tooLong(*definition));
    if (definition->priority == Priority::Control && header.moreSegments)
        return refuse(fmt::format("{} is a control message in several segments", definition->name));
    return {HeaderVerdict::Take, definition->maximumSize(), {}, definition};
}

HeaderJudgement judgePacketApplication(const Ends& ends, const DatagramHeader& header)
{
    const auto* definition = ends.definitionOf(header.message.number);
    if (definition == nullptr)
        return skip("unknown message number");
    if (definition->path != Path::Datagram)
        return skip("a message that does not travel by UDP");
    if (header.target.isBroadcast() && forbidsBroadcast(*definition))
        return skip("a command or control message that is broadcast");
    if (header.length > definition->maximumSize())
        return refuse(tooLong(*definition));
    return {HeaderVerdict::Take, definition->maximumSize(), {}, definition};
}

} // namespace

const MessageDefinition* Ends::definitionOf(std::uint16_t number) const
{
    const MessageId id{peer, number};
    const auto* set = id.isCommand() ? ownSet : peerSet;
    return set != nullptr && (id.isCommand() || id.isReport()) ? set->find(number) : nullptr;
}

HeaderJudgement judgeOnLane(const Ends& ends, std::uint8_t lane, const DatagramHeader& header)
{
    if (auto fault = judgeAddress(ends, header))
        return std::move(*fault);
    return header.message.isSessionManagement() ? judgeSession(lane, header) : judgeApplication(ends, lane, header);
}

HeaderJudgement judgeInPacket(const Ends& ends, const DatagramHeader& header, std::size_t partSize)
{
    if (auto fault = judgeAddress(ends, header))
        return std::move(*fault);
    if (header.moreSegments || header.length != partSize)
        return skip("a datagram that does not fill its UDP packet");
    if (!header.message.isSessionManagement())
        return judgePacketApplication(ends, header);
    if (!mayTravelByUdp(header.message.number) || header.target.isBroadcast())
        return skip("a session message that does not travel by UDP");
    return judgeSession(0, header);
}

bool isAttachHeader(DeviceId self, std::optional<DeviceId> authenticated, const DatagramHeader& header)
{
    return header.message.number == Attach::number && !header.moreSegments && header.target == self &&
           (!authenticated || header.message.origin == *authenticated) && header.length == maximumSessionBody(Attach::number);
}

bool isHandshakeHeader(DeviceId self, DeviceId peer, const DatagramHeader& header)
{
    const auto number = header.message.number;
    const bool handshake = number == Handshake::number || number == DiagnosisHandshake::number;
    return handshake && header.message.origin == peer && header.target == self && !header.moreSegments &&
           header.length <= *maximumSessionBody(number);
}

} // namespace liena::protocol
