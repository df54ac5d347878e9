// Names, sizes and look-ups of message definitions: everything about a message set but its XML.
#include "liena/message_set.hpp"

#include "protocol/wire_layout.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace liena {

namespace {

struct TypeRow {
    FieldType type;
    std::string_view name;
    std::size_t size;
};

constexpr std::array typeRows{
    TypeRow{FieldType::Bool, "bool", 1},       TypeRow{FieldType::Int8, "int8", 1},       TypeRow{FieldType::Int16, "int16", 2},
    TypeRow{FieldType::Int32, "int32", 4},     TypeRow{FieldType::Int64, "int64", 8},     TypeRow{FieldType::UInt8, "uint8", 1},
    TypeRow{FieldType::UInt16, "uint16", 2},   TypeRow{FieldType::UInt32, "uint32", 4},   TypeRow{FieldType::UInt64, "uint64", 8},
    TypeRow{FieldType::Float32, "float32", 4}, TypeRow{FieldType::Float64, "float64", 8}, TypeRow{FieldType::String, "string", 0},
    TypeRow{FieldType::Bytes, "bytes", 0},
};

constexpr bool standInOrder()
{
    for (std::size_t i = 0; i < typeRows.size(); ++i)
        if (static_cast<std::size_t>(typeRows[i].type) != i)
            return false;
    return true;
}
static_assert(standInOrder(), "a type's row is found by its number");

constexpr std::size_t stringLengthSize = 2;
constexpr std::size_t bytesLengthSize = 4;
constexpr std::size_t sequenceCountSize = 4;

std::size_t lengthSizeOf(FieldType type)
{
    if (type == FieldType::String)
        return stringLengthSize;
    return type == FieldType::Bytes ? bytesLengthSize : 0;
}

template <typename Range, typename Predicate>
auto* firstOf(const Range& range, Predicate predicate)
{
    const auto found = std::find_if(range.begin(), range.end(), predicate);
    return found == range.end() ? nullptr : &*found;
}

} // namespace

std::string_view toString(FieldType type)
{
    const auto* row = firstOf(typeRows, [type](const TypeRow& candidate) { return candidate.type == type; });
    return row ? row->name : std::string_view("unknown");
}

std::optional<FieldType> fieldTypeFrom(std::string_view name)
{
    const auto* row = firstOf(typeRows, [name](const TypeRow& candidate) { return candidate.name == name; });
    return row ? std::optional(row->type) : std::nullopt;
}

std::size_t sizeOf(FieldType type)
{
    const auto row = static_cast<std::size_t>(type);
    return row < typeRows.size() ? typeRows[row].size : 0;
}

std::string_view toString(Role role) { return role == Role::Command ? "command" : "report"; }

std::string_view toString(Priority priority)
{
    switch (priority) {
    case Priority::Safety:
        return "safety";
    case Priority::Control:
        return "control";
    case Priority::Status:
        return "status";
    case Priority::Bulk:
        return "bulk";
    }
    return "unknown";
}

const EnumValue* EnumDefinition::find(std::int64_t number) const
{
    return firstOf(values, [number](const EnumValue& value) { return value.number == number; });
}

const EnumValue* EnumDefinition::find(std::string_view wanted) const
{
    return firstOf(values, [wanted](const EnumValue& value) { return value.name == wanted; });
}

std::size_t FieldDefinition::minimumSize() const
{
    if (shape == FieldShape::Sequence)
        return sequenceCountSize;
    return hasFixedSize() ? maximumSize() : lengthSizeOf(type);
}

std::size_t FieldDefinition::maximumSize() const
{
    const std::size_t elements = count;
    if (type == FieldType::String || type == FieldType::Bytes)
        return lengthSizeOf(type) + elements;
    switch (shape) {
    case FieldShape::Scalar:
        return sizeOf(type);
    case FieldShape::FixedArray:
        return elements * sizeOf(type);
    case FieldShape::Sequence:
        return sequenceCountSize + elements * sizeOf(type);
    }
    return 0;
}

std::size_t MessageDefinition::maximumSize() const
{
    if (const auto* compiled = layout.get())
        return recordSize() + compiled->maximumSize();
    std::size_t size = recordSize();
    for (const auto& field : fields)
        size += field.maximumSize();
    return size;
}

std::optional<std::size_t> MessageDefinition::indexOf(std::string_view field) const
{
    if (const auto* compiled = layout.get())
        return compiled->indexOf(*this, field);
    for (std::size_t i = 0; i < fields.size(); ++i)
        if (fields[i].name == field)
            return i;
    return std::nullopt;
}

const MessageDefinition* MessageSet::find(std::uint16_t number) const
{
    const auto found = std::lower_bound(m_messages.begin(), m_messages.end(), number,
                                        [](const MessageDefinition& message, std::uint16_t wanted) { return message.number < wanted; });
    return found != m_messages.end() && found->number == number ? &*found : nullptr;
}

const MessageDefinition* MessageSet::find(std::string_view name) const
{
    return firstOf(m_messages, [name](const MessageDefinition& message) { return message.name == name; });
}

} // namespace liena
