// The datagram path of one peer: what its packets bring, and what ours may carry (protocol section 6, ruling B4).
#include "system/distributed_module.hpp"

namespace liena::system {

bool DistributedModule::owns(std::uint64_t token) const
{
    const auto state = m_machine.state();
    return token != 0 && token == m_machine.token() && state != SessionState::Closed && state != SessionState::StandBy;
}

void DistributedModule::packetHeard(std::span<std::byte> packet)
{
    if (!m_datagrams.hears())
        return; // a packet that was faster than the peer's lane 0 is no forgery
    const auto opened = m_datagrams.open(packet, m_host.now().mono);
    if (opened.fault)
        return drop(std::string(toString(*opened.fault)), 0);
    if (opened.datagram.size() < protocol::headerSize)
        return drop("a UDP packet without a whole header", 0);
    const auto header = protocol::decodeHeader(opened.datagram.first<protocol::headerSize>());
    const auto part = opened.datagram.subspan(protocol::headerSize);
    const bool dialogue = m_machine.state() == SessionState::Opening || m_machine.state() == SessionState::Reopening;
    if (dialogue && header.message.number != protocol::Heartbeat::number)
        return; // ruling A6: nothing else may travel yet, and nothing is counted
    const auto judgement = protocol::judgeInPacket(m_ends, header, part.size());
    m_judged = judgement.definition;
    if (judgement.verdict == protocol::HeaderVerdict::Refuse)
        return packetViolation(judgement.why, header);
    if (judgement.verdict == protocol::HeaderVerdict::Skip)
        return drop(judgement.why, header.message.number);
    if (header.message.number == protocol::Probe::number && !admitsProbe(0, header))
        return;
    handle(session::LifeHeard{session::LifePath::Packet});
    if (!heardMeasurement(protocol::ProbeWay::Packet, header, part))
        received(0, header, part, nullptr);
}

/// In the clear anybody could have written it, so that nothing may follow from it.
void DistributedModule::packetViolation(const std::string& detail, const protocol::DatagramHeader& header)
{
    if (m_datagrams.isSealed())
        violation(detail);
    else
        drop("a UDP packet that breaks the protocol", header.message.number, detail);
}

bool DistributedModule::isNewest(const MessageDefinition& definition, const protocol::DatagramHeader& header) const
{
    if (definition.path != Path::Datagram)
        return true;
    const auto newest = m_newest.find(definition.number);
    return newest == m_newest.end() || header.timestamp > newest->second;
}

} // namespace liena::system
