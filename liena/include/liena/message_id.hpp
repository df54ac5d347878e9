// The 48-bit name of a message: who sends it, and its number in a message set (protocol section 1).
#pragma once

#include "liena/device_id.hpp"

#include <compare>
#include <cstdint>
#include <string>

namespace liena {

struct MessageId {
    DeviceId origin;
    std::uint16_t number = 0;

    constexpr bool isSessionManagement() const { return number >= 0x0001 && number <= 0x00FF; }
    constexpr bool isCommand() const { return number >= 0x0100 && number <= 0x01FF; }
    constexpr bool isReport() const { return number >= 0x0200 && number <= 0x0FFF; }

    /// `0x40018208/0x0101`.
    std::string toString() const;

    friend constexpr auto operator<=>(const MessageId&, const MessageId&) = default;
};

} // namespace liena

template <>
struct std::hash<liena::MessageId> {
    std::size_t operator()(const liena::MessageId& id) const noexcept
    {
        return std::hash<std::uint64_t>{}(static_cast<std::uint64_t>(id.origin.value()) << 16U | id.number);
    }
};
