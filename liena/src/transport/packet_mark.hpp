// The DSCP of the packets that a socket sends (RFC 2474).
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>

namespace liena::transport {

/// False on a system that does not permit it: all goes on without a mark.
bool markPackets(int socket, bool v6, std::uint8_t dscp);

/// Why packets of this computer cannot bear one of these marks, tried on a socket that sends nothing; nothing when they can.
std::optional<std::string> whyUnmarked(bool v6, std::initializer_list<std::uint8_t> marks);

} // namespace liena::transport
