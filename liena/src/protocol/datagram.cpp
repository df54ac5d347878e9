// The header's byte layout.
#include "protocol/datagram.hpp"

#include "protocol/byte_reader.hpp"

#include <cstring>

namespace liena::protocol {

namespace {

template <typename T>
void put(HeaderBytes& bytes, std::size_t offset, T value)
{
    std::memcpy(bytes.data() + offset, &value, sizeof(T));
}

constexpr std::uint16_t moreSegmentsBit = 0x8000;

} // namespace

HeaderBytes encodeHeader(const DatagramHeader& header)
{
    HeaderBytes bytes{};
    put(bytes, 0, header.message.number);
    put(bytes, 2, header.message.origin.value());
    put(bytes, 6, header.target.value());
    put(bytes, 10, header.timestamp.ns);
    put(bytes, 18, static_cast<std::uint16_t>(header.length | (header.moreSegments ? moreSegmentsBit : 0)));
    return bytes;
}

DatagramHeader decodeHeader(std::span<const std::byte, headerSize> bytes)
{
    ByteReader reader(bytes);
    DatagramHeader header;
    header.message.number = reader.read<std::uint16_t>();
    header.message.origin = DeviceId(reader.read<std::uint32_t>());
    header.target = DeviceId(reader.read<std::uint32_t>());
    header.timestamp.ns = reader.read<std::uint64_t>();
    const auto dlc = reader.read<std::uint16_t>();
    header.length = dlc & static_cast<std::uint16_t>(~moreSegmentsBit);
    header.moreSegments = (dlc & moreSegmentsBit) != 0;
    return header;
}

} // namespace liena::protocol
