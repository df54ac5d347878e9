// The datagram path of one peer: what its packets bring, and what ours may carry (protocol section 6, ruling B4).
#include "system/distributed_module.hpp"

#include <fmt/format.h>

namespace liena::system {

bool DistributedModule::owns(std::uint64_t token) const
{
    const auto state = m_machine.state();
    return token != 0 && token == m_machine.token() && state != SessionState::Closed && state != SessionState::StandBy;
}

void DistributedModule::packetHeard(std::span<std::byte> packet)
{
    const auto opened = m_datagrams.open(packet, m_host.now().mono);
    if (opened.fault)
        return drop(std::string(toString(*opened.fault)), 0);
    if (opened.datagram.size() < protocol::headerSize)
        return drop("a UDP packet without a whole header", 0);
    const auto header = protocol::decodeHeader(opened.datagram.first<protocol::headerSize>());
    const auto part = opened.datagram.subspan(protocol::headerSize);
    if (!isAddressedHere(header) || !fillsItsPacket(header, part.size()))
        return;
    if (header.message.isSessionManagement())
        heartbeatPacket(header, part);
    else
        applicationPacket(header, part);
}

bool DistributedModule::isAddressedHere(const protocol::DatagramHeader& header)
{
    if (header.message.origin != m_peer.id) {
        packetViolation(fmt::format("origin {} in a packet of {}", header.message.origin.toString(), m_peer.id.toString()), header);
        return false;
    }
    if (header.target == m_host.ownDevice().id || header.target.isBroadcast())
        return true;
    drop("target is another device", header.message.number);
    return false;
}

bool DistributedModule::fillsItsPacket(const protocol::DatagramHeader& header, std::size_t partSize)
{
    if (!header.moreSegments && header.length == partSize)
        return true;
    drop("a datagram that does not fill its UDP packet", header.message.number);
    return false;
}

/// In the clear anybody could have written it, so that nothing may follow from it.
void DistributedModule::packetViolation(const std::string& detail, const protocol::DatagramHeader& header)
{
    if (m_datagrams.isSealed())
        violation(detail);
    else
        drop(detail, header.message.number);
}

void DistributedModule::heartbeatPacket(const protocol::DatagramHeader& header, std::span<const std::byte> part)
{
    if (header.message.number != protocol::Heartbeat::number || header.target.isBroadcast())
        return drop("a session message that does not travel by UDP", header.message.number);
    if (part.size() > protocol::maximumSessionBody(protocol::Heartbeat::number))
        return packetViolation("a heartbeat that is longer than it can be", header);
    handle(session::LifeHeard{session::LifePath::Packet});
    receivedSession(0, header, part);
}

void DistributedModule::applicationPacket(const protocol::DatagramHeader& header, std::span<const std::byte> part)
{
    if (m_machine.state() == SessionState::Opening || m_machine.state() == SessionState::Reopening)
        return;
    const auto* definition = definitionOf(header.message.number);
    if (definition == nullptr)
        return drop("unknown message number", header.message.number);
    if (definition->path != Path::Datagram)
        return drop("a message that does not travel by UDP", header.message.number);
    if (header.target.isBroadcast() && (definition->role == Role::Command || definition->priority == Priority::Control))
        return drop("a command or control message that is broadcast", header.message.number);
    if (part.size() > definition->maximumSize())
        return packetViolation(
            fmt::format("{} is longer than the {} bytes its definition allows", definition->name, definition->maximumSize()), header);
    handle(session::LifeHeard{session::LifePath::Packet});
    receivedApplication(header, part, nullptr);
}

bool DistributedModule::isNewest(const MessageDefinition& definition, const protocol::DatagramHeader& header) const
{
    if (definition.path != Path::Datagram)
        return true;
    const auto newest = m_newest.find(definition.number);
    return newest == m_newest.end() || header.timestamp > newest->second;
}

} // namespace liena::system
