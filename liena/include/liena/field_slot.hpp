// A number at a fixed place of a message: where it stands and between which bounds it is taken at once. For the inlined part of Message.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace liena::protocol {

/// Whole numbers of one size are read alike, signed or not.
enum class SlotKind : std::uint8_t { None, Whole8, Whole16, Whole32, Whole64, Real32, Real64 };

constexpr SlotKind wholeKind(std::size_t size)
{
    return size == 1 ? SlotKind::Whole8 : size == 2 ? SlotKind::Whole16 : size == 4 ? SlotKind::Whole32 : SlotKind::Whole64;
}

/// The bytes of a number in the host's order, which is the wire's.
template <typename T>
T load(const std::byte* bytes)
{
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

template <typename T>
void store(std::byte* bytes, T value)
{
    std::memcpy(bytes, &value, sizeof(T));
}

template <typename T>
T loadWhole(const std::byte* bytes)
{
    if constexpr (std::is_enum_v<T>)
        return static_cast<T>(loadWhole<std::underlying_type_t<T>>(bytes));
    else if constexpr (std::same_as<T, bool>)
        return load<std::uint8_t>(bytes) != 0;
    else
        return load<T>(bytes);
}

template <typename T>
inline constexpr bool isSignedWhole = std::is_signed_v<T>;
template <typename T>
requires std::is_enum_v<T>
inline constexpr bool isSignedWhole<T> = std::is_signed_v<std::underlying_type_t<T>>;

/// A value between the bounds is allowed; one that is not is asked about in full, for it may be allowed all the same (NaN, some enums).
struct FieldSlot {
    SlotKind kind = SlotKind::None; ///< None: not a single number, or behind a field of varying size
    std::uint32_t offset = 0;       ///< in the fields' bytes
    std::array<std::byte, 8> low{};
    std::array<std::byte, 8> high{};

    /// T: std::int64_t for whole numbers, float or double for the others.
    template <typename T>
    bool allows(T value) const
    {
        return value >= load<T>(low.data()) && value <= load<T>(high.data());
    }
};

} // namespace liena::protocol
