// The datagram path of one session: numbers, keys and the window of its packets (protocol section 6; rulings A11, B4).
#pragma once

#include "protocol/datagram_encoder.hpp"
#include "protocol/packet.hpp"
#include "security/datagram_seal.hpp"
#include "session/instant.hpp"
#include "session/packet_window.hpp"
#include "transport/udp_socket.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace liena::system {

/// Network thread. In mode `none` packets are in the clear and have no tag.
class DatagramPath {
public:
    /// The peer listens on `port`, on the host that its lane 0 has reached.
    DatagramPath(transport::UdpSocket& socket, std::uint16_t port, bool sealed);

    using Key = Result<security::DatagramKey>; ///< of a lane 0; an error where it has none, as in mode `none`

    /// Our lane 0 of the session with that token stands, to that host: its key seals; from now on, or soon when another one did until now.
    void outgoingUp(std::uint64_t token, const Key& key, const boost::asio::ip::address& host, session::Instant now);

    /// The peer's lane 0 stands: its key opens from now on, and those before for another second each.
    void incomingUp(std::uint64_t token, const Key& key, session::Instant now);

    /// The session is over; its keys are forgotten.
    void end();

    /// False before the peer's lane 0 stands: its packets cannot be judged yet.
    bool hears() const { return m_hears && (!m_sealed || m_receiving); }
    bool isSealed() const { return m_sealed; }

    /// Seals and sends one whole message; false when it did not leave.
    bool send(const protocol::EncodedMessage& message, session::Instant now);

    enum class Fault : std::uint8_t { NotNew, NotGenuine };
    struct Opened {
        std::optional<Fault> fault;
        std::span<const std::byte> datagram; ///< within `packet`, or until the next one is opened
    };
    /// Judges a packet that has this session's token: the number first, then the tag, and only then the number is noted.
    Opened open(std::span<const std::byte> packet, session::Instant now);

    std::uint64_t bytesSent() const { return m_bytesSent; }
    std::uint64_t bytesReceived() const { return m_bytesReceived; }

private:
    /// The key of a lane 0 that was replaced. A peer that makes it anew again and again still seals with the first of them.
    struct Before {
        security::DatagramSeal seal;
        session::Instant until;
    };
    static constexpr std::size_t mostBefore = 4;

    void begin(std::uint64_t token);
    bool unseal(std::uint64_t number, std::span<const std::byte> packet, session::Instant now);

    transport::UdpSocket& m_socket;
    std::uint16_t m_port;
    bool m_sealed;
    std::uint64_t m_token = 0;

    std::optional<boost::asio::ip::udp::endpoint> m_to;
    std::optional<security::DatagramSeal> m_sending;
    std::optional<security::DatagramSeal> m_next; ///< of our newest lane 0, when the peer may not have read its Attach yet
    session::Instant m_nextFrom;
    std::uint64_t m_lastNumber = 0;
    std::array<std::byte, protocol::maximumPacket> m_packet{};

    bool m_hears = false;
    std::array<std::byte, protocol::maximumPacketDatagram> m_opened{};
    std::optional<security::DatagramSeal> m_receiving;
    std::vector<Before> m_before; ///< the newest last
    session::PacketWindow m_window;

    std::uint64_t m_bytesSent = 0;
    std::uint64_t m_bytesReceived = 0;
};

std::string_view toString(DatagramPath::Fault fault);

} // namespace liena::system
