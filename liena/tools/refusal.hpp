// How a command says that it cannot.
#pragma once

#include <fmt/format.h>

#include <string_view>

namespace liena::tools {

/// Says on stderr why `command` ("pki revoke") did not do what it was asked for, and gives the status that the program ends with: 1.
inline int refuse(std::string_view command, std::string_view what)
{
    fmt::print(stderr, "liena {}: {}\n", command, what);
    return 1;
}

} // namespace liena::tools
