// Checks the fields of a message against their definition (protocol section 3).
#pragma once

#include "liena/message_set.hpp"
#include "protocol/wire_layout.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace liena::protocol {

/// Where field `index` stands in `bytes`, which must be well formed up to it.
FieldSpan locateField(const MessageDefinition& definition, std::span<const std::byte> bytes, std::size_t index);

/// Nothing when the bytes are exactly what the definition allows: sizes, counts, UTF-8, booleans, enums, finiteness, bounds.
/// Otherwise why not: message, field, value and bounds.
std::optional<std::string> checkFields(const MessageDefinition& definition, std::span<const std::byte> bytes);

/// The same, field by field and without the definition's layout: slower, and able to say what is wrong.
std::optional<std::string> faultIn(const MessageDefinition& definition, std::span<const std::byte> bytes);

/// One number of a field's type at the start of `bytes`, which must hold sizeOf(type) bytes.
Number readNumber(FieldType type, const std::byte* bytes);

/// The same for whole numbers and truths alone; those below zero wrap around.
std::uint64_t wholeAt(FieldType type, const std::byte* bytes);

/// Nothing when the number satisfies the field's enum, bounds and finiteness; otherwise why not (ruling B12).
std::optional<std::string> checkNumber(const MessageDefinition& definition, const FieldDefinition& field, const Number& value);

/// Whether a number fits its type, and its bytes in that type; float32 takes the nearest value.
bool writeNumber(FieldType type, const Number& value, std::byte* bytes);

bool isUtf8(std::string_view text);

std::string toString(const Number& value);

} // namespace liena::protocol
