// Walks the fields of an information part.
#include "protocol/information_part.hpp"

#include "protocol/byte_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

namespace liena::protocol {

namespace {

template <typename T>
bool put(std::byte* bytes, T value)
{
    store(bytes, value);
    return true;
}

template <typename T>
bool storeInteger(const Number& value, std::byte* bytes)
{
    return std::visit(
        [&](auto v) {
            if constexpr (std::is_floating_point_v<decltype(v)>) {
                // 2^63 and 2^64 are exact as doubles; the casts below are defined only under them.
                if (!(v >= static_cast<double>(std::numeric_limits<T>::min())) ||
                    !(v <= static_cast<double>(std::numeric_limits<T>::max())) || v != std::floor(v) ||
                    v >= (std::is_signed_v<T> ? 9223372036854775808.0 : 18446744073709551616.0))
                    return false;
                return put(bytes, static_cast<T>(v));
            } else {
                return std::in_range<T>(v) && put(bytes, static_cast<T>(v));
            }
        },
        value);
}

double asDouble(const Number& value)
{
    return std::visit([](auto v) { return static_cast<double>(v); }, value);
}

/// a < b in exact integer arithmetic where both are integers.
bool less(const Number& a, const Number& b)
{
    return std::visit(
        [](auto x, auto y) {
            if constexpr (std::is_integral_v<decltype(x)> && std::is_integral_v<decltype(y)>)
                return std::cmp_less(x, y);
            else
                return static_cast<double>(x) < static_cast<double>(y);
        },
        a, b);
}

Number boundIn(FieldType type, const Number& bound)
{
    return type == FieldType::Float32 ? Number(static_cast<double>(static_cast<float>(asDouble(bound)))) : bound;
}

std::optional<std::string> checkElements(const MessageDefinition& definition, const FieldDefinition& field,
                                         std::span<const std::byte> bytes)
{
    const auto size = sizeOf(field.type);
    for (std::size_t at = 0; at < bytes.size(); at += size)
        if (auto fault = checkNumber(definition, field, readNumber(field.type, bytes.data() + at)))
            return fault;
    return std::nullopt;
}

/// Takes one field from the reader and checks it.
std::optional<std::string> checkField(const MessageDefinition& definition, const FieldDefinition& field, ByteReader& reader)
{
    const auto tooLong = [&](std::size_t length, std::string_view unit) {
        return fmt::format("{}.{} has {} {}, at most {} are allowed", definition.name, field.name, length, unit, field.count);
    };
    if (field.type == FieldType::String) {
        const std::size_t length = reader.read<std::uint16_t>();
        const auto text = reader.takeText(length);
        if (reader.ok() && length > field.count)
            return tooLong(length, "bytes");
        if (reader.ok() && !isUtf8(text))
            return fmt::format("{}.{} is not UTF-8", definition.name, field.name);
        return std::nullopt;
    }
    if (field.type == FieldType::Bytes) {
        const std::size_t length = reader.read<std::uint32_t>();
        reader.take(length);
        return reader.ok() && length > field.count ? std::optional(tooLong(length, "bytes")) : std::nullopt;
    }
    std::size_t count = field.shape == FieldShape::FixedArray ? field.count : 1;
    if (field.shape == FieldShape::Sequence) {
        count = reader.read<std::uint32_t>();
        if (reader.ok() && count > field.count)
            return tooLong(count, "elements");
    }
    return checkElements(definition, field, reader.take(count * sizeOf(field.type)));
}

} // namespace

Number readNumber(FieldType type, const std::byte* bytes)
{
    switch (type) {
    case FieldType::Int8:
        return std::int64_t{load<std::int8_t>(bytes)};
    case FieldType::Int16:
        return std::int64_t{load<std::int16_t>(bytes)};
    case FieldType::Int32:
        return std::int64_t{load<std::int32_t>(bytes)};
    case FieldType::Int64:
        return load<std::int64_t>(bytes);
    case FieldType::Bool:
    case FieldType::UInt8:
        return std::uint64_t{load<std::uint8_t>(bytes)};
    case FieldType::UInt16:
        return std::uint64_t{load<std::uint16_t>(bytes)};
    case FieldType::UInt32:
        return std::uint64_t{load<std::uint32_t>(bytes)};
    case FieldType::UInt64:
        return load<std::uint64_t>(bytes);
    case FieldType::Float32:
        return double{load<float>(bytes)};
    case FieldType::Float64:
        return load<double>(bytes);
    case FieldType::String:
    case FieldType::Bytes:
        break;
    }
    return std::uint64_t{0};
}

std::uint64_t wholeAt(FieldType type, const std::byte* bytes)
{
    const auto widened = [](std::int64_t value) { return static_cast<std::uint64_t>(value); };
    switch (type) {
    case FieldType::Int8:
        return widened(load<std::int8_t>(bytes));
    case FieldType::Int16:
        return widened(load<std::int16_t>(bytes));
    case FieldType::Int32:
        return widened(load<std::int32_t>(bytes));
    case FieldType::Bool:
    case FieldType::UInt8:
        return load<std::uint8_t>(bytes);
    case FieldType::UInt16:
        return load<std::uint16_t>(bytes);
    case FieldType::UInt32:
        return load<std::uint32_t>(bytes);
    case FieldType::Int64:
    case FieldType::UInt64:
        return load<std::uint64_t>(bytes);
    default:
        return 0;
    }
}

bool writeNumber(FieldType type, const Number& value, std::byte* bytes)
{
    switch (type) {
    case FieldType::Int8:
        return storeInteger<std::int8_t>(value, bytes);
    case FieldType::Int16:
        return storeInteger<std::int16_t>(value, bytes);
    case FieldType::Int32:
        return storeInteger<std::int32_t>(value, bytes);
    case FieldType::Int64:
        return storeInteger<std::int64_t>(value, bytes);
    case FieldType::Bool:
    case FieldType::UInt8:
        return storeInteger<std::uint8_t>(value, bytes);
    case FieldType::UInt16:
        return storeInteger<std::uint16_t>(value, bytes);
    case FieldType::UInt32:
        return storeInteger<std::uint32_t>(value, bytes);
    case FieldType::UInt64:
        return storeInteger<std::uint64_t>(value, bytes);
    case FieldType::Float32: {
        const auto narrow = static_cast<float>(asDouble(value));
        return (std::isfinite(narrow) || !std::isfinite(asDouble(value))) && put(bytes, narrow);
    }
    case FieldType::Float64:
        return put(bytes, asDouble(value));
    case FieldType::String:
    case FieldType::Bytes:
        break;
    }
    return false;
}

std::optional<std::string> checkNumber(const MessageDefinition& definition, const FieldDefinition& field, const Number& value)
{
    const auto refuse = [&](std::string_view why) {
        return fmt::format("{}.{} = {}{}{} {}", definition.name, field.name, toString(value), field.unit.empty() ? "" : " ", field.unit,
                           why);
    };
    if (field.type == FieldType::Bool)
        return std::get<std::uint64_t>(value) > 1 ? std::optional(refuse("is neither 0 nor 1")) : std::nullopt;
    if (field.enumeration) {
        const auto number = std::visit([](auto v) { return static_cast<std::int64_t>(v); }, value);
        return field.enumeration->find(number) == nullptr ? std::optional(refuse(fmt::format("is no value of {}", field.enumeration->name)))
                                                          : std::nullopt;
    }
    if (const auto* real = std::get_if<double>(&value); real != nullptr && !std::isfinite(*real))
        return field.nonfinite ? std::nullopt : std::optional(refuse("is not finite"));
    const bool low = field.min && less(value, boundIn(field.type, *field.min));
    const bool high = field.max && less(boundIn(field.type, *field.max), value);
    if (low || high)
        return refuse(
            fmt::format("is outside {} to {}", field.min ? toString(*field.min) : "any", field.max ? toString(*field.max) : "any"));
    return std::nullopt;
}

std::optional<std::string> checkFields(const MessageDefinition& definition, std::span<const std::byte> bytes)
{
    const auto* layout = definition.layout.get();
    return layout != nullptr && layout->accepts(bytes) ? std::nullopt : faultIn(definition, bytes);
}

std::optional<std::string> faultIn(const MessageDefinition& definition, std::span<const std::byte> bytes)
{
    ByteReader reader(bytes);
    for (const auto& field : definition.fields) {
        if (auto fault = checkField(definition, field, reader))
            return fault;
        if (!reader.ok())
            return fmt::format("{} ends within {}", definition.name, field.name);
    }
    if (!reader.atEnd())
        return fmt::format("{} has {} bytes after its last field", definition.name, reader.remaining());
    return std::nullopt;
}

FieldSpan locateField(const MessageDefinition& definition, std::span<const std::byte> bytes, std::size_t index)
{
    if (const auto* layout = definition.layout.get())
        return layout->locate(bytes, index);
    FieldSpan span;
    for (std::size_t i = 0; i <= index; ++i) {
        const auto& field = definition.fields[i];
        span.begin += span.size;
        if (field.hasFixedSize()) {
            span.size = field.maximumSize();
        } else if (field.type == FieldType::String) {
            span.size = 2 + load<std::uint16_t>(bytes.data() + span.begin);
        } else {
            const std::size_t element = field.type == FieldType::Bytes ? 1 : sizeOf(field.type);
            span.size = 4 + load<std::uint32_t>(bytes.data() + span.begin) * element;
        }
    }
    return span;
}

bool isUtf8(std::string_view text)
{
    constexpr std::uint64_t highBits = 0x8080808080808080U;
    for (std::size_t i = 0; i < text.size();) {
        if (text.size() - i >= sizeof highBits &&
            (load<std::uint64_t>(reinterpret_cast<const std::byte*>(text.data()) + i) & highBits) == 0) {
            i += sizeof highBits;
            continue;
        }
        const auto at = [&](std::size_t k) { return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0U; };
        const auto continues = [&](std::size_t k) { return (at(k) & 0xC0U) == 0x80U; };
        const unsigned lead = at(0);
        std::size_t length = 0;
        if (lead < 0x80)
            length = 1;
        else if (lead >= 0xC2 && lead <= 0xDF && continues(1))
            length = 2;
        else if (lead >= 0xE0 && lead <= 0xEF && continues(1) && continues(2) && (lead != 0xE0 || at(1) >= 0xA0) &&
                 (lead != 0xED || at(1) < 0xA0))
            length = 3;
        else if (lead >= 0xF0 && lead <= 0xF4 && continues(1) && continues(2) && continues(3) && (lead != 0xF0 || at(1) >= 0x90) &&
                 (lead != 0xF4 || at(1) < 0x90))
            length = 4;
        if (length == 0)
            return false;
        i += length;
    }
    return true;
}

std::string toString(const Number& value)
{
    return std::visit([](auto v) { return fmt::format("{}", v); }, value);
}

} // namespace liena::protocol
