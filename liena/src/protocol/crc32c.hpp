// CRC-32C (Castagnoli), as the safety record carries it; RFC 3720 appendix B.4 holds test values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace liena::protocol {

/// The CRC of `bytes` after those that gave `previous`; start with 0.
std::uint32_t crc32c(std::span<const std::byte> bytes, std::uint32_t previous = 0);

/// The same on every processor.
std::uint32_t crc32cByTables(std::span<const std::byte> bytes, std::uint32_t previous = 0);

} // namespace liena::protocol
