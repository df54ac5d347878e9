// Syntax of addresses and DNS names (RFC 1123); only the C library's address parsing, no resolver.
#include "topology/host_name.hpp"

#include "topology/ascii.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace liena {

namespace {

constexpr std::size_t longestName = 253;
constexpr std::size_t longestLabel = 63;

char lowered(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool isLabelCharacter(char c) { return isDigit(c) || isLetter(c) || c == '-'; }

std::optional<HostName> version4(const in_addr& address, std::string& why)
{
    const std::uint32_t value = ntohl(address.s_addr);
    const auto first = value >> 24U;
    if (first == 0 || first >= 224) {
        why = "is not the address of one device";
        return std::nullopt;
    }
    std::array<char, INET_ADDRSTRLEN> text{};
    inet_ntop(AF_INET, &address, text.data(), text.size());
    return HostName{text.data(), first == 127};
}

std::optional<HostName> version6(const in6_addr& address, std::string& why)
{
    if (IN6_IS_ADDR_UNSPECIFIED(&address) || IN6_IS_ADDR_MULTICAST(&address)) {
        why = "is not the address of one device";
        return std::nullopt;
    }
    std::array<char, INET6_ADDRSTRLEN> text{};
    inet_ntop(AF_INET6, &address, text.data(), text.size());
    return HostName{text.data(), IN6_IS_ADDR_LOOPBACK(&address) != 0};
}

bool isLabel(std::string_view label)
{
    return !label.empty() && label.size() <= longestLabel && label.front() != '-' && label.back() != '-' &&
           std::all_of(label.begin(), label.end(), isLabelCharacter);
}

bool isDnsName(std::string_view name)
{
    if (name.empty() || name.size() > longestName)
        return false;
    for (;;) {
        const auto dot = name.find('.');
        const auto label = name.substr(0, dot);
        if (!isLabel(label))
            return false;
        if (dot == std::string_view::npos)
            return !std::all_of(label.begin(), label.end(), isDigit); // a last label of digits is a mistyped IPv4 address
        name.remove_prefix(dot + 1);
    }
}

} // namespace

std::optional<HostName> hostNameFrom(std::string_view text, std::string& why)
{
    const std::string host(text);
    in_addr four{};
    if (inet_pton(AF_INET, host.c_str(), &four) == 1)
        return version4(four, why);
    in6_addr six{};
    if (inet_pton(AF_INET6, host.c_str(), &six) == 1)
        return version6(six, why);
    if (!isDnsName(text)) {
        why = "is neither an IPv4 or IPv6 address nor a DNS name";
        return std::nullopt;
    }
    HostName name{host, false};
    std::transform(host.begin(), host.end(), name.canonical.begin(), lowered);
    name.isLoopback = name.canonical == "localhost";
    return name;
}

} // namespace liena
