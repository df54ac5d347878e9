// SHA-256 by OpenSSL, and its hex form.
#include "liena/hash.hpp"

#include <openssl/sha.h>

#include <fmt/format.h>

namespace liena {

Sha256 Sha256::of(std::span<const std::byte> data)
{
    Sha256 hash;
    SHA256(reinterpret_cast<const unsigned char*>(data.data()), data.size(), hash.bytes.data());
    return hash;
}

Sha256 Sha256::of(std::string_view text) { return of(std::as_bytes(std::span(text.data(), text.size()))); }

std::optional<Sha256> Sha256::fromHex(std::string_view text)
{
    if (text.size() != 64)
        return std::nullopt;
    Sha256 hash;
    const auto digit = [](char c) { return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1; };
    for (std::size_t i = 0; i < 32; ++i) {
        const int high = digit(text[2 * i]);
        const int low = digit(text[2 * i + 1]);
        if (high < 0 || low < 0)
            return std::nullopt;
        hash.bytes[i] = static_cast<std::uint8_t>(high * 16 + low);
    }
    return hash;
}

std::string Sha256::toHex() const
{
    std::string text;
    for (const auto byte : bytes)
        text += fmt::format("{:02x}", byte);
    return text;
}

} // namespace liena
