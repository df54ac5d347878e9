// Information parts under a random message set: what decodes is encoded again byte for byte, and what the sender allows the receiver takes.
#include "fuzz_input.hpp"
#include "fuzz_target.hpp"
#include "protocol/information_part.hpp"
#include "protocol/message_access.hpp"
#include "random_set.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <vector>

using namespace liena;
using namespace liena::fuzz;

namespace {

using Set = std::shared_ptr<const MessageSet>;

/// Reading XML takes longer than all else here: there are so many sets, and each is made once.
Set randomSet(std::uint16_t choice)
{
    constexpr std::uint16_t sets = 4096;
    static std::array<Set, sets> made;
    const auto seed = static_cast<std::uint16_t>(choice % sets);
    if (made[seed])
        return made[seed];
    const auto xml = randomSetXml(seed);
    Findings findings;
    const auto set = MessageSet::parse(xml, "random.xml", &findings);
    if (!set)
        std::fprintf(stderr, "%s%s\n", xml.c_str(), set.error().what.c_str());
    expect(set.has_value(), "what the grammar allows is read");
    return made[seed] = set.value();
}

bool isText(const FieldDefinition& field) { return field.type == FieldType::String; }
bool isBytes(const FieldDefinition& field) { return field.type == FieldType::Bytes; }
bool isReal(const FieldDefinition& field) { return field.type == FieldType::Float32 || field.type == FieldType::Float64; }
bool isScalar(const FieldDefinition& field) { return field.shape == FieldShape::Scalar; }

/// Arrays are handed out as double, which holds neither each 64-bit integer nor each NaN.
bool survivesDouble(const FieldDefinition& field, const Message& message, std::size_t index)
{
    if (!isScalar(field) && (field.type == FieldType::Int64 || field.type == FieldType::UInt64))
        return false;
    if (!isReal(field))
        return true;
    const auto values = isScalar(field) ? std::vector<double>{message.get<double>(index)} : message.get<std::vector<double>>(index);
    return std::none_of(values.begin(), values.end(), [](double v) { return std::isnan(v); });
}

/// Reads a field from one message and writes it to another.
void carry(const Message& from, Message& to, std::size_t index)
{
    const auto& field = from.definition().fields[index];
    if (isText(field))
        to.set(index, from.get<std::string_view>(index));
    else if (isBytes(field))
        to.set(index, from.get<std::span<const std::byte>>(index));
    else if (!isScalar(field))
        to.set(index, from.get<std::vector<double>>(index));
    else if (field.enumeration)
        to.set(index, from.get<std::string_view>(index));
    else if (isReal(field))
        to.set(index, from.get<double>(index));
    else if (std::holds_alternative<std::int64_t>(protocol::readNumber(field.type, from.fieldBytes().data())))
        to.set(index, from.get<std::int64_t>(index));
    else
        to.set(index, from.get<std::uint64_t>(index));
}

/// Bytes that the definition allows, decoded and encoded again.
void checkDecoded(const Set& set, const MessageDefinition& definition, std::span<const std::byte> bytes)
{
    expect(bytes.size() + definition.recordSize() <= definition.maximumSize(), "what is allowed is within the maximum");
    const auto message = MessageAccess::fromFields(set, definition, FieldBytes(bytes.begin(), bytes.end()));
    expect(!message.toString().empty(), "every message has a line for the log");
    Message again(set, definition);
    bool exact = true;
    for (std::size_t i = 0; i < definition.fields.size(); ++i) {
        exact = exact && survivesDouble(definition.fields[i], message, i);
        if (survivesDouble(definition.fields[i], message, i))
            carry(message, again, i);
    }
    expect(!again.fault(), "a value that was received may be sent");
    const auto written = again.fieldBytes();
    expect(!exact || std::equal(written.begin(), written.end(), bytes.begin(), bytes.end()), "what is decoded is encoded again");
}

/// No message is the beginning of another: a byte less or more is malformed.
void checkNeighbours(const MessageDefinition& definition, std::span<const std::byte> bytes)
{
    if (!bytes.empty())
        expect(protocol::checkFields(definition, bytes.first(bytes.size() - 1)).has_value(), "a byte less is malformed");
    std::vector<std::byte> longer(bytes.begin(), bytes.end());
    longer.push_back(std::byte{0});
    expect(protocol::checkFields(definition, longer).has_value(), "a byte more is malformed");
}

void setField(Message& message, std::size_t index, FuzzInput& input)
{
    const auto& field = message.definition().fields[index];
    if (isText(field) || isBytes(field)) {
        const auto bytes = input.take(input.below(64));
        if (isBytes(field))
            message.set(index, bytes);
        else
            message.set(index, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    } else if (!isScalar(field)) {
        std::vector<double> values(input.below(8));
        for (auto& value : values)
            value = input.flag() ? input.number<double>() : input.number<std::int8_t>();
        message.set(index, values);
    } else if (input.flag()) {
        message.set(index, input.number<double>());
    } else if (input.flag()) {
        message.set(index, input.number<std::int64_t>());
    } else {
        message.set(index, std::uint64_t{input.number<std::uint8_t>()});
    }
}

/// One byte or element more than the definition allows is malformed, in each field that may be of any length.
void checkOneMore(const MessageDefinition& definition, std::span<const std::byte> bytes)
{
    for (std::size_t i = 0; i < definition.fields.size(); ++i) {
        const auto& field = definition.fields[i];
        if (field.hasFixedSize())
            continue;
        const auto span = protocol::locateField(definition, bytes, i);
        const std::uint32_t count = field.count + 1;
        std::vector<std::byte> longer(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(span.begin));
        for (unsigned byte = 0; byte < (isText(field) ? 2U : 4U); ++byte)
            longer.push_back(static_cast<std::byte>(count >> 8U * byte));
        longer.resize(longer.size() + count * (isText(field) || isBytes(field) ? 1 : sizeOf(field.type)));
        longer.insert(longer.end(), bytes.begin() + static_cast<std::ptrdiff_t>(span.begin + span.size), bytes.end());
        expect(protocol::checkFields(definition, longer).has_value(), "one more than the definition allows is malformed");
    }
}

/// What a program sets, whatever it is, leaves a message that every receiver takes.
void checkSet(const Set& set, const MessageDefinition& definition, FuzzInput& input)
{
    Message message(set, definition);
    expect(!protocol::checkFields(definition, message.fieldBytes()), "a message at its defaults is allowed");
    for (std::size_t i = 0; i < definition.fields.size(); ++i)
        setField(message, i, input);
    const auto fault = protocol::checkFields(definition, message.fieldBytes());
    expect(!fault, fault ? fault->c_str() : "");
    checkOneMore(definition, message.fieldBytes());
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    FuzzInput input(data, size);
    const auto set = randomSet(input.number<std::uint16_t>());
    const auto& definition = set->messages().at(input.below(set->messages().size()));
    if (input.flag()) {
        checkSet(set, definition, input);
        return 0;
    }
    const auto bytes = input.rest();
    expect(definition.layout.get()->accepts(bytes) != protocol::faultIn(definition, bytes).has_value(), "layout and definition agree");
    if (protocol::checkFields(definition, bytes))
        return 0;
    checkDecoded(set, definition, bytes);
    checkNeighbours(definition, bytes);
    return 0;
}
