// The compiled layout judges, reads and writes as the definition's own words do.
#include "protocol/wire_layout.hpp"

#include "protocol/information_part.hpp"
#include "protocol/message_access.hpp"
#include "support/hex.hpp"
#include "support/sample_set.hpp"

#include <QTest>

#include <bit>
#include <cmath>
#include <limits>

using namespace liena;
using namespace liena::protocol;
using namespace liena::test;

namespace {

const std::vector<FieldType> numberTypes{FieldType::Bool,   FieldType::Int8,    FieldType::Int16,  FieldType::Int32,
                                         FieldType::Int64,  FieldType::UInt8,   FieldType::UInt16, FieldType::UInt32,
                                         FieldType::UInt64, FieldType::Float32, FieldType::Float64};

FieldDefinition field(FieldType type, std::optional<Number> min = {}, std::optional<Number> max = {})
{
    FieldDefinition definition;
    definition.name = "value";
    definition.type = type;
    definition.min = min;
    definition.max = max;
    return definition;
}

FieldDefinition enumField(FieldType base, std::vector<std::int64_t> numbers)
{
    auto definition = field(base);
    EnumDefinition modes{"Mode", base, {}};
    for (const auto number : numbers)
        modes.values.push_back({"value" + std::to_string(number), number, {}});
    definition.enumeration = std::make_shared<EnumDefinition>(modes);
    return definition;
}

MessageDefinition message(std::vector<FieldDefinition> fields)
{
    MessageDefinition definition;
    definition.number = 0x0200;
    definition.name = "Sample";
    definition.fields = std::move(fields);
    return definition;
}

/// Numbers where types and bounds end, each with its neighbours.
std::vector<Number> tellingNumbers()
{
    std::vector<Number> numbers;
    for (const std::int64_t end : {std::int64_t{0}, std::int64_t{-5}, std::int64_t{7}, std::int64_t{100}, std::int64_t{-128},
                                   std::int64_t{127}, std::int64_t{255}, std::int64_t{-32768}, std::int64_t{32767}, std::int64_t{65535},
                                   std::int64_t{1} << 31U, -(std::int64_t{1} << 31U), std::int64_t{1} << 32U, std::int64_t{1} << 53U})
        for (const std::int64_t step : {-1, 0, 1})
            numbers.emplace_back(end + step);
    numbers.insert(numbers.end(), {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()});
    numbers.insert(numbers.end(), {std::uint64_t{7}, std::uint64_t{1} << 63U, std::numeric_limits<std::uint64_t>::max()});
    const double largest = std::numeric_limits<float>::max();
    for (const double real : {0.0, -0.0, 0.1, -0.1, 0.5, 7.0, 7.25, -5.0, 100.0, largest, -largest, 1e300, -1e300, 9223372036854775808.0,
                              18446744073709551616.0, std::nan(""), HUGE_VAL, -HUGE_VAL})
        numbers.insert(numbers.end(), {real, std::nextafter(real, HUGE_VAL), double{std::nextafter(static_cast<float>(real), 1e30F)}});
    return numbers;
}

std::vector<FieldDefinition> tellingFields()
{
    std::vector<FieldDefinition> fields;
    const std::vector<std::pair<std::optional<Number>, std::optional<Number>>> bounds{
        {{}, {}},
        {Number(std::int64_t{-5}), Number(std::int64_t{7})},
        {Number(std::int64_t{0}), {}},
        {{}, Number(std::int64_t{100})},
        {Number(std::uint64_t{7}), Number(std::uint64_t{7})},
        {{}, Number(std::int64_t{-5})},
        {Number(std::uint64_t{1} << 63U), {}},
        {{}, Number(std::uint64_t{1} << 63U)},
        {Number(-0.1), Number(0.1)},
        {Number(0.5), {}},
    };
    for (const auto type : numberTypes)
        for (const auto& [min, max] : bounds) {
            fields.push_back(field(type, min, max));
            fields.push_back(field(type, min, max));
            fields.back().nonfinite = true;
        }
    for (const auto base : {FieldType::UInt8, FieldType::Int8, FieldType::UInt16, FieldType::Int64, FieldType::UInt64}) {
        fields.push_back(enumField(base, {5, 6, 7}));
        fields.push_back(enumField(base, {100, 0, 7}));
    }
    fields.push_back(enumField(FieldType::Int16, {-5, -4, -3}));
    fields.push_back(enumField(FieldType::Int8, {-128, 7}));
    return fields;
}

/// What the definition says to a number: its bytes, or nothing.
std::optional<std::vector<std::byte>> allowed(const MessageDefinition& definition, const Number& number)
{
    const auto& only = definition.fields.front();
    std::vector<std::byte> bytes(sizeOf(only.type));
    if (!writeNumber(only.type, number, bytes.data()) || checkNumber(definition, only, readNumber(only.type, bytes.data())))
        return std::nullopt;
    return bytes;
}

/// Hands a number to a message as each type of C++ that holds it.
void setAs(Message& subject, const Number& number, int choice)
{
    const auto give = [&](auto typed) { subject.set(std::size_t{0}, typed); };
    std::visit(
        [&](auto value) {
            if constexpr (std::is_floating_point_v<decltype(value)>)
                return choice == 0 && std::isfinite(value) && static_cast<double>(static_cast<float>(value)) == value
                           ? give(static_cast<float>(value))
                           : give(value);
            else if (choice == 0 && std::in_range<std::int8_t>(value))
                return give(static_cast<std::int8_t>(value));
            else if (choice == 1 && std::in_range<std::uint8_t>(value))
                return give(static_cast<std::uint8_t>(value));
            else if (choice == 2 && std::in_range<std::uint16_t>(value))
                return give(static_cast<std::uint16_t>(value));
            else if (choice == 3 && std::in_range<std::int32_t>(value))
                return give(static_cast<std::int32_t>(value));
            else if (choice == 4 && std::in_range<std::uint32_t>(value))
                return give(static_cast<std::uint32_t>(value));
            else if (choice == 5 && std::in_range<std::uint64_t>(value))
                return give(static_cast<std::uint64_t>(value));
            return give(value);
        },
        number);
}

constexpr int choices = 7;

} // namespace

class WireLayoutTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void judgesEveryNumberAsTheDefinitionDoes();
    void writesEveryNumberAsTheDefinitionDoes();
    void readsEveryNumberAsTheDefinitionDoes();
    void judgesEveryByteOfAMessage();
    void findsNamesThatDifferOnlyInTheMiddle();
    void copyOfADefinitionBeginsWithoutLayout();
    void longArraysAreJudgedToTheirEnd();
};

void WireLayoutTest::judgesEveryNumberAsTheDefinitionDoes()
{
    int refused = 0;
    for (const auto& only : tellingFields()) {
        const auto definition = message({only});
        const WireLayout layout(definition);
        for (const auto& number : tellingNumbers()) {
            std::vector<std::byte> bytes(sizeOf(only.type));
            if (!writeNumber(only.type, number, bytes.data()))
                continue;
            const auto fault = faultIn(definition, bytes);
            refused += fault ? 1 : 0;
            // Files give bounds of the field's own kind; with others the layout may leave a number to the definition, never take one.
            const bool foreign = only.min && only.type < FieldType::Float32 && std::holds_alternative<double>(*only.min);
            const bool accepted = layout.accepts(bytes);
            QVERIFY2(accepted != fault.has_value() || (foreign && !accepted), fault ? fault->c_str() : toString(number).c_str());
        }
    }
    QVERIFY(refused > 1000);
}

void WireLayoutTest::writesEveryNumberAsTheDefinitionDoes()
{
    int written = 0;
    for (const auto& only : tellingFields()) {
        const auto definition = message({only});
        const Message fresh(nullptr, definition);
        for (const auto& number : tellingNumbers())
            for (int choice = 0; choice < choices; ++choice) {
                auto subject = fresh;
                setAs(subject, number, choice);
                const auto expected = allowed(definition, number);
                const auto seen = hexOf(subject.fieldBytes());
                QVERIFY2(subject.fault().has_value() != expected.has_value(), toString(number).c_str());
                QCOMPARE(seen, expected ? hexOf(*expected) : hexOf(fresh.fieldBytes()));
                written += expected ? 1 : 0;
            }
    }
    QVERIFY(written > 10000);
}

void WireLayoutTest::readsEveryNumberAsTheDefinitionDoes()
{
    for (const auto type : numberTypes) {
        const auto definition = message({field(type)});
        for (const auto& number : tellingNumbers()) {
            FieldBytes bytes(sizeOf(type));
            if (!allowed(definition, number))
                continue;
            writeNumber(type, number, bytes.data());
            const auto read = readNumber(type, bytes.data());
            const auto subject = MessageAccess::fromFields(nullptr, definition, FieldBytes(bytes));
            QCOMPARE(subject.get<double>(std::size_t{0}), std::visit([](auto v) { return static_cast<double>(v); }, read));
            QCOMPARE(subject.get<float>(std::size_t{0}),
                     std::visit([](auto v) { return static_cast<float>(static_cast<double>(v)); }, read));
            if (std::holds_alternative<double>(read)) {
                QVERIFY_EXCEPTION_THROWN(static_cast<void>(subject.get<std::int32_t>(std::size_t{0})), std::logic_error);
                QVERIFY_EXCEPTION_THROWN(static_cast<void>(subject.get<std::int64_t>(std::size_t{0})), std::logic_error);
                continue;
            }
            const auto same = [&](auto as) {
                using T = decltype(as);
                const auto whole = std::visit([](auto v) { return static_cast<std::uint64_t>(v); }, read);
                return subject.get<T>(std::size_t{0}) == static_cast<T>(whole);
            };
            QVERIFY(same(std::int8_t{}) && same(std::uint8_t{}) && same(std::int16_t{}) && same(std::uint16_t{}) && same(bool{}));
            QVERIFY(same(std::int32_t{}) && same(std::uint32_t{}) && same(std::int64_t{}) && same(std::uint64_t{}));
        }
    }
}

void WireLayoutTest::judgesEveryByteOfAMessage()
{
    const auto set = sampleSet();
    for (const auto& definition : set->messages()) {
        const Message sample(set, definition);
        const std::vector<std::byte> bytes(sample.fieldBytes().begin(), sample.fieldBytes().end());
        QVERIFY(definition.layout.get() != nullptr);
        QVERIFY(definition.layout.get()->accepts(bytes));
        for (std::size_t at = 0; at < bytes.size(); ++at)
            for (unsigned value = 0; value < 256; ++value) {
                auto changed = bytes;
                changed[at] = static_cast<std::byte>(value);
                QCOMPARE(definition.layout.get()->accepts(changed), !faultIn(definition, changed).has_value());
            }
    }
}

void WireLayoutTest::findsNamesThatDifferOnlyInTheMiddle()
{
    std::vector<FieldDefinition> fields;
    for (const char* name : {"a", "b", "ab", "ba", "velocity", "guidewire_1_velocity", "guidewire_2_velocity", "guidewire_3_velocity"}) {
        fields.push_back(field(FieldType::UInt8));
        fields.back().name = name;
    }
    const auto definition = message(fields);
    const WireLayout layout(definition);
    for (std::size_t i = 0; i < fields.size(); ++i)
        QVERIFY(layout.indexOf(definition, fields[i].name) == i);
    for (const char* name : {"", "c", "velocitx", "guidewire_4_velocity", "guidewire_1_velocity_"})
        QVERIFY(!layout.indexOf(definition, name));
    QVERIFY(!WireLayout(message({})).indexOf(message({}), "a"));
}

void WireLayoutTest::copyOfADefinitionBeginsWithoutLayout()
{
    const auto set = sampleSet();
    auto copy = *set->find("Move");
    QVERIFY(copy.layout.get() == nullptr);
    copy.fields[2].max = Number(50.0); // was 40
    const auto made = [&] {
        Message message(set, copy);
        message.set("speed", 45);
        return message;
    }();
    QVERIFY(!made.fault());
    QCOMPARE(made.get<double>("speed"), 45.0);
    QCOMPARE(made.messageSet().name(), std::string("sample-device"));
    copy = *set->find("Move");
    QVERIFY(copy.layout.get() == nullptr);
    const auto moved = std::move(copy);
    QVERIFY(checkFields(*set->find("Move"), made.fieldBytes()));
}

void WireLayoutTest::longArraysAreJudgedToTheirEnd()
{
    for (const std::uint32_t count : {3U, 16U, 17U, 100U}) {
        auto array = field(FieldType::Float32, Number(-1.0), Number(1.0));
        array.shape = FieldShape::FixedArray;
        array.count = count;
        const auto definition =
            message({field(FieldType::UInt8), array, field(FieldType::UInt16, Number(std::int64_t{0}), Number(std::int64_t{9}))});
        const WireLayout layout(definition);
        std::vector<std::byte> bytes(1 + 4 * count + 2);
        QVERIFY(layout.accepts(bytes));
        for (std::size_t i = 0; i < count; ++i) {
            auto changed = bytes;
            store(changed.data() + 1 + 4 * i, 1.5F);
            QVERIFY(!layout.accepts(changed) && faultIn(definition, changed));
        }
        store(bytes.data() + 1 + 4 * count, std::uint16_t{10});
        QVERIFY(!layout.accepts(bytes));
    }
}

QTEST_APPLESS_MAIN(WireLayoutTest)
#include "wire_layout_test.moc"
