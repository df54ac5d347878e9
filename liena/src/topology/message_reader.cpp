// Enumerations and messages: what goes with what, and the sizes a message may have (protocol sections 3 and 4, rulings B2, B5, B9, B13).
#include "topology/message_reader.hpp"

#include "topology/attribute_values.hpp"

#include <fmt/format.h>

#include <limits>

namespace liena {

namespace {

constexpr std::size_t largestMessage = 32UL * 1024 * 1024;
constexpr std::size_t largestControl = 32'767;
constexpr std::size_t largestDatagram = 1'200;

struct NumberRange {
    std::uint16_t first;
    std::uint16_t last;
};

NumberRange rangeOf(Role role) { return role == Role::Command ? NumberRange{0x0100, 0x01FF} : NumberRange{0x0200, 0x0FFF}; }

struct IntegerRange {
    std::int64_t lowest;
    std::int64_t highest;
};

IntegerRange rangeOf(FieldType base)
{
    const auto bits = sizeOf(base) * 8;
    const auto highest = std::numeric_limits<std::int64_t>::max() >> (64 - bits);
    switch (base) {
    case FieldType::Int8:
    case FieldType::Int16:
    case FieldType::Int32:
    case FieldType::Int64:
        return {-highest - 1, highest};
    case FieldType::UInt64: // numbers of enums are kept in 63 bits
        return {0, highest};
    default:
        return {0, highest * 2 + 1};
    }
}

FieldType readBase(const Element& element)
{
    return choiceFrom<FieldType>(element.find("base"), {{"uint8", FieldType::UInt8},
                                                        {"uint16", FieldType::UInt16},
                                                        {"uint32", FieldType::UInt32},
                                                        {"uint64", FieldType::UInt64},
                                                        {"int8", FieldType::Int8},
                                                        {"int16", FieldType::Int16},
                                                        {"int32", FieldType::Int32},
                                                        {"int64", FieldType::Int64}})
        .value_or(FieldType::UInt8);
}

class MessageReader {
public:
    explicit MessageReader(const Element& element) : m_element(element) {}

    MessageDefinition read(const EnumTable& enums);

private:
    void readNumber();
    void readTimes();
    void readQueue();
    void readFields(const std::vector<Element>& children, const EnumTable& enums);
    void checkSize() const;
    void checkControlBounds(const Element& field, const FieldDefinition& definition) const;

    const Element& m_element;
    MessageDefinition m_message;
};

MessageDefinition MessageReader::read(const EnumTable& enums)
{
    m_element.expectAttributes(
        {"number", "name", "role", "priority", "in-standby", "period", "deadline", "lifespan", "history", "max-age", "path", "title"});
    const auto children = m_element.children({"description", "field"});
    m_message.description = descriptionAmong(children);
    m_message.name = nameFrom(m_element.require("name")).value_or("");
    m_message.title = textFrom(m_element.find("title"));
    readNumber();
    m_message.priority =
        choiceFrom<Priority>(
            m_element.require("priority"),
            {{"safety", Priority::Safety}, {"control", Priority::Control}, {"status", Priority::Status}, {"bulk", Priority::Bulk}})
            .value_or(Priority::Status);
    m_message.allowedInStandBy = choiceFrom<bool>(m_element.find("in-standby"), {{"refuse", false}, {"allow", true}})
                                     .value_or(m_message.priority != Priority::Control);
    readTimes();
    readQueue();
    readFields(children, enums);
    checkSize();
    return std::move(m_message);
}

void MessageReader::readNumber()
{
    const auto attribute = m_element.require("number");
    const auto number = messageNumberFrom(attribute);
    const auto role = choiceFrom<Role>(m_element.require("role"), {{"command", Role::Command}, {"report", Role::Report}});
    m_message.number = number.value_or(0);
    m_message.role = role.value_or(Role::Report);
    if (!number || !role)
        return;
    const auto [first, last] = rangeOf(*role);
    if (*number < first || *number > last)
        attribute->reject(fmt::format("0x{:04x} is no number of a {}", *number, toString(*role)),
                          fmt::format("a {} has 0x{:04x} to 0x{:04x}", toString(*role), first, last));
}

void MessageReader::readTimes()
{
    const auto deadline = m_element.find("deadline");
    m_message.period = durationFrom(m_element.find("period"));
    m_message.deadline = durationFrom(deadline);
    m_message.lifespan = durationFrom(m_element.find("lifespan"));
    const auto maxAge = m_element.find("max-age");
    m_message.maxAge = durationFrom(maxAge);
    if (maxAge && m_message.priority != Priority::Control)
        maxAge->misplaced("'max-age' belongs to control messages only", "remove it; 'lifespan' drops old messages of every priority");
    if (m_message.period && m_message.deadline && *m_message.deadline < *m_message.period)
        m_element.findings().warning(deadline->valueAt(), "the deadline is shorter than the period, so it is always missed",
                                     "give the receiver more time than one period");
}

void MessageReader::readQueue()
{
    const auto history = integerFrom(m_element.find("history"), 1, std::numeric_limits<std::uint32_t>::max());
    m_message.history = static_cast<std::uint32_t>(history.value_or(0));
    const auto path = m_element.find("path");
    m_message.path = choiceFrom<Path>(path, {{"stream", Path::Stream}, {"datagram", Path::Datagram}}).value_or(Path::Stream);
    if (m_message.path == Path::Datagram && m_message.history != 1)
        path->reject("a message on the datagram path has no history=\"1\"", "add history=\"1\": on this path the newest wins");
}

void MessageReader::readFields(const std::vector<Element>& children, const EnumTable& enums)
{
    Once<std::string> names;
    for (const auto& child : children) {
        if (child.name() != "field")
            continue;
        auto field = readField(child, enums);
        if (!field)
            continue;
        checkControlBounds(child, *field);
        if (names.take(field->name, *child.find("name"), "the field name '" + field->name + "'"))
            m_message.fields.push_back(std::move(*field));
    }
}

void MessageReader::checkControlBounds(const Element& field, const FieldDefinition& definition) const
{
    const bool isNumber = !definition.enumeration && definition.type != FieldType::Bool && definition.type != FieldType::String &&
                          definition.type != FieldType::Bytes;
    if (m_message.priority != Priority::Control || !isNumber)
        return;
    if (!field.find("min") || !field.find("max"))
        field.warning(fmt::format("the number '{}' of a control message has no min and max", definition.name),
                      "give both, so that an absurd value is refused before it reaches the device");
    if (definition.nonfinite)
        field.warning(fmt::format("the number '{}' of a control message may be NaN or infinite", definition.name),
                      "remove nonfinite, unless the device is safe with both");
}

void MessageReader::checkSize() const
{
    const auto size = m_message.maximumSize();
    const auto tooLarge = [&](std::size_t most, std::string_view what) {
        m_element.error(fmt::format("{} can have {} bytes{}", inQuotes(m_message.name), size,
                                    m_message.recordSize() > 0 ? " with its safety record" : ""),
                        fmt::format("{} has at most {}; shorten max-length, max-count or the arrays", what, most));
    };
    if (size > largestMessage)
        return tooLarge(largestMessage, "a message");
    if (m_message.priority == Priority::Control && size > largestControl)
        return tooLarge(largestControl, "a control message");
    if (m_message.path == Path::Datagram && size > largestDatagram)
        tooLarge(largestDatagram, "a message on the datagram path");
}

} // namespace

std::shared_ptr<const EnumDefinition> readEnum(const Element& element)
{
    element.expectAttributes({"name", "base"});
    auto definition = std::make_shared<EnumDefinition>();
    definition->name = nameFrom(element.require("name")).value_or("");
    definition->base = readBase(element);
    const auto [lowest, highest] = rangeOf(definition->base);
    Once<std::string> names;
    Once<std::int64_t> numbers;
    for (const auto& child : element.children({"value"})) {
        child.expectAttributes({"name", "number", "title"});
        child.children({});
        const auto name = nameFrom(child.require("name"));
        const auto number = integerFrom(child.require("number"), lowest, highest);
        const bool newName = name && names.take(*name, *child.find("name"), "the value name '" + *name + "'");
        const bool newNumber = number && numbers.take(*number, *child.find("number"), fmt::format("the number {}", *number));
        if (newName && newNumber)
            definition->values.push_back({*name, *number, textFrom(child.find("title"))});
    }
    if (definition->values.empty())
        element.error(fmt::format("the enum {} has no value", inQuotes(definition->name)), "add <value name=\"…\" number=\"…\"/>");
    return definition;
}

MessageDefinition readMessage(const Element& element, const EnumTable& enums) { return MessageReader(element).read(enums); }

} // namespace liena
