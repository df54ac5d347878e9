// What the kernel may be asked to hold of a connection over a long line, by the rule of LiENa's bulk lanes.
#pragma once

#include <fstream>
#include <optional>

namespace liena::compare {

/// Pure; in bytes. What SO_SNDBUF may ask for (net.core.wmem_max), of which the kernel takes the double, beside what a connection has at
/// most by itself (the last figure of net.ipv4.tcp_wmem). Nothing: that is as much, or is not known.
inline std::optional<int> sendBufferWorthAsking(int mostAsked, int byItself)
{
    return byItself > 0 && mostAsked > byItself / 2 ? std::optional(mostAsked) : std::nullopt;
}

/// On this computer.
inline std::optional<int> sendBufferWorthAsking()
{
    int mostAsked = 0;
    int least = 0;
    int usual = 0;
    int byItself = 0;
    std::ifstream("/proc/sys/net/core/wmem_max") >> mostAsked;
    std::ifstream("/proc/sys/net/ipv4/tcp_wmem") >> least >> usual >> byItself;
    return sendBufferWorthAsking(mostAsked, byItself);
}

} // namespace liena::compare
