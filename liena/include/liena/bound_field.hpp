// A member of a structure and the field that it is bound to: types and bounds. For the inlined part of MessageBinding.
#pragma once

#include "liena/field_slot.hpp"
#include "liena/message_set.hpp"

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace liena::protocol {

template <std::size_t Size>
using UnsignedOfSize =
    std::conditional_t<Size == 1, std::uint8_t,
                       std::conditional_t<Size == 2, std::uint16_t, std::conditional_t<Size == 4, std::uint32_t, std::uint64_t>>>;

/// Real numbers are compared as they are, all others as unsigned ones of their size: one comparison then serves both bounds.
template <typename Number>
using Raw = std::conditional_t<std::floating_point<Number>, Number, UnsignedOfSize<sizeof(Number)>>;

template <typename Number>
Raw<Number> rawOf(Number value)
{
    return static_cast<Raw<Number>>(value);
}

template <typename Number>
Number numberOf(Raw<Number> raw)
{
    if constexpr (std::same_as<Number, bool>)
        return raw != 0;
    else
        return static_cast<Number>(raw);
}

/// The type on the wire that is exactly this one; an enumeration stands for its base.
template <typename Number>
consteval FieldType fieldTypeFor()
{
    if constexpr (std::is_enum_v<Number>)
        return fieldTypeFor<std::underlying_type_t<Number>>();
    else if constexpr (std::same_as<Number, bool>)
        return FieldType::Bool;
    else if constexpr (std::same_as<Number, float>)
        return FieldType::Float32;
    else if constexpr (std::same_as<Number, double>)
        return FieldType::Float64;
    else {
        static_assert(std::integral<Number>, "only numbers, truths, enumerations, and arrays of them can be bound");
        constexpr bool isSigned = std::is_signed_v<Number>;
        if constexpr (sizeof(Number) == 1)
            return isSigned ? FieldType::Int8 : FieldType::UInt8;
        else if constexpr (sizeof(Number) == 2)
            return isSigned ? FieldType::Int16 : FieldType::UInt16;
        else if constexpr (sizeof(Number) == 4)
            return isSigned ? FieldType::Int32 : FieldType::UInt32;
        else
            return isSigned ? FieldType::Int64 : FieldType::UInt64;
    }
}

/// What a member asks of its field.
struct MemberForm {
    std::string_view field;
    FieldType type = FieldType::UInt8; ///< of one element
    bool isArray = false;
    std::size_t count = 1;
};

/// Where the field stands in the message's bytes, and between which bounds a number is allowed for certain, in the raw type.
struct FieldPlace {
    std::size_t index = 0;
    std::size_t offset = 0;
    std::array<std::byte, 8> low{};
    std::array<std::byte, 8> high{}; ///< of whole numbers: how far it is above the lower bound
};

/// The same in a number's own type. A number that is not between the bounds is asked about in full: it may be NaN where that is allowed,
/// or an enumeration's value beyond a gap.
template <typename Number>
class CertainRange {
public:
    explicit CertainRange(const FieldPlace& place)
        : m_low(load<Raw<Number>>(place.low.data())), m_high(load<Raw<Number>>(place.high.data()))
    {}

    bool has(Raw<Number> value) const
    {
        if constexpr (std::floating_point<Number>)
            return value >= m_low && value <= m_high;
        else
            return static_cast<Raw<Number>>(value - m_low) <= m_high;
    }

private:
    Raw<Number> m_low;
    Raw<Number> m_high; ///< as in FieldPlace
};

/// Which of the members' values are single ones of type float.
template <typename... Values>
consteval auto positionsOfReals()
{
    std::array<std::size_t, (std::size_t{std::same_as<Values, float>} + ...)> positions{};
    std::size_t found = 0;
    std::size_t position = 0;
    ((std::same_as<Values, float> ? static_cast<void>(positions[found++] = position++) : static_cast<void>(position++)), ...);
    return positions;
}

/// The ranges of several single members of type float, which most values of a device are: four are compared at once.
template <std::size_t Count>
class CertainReals {
public:
    /// `places` of these members.
    explicit CertainReals(const std::array<FieldPlace, Count>& places)
    {
        for (std::size_t i = 0; i < Count; ++i) {
            m_low[i / 4][i % 4] = load<float>(places[i].low.data());
            m_high[i / 4][i % 4] = load<float>(places[i].high.data());
        }
    }

    /// One value for each member; those that are missing in the last four are zeros between zeros.
    template <typename... Values>
    [[gnu::always_inline]] bool have(Values... values) const
    {
        const std::array<float, 4 * m_fours> all{values...};
        Words within{-1, -1};
        for (std::size_t i = 0; i < m_fours; ++i) {
            const Four four{all[4 * i], all[4 * i + 1], all[4 * i + 2], all[4 * i + 3]};
            within &= std::bit_cast<Words>((four >= m_low[i]) & (four <= m_high[i]));
        }
        return (within[0] & within[1]) == -1;
    }

private:
    using Four [[gnu::vector_size(16)]] = float;
    using Words [[gnu::vector_size(16)]] = std::int64_t;
    static constexpr std::size_t m_fours = (Count + 3) / 4;

    std::array<Four, m_fours> m_low{};
    std::array<Four, m_fours> m_high{};
};

/// A member that is a single number.
template <typename Member>
struct BoundMember {
    using Number = Member;
    using Values = Raw<Member>;
    static constexpr bool isArray = false;
    static constexpr std::size_t count = 1;

    static Values take(const Member& member) { return rawOf(member); }
    static void give(const Values& values, Member& member) { member = numberOf<Member>(values); }
    static bool areWithin(const Values& values, const CertainRange<Number>& range) { return range.has(values); }
};

template <typename Element, std::size_t Count>
struct BoundMember<std::array<Element, Count>> {
    using Number = Element;
    using Values = std::array<Raw<Element>, Count>;
    static constexpr bool isArray = true;
    static constexpr std::size_t count = Count;

    static Values take(const std::array<Element, Count>& member)
    {
        Values values;
        for (std::size_t i = 0; i < Count; ++i)
            values[i] = rawOf(member[i]);
        return values;
    }

    static void give(const Values& values, std::array<Element, Count>& member)
    {
        for (std::size_t i = 0; i < Count; ++i)
            member[i] = numberOf<Element>(values[i]);
    }

    static bool areWithin(const Values& values, const CertainRange<Number>& range)
    {
        bool within = true;
        for (const auto value : values)
            within &= range.has(value);
        return within;
    }
};

} // namespace liena::protocol
