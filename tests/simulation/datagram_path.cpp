// Numbers, keys and the window.
#include "datagram_path.hpp"

#include <cstring>

namespace liena::simulation {

using namespace std::chrono_literals;

namespace {

constexpr std::size_t keySize = sizeof(ConnectionNumber);

} // namespace

void DatagramPath::begin(std::uint64_t token)
{
    if (token == m_token)
        return;
    end();
    m_token = token;
}

void DatagramPath::end() { *this = DatagramPath(); }

void DatagramPath::outgoingUp(std::uint64_t token, ConnectionNumber lane)
{
    begin(token);
    m_sending = lane;
}

void DatagramPath::incomingUp(std::uint64_t token, ConnectionNumber lane, Instant now)
{
    begin(token);
    if (m_receiving != 0) {
        m_before = m_receiving;
        m_beforeUntil = now + 1s;
    }
    m_receiving = lane;
}

std::optional<std::vector<std::byte>> DatagramPath::packet(const protocol::EncodedMessage& message)
{
    if (m_sending == 0 || message.part.size() > protocol::maximumPacketPart)
        return std::nullopt;
    const auto prefix = protocol::encodePacketPrefix({m_token, ++m_lastNumber});
    std::vector<std::byte> bytes(prefix.begin(), prefix.end());
    bytes.resize(prefix.size() + keySize);
    std::memcpy(bytes.data() + prefix.size(), &m_sending, keySize);
    protocol::DatagramEncoder().appendSegment(message, protocol::maximumBody, bytes);
    return bytes;
}

std::optional<std::span<const std::byte>> DatagramPath::open(std::span<const std::byte> packet, Instant now)
{
    const auto prefix = protocol::decodePacketPrefix(packet);
    if (m_receiving == 0 || !prefix || prefix->token != m_token || !m_window.isNew(prefix->number))
        return std::nullopt;
    ConnectionNumber key = 0;
    std::memcpy(&key, packet.data() + protocol::packetPrefixSize, keySize);
    if (key != m_receiving && (key != m_before || now >= m_beforeUntil))
        return std::nullopt;
    m_window.note(prefix->number);
    return packet.subspan(protocol::packetPrefixSize + keySize);
}

} // namespace liena::simulation
