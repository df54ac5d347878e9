// Bytes written as people read them: "01 02 ff".
#pragma once

#include <cctype>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace liena::test {

/// Anything that is not a hex digit only separates.
inline std::vector<std::byte> bytesOf(std::string_view hex)
{
    std::vector<std::byte> bytes;
    int high = -1;
    for (const char c : hex) {
        if (std::isxdigit(static_cast<unsigned char>(c)) == 0)
            continue;
        const int digit = c <= '9' ? c - '0' : (c | 0x20) - 'a' + 10;
        if (high < 0) {
            high = digit;
        } else {
            bytes.push_back(static_cast<std::byte>(high * 16 + digit));
            high = -1;
        }
    }
    return bytes;
}

inline std::string hexOf(std::span<const std::byte> bytes)
{
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const auto byte : bytes) {
        text += digits[static_cast<std::size_t>(byte) >> 4U];
        text += digits[static_cast<std::size_t>(byte) & 0xFU];
        text += ' ';
    }
    if (!text.empty())
        text.pop_back();
    return text;
}

inline std::vector<std::byte> bytesOfText(std::string_view text)
{
    const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    return {bytes.begin(), bytes.end()};
}

inline std::vector<std::byte> filled(std::size_t count, unsigned value)
{
    return std::vector<std::byte>(count, static_cast<std::byte>(value));
}

} // namespace liena::test
