// What the numbers of a field may be, as comparisons in the field's own type.
#pragma once

#include "liena/field_slot.hpp"
#include "liena/message_set.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace liena::protocol {

using BoundBytes = std::array<std::byte, 8>; ///< a number of the field's type at the front

/// Made once for each field, so that a look at a number is two comparisons.
struct RangeCheck {
    enum class Kind : std::uint8_t {
        Whole8, ///< bounds of Whole*: low, and high − low, both unsigned, so that one comparison serves signed numbers too
        Whole16,
        Whole32,
        Whole64,
        Real32, ///< bounds of Real*: low and high, both finite
        Real64,
        Nonfinite32, ///< as Real32, and what is not finite is allowed
        Nonfinite64,
        Declared, ///< an enum whose numbers have gaps
        Nothing,  ///< every value is allowed
    };

    Kind kind = Kind::Nothing;
    FieldType type = FieldType::UInt8;
    BoundBytes low{};
    BoundBytes high{};
    std::vector<std::int64_t> declared; ///< ascending
};

RangeCheck checkOf(const FieldDefinition& field);

/// With the bounds between which a single number of that field is allowed for certain; its offset is left at 0.
FieldSlot slotOf(const FieldDefinition& field);

/// Whether `count` numbers that stand one behind the other are all allowed.
bool holds(const RangeCheck& check, const std::byte* numbers, std::size_t count);

/// One number of the kinds Whole* (T unsigned) and Real*.
template <typename T>
bool isWithin(T value, const BoundBytes& low, const BoundBytes& high)
{
    if constexpr (std::floating_point<T>)
        return value >= load<T>(low.data()) && value <= load<T>(high.data());
    else
        return static_cast<T>(value - load<T>(low.data())) <= load<T>(high.data());
}

} // namespace liena::protocol
