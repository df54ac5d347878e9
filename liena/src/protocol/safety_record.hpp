// The 16 bytes that guard every control message (protocol section 3, rulings A1, A2, B1).
#pragma once

#include "protocol/datagram.hpp"

#include <cstdint>
#include <span>

namespace liena::protocol {

inline constexpr std::size_t safetyRecordSize = 16;

struct SafetyRecord {
    std::uint32_t epoch = 0;    ///< the target's session epoch, as last heard in its Heartbeat
    std::uint32_t sequence = 0; ///< from 1, +1 per message of this number, session and epoch
    std::uint32_t echo = 0;     ///< the newest Heartbeat sequence heard from the target
    std::uint32_t crc = 0;

    friend bool operator==(const SafetyRecord&, const SafetyRecord&) = default;
};

using SafetyRecordBytes = std::array<std::byte, safetyRecordSize>;

/// CRC-32C of the header (DLC as for one segment), the record's first 12 bytes and the fields.
std::uint32_t safetyCrc(const DatagramHeader& header, const SafetyRecord& record, std::span<const std::byte> fields);

SafetyRecordBytes encodeSafetyRecord(const SafetyRecord& record);
SafetyRecord decodeSafetyRecord(std::span<const std::byte, safetyRecordSize> bytes);

} // namespace liena::protocol
