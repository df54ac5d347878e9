// Tokens that nobody can guess.
#pragma once

#include <cstdint>

namespace liena::security {

/// From the system's random source; never 0. Throws when that source fails: a token that can be guessed is worse than none.
std::uint64_t randomToken();

} // namespace liena::security
