// The unreliable path beside lane 0, as one session sees it: what system::DatagramPath decides, without its cipher.
#pragma once

#include "network.hpp"

#include "protocol/datagram_encoder.hpp"
#include "protocol/packet.hpp"
#include "session/packet_window.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace liena::simulation {

/// The key of a lane 0 is stood in for by the number of its connection: who has not the same connection cannot open the packet.
class DatagramPath {
public:
    void outgoingUp(std::uint64_t token, ConnectionNumber lane);
    void incomingUp(std::uint64_t token, ConnectionNumber lane, Instant now);
    void end();

    /// Nothing while our lane 0 does not stand, or when the message is too long.
    std::optional<std::vector<std::byte>> packet(const protocol::EncodedMessage& message);

    /// The datagram of a packet that is of this session, was sealed by the peer, and did not come before.
    std::optional<std::span<const std::byte>> open(std::span<const std::byte> packet, Instant now);

private:
    void begin(std::uint64_t token);

    std::uint64_t m_token = 0;
    ConnectionNumber m_sending = 0;
    ConnectionNumber m_receiving = 0;
    ConnectionNumber m_before = 0;
    Instant m_beforeUntil;
    std::uint64_t m_lastNumber = 0;
    session::PacketWindow m_window;
};

} // namespace liena::simulation
