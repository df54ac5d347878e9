// Checks the fields of a message against their definition (protocol section 3).
#pragma once

#include "liena/message_set.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace liena::protocol {

/// Where one field stands in a message's bytes.
struct FieldSpan {
    std::size_t begin = 0;
    std::size_t size = 0;
};

/// Where field `index` stands in `bytes`, which must be well formed up to it.
FieldSpan locateField(const MessageDefinition& definition, std::span<const std::byte> bytes, std::size_t index);

/// Nothing when the bytes are exactly what the definition allows: sizes, counts, UTF-8, booleans, enums, finiteness, bounds.
/// Otherwise why not: message, field, value and bounds.
std::optional<std::string> checkFields(const MessageDefinition& definition, std::span<const std::byte> bytes);

/// One number of a field's type at the start of `bytes`, which must hold sizeOf(type) bytes.
Number readNumber(FieldType type, const std::byte* bytes);

/// Nothing when the number satisfies the field's enum, bounds and finiteness; otherwise why not (ruling B12).
std::optional<std::string> checkNumber(const MessageDefinition& definition, const FieldDefinition& field, const Number& value);

/// Whether a number fits its type, and its bytes in that type; float32 takes the nearest value.
bool writeNumber(FieldType type, const Number& value, std::byte* bytes);

bool isUtf8(std::string_view text);

std::string toString(const Number& value);

} // namespace liena::protocol
