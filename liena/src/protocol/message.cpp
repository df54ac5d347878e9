// Reading and writing the fields of a message in their wire form.
#include "liena/message.hpp"

#include "liena/log.hpp"
#include "protocol/information_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <stdexcept>

namespace liena {

using protocol::FieldSlot;
using protocol::FieldSpan;
using protocol::load;
using protocol::SlotKind;
using protocol::store;

namespace {

constexpr std::size_t bytesPrefix = 4; // the length of a field of type bytes

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
    const auto length = static_cast<std::uint32_t>(count);
    std::memcpy(bytes.data() + old.begin, &length, prefix);
    const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(old.begin + prefix);
    const auto there = old.size - prefix;
    if (content.size() > there) { // what is new is written once: an image is long
        const auto rest = content.subspan(there);
        bytes.insert(place + static_cast<std::ptrdiff_t>(there), rest.data(), rest.data() + rest.size());
    } else {
        bytes.erase(place + static_cast<std::ptrdiff_t>(content.size()), place + static_cast<std::ptrdiff_t>(there));
    }
    const auto replaced = std::min(there, content.size());
    if (replaced > 0)
        std::memcpy(bytes.data() + old.begin + prefix, content.data(), replaced);
}

} // namespace

namespace {

/// A definition that is not of a set that was read has none: one is made that lives as long as what holds the set.
const protocol::WireLayout* layoutFor(std::shared_ptr<const MessageSet>& set, const MessageDefinition& definition)
{
    if (const auto* layout = definition.layout.get())
        return layout;
    struct SetAndLayout {
        std::shared_ptr<const MessageSet> set;
        protocol::WireLayout layout;
    };
    const auto both = std::make_shared<const SetAndLayout>(SetAndLayout{set, protocol::WireLayout(definition)});
    set = std::shared_ptr<const MessageSet>(both, set.get());
    return &both->layout;
}

} // namespace

Message::Message(std::shared_ptr<const MessageSet> set, const MessageDefinition& definition)
    : m_set(std::move(set)),
      m_definition(&definition),
      m_layout(layoutFor(m_set, definition)),
      m_slots(m_layout->slots()),
      m_fields(m_layout->defaults().data(), m_layout->defaults().data() + m_layout->defaults().size())
{}

Message::Message(std::shared_ptr<const MessageSet> set, const MessageDefinition& definition, FieldBytes&& fields)
    : m_set(std::move(set)),
      m_definition(&definition),
      m_layout(layoutFor(m_set, definition)),
      m_slots(m_layout->slots()),
      m_fields(std::move(fields))
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

bool isReal(FieldType type) { return type == FieldType::Float32 || type == FieldType::Float64; }

bool isSigned(FieldType type)
{
    return type == FieldType::Int8 || type == FieldType::Int16 || type == FieldType::Int32 || type == FieldType::Int64;
}

/// One number as double, which is how arrays are handed out.
double realFrom(FieldType type, const std::byte* bytes)
{
    if (type == FieldType::Float32)
        return load<float>(bytes);
    if (type == FieldType::Float64)
        return load<double>(bytes);
    const auto whole = protocol::wholeAt(type, bytes);
    return isSigned(type) ? static_cast<double>(static_cast<std::int64_t>(whole)) : static_cast<double>(whole);
}

/// Writes what is allowed for certain; false when it must be asked about in full.
bool storeAllowed(const FieldSlot& slot, FieldType type, const Number& value, std::byte* at)
{
    const auto* unsignedValue = std::get_if<std::uint64_t>(&value);
    const auto* real = std::get_if<double>(&value);
    if (slot.kind == SlotKind::Real32 || slot.kind == SlotKind::Real64) {
        const auto wide = std::visit([](auto v) { return static_cast<double>(v); }, value);
        const auto narrow = static_cast<float>(wide);
        const bool isDouble = slot.kind == SlotKind::Real64;
        if (isDouble ? !slot.allows(wide) : !slot.allows(narrow))
            return false;
        isDouble ? store(at, wide) : store(at, narrow);
        return true;
    }
    if (slot.kind == SlotKind::None || real != nullptr || (unsignedValue != nullptr && *unsignedValue >> 63U != 0))
        return false;
    const auto whole = unsignedValue != nullptr ? static_cast<std::int64_t>(*unsignedValue) : std::get<std::int64_t>(value);
    if (!slot.allows(whole))
        return false;
    std::memcpy(at, &whole, sizeOf(type));
    return true;
}

} // namespace

const std::byte* Message::numberAt(std::size_t index) const
{
    const auto& field = m_definition->fields.at(index);
    if (!isNumber(field))
        throw misuse(*m_definition, field.name, "is not a single number");
    return m_fields.data() + m_layout->locate(fieldBytes(), index).begin;
}

std::uint64_t Message::unsignedAt(std::size_t field) const
{
    const auto* bytes = numberAt(field);
    const auto& definition = m_definition->fields[field];
    if (isReal(definition.type))
        throw misuse(*m_definition, definition.name, "is a floating-point number");
    return protocol::wholeAt(definition.type, bytes);
}

double Message::realAt(std::size_t field) const
{
    const auto* bytes = numberAt(field);
    return realFrom(m_definition->fields[field].type, bytes);
}

std::string_view Message::textAt(std::size_t field) const
{
    const auto& definition = m_definition->fields.at(field);
    if (definition.enumeration && definition.shape == FieldShape::Scalar) {
        const auto* value = definition.enumeration->find(static_cast<std::int64_t>(unsignedAt(field)));
        return value != nullptr ? std::string_view(value->name) : std::string_view();
    }
    if (!isText(definition))
        throw misuse(*m_definition, definition.name, "is not text");
    const auto span = m_layout->locate(fieldBytes(), field);
    return {reinterpret_cast<const char*>(m_fields.data()) + span.begin + 2, span.size - 2};
}

std::span<const std::byte> Message::bytesAt(std::size_t field) const
{
    if (!isBytes(m_definition->fields.at(field)))
        throw misuse(*m_definition, m_definition->fields[field].name, "is not of type bytes");
    if (m_lent && field + 1 == m_definition->fields.size())
        return m_lent->bytes;
    const auto span = m_layout->locate(fieldBytes(), field);
    return fieldBytes().subspan(span.begin + bytesPrefix, span.size - bytesPrefix);
}

std::vector<double> Message::realsAt(std::size_t field) const
{
    const auto& definition = m_definition->fields.at(field);
    if (isText(definition) || isBytes(definition))
        throw misuse(*m_definition, definition.name, "is not made of numbers");
    auto span = m_layout->locate(fieldBytes(), field);
    const std::size_t prefix = definition.shape == FieldShape::Sequence ? 4 : 0;
    std::vector<double> values;
    values.reserve((span.size - prefix) / sizeOf(definition.type));
    for (auto at = span.begin + prefix; at < span.begin + span.size; at += sizeOf(definition.type))
        values.push_back(realFrom(definition.type, m_fields.data() + at));
    return values;
}

void Message::assign(std::size_t index, const Number& value)
{
    const auto& field = m_definition->fields.at(index);
    if (storeAllowed(m_slots[index], field.type, value, m_fields.data() + m_slots[index].offset))
        return;
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
    std::memcpy(m_fields.data() + m_layout->locate(fieldBytes(), index).begin, encoded.data(), sizeOf(field.type));
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
    splice(m_fields, m_layout->locate(fieldBytes(), index), 2, value.size(), std::as_bytes(std::span(value.data(), value.size())));
}

Message& Message::setPrintable(std::size_t index, std::string_view words)
{
    constexpr std::size_t cutMark = std::string_view("…").size(); // printable() adds it beyond the limit
    const auto& field = m_definition->fields.at(index);
    if (!isText(field))
        throw misuse(*m_definition, field.name, "is not text");
    auto text = printable(words, field.count);
    if (text.size() > field.count)
        text = field.count < cutMark ? std::string() : printable(words, field.count - cutMark);
    assignText(index, text);
    return *this;
}

void Message::assignBytes(std::size_t index, std::span<const std::byte> value)
{
    const auto& field = m_definition->fields.at(index);
    if (!isBytes(field))
        throw misuse(*m_definition, field.name, "is not of type bytes");
    if (value.size() > field.count) {
        return refuse(fmt::format("{}.{} holds at most {} bytes, not {}", m_definition->name, field.name, field.count, value.size()));
    }
    if (m_lent && index + 1 == m_definition->fields.size())
        writeLength(0);
    splice(m_fields, m_layout->locate(fieldBytes(), index), bytesPrefix, value.size(), value);
    if (index + 1 == m_definition->fields.size())
        m_lent = nullptr; // last: `value` may be what was lent
}

Message& Message::lend(std::size_t index, std::shared_ptr<const void> owner, std::span<const std::byte> bytes)
{
    constexpr std::size_t worthLending = 4096;
    if (index + 1 != m_definition->fields.size())
        throw misuse(*m_definition, m_definition->fields.at(index).name, "is not the last field, and only that can be lent to");
    const bool copied = bytes.size() < worthLending || m_definition->priority != Priority::Bulk || m_definition->path != Path::Stream;
    if (copied || bytes.size() > m_definition->fields[index].count) {
        assignBytes(index, bytes);
        return *this;
    }
    auto lent = std::make_shared<const LentBytes>(LentBytes{std::move(owner), bytes}); // before anything is changed: it may throw
    assignBytes(index, {});
    writeLength(bytes.size());
    m_lent = std::move(lent);
    return *this;
}

/// Of the last field, which is of type bytes and has no content in m_fields.
void Message::writeLength(std::size_t length)
{
    const auto count = static_cast<std::uint32_t>(length);
    std::memcpy(m_fields.data() + m_fields.size() - bytesPrefix, &count, bytesPrefix);
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
    FieldBytes encoded(values.size() * sizeOf(field.type));
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
    splice(m_fields, m_layout->locate(fieldBytes(), index), sequence ? 4 : 0, values.size(), {encoded.data(), encoded.size()});
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
            line += protocol::toString(protocol::readNumber(field.type, numberAt(i)));
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
