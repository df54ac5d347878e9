// Asking the kernel. Apart from all other sources, since Linux's and the C library's headers of TCP exclude each other.
#include "transport/path_facts.hpp"

#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstddef>

namespace liena::transport {

std::optional<PathFacts> readPathFacts(int socket)
{
    tcp_info info{};
    socklen_t size = sizeof info;
    if (::getsockopt(socket, IPPROTO_TCP, TCP_INFO, &info, &size) != 0 || size < offsetof(tcp_info, tcpi_dsack_dups))
        return std::nullopt;
    PathFacts facts;
    facts.roundTrip = std::chrono::microseconds(info.tcpi_rtt);
    facts.leastRoundTrip = std::chrono::microseconds(info.tcpi_min_rtt);
    facts.bytesSent = info.tcpi_bytes_sent - info.tcpi_bytes_retrans;
    facts.bytesAcknowledged = info.tcpi_bytes_acked;
    facts.windowClosed = std::chrono::microseconds(info.tcpi_rwnd_limited);
    facts.bytesUnsent = info.tcpi_notsent_bytes;
    return facts;
}

} // namespace liena::transport
