// What a topology may give as a device's host: an IPv4 or IPv6 address, or a DNS name.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace liena {

struct HostName {
    std::string canonical; ///< two spellings of one address have the same
    bool isLoopback = false;
};

/// Nothing, and the reason in `why`, when it can name no device. Looks nothing up.
std::optional<HostName> hostNameFrom(std::string_view text, std::string& why);

} // namespace liena
