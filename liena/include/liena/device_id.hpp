// The 32-bit name of one physical device in the world of LiENa (protocol section 1).
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace liena {

enum class DeviceClass : std::uint8_t { Hand = 0, Eye = 1, Brain = 2, Arm = 3, Special = 7 };

std::string_view toString(DeviceClass deviceClass);
std::optional<DeviceClass> deviceClassFrom(std::string_view name);

class DeviceId {
public:
    constexpr DeviceId() = default;
    constexpr explicit DeviceId(std::uint32_t value) : m_value(value) {}

    /// Composes class (3 bits), manufacturer (14), type (6), version (6) and index (3); higher bits of each are cut.
    static constexpr DeviceId compose(DeviceClass deviceClass, std::uint32_t manufacturer, std::uint32_t type, std::uint32_t version,
                                      std::uint32_t index)
    {
        return DeviceId((static_cast<std::uint32_t>(deviceClass) & 0x7U) << 29U | (manufacturer & 0x3FFFU) << 15U | (type & 0x3FU) << 9U |
                        (version & 0x3FU) << 3U | (index & 0x7U));
    }

    /// The target of a broadcast; never an origin.
    static constexpr DeviceId broadcast() { return DeviceId(0xFFFFFFFFU); }

    /// Reads `0x` and eight hex digits; nothing else is an id.
    static std::optional<DeviceId> fromString(std::string_view text);

    constexpr std::uint32_t value() const { return m_value; }
    constexpr std::uint8_t classNumber() const { return static_cast<std::uint8_t>(m_value >> 29U); }
    constexpr std::uint16_t manufacturer() const { return static_cast<std::uint16_t>(m_value >> 15U & 0x3FFFU); }
    constexpr std::uint8_t type() const { return static_cast<std::uint8_t>(m_value >> 9U & 0x3FU); }
    constexpr std::uint8_t version() const { return static_cast<std::uint8_t>(m_value >> 3U & 0x3FU); }
    constexpr std::uint8_t index() const { return static_cast<std::uint8_t>(m_value & 0x7U); }

    /// The device type: the id without its index.
    constexpr DeviceId deviceType() const { return DeviceId(m_value & ~0x7U); }

    constexpr bool isBroadcast() const { return m_value == 0xFFFFFFFFU; }

    /// A declared class and an index of 0 to 6: an id that a device may have.
    constexpr bool isValidDevice() const { return (classNumber() <= 3 || classNumber() == 7) && index() <= 6; }

    /// `0x40018208`.
    std::string toString() const;

    friend constexpr auto operator<=>(DeviceId, DeviceId) = default;

private:
    std::uint32_t m_value = 0;
};

} // namespace liena

template <>
struct std::hash<liena::DeviceId> {
    std::size_t operator()(liena::DeviceId id) const noexcept { return std::hash<std::uint32_t>{}(id.value()); }
};
