// A structure that is bound to a message is written, read and judged exactly as the message's own fields are.
#include "liena/message_binding.hpp"

#include "everything.hpp"
#include "protocol/information_part.hpp"
#include "protocol/message_access.hpp"
#include "support/hex.hpp"

#include <QTest>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

using namespace liena;
using namespace liena::protocol;
using namespace liena::test;

namespace {

template <typename T>
constexpr bool isArray = false;
template <typename Element, std::size_t Count>
constexpr bool isArray<std::array<Element, Count>> = true;

/// As Message::set() takes it.
template <typename T>
auto settable(const T& member)
{
    if constexpr (isArray<T>) {
        std::vector<double> numbers;
        for (const auto element : member)
            numbers.push_back(static_cast<double>(element));
        return numbers;
    } else {
        return member;
    }
}

template <typename T>
bool sameBits(const T& a, const T& b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}

template <typename T>
bool holdsSame(const Message& message, const char* field, const T& member)
{
    if constexpr (isArray<T>)
        return message.get<std::vector<double>>(field) == settable(member);
    else
        return sameBits(message.get<T>(field), member);
}

/// The same numbers in each run.
class Numbers {
public:
    unsigned below(unsigned end) { return static_cast<unsigned>(m_engine() % end); }
    std::byte byte() { return static_cast<std::byte>(m_engine()); }

    void fill(bool& member) { member = below(2) != 0; }
    void fill(std::integral auto& member) { member = static_cast<std::remove_reference_t<decltype(member)>>(m_engine()); }
    void fill(Mode& member) { member = static_cast<Mode>(below(11)); }
    void fill(Side& member) { member = static_cast<Side>(static_cast<int>(below(5)) - 2); }
    void fill(std::floating_point auto& member)
    {
        using Real = std::remove_reference_t<decltype(member)>;
        using Limits = std::numeric_limits<Real>;
        const std::array<Real, 12> telling{
            0, -Real(0), 1, std::nextafter(Real(1), Real(2)), -1, 40, std::nextafter(Real(40), Real(41)), 10, -40, 41, Limits::max(), 5};
        const std::array<Real, 3> nonfinite{Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()};
        member = below(8) == 0 ? nonfinite[below(3)] : telling[below(12)];
    }
    template <typename Element, std::size_t Count>
    void fill(std::array<Element, Count>& member)
    {
        fill(member[below(Count)]);
    }

private:
    std::mt19937_64 m_engine{20240229};
};

/// Mostly what is allowed: one to three fields differ from values that are.
Everything someValues(Numbers& numbers)
{
    Everything values;
    for (unsigned changes = numbers.below(4); changes > 0; --changes) {
        const auto chosen = numbers.below(19);
        unsigned index = 0;
        eachField(values, [&](const char*, auto& member) {
            if (index++ == chosen)
                numbers.fill(member);
        });
    }
    return values;
}

/// The bytes of such values, at times with other bytes among them, or with some missing or added.
std::vector<std::byte> someBytes(Numbers& numbers, std::span<const std::byte> sound)
{
    std::vector<std::byte> bytes(sound.begin(), sound.end());
    for (unsigned changes = numbers.below(3); changes > 0; --changes)
        bytes[numbers.below(static_cast<unsigned>(bytes.size()))] = numbers.byte();
    if (numbers.below(20) == 0)
        bytes.resize(numbers.below(static_cast<unsigned>(bytes.size()) + 10));
    return bytes;
}

template <typename Binding>
std::vector<std::byte> encoded(const Binding& binding, const Everything& values)
{
    std::vector<std::byte> bytes(binding.size());
    if (!binding.encode(values, bytes))
        bytes.clear();
    return bytes;
}

/// What to() answers; empty when it binds.
using Answer = std::string (*)(const std::shared_ptr<const MessageSet>&);

template <typename Field>
std::string answerOf(const std::shared_ptr<const MessageSet>& set, std::string_view message)
{
    const auto bound = MessageBinding<Everything, Field>::to(set, message);
    return bound ? std::string() : bound.error().what;
}

template <typename Field>
std::string ofEverything(const std::shared_ptr<const MessageSet>& set)
{
    return answerOf<Field>(set, "Everything");
}

template <typename Field>
std::string ofTailed(const std::shared_ptr<const MessageSet>& set)
{
    return answerOf<Field>(set, "Tailed");
}

} // namespace

Q_DECLARE_METATYPE(Answer)

class MessageBindingTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void saysWhatDoesNotFit_data();
    void saysWhatDoesNotFit();
    void writesAsTheMessageIsSet();
    void decodesExactlyWhatTheLibraryAccepts();
    void readsWhatTheMessageHolds();
    void refusedStructureIsNotEncoded();
    void fieldsThatAreNotBoundKeepTheirDefaultsAndAreJudged();
    void fieldsInFrontOfATextAreBound();
    void messageOfAnotherDefinitionIsLeftAlone();
    void messageThatWasMovedAwayIsLeftAlone();
    void sameSetReadTwiceIsTheSame();
};

void MessageBindingTest::saysWhatDoesNotFit_data()
{
    QTest::addColumn<Answer>("answer");
    QTest::addColumn<QString>("expected");
    const auto row = [](const char* name, Answer answer, const char* expected) { QTest::newRow(name) << answer << QString(expected); };
    row("fits", ofEverything<Bind<"mode", &E::mode>>, "");
    row("number for an enumeration", ofEverything<Bind<"mode", &E::small>>, "");
    row(
        "no such message", [](const std::shared_ptr<const MessageSet>& set) { return answerOf<Bind<"mode", &E::mode>>(set, "Nothing"); },
        "message set everything 1.0 has no message Nothing: bind one that it has");
    row(
        "no set", [](const std::shared_ptr<const MessageSet>&) { return answerOf<Bind<"mode", &E::mode>>(nullptr, "Everything"); },
        "Everything cannot be bound: there is no message set");
    row("no such field", ofEverything<Bind<"sped", &E::speed>>,
        "Everything of message set everything 1.0 has no field sped: correct the binding, or the set");
    row("sign", ofEverything<Bind<"sequence", &E::step>>,
        "Everything.sequence is uint32, and the member bound to it is int32: make the member std::uint32_t");
    row("size", ofEverything<Bind<"speed", &E::angle>>,
        "Everything.speed is float32, and the member bound to it is float64: make the member float");
    row("truth for a number", ofEverything<Bind<"small", &E::engaged>>,
        "Everything.small is uint8, and the member bound to it is bool: make the member std::uint8_t");
    row("number for a truth", ofEverything<Bind<"engaged", &E::small>>,
        "Everything.engaged is bool, and the member bound to it is uint8: make the member bool");
    row("base of an enumeration", ofEverything<Bind<"mode", &E::side>>,
        "Everything.mode is Mode (an enumeration of uint8), and the member bound to it is int8: make the member an enum class of "
        "std::uint8_t");
    row("array for a number", ofEverything<Bind<"speed", &E::axes>>,
        "Everything.speed is float32, and the member bound to it is float32[3]: make the member float");
    row("number for an array", ofEverything<Bind<"axes", &E::speed>>,
        "Everything.axes is float32[3], and the member bound to it is float32: make the member std::array<float, 3>");
    row("length of an array", ofEverything<Bind<"trace", &E::axes>>,
        "Everything.trace is float64[20], and the member bound to it is float32[3]: make the member std::array<double, 20>");
    row("text", ofTailed<Bind<"note", &E::small>>,
        "Tailed.note varies in size and cannot be bound: leave it out, and use Message::set() and get() for it");
    row("sequence", ofTailed<Bind<"marks", &E::offset>>,
        "Tailed.marks varies in size and cannot be bound: leave it out, and use Message::set() and get() for it");
    row("behind a text", ofTailed<Bind<"speed", &E::speed>>,
        "Tailed.speed stands behind note, which varies in size, and cannot be bound: leave it out, and use Message::set() and get() for "
        "it, or declare it in front");
}

void MessageBindingTest::saysWhatDoesNotFit()
{
    QFETCH(const Answer, answer);
    QFETCH(const QString, expected);
    QCOMPARE(QString::fromStdString(answer(everythingSet())), expected);
}

void MessageBindingTest::writesAsTheMessageIsSet()
{
    const auto set = everythingSet();
    const auto whole = WholeBinding::to(set, "Everything").value();
    const auto shuffled = ShuffledBinding::to(set, "Everything").value();
    Numbers numbers;
    int refused = 0;
    for (int turn = 0; turn < 20000; ++turn) {
        const auto values = someValues(numbers);
        Message expected(set, whole.definition());
        eachField(values, [&](const char* name, const auto& member) { expected.set(name, settable(member)); });
        const bool sound = !expected.fault();
        refused += sound ? 0 : 1;
        Message written(set, whole.definition());
        QCOMPARE(whole.write(values, written), sound);
        QVERIFY2(written.fault() == expected.fault(), expected.fault() ? expected.fault()->what.c_str() : "written");
        QCOMPARE(hexOf(written.fieldBytes()), hexOf(expected.fieldBytes()));
        Message other(set, whole.definition());
        QCOMPARE(shuffled.write(values, other), sound);
        QCOMPARE(hexOf(other.fieldBytes()), hexOf(expected.fieldBytes()));
        QCOMPARE(hexOf(encoded(whole, values)), sound ? hexOf(expected.fieldBytes()) : std::string());
        QCOMPARE(hexOf(encoded(shuffled, values)), sound ? hexOf(expected.fieldBytes()) : std::string());
    }
    QVERIFY2(refused > 2000 && refused < 18000, std::to_string(refused).c_str());
}

void MessageBindingTest::decodesExactlyWhatTheLibraryAccepts()
{
    const auto set = everythingSet();
    const auto whole = WholeBinding::to(set, "Everything").value();
    const auto shuffled = ShuffledBinding::to(set, "Everything").value();
    const auto part = PartBinding::to(set, "Everything").value();
    Numbers numbers;
    int refused = 0;
    for (int turn = 0; turn < 40000; ++turn) {
        auto sound = encoded(whole, someValues(numbers));
        if (sound.empty())
            sound = encoded(whole, Everything());
        const auto bytes = someBytes(numbers, sound);
        const auto fault = faultIn(whole.definition(), bytes);
        refused += fault ? 1 : 0;
        Everything first;
        Everything second;
        Everything third;
        QVERIFY2(whole.decode(bytes, first) != fault.has_value(), fault ? fault->c_str() : hexOf(bytes).c_str());
        QVERIFY2(shuffled.decode(bytes, second) != fault.has_value(), fault ? fault->c_str() : hexOf(bytes).c_str());
        QVERIFY2(part.decode(bytes, third) != fault.has_value(), fault ? fault->c_str() : hexOf(bytes).c_str());
        if (fault) {
            QVERIFY(first == Everything() && second == Everything() && third == Everything());
            QCOMPARE(whole.faultIn(bytes)->what, *fault);
            continue;
        }
        const auto message = MessageAccess::fromFields(set, whole.definition(), FieldBytes(bytes.begin(), bytes.end()));
        const auto compare = [&](const char* name, const auto& member) { QVERIFY2(holdsSame(message, name, member), name); };
        eachField(first, compare);
        eachField(second, compare);
        QVERIFY(third.mode == first.mode && sameBits(third.speed, first.speed) && third.faults == first.faults);
        QVERIFY(third.sequence == Everything().sequence && third.trace == Everything().trace);
    }
    QVERIFY2(refused > 4000 && refused < 36000, std::to_string(refused).c_str());
}

void MessageBindingTest::readsWhatTheMessageHolds()
{
    const auto set = everythingSet();
    const auto whole = WholeBinding::to(set, "Everything").value();
    const auto shuffled = ShuffledBinding::to(set, "Everything").value();
    Message message(set, whole.definition());
    message.set("sequence", 99U).set("mode", "special").set("side", "right").set("speed", -39.5).set("anything", HUGE_VAL);
    message.set("total", std::uint64_t{9223372036854775818U}).set("axes", std::vector{-1.0, 0.5, 1.0}).set("offset", -100);
    QVERIFY(!message.fault());
    Everything first;
    Everything second;
    QVERIFY(whole.read(message, first) && shuffled.read(message, second));
    QVERIFY(first == second && first.mode == Mode::Special && first.side == Side::Right && first.offset == -100);
    eachField(first, [&](const char* name, const auto& member) { QVERIFY2(holdsSame(message, name, member), name); });
}

void MessageBindingTest::refusedStructureIsNotEncoded()
{
    const auto set = everythingSet();
    const auto whole = WholeBinding::to(set, "Everything").value();
    Everything values;
    std::vector<std::byte> bytes(whole.size(), std::byte{0x5A});
    const auto before = bytes;
    values.faults = 10000; // the last one
    QVERIFY(!whole.encode(values, bytes));
    QVERIFY(bytes == before);
    values.faults = 9999;
    QVERIFY(!whole.encode(values, std::span(bytes).first(bytes.size() - 1)));
    QVERIFY(bytes == before);
    bytes.push_back(std::byte{0});
    QVERIFY(!whole.encode(values, bytes));
    QVERIFY(whole.encode(values, std::span(bytes).first(whole.size())));
    QVERIFY(!whole.decode(bytes, values));
    QVERIFY(whole.decode(std::span(bytes).first(whole.size()), values));
}

void MessageBindingTest::fieldsThatAreNotBoundKeepTheirDefaultsAndAreJudged()
{
    const auto set = everythingSet();
    const auto part = PartBinding::to(set, "Everything").value();
    Everything values;
    values.speed = 3.0F;
    const auto bytes = encoded(part, values);
    Message expected(set, part.definition());
    expected.set("mode", Mode::On).set("speed", 3.0F).set("faults", 10);
    QCOMPARE(hexOf(bytes), hexOf(expected.fieldBytes()));

    Message message(set, part.definition());
    message.set("sequence", 1234U);
    QVERIFY(part.write(values, message));
    QCOMPARE(message.get<std::uint32_t>("sequence"), 1234U);

    auto changed = bytes;
    changed[4] = std::byte{0}; // offset: -10 becomes −256
    Everything untouched;
    QVERIFY(!part.decode(changed, untouched));
    QVERIFY(untouched == Everything());
    QVERIFY(part.faultIn(changed)->what.find("Everything.offset") == 0);
}

void MessageBindingTest::fieldsInFrontOfATextAreBound()
{
    const auto set = everythingSet();
    const auto front = FrontBinding::to(set, "Tailed").value();
    Everything values;
    Message message(set, front.definition());
    message.set("note", "a note").set("speed", 7.0F).set("marks", std::vector{1.0, 2.0});
    QVERIFY(front.write(values, message));
    QCOMPARE(message.get<std::uint16_t>("faults"), std::uint16_t{10});
    QCOMPARE(message.get<std::string>("note"), std::string("a note"));
    Everything read;
    QVERIFY(front.decode(message.fieldBytes(), read));
    QVERIFY(read.faults == 10 && read.sequence == 1);
    QVERIFY(!front.decode(message.fieldBytes().first(message.fieldBytes().size() - 1), read));
    QCOMPARE(hexOf(encoded(front, values)), std::string("01 00 00 00 0a 00 00 00 00 00 00 00 00 00 00 00"));
}

void MessageBindingTest::messageOfAnotherDefinitionIsLeftAlone()
{
    const auto set = everythingSet();
    const auto front = FrontBinding::to(set, "Tailed").value();
    auto copied = front.definition(); // may have been changed since
    for (const auto* definition : {set->find("Everything"), static_cast<const MessageDefinition*>(&copied)}) {
        Message stranger(set, *definition);
        const auto before = hexOf(stranger.fieldBytes());
        Everything values;
        QVERIFY(!front.read(stranger, values));
        QVERIFY(values == Everything());
        QVERIFY(!front.write(values, stranger));
        QCOMPARE(hexOf(stranger.fieldBytes()), before);
        QVERIFY(stranger.fault()->what.find("is not Tailed of message set everything 1.0, to which the structure is bound") !=
                std::string::npos);
    }
}

void MessageBindingTest::messageThatWasMovedAwayIsLeftAlone()
{
    const auto front = FrontBinding::to(everythingSet(), "Tailed").value();
    Message message(front.messageSet(), front.definition());
    const auto moved = std::move(message);
    Everything values;
    QVERIFY(!front.write(values, message) && !front.read(message, values)); // NOLINT(bugprone-use-after-move): that is what is tested
    QVERIFY(message.fault()->what.find("a message that was moved away is not Tailed") == 0);
    QVERIFY(front.read(moved, values));
}

void MessageBindingTest::sameSetReadTwiceIsTheSame()
{
    const auto front = FrontBinding::to(everythingSet(), "Tailed").value();
    const auto again = everythingSet();
    Message message(again, *again->find("Tailed"));
    Everything values;
    QVERIFY(front.write(values, message));
    values.faults = 0;
    QVERIFY(front.read(message, values));
    QCOMPARE(values.faults, std::uint16_t{10});
}

QTEST_APPLESS_MAIN(MessageBindingTest)
#include "message_binding_test.moc"
