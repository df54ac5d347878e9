// The DSCP of the packets that a socket sends (RFC 2474).
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdint>

namespace liena::transport {

/// A system that does not permit it goes on without a mark.
inline void markPackets(int socket, bool v6, std::uint8_t dscp)
{
    constexpr int ecnBits = 2; // below the DSCP in that byte (RFC 3168)
    const int value = dscp << ecnBits;
    (void)::setsockopt(socket, v6 ? IPPROTO_IPV6 : IPPROTO_IP, v6 ? IPV6_TCLASS : IP_TOS, &value, sizeof value);
}

} // namespace liena::transport
