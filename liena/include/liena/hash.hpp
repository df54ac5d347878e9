// SHA-256 identity of a message set or a topology file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace liena {

struct Sha256 {
    std::array<std::uint8_t, 32> bytes{};

    static Sha256 of(std::span<const std::byte> data);
    static Sha256 of(std::string_view text);

    /// Reads 64 lower-case hex digits; nothing else is a hash.
    static std::optional<Sha256> fromHex(std::string_view text);

    /// 64 lower-case hex digits.
    std::string toHex() const;

    friend auto operator<=>(const Sha256&, const Sha256&) = default;
};

} // namespace liena
