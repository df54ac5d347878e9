// Sealing, opening, and the change of keys.
#include "system/datagram_path.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace liena::system {

using namespace std::chrono_literals;

std::string_view toString(DatagramPath::Fault fault)
{
    return fault == DatagramPath::Fault::NotNew ? "a UDP packet with an old number: repeated, or much delayed"
                                                : "a UDP packet that the peer has not sealed: forged or damaged";
}

DatagramPath::DatagramPath(transport::UdpSocket& socket, std::uint16_t port, bool sealed) : m_socket(socket), m_port(port), m_sealed(sealed)
{}

void DatagramPath::begin(std::uint64_t token)
{
    if (token == m_token)
        return;
    end();
    m_token = token;
}

void DatagramPath::end()
{
    m_token = 0;
    m_to.reset();
    m_sending.reset();
    m_next.reset();
    m_lastNumber = 0;
    m_hears = false;
    m_receiving.reset();
    m_before.clear();
    m_window = {};
}

void DatagramPath::outgoingUp(std::uint64_t token, const Key& key, const boost::asio::ip::address& host, session::Instant now)
{
    begin(token);
    m_to.reset();
    m_next.reset();
    if (m_sealed) {
        if (!key)
            return m_sending.reset(); // the session works without this path
        // A packet is faster than the Attach before it, and would look forged. The peer opens with the old key for long enough.
        if (m_sending) {
            m_next.emplace(key.value());
            m_nextFrom = now + 200ms;
        } else {
            m_sending.emplace(key.value());
        }
    }
    m_to.emplace(host, m_port);
}

void DatagramPath::incomingUp(std::uint64_t token, const Key& key, session::Instant now)
{
    begin(token);
    m_hears = true;
    if (!m_sealed)
        return;
    if (m_receiving) {
        if (m_before.size() == mostBefore)
            m_before.erase(m_before.begin());
        m_before.push_back({std::move(*m_receiving), now + 1s});
    }
    m_receiving.reset();
    if (key)
        m_receiving.emplace(key.value());
}

bool DatagramPath::send(const protocol::EncodedMessage& message, session::Instant now)
{
    if (m_next && now >= m_nextFrom)
        m_sending = std::exchange(m_next, std::nullopt);
    if (!m_to || message.part.size() > protocol::maximumPacketPart)
        return false;
    auto header = message.header;
    header.length = static_cast<std::uint16_t>(message.part.size());
    header.moreSegments = false;
    const auto number = ++m_lastNumber; // used up even if the packet does not leave: a nonce never returns
    const auto prefix = protocol::encodePacketPrefix({m_token, number});
    const auto headerBytes = protocol::encodeHeader(header);
    const auto length = protocol::headerSize + message.part.size();
    const std::span packet(m_packet);
    const auto datagram = packet.subspan(protocol::packetPrefixSize, length);
    std::memcpy(packet.data(), prefix.data(), prefix.size());
    std::memcpy(datagram.data(), headerBytes.data(), headerBytes.size());
    if (!message.part.empty())
        std::memcpy(datagram.data() + protocol::headerSize, message.part.data(), message.part.size());
    auto size = protocol::packetPrefixSize + length;
    if (m_sealed) {
        const auto sealed = packet.subspan(protocol::packetPrefixSize, length + protocol::packetTagSize);
        if (!m_sending || !m_sending->seal(number, packet.first(protocol::packetPrefixSize), datagram, sealed))
            return false;
        size += protocol::packetTagSize;
    }
    if (!m_socket.send(*m_to, packet.first(size)))
        return false;
    m_bytesSent += size;
    return true;
}

DatagramPath::Opened DatagramPath::open(std::span<const std::byte> packet, session::Instant now)
{
    const auto prefix = protocol::decodePacketPrefix(packet);
    const auto least = protocol::packetPrefixSize + (m_sealed ? protocol::packetTagSize : 0);
    if (!m_hears || !prefix || prefix->token != m_token || packet.size() < least)
        return {Fault::NotGenuine, {}};
    if (!m_window.isNew(prefix->number))
        return {Fault::NotNew, {}};
    if (m_sealed && !unseal(prefix->number, packet, now))
        return {Fault::NotGenuine, {}};
    m_window.note(prefix->number);
    m_bytesReceived += packet.size();
    const auto length = packet.size() - least;
    return {std::nullopt,
            m_sealed ? std::span<const std::byte>(m_opened).first(length) : packet.subspan(protocol::packetPrefixSize, length)};
}

bool DatagramPath::unseal(std::uint64_t number, std::span<const std::byte> packet, session::Instant now)
{
    const auto clear = packet.first(protocol::packetPrefixSize);
    const auto sealed = packet.subspan(protocol::packetPrefixSize);
    const auto length = sealed.size() - protocol::packetTagSize;
    if (length > m_opened.size())
        return false;
    const auto target = std::span(m_opened).first(length);
    const auto opens = [&](security::DatagramSeal& seal) { return seal.open(number, clear, sealed, target); };
    return (m_receiving && opens(*m_receiving)) ||
           std::any_of(m_before.rbegin(), m_before.rend(), [&](Before& before) { return now < before.until && opens(before.seal); });
}

} // namespace liena::system
