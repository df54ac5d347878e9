// The prefix's byte layout.
#include "protocol/packet.hpp"

#include "protocol/byte_reader.hpp"

#include <cstring>

namespace liena::protocol {

PacketPrefixBytes encodePacketPrefix(const PacketPrefix& prefix)
{
    PacketPrefixBytes bytes{};
    std::memcpy(bytes.data(), &prefix.token, sizeof prefix.token);
    std::memcpy(bytes.data() + sizeof prefix.token, &prefix.number, sizeof prefix.number);
    return bytes;
}

std::optional<PacketPrefix> decodePacketPrefix(std::span<const std::byte> packet)
{
    ByteReader reader(packet);
    PacketPrefix prefix;
    prefix.token = reader.read<std::uint64_t>();
    prefix.number = reader.read<std::uint64_t>();
    return reader.ok() ? std::optional(prefix) : std::nullopt;
}

} // namespace liena::protocol
