// The unit of transmission: a header of 20 bytes, then the body (protocol section 2).
#pragma once

#include "liena/device_id.hpp"
#include "liena/message_id.hpp"
#include "liena/timestamp.hpp"

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

HeaderBytes encodeHeader(const DatagramHeader& header);

/// Any 20 bytes are a header; what it says is judged by the session.
DatagramHeader decodeHeader(std::span<const std::byte, headerSize> bytes);

} // namespace liena::protocol
