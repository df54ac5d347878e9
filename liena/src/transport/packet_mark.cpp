// Asking the kernel for marks.
#include "transport/packet_mark.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace liena::transport {

namespace {

constexpr int ecnBits = 2; // below the DSCP in that byte (RFC 3168)

int levelOf(bool v6) { return v6 ? IPPROTO_IPV6 : IPPROTO_IP; }
int optionOf(bool v6) { return v6 ? IPV6_TCLASS : IP_TOS; }

/// What the kernel says of it; nothing when packets bear it.
std::optional<std::string> refusal(int socket, bool v6, std::uint8_t dscp)
{
    if (!markPackets(socket, v6, dscp))
        return std::generic_category().message(errno);
    int value = 0;
    socklen_t size = sizeof value;
    const bool known = ::getsockopt(socket, levelOf(v6), optionOf(v6), &value, &size) == 0;
    return known && value >> ecnBits != dscp ? std::optional(fmt::format("it takes {} instead", value >> ecnBits)) : std::nullopt;
}

} // namespace

bool markPackets(int socket, bool v6, std::uint8_t dscp)
{
    const int value = dscp << ecnBits;
    return ::setsockopt(socket, levelOf(v6), optionOf(v6), &value, sizeof value) == 0;
}

std::optional<std::string> whyUnmarked(bool v6, std::initializer_list<std::uint8_t> marks)
{
    const int socket = ::socket(v6 ? AF_INET6 : AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (socket < 0)
        return std::nullopt; // whoever needs one says so
    std::optional<std::string> why;
    for (const auto mark : marks)
        if (const auto refused = why ? std::nullopt : refusal(socket, v6, mark))
            why = fmt::format("the kernel refuses the mark {} (DSCP): {}; packets leave without it, and no priority queue of the network "
                              "takes them: permit it where this program is confined (container, sandbox), or choose 0, no mark",
                              mark, *refused);
    ::close(socket);
    return why;
}

} // namespace liena::transport
