// One UDP packet of the datagram path: its prefix in the clear, one datagram, and the tag (protocol section 6).
#pragma once

#include "protocol/datagram.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace liena::protocol {

inline constexpr std::size_t packetPrefixSize = 16;
inline constexpr std::size_t packetTagSize = 16;
inline constexpr std::size_t maximumPacketPart = 1200; ///< information part with its safety record, in bytes
inline constexpr std::size_t maximumPacketDatagram = headerSize + maximumPacketPart;
inline constexpr std::size_t maximumPacket = packetPrefixSize + maximumPacketDatagram + packetTagSize;

struct PacketPrefix {
    std::uint64_t token = 0;
    std::uint64_t number = 0; ///< from 1, strictly increasing per sender and token

    friend bool operator==(const PacketPrefix&, const PacketPrefix&) = default;
};

using PacketPrefixBytes = std::array<std::byte, packetPrefixSize>;

PacketPrefixBytes encodePacketPrefix(const PacketPrefix& prefix);

/// Nothing when the packet is shorter than a prefix.
std::optional<PacketPrefix> decodePacketPrefix(std::span<const std::byte> packet);

} // namespace liena::protocol
