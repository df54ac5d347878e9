// The unit of transmission: a header of 20 bytes, then the body (protocol section 2).
#pragma once

#include "liena/device_id.hpp"
#include "liena/field_slot.hpp"
#include "liena/message_id.hpp"
#include "liena/timestamp.hpp"
#include "protocol/byte_reader.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace liena::protocol {

inline constexpr std::size_t headerSize = 20;
inline constexpr std::size_t maximumBody = 32767;

struct DatagramHeader {
    MessageId message;
    DeviceId target;
    Timestamp timestamp;
    std::uint16_t length = 0; ///< of the body, 0 to 32 767
    bool moreSegments = false;

    friend bool operator==(const DatagramHeader&, const DatagramHeader&) = default;
};

using HeaderBytes = std::array<std::byte, headerSize>;

inline constexpr std::uint16_t moreSegmentsBit = 0x8000;

inline HeaderBytes encodeHeader(const DatagramHeader& header)
{
    HeaderBytes bytes;
    store(bytes.data(), header.message.number);
    store(bytes.data() + 2, header.message.origin.value());
    store(bytes.data() + 6, header.target.value());
    store(bytes.data() + 10, header.timestamp.ns);
    store(bytes.data() + 18, static_cast<std::uint16_t>(header.length | (header.moreSegments ? moreSegmentsBit : 0)));
    return bytes;
}

/// Any 20 bytes are a header; what it says is judged by the session.
inline DatagramHeader decodeHeader(std::span<const std::byte, headerSize> bytes)
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
