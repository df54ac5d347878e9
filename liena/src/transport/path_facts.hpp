// What the kernel knows of the path of a connection (tcp(7), TCP_INFO).
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace liena::transport {

struct PathFacts {
    std::chrono::nanoseconds roundTrip{};      ///< smoothed
    std::chrono::nanoseconds leastRoundTrip{}; ///< of the last minutes
    std::uint64_t bytesSent = 0;               ///< since it was connected
    std::uint64_t bytesAcknowledged = 0;       ///< since it was connected
    std::chrono::nanoseconds windowClosed{};   ///< since it was connected: the receiver had no room
    std::uint32_t bytesUnsent = 0;             ///< in the kernel, not yet on the wire
};

/// Nothing where the kernel does not tell (before Linux 4.19), or when the socket is closed.
std::optional<PathFacts> readPathFacts(int socket);

} // namespace liena::transport
