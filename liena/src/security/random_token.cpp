// Tokens from OpenSSL's random source.
#include "security/random_token.hpp"

#include <openssl/rand.h>

#include <array>
#include <bit>
#include <stdexcept>

namespace liena::security {

std::uint64_t randomToken()
{
    std::array<unsigned char, sizeof(std::uint64_t)> bytes{};
    std::uint64_t token = 0;
    while (token == 0) {
        if (RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) != 1)
            throw std::runtime_error("the system's random source failed; no session can be opened safely");
        token = std::bit_cast<std::uint64_t>(bytes);
    }
    return token;
}

} // namespace liena::security
