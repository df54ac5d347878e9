// Bounds in the types of their fields.
#include "protocol/range_check.hpp"

#include "protocol/information_part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace liena::protocol {

namespace {

template <typename T>
struct Range {
    T low = std::numeric_limits<T>::lowest();
    T high = std::numeric_limits<T>::max();

    bool isEmpty() const { return high < low; }
    bool isEverything() const { return low == std::numeric_limits<T>::lowest() && high == std::numeric_limits<T>::max(); }
};

template <typename T>
constexpr Range<T> nothing{T{1}, T{0}};

/// Calls `use` with a number of the field's type.
template <typename Use>
auto withType(FieldType type, Use use)
{
    switch (type) {
    case FieldType::Int8:
        return use(std::int8_t{});
    case FieldType::Int16:
        return use(std::int16_t{});
    case FieldType::Int32:
        return use(std::int32_t{});
    case FieldType::Int64:
        return use(std::int64_t{});
    case FieldType::UInt16:
        return use(std::uint16_t{});
    case FieldType::UInt32:
        return use(std::uint32_t{});
    case FieldType::UInt64:
        return use(std::uint64_t{});
    case FieldType::Float32:
        return use(float{});
    case FieldType::Float64:
        return use(double{});
    default:
        return use(std::uint8_t{});
    }
}

/// Ascending, and each once.
template <typename T>
std::vector<std::int64_t> declaredNumbers(const EnumDefinition& enumeration)
{
    std::vector<std::int64_t> numbers;
    for (const auto& value : enumeration.values)
        if (std::in_range<T>(value.number))
            numbers.push_back(value.number);
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}

template <typename T>
Range<T> declaredRange(const EnumDefinition& enumeration)
{
    const auto numbers = declaredNumbers<T>(enumeration);
    if (numbers.empty() || static_cast<std::uint64_t>(numbers.back()) - static_cast<std::uint64_t>(numbers.front()) != numbers.size() - 1)
        return nothing<T>;
    return {static_cast<T>(numbers.front()), static_cast<T>(numbers.back())};
}

/// Exact; a bound that is no whole number, which no file can give, leaves nothing allowed for certain.
template <typename T>
Range<T> wholeRange(const FieldDefinition& field)
{
    if (field.type == FieldType::Bool)
        return {T{0}, T{1}};
    if (field.enumeration)
        return declaredRange<T>(*field.enumeration);
    Range<T> range;
    const auto narrow = [&](const std::optional<Number>& bound, auto take) {
        if (bound)
            std::visit(
                [&](auto value) {
                    if constexpr (std::floating_point<decltype(value)>)
                        range = nothing<T>;
                    else
                        take(value);
                },
                *bound);
    };
    narrow(field.min, [&](auto min) {
        if (std::cmp_greater(min, range.high))
            range = nothing<T>;
        else if (std::cmp_greater(min, range.low))
            range.low = static_cast<T>(min);
    });
    narrow(field.max, [&](auto max) {
        if (std::cmp_less(max, range.low))
            range = nothing<T>;
        else if (std::cmp_less(max, range.high))
            range.high = static_cast<T>(max);
    });
    return range;
}

template <typename T>
Range<T> realRange(const FieldDefinition& field)
{
    const auto real = [](const Number& bound) { return static_cast<T>(std::visit([](auto v) { return static_cast<double>(v); }, bound)); };
    Range<T> range;
    if (field.min && real(*field.min) > range.low)
        range.low = real(*field.min);
    if (field.max && real(*field.max) < range.high)
        range.high = real(*field.max);
    return range;
}

template <typename T>
void put(BoundBytes& bytes, T value)
{
    store(bytes.data(), value);
}

template <std::floating_point T>
RangeCheck checkAs(const FieldDefinition& field)
{
    using Kind = RangeCheck::Kind;
    constexpr bool isFloat = std::same_as<T, float>;
    RangeCheck check;
    check.kind = isFloat ? Kind::Real32 : Kind::Real64;
    if (field.nonfinite)
        check.kind = !field.min && !field.max ? Kind::Nothing : isFloat ? Kind::Nonfinite32 : Kind::Nonfinite64;
    const auto range = realRange<T>(field);
    put(check.low, range.low);
    put(check.high, range.high);
    return check;
}

template <std::integral T>
RangeCheck checkAs(const FieldDefinition& field)
{
    using Kind = RangeCheck::Kind;
    using Unsigned = std::make_unsigned_t<T>;
    RangeCheck check;
    const auto range = wholeRange<T>(field);
    if (range.isEverything())
        return check;
    if (range.isEmpty()) {
        check.kind = Kind::Declared;
        if (field.enumeration)
            check.declared = declaredNumbers<T>(*field.enumeration);
        return check;
    }
    check.kind = sizeof(T) == 1 ? Kind::Whole8 : sizeof(T) == 2 ? Kind::Whole16 : sizeof(T) == 4 ? Kind::Whole32 : Kind::Whole64;
    put(check.low, static_cast<Unsigned>(range.low));
    put(check.high, static_cast<Unsigned>(static_cast<Unsigned>(range.high) - static_cast<Unsigned>(range.low)));
    return check;
}

template <std::floating_point T>
FieldSlot slotAs(const FieldDefinition& field)
{
    FieldSlot slot;
    slot.kind = std::same_as<T, float> ? SlotKind::Real32 : SlotKind::Real64;
    const auto range = realRange<T>(field);
    put(slot.low, range.low);
    put(slot.high, range.high);
    return slot;
}

template <std::integral T>
FieldSlot slotAs(const FieldDefinition& field)
{
    FieldSlot slot;
    slot.kind = wholeKind(sizeof(T));
    auto range = wholeRange<T>(field);
    if (!std::in_range<std::int64_t>(range.low))
        range = nothing<T>;
    constexpr auto most = std::numeric_limits<std::int64_t>::max();
    put(slot.low, static_cast<std::int64_t>(range.low));
    put(slot.high, std::cmp_greater(range.high, most) ? most : static_cast<std::int64_t>(range.high));
    return slot;
}

template <typename T>
bool allWithin(const RangeCheck& check, const std::byte* numbers, std::size_t count)
{
    bool within = true;
    for (std::size_t i = 0; i < count; ++i)
        within &= isWithin(load<T>(numbers + i * sizeof(T)), check.low, check.high);
    return within;
}

template <typename T>
bool allWithinOrNonfinite(const RangeCheck& check, const std::byte* numbers, std::size_t count)
{
    bool within = true;
    for (std::size_t i = 0; i < count; ++i) {
        const auto value = load<T>(numbers + i * sizeof(T));
        within &= !std::isfinite(value) || isWithin(value, check.low, check.high);
    }
    return within;
}

bool allDeclared(const RangeCheck& check, const std::byte* numbers, std::size_t count)
{
    const auto size = sizeOf(check.type);
    for (std::size_t i = 0; i < count; ++i)
        if (!std::binary_search(check.declared.begin(), check.declared.end(),
                                static_cast<std::int64_t>(wholeAt(check.type, numbers + i * size))))
            return false;
    return true;
}

} // namespace

RangeCheck checkOf(const FieldDefinition& field)
{
    if (field.type == FieldType::String || field.type == FieldType::Bytes)
        return {};
    auto check = withType(field.type, [&](auto number) { return checkAs<decltype(number)>(field); });
    check.type = field.type;
    return check;
}

FieldSlot slotOf(const FieldDefinition& field)
{
    if (field.type == FieldType::String || field.type == FieldType::Bytes)
        return {};
    return withType(field.type, [&](auto number) { return slotAs<decltype(number)>(field); });
}

bool holds(const RangeCheck& check, const std::byte* numbers, std::size_t count)
{
    switch (check.kind) {
    case RangeCheck::Kind::Whole8:
        return allWithin<std::uint8_t>(check, numbers, count);
    case RangeCheck::Kind::Whole16:
        return allWithin<std::uint16_t>(check, numbers, count);
    case RangeCheck::Kind::Whole32:
        return allWithin<std::uint32_t>(check, numbers, count);
    case RangeCheck::Kind::Whole64:
        return allWithin<std::uint64_t>(check, numbers, count);
    case RangeCheck::Kind::Real32:
        return allWithin<float>(check, numbers, count);
    case RangeCheck::Kind::Real64:
        return allWithin<double>(check, numbers, count);
    case RangeCheck::Kind::Nonfinite32:
        return allWithinOrNonfinite<float>(check, numbers, count);
    case RangeCheck::Kind::Nonfinite64:
        return allWithinOrNonfinite<double>(check, numbers, count);
    case RangeCheck::Kind::Declared:
        return allDeclared(check, numbers, count);
    case RangeCheck::Kind::Nothing:
        break;
    }
    return true;
}

} // namespace liena::protocol
