// What a test makes a scripted peer say: on fresh connections, on the session's lanes, by UDP.
#include "support/scripted_peer.hpp"

#include <algorithm>
#include <netinet/in.h>
#include <sys/socket.h>

namespace liena::test {

using namespace wire;

namespace {

constexpr std::size_t rememberedPackets = 2000;

} // namespace

std::uint64_t ScriptedPeer::stamp()
{
    const auto now = static_cast<std::uint64_t>(std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count());
    auto last = m_lastStamp.load();
    auto next = std::max(now, last + 1);
    while (!m_lastStamp.compare_exchange_weak(last, next))
        next = std::max(now, last + 1);
    return next;
}

Header ScriptedPeer::header(std::uint16_t number)
{
    return {.number = number, .origin = m_role.id, .target = m_role.device, .timestamp = stamp()};
}

Bytes ScriptedPeer::handshake(std::uint64_t token)
{
    return said(number::handshake, wire::handshake(token, hashOf(m_role.topology), hashOf(m_role.set)));
}

Bytes ScriptedPeer::diagnosisHandshake(std::uint64_t token, std::uint64_t previous)
{
    return said(number::diagnosisHandshake, wire::diagnosisHandshake(token, hashOf(m_role.topology), hashOf(m_role.set), previous));
}

std::unique_ptr<TlsLink> ScriptedPeer::saying(const Bytes& first) const
{
    auto made = connection();
    made->send(first);
    return made;
}

std::unique_ptr<TlsLink> ScriptedPeer::lane(std::uint8_t lane) { return saying(attach(token(), lane)); }

void ScriptedPeer::replaceLaneZero()
{
    auto before = lane(0);
    {
        const std::lock_guard lock(m_mutex);
        std::swap(before, m_lane0);
        m_laneClosed = false;
        m_sealKey = m_lane0->datagramKey(m_token);
    }
    before->closes(); // the old one serves until the new one stands
}

bool ScriptedPeer::talkBack(const Bytes& bytes)
{
    const std::lock_guard lock(m_mutex);
    for (const auto& incoming : m_incoming)
        if (incoming->token == m_token && incoming->lane == 0)
            return incoming->link->send(bytes);
    return false;
}

bool ScriptedPeer::send(const Bytes& bytes)
{
    const std::lock_guard lock(m_mutex);
    return m_lane0 && m_lane0->send(bytes);
}

bool ScriptedPeer::say(std::uint16_t number, const Bytes& body)
{
    const std::lock_guard lock(m_mutex); // the stamp inside, so that stamps leave in their order
    return m_lane0 && m_lane0->send(said(number, body));
}

ScriptedPeer::Guard ScriptedPeer::guard(std::uint16_t number)
{
    const std::lock_guard lock(m_mutex);
    return {.epoch = m_newest.epoch, .sequence = ++m_sequences[number], .echo = m_newest.sequence};
}

Bytes ScriptedPeer::control(std::uint16_t number, const Bytes& fields, const Guard& guard)
{
    const auto head = header(number);
    return wire::datagram(head, guarded(head, guard.epoch, guard.sequence, guard.echo, fields));
}

Bytes ScriptedPeer::sealNext(const Bytes& datagram)
{
    auto packet = sealed(m_sealKey, m_token, ++m_packet, datagram);
    m_sentPackets.push_back(packet);
    if (m_sentPackets.size() > rememberedPackets)
        m_sentPackets.pop_front();
    return packet;
}

Bytes ScriptedPeer::packet(const Bytes& datagram)
{
    const std::lock_guard lock(m_mutex);
    return sealNext(datagram);
}

Bytes ScriptedPeer::packetNumbered(std::uint64_t packet, const Bytes& datagram) const
{
    const std::lock_guard lock(m_mutex);
    return sealed(m_sealKey, m_token, packet, datagram);
}

std::uint64_t ScriptedPeer::lastPacket() const
{
    const std::lock_guard lock(m_mutex);
    return m_packet;
}

void ScriptedPeer::sendPacket(const Bytes& packet) const
{
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(m_role.devicePort);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::sendto(m_udp.number(), packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&address), sizeof address);
}

std::vector<Bytes> ScriptedPeer::sentPackets() const
{
    const std::lock_guard lock(m_mutex);
    return {m_sentPackets.begin(), m_sentPackets.end()};
}

std::vector<ScriptedPeer::Heard> ScriptedPeer::heard(std::uint16_t number) const
{
    const std::lock_guard lock(m_mutex);
    std::vector<Heard> found;
    std::copy_if(m_heard.begin(), m_heard.end(), std::back_inserter(found),
                 [number](const Heard& one) { return one.datagram.header.number == number; });
    return found;
}

std::size_t ScriptedPeer::packetsHeard() const
{
    const std::lock_guard lock(m_mutex);
    return m_packetsHeard;
}

} // namespace liena::test
