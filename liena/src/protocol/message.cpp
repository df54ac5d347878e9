// Reading and writing the fields of a message in their wire form.
#include "liena/message.hpp"

#include "liena/log.hpp"
#include "protocol/byte_reader.hpp"
#include "protocol/information_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <stdexcept>

namespace liena {

using protocol::FieldSpan;
using protocol::locateField;

namespace {

/// The default, or 0, or the bound nearest to 0, or the enum's first value.
Number initialNumber(const FieldDefinition& field)
{
    if (field.initial)
        return *field.initial;
    if (field.enumeration)
        return field.enumeration->values.front().number;
    const auto real = [](const Number& n) { return std::visit([](auto v) { return static_cast<double>(v); }, n); };
    if (field.min && real(*field.min) > 0)
        return *field.min;
    if (field.max && real(*field.max) < 0)
        return *field.max;
    return std::uint64_t{0};
}

std::logic_error misuse(const MessageDefinition& definition, std::string_view field, std::string_view why)
{
    return std::logic_error(fmt::format("{}.{} {}", definition.name, field, why));
}

bool isText(const FieldDefinition& field) { return field.type == FieldType::String; }
bool isBytes(const FieldDefinition& field) { return field.type == FieldType::Bytes; }
bool isNumber(const FieldDefinition& field) { return !isText(field) && !isBytes(field) && field.shape == FieldShape::Scalar; }

/// Replaces a field by `content` behind a count of `prefix` bytes (0, 2 or 4).
void splice(FieldBytes& bytes, FieldSpan old, std::size_t prefix, std::size_t count, std::span<const std::byte> content)
{
    FieldBytes copy; // what comes from another field of this message must not move while it is read
    const std::less_equal<> before;
    if (before(bytes.data(), content.data()) && before(content.data(), bytes.data() + bytes.size())) {
        copy.assign(content.begin(), content.end());
        content = {copy.data(), copy.size()};
    }
    const auto size = prefix + content.size();
    if (size > old.size)
        bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(old.begin + old.size), size - old.size, std::byte{});
    else
        bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(old.begin + size),
                    bytes.begin() + static_cast<std::ptrdiff_t>(old.begin + old.size));
    const auto length = static_cast<std::uint32_t>(count);
    std::memcpy(bytes.data() + old.begin, &length, prefix);
    if (!content.empty())
        std::memcpy(bytes.data() + old.begin + prefix, content.data(), content.size());
}

} // namespace

Message::Message(std::shared_ptr<const MessageSet> set, const MessageDefinition& definition)
    : m_set(std::move(set)), m_definition(&definition)
{
    for (const auto& field : definition.fields) {
        const auto at = m_fields.size();
        m_fields.resize(at + field.minimumSize(), std::byte{});
        if (!field.hasFixedSize())
            continue;
        const auto value = initialNumber(field);
        for (std::size_t offset = at; offset < m_fields.size(); offset += sizeOf(field.type))
            protocol::writeNumber(field.type, value, m_fields.data() + offset);
    }
}

Message::Message(std::shared_ptr<const MessageSet> set, const MessageDefinition& definition, FieldBytes&& fields)
    : m_set(std::move(set)), m_definition(&definition), m_fields(std::move(fields))
{}

void Message::refuse(std::string why)
{
    if (!m_fault)
        m_fault = Error{Errc::ValueRefused, std::move(why)};
}

std::size_t Message::position(std::string_view field) const
{
    const auto index = m_definition->indexOf(field);
    if (!index)
        throw misuse(*m_definition, field, "does not exist");
    return *index;
}

namespace {

Number scalarAt(const MessageDefinition& definition, const FieldBytes& bytes, std::size_t index)
{
    const auto& field = definition.fields.at(index);
    if (!isNumber(field))
        throw misuse(definition, field.name, "is not a single number");
    return protocol::readNumber(field.type, bytes.data() + locateField(definition, {bytes.data(), bytes.size()}, index).begin);
}

template <typename T>
T convert(const Number& value)
{
    return std::visit([](auto v) { return static_cast<T>(v); }, value);
}

} // namespace

std::uint64_t Message::unsignedAt(std::size_t field) const
{
    const auto number = scalarAt(*m_definition, m_fields, field);
    if (std::holds_alternative<double>(number))
        throw misuse(*m_definition, m_definition->fields[field].name, "is a floating-point number");
    return convert<std::uint64_t>(number);
}

std::int64_t Message::signedAt(std::size_t field) const { return static_cast<std::int64_t>(unsignedAt(field)); }

double Message::realAt(std::size_t field) const { return convert<double>(scalarAt(*m_definition, m_fields, field)); }

std::string_view Message::textAt(std::size_t field) const
{
    const auto& definition = m_definition->fields.at(field);
    if (definition.enumeration && definition.shape == FieldShape::Scalar) {
        const auto* value = definition.enumeration->find(signedAt(field));
        return value != nullptr ? std::string_view(value->name) : std::string_view();
    }
    if (!isText(definition))
        throw misuse(*m_definition, definition.name, "is not text");
    const auto span = locateField(*m_definition, fieldBytes(), field);
    return {reinterpret_cast<const char*>(m_fields.data()) + span.begin + 2, span.size - 2};
}

std::span<const std::byte> Message::bytesAt(std::size_t field) const
{
    if (!isBytes(m_definition->fields.at(field)))
        throw misuse(*m_definition, m_definition->fields[field].name, "is not of type bytes");
    const auto span = locateField(*m_definition, fieldBytes(), field);
    return fieldBytes().subspan(span.begin + 4, span.size - 4);
}

std::vector<double> Message::realsAt(std::size_t field) const
{
    const auto& definition = m_definition->fields.at(field);
    if (isText(definition) || isBytes(definition))
        throw misuse(*m_definition, definition.name, "is not made of numbers");
    auto span = locateField(*m_definition, fieldBytes(), field);
    const std::size_t prefix = definition.shape == FieldShape::Sequence ? 4 : 0;
    std::vector<double> values;
    for (auto at = span.begin + prefix; at < span.begin + span.size; at += sizeOf(definition.type))
        values.push_back(convert<double>(protocol::readNumber(definition.type, m_fields.data() + at)));
    return values;
}

void Message::assign(std::size_t index, const Number& value)
{
    const auto& field = m_definition->fields.at(index);
    if (!isNumber(field))
        throw misuse(*m_definition, field.name, "is not a single number");
    std::array<std::byte, 8> encoded{};
    std::optional<std::string> fault;
    if (!protocol::writeNumber(field.type, value, encoded.data()))
        fault = fmt::format("{}.{} = {} does not fit {}", m_definition->name, field.name, protocol::toString(value),
                            liena::toString(field.type));
    else
        fault = protocol::checkNumber(*m_definition, field, protocol::readNumber(field.type, encoded.data()));
    if (fault) {
        return refuse(*fault);
    }
    std::memcpy(m_fields.data() + locateField(*m_definition, fieldBytes(), index).begin, encoded.data(), sizeOf(field.type));
}

void Message::assignText(std::size_t index, std::string_view value)
{
    const auto& field = m_definition->fields.at(index);
    if (field.enumeration && field.shape == FieldShape::Scalar) {
        if (const auto* named = field.enumeration->find(value))
            return assign(index, named->number);
        throw misuse(*m_definition, field.name, fmt::format("has no value \"{}\"", value));
    }
    if (!isText(field))
        throw misuse(*m_definition, field.name, "is not text");
    if (value.size() > field.count || !protocol::isUtf8(value)) {
        return refuse(fmt::format("{}.{} holds at most {} bytes of UTF-8, the text has {}", m_definition->name, field.name, field.count,
                                  value.size()));
    }
    splice(m_fields, locateField(*m_definition, fieldBytes(), index), 2, value.size(),
           std::as_bytes(std::span(value.data(), value.size())));
}

void Message::assignBytes(std::size_t index, std::span<const std::byte> value)
{
    const auto& field = m_definition->fields.at(index);
    if (!isBytes(field))
        throw misuse(*m_definition, field.name, "is not of type bytes");
    if (value.size() > field.count) {
        return refuse(fmt::format("{}.{} holds at most {} bytes, not {}", m_definition->name, field.name, field.count, value.size()));
    }
    splice(m_fields, locateField(*m_definition, fieldBytes(), index), 4, value.size(), value);
}

void Message::assignReals(std::size_t index, std::span<const double> values)
{
    const auto& field = m_definition->fields.at(index);
    if (field.shape == FieldShape::Scalar || isText(field) || isBytes(field))
        throw misuse(*m_definition, field.name, "is not an array of numbers");
    const bool sequence = field.shape == FieldShape::Sequence;
    if (sequence ? values.size() > field.count : values.size() != field.count) {
        return refuse(fmt::format("{}.{} holds {}{} numbers, not {}", m_definition->name, field.name, sequence ? "at most " : "",
                                  field.count, values.size()));
    }
    std::vector<std::byte> encoded(values.size() * sizeOf(field.type));
    for (std::size_t i = 0; i < values.size(); ++i) {
        auto* at = encoded.data() + i * sizeOf(field.type);
        auto fault = protocol::writeNumber(field.type, values[i], at)
                         ? protocol::checkNumber(*m_definition, field, protocol::readNumber(field.type, at))
                         : std::optional(fmt::format("{}.{} = {} does not fit {}", m_definition->name, field.name, values[i],
                                                     liena::toString(field.type)));
        if (fault) {
            return refuse(*fault);
        }
    }
    splice(m_fields, locateField(*m_definition, fieldBytes(), index), sequence ? 4 : 0, values.size(), encoded);
}

std::string Message::toString() const
{
    std::string line = m_definition->name;
    for (std::size_t i = 0; i < m_definition->fields.size(); ++i) {
        const auto& field = m_definition->fields[i];
        line += fmt::format(" {}=", field.name);
        if (isBytes(field))
            line += fmt::format("({} bytes)", bytesAt(i).size());
        else if (isText(field))
            line += fmt::format("\"{}\"", printable(textAt(i)));
        else if (field.enumeration && isNumber(field))
            line += textAt(i);
        else if (field.type == FieldType::Bool && isNumber(field))
            line += unsignedAt(i) != 0 ? "true" : "false";
        else if (isNumber(field))
            line += protocol::toString(scalarAt(*m_definition, m_fields, i));
        else {
            const auto values = realsAt(i);
            line +=
                fmt::format("[{}]", fmt::join(values.begin(),
                                              values.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(values.size(), 16)), " "));
        }
    }
    return line;
}

} // namespace liena
