// Which bodies are session messages and which are not; the golden bytes themselves stand in tests/corpus/session.
#include "protocol/datagram.hpp"
#include "protocol/session_messages.hpp"
#include "support/corpus_file.hpp"
#include "support/hex.hpp"

#include <QTest>

#include <algorithm>
#include <array>
#include <set>

using namespace liena;
using namespace liena::protocol;
using namespace liena::test;

namespace {

constexpr std::uint64_t token = 0x1122334455667788ULL;
const auto tokenHex = QStringLiteral("88 77 66 55 44 33 22 11");
const auto hashHex80 = QStringLiteral("80 81 82 83 84 85 86 87 88 89 8a 8b 8c 8d 8e 8f 90 91 92 93 94 95 96 97 98 99 9a 9b 9c 9d 9e 9f");

struct Kind {
    const char* name; ///< and its file in tests/corpus/session
    std::uint16_t number;
    std::size_t maximum; ///< body in bytes
};

constexpr std::array kinds{
    Kind{"Attach", 0x0001, 2 + 8 + 1},
    Kind{"Handshake", 0x0002, 8 + 32 + 32 + 2 + 64},
    Kind{"HandshakeCommit", 0x0003, 8 + 32 + 1 + 2 + 64},
    Kind{"MessageSetRequest", 0x0004, 32},
    Kind{"MessageSet", 0x0005, 32 + 4 + 262144},
    Kind{"ChannelOpened", 0x0006, 8},
    Kind{"Rejected", 0x0007, 8 + 1 + 2 + 512},
    Kind{"Heartbeat", 0x0010, 40},
    Kind{"Disengagement", 0x0020, 8 + 2 + 256},
    Kind{"DisengagementCommit", 0x0021, 8},
    Kind{"ChannelClosed", 0x0022, 8},
    Kind{"DiagnosisHandshake", 0x0030, 8 + 32 + 32 + 2 + 64 + 8},
    Kind{"DiagnosisHandshakeCommit", 0x0031, 8 + 32 + 1 + 2 + 64 + 8},
    Kind{"ChannelReOpened", 0x0032, 8 + 8 + 4 + 4},
    Kind{"StandBy", 0x0040, 8 + 4 + 4 + 1 + 8 + 4},
    Kind{"StandByReport", 0x0041, 8 + 4 + 1 + 8},
    Kind{"IncidentDismissed", 0x0042, 8 + 4 + 2 + 256},
    Kind{"LinkReport", 0x0050, 4 + 6 * 8 + 4},
    Kind{"Abandon", 0x0051, 2 + 8},
    Kind{"MeasureRequest", 0x0060, 4 + 4 + 4 + 8},
    Kind{"MeasureAnswer", 0x0061, 4 + 1 + 1 + 4 + 4 + 8 + 2 + 256},
    Kind{"Probe", 0x0062, 4 + 1 + 4 + 8 + 4 + 8 * 1024 * 1024},
    Kind{"ProbeEcho", 0x0063, 4 + 1 + 4 + 8 + 4},
};

/// The body of the message's file, which is one datagram.
std::vector<std::byte> goldenBytes(std::uint16_t number)
{
    const auto kind = std::find_if(kinds.begin(), kinds.end(), [number](const Kind& k) { return k.number == number; });
    const auto file = readCorpusFile(std::filesystem::path(LIENA_SOURCE_DIR "/tests/corpus/session") / (std::string(kind->name) + ".hex"));
    return {file.bytes.begin() + headerSize, file.bytes.end()};
}

/// The golden message with some bytes replaced, from offset `at`.
std::vector<std::byte> patched(std::uint16_t number, std::size_t at, const char* hex)
{
    auto bytes = goldenBytes(number);
    const auto patch = bytesOf(hex);
    std::copy(patch.begin(), patch.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
    return bytes;
}

} // namespace

Q_DECLARE_METATYPE(std::vector<std::byte>)

class SessionMessagesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void hasTheNumbersAndNamesOfThePage();
    void takesNoBodyThatIsTooShortOrTooLong();
    void knowsTheLongestBodies();
    void knowsNoOtherNumbers();
    void refusesMalformedBodies_data();
    void refusesMalformedBodies();
    void takesEveryDeclaredValue_data();
    void takesEveryDeclaredValue();
    void takesTextOfTheGreatestLength();
    void cutsOwnTextAtACharacter();
    void takesTheLargestSet();
};

void SessionMessagesTest::hasTheNumbersAndNamesOfThePage()
{
    std::set<std::size_t> seen;
    for (const auto& kind : kinds) {
        const auto message = decodeSessionMessage(kind.number, goldenBytes(kind.number));
        QVERIFY2(message.has_value(), kind.name);
        seen.insert(message->index());
        QCOMPARE(numberOf(*message), kind.number);
        QCOMPARE(std::string(nameOf(*message)), std::string(kind.name));
    }
    QCOMPARE(seen.size(), std::variant_size_v<SessionMessage>);
}

void SessionMessagesTest::takesNoBodyThatIsTooShortOrTooLong()
{
    for (const auto& kind : kinds) {
        auto bytes = goldenBytes(kind.number);
        for (std::size_t length = 0; length < bytes.size(); ++length)
            QVERIFY2(!decodeSessionMessage(kind.number, std::span(bytes).first(length)), kind.name);
        bytes.push_back(std::byte{0});
        QVERIFY2(!decodeSessionMessage(kind.number, bytes), kind.name);
    }
}

void SessionMessagesTest::knowsTheLongestBodies()
{
    for (const auto& kind : kinds) {
        const auto maximum = maximumSessionBody(kind.number);
        QVERIFY2(maximum.has_value(), kind.name);
        QVERIFY2(*maximum == kind.maximum, kind.name);
    }
}

void SessionMessagesTest::knowsNoOtherNumbers()
{
    std::set<int> numbers;
    for (const auto& kind : kinds)
        numbers.insert(kind.number);
    for (int number = 0; number <= 0xFFFF; ++number) {
        if (numbers.contains(number))
            continue;
        QVERIFY(!maximumSessionBody(static_cast<std::uint16_t>(number)));
        QVERIFY(!decodeSessionMessage(static_cast<std::uint16_t>(number), bytesOf("88 77 66 55 44 33 22 11")));
    }
}

void SessionMessagesTest::refusesMalformedBodies_data()
{
    QTest::addColumn<int>("number");
    QTest::addColumn<std::vector<std::byte>>("body");
    QTest::newRow("want_set neither 0 nor 1") << 0x0003 << patched(0x0003, 40, "02");
    QTest::newRow("want_set of a re-opening") << 0x0031 << patched(0x0031, 40, "ff");
    QTest::newRow("holding neither 0 nor 1") << 0x0041 << patched(0x0041, 12, "80");
    QTest::newRow("no such reason") << 0x0007 << patched(0x0007, 8, "0e");
    QTest::newRow("reason 0") << 0x0007 << patched(0x0007, 8, "00");
    QTest::newRow("no such state") << 0x0010 << patched(0x0010, 33, "08");
    QTest::newRow("state 0") << 0x0010 << patched(0x0010, 33, "00");
    QTest::newRow("no such cause") << 0x0040 << patched(0x0040, 16, "06");
    QTest::newRow("cause 0") << 0x0040 << patched(0x0040, 16, "00");
    QTest::newRow("overlong UTF-8") << 0x0007 << patched(0x0007, 12, "c0 af");
    QTest::newRow("lone continuation") << 0x0007 << patched(0x0007, 12, "80 41");
    QTest::newRow("surrogate") << 0x0020 << patched(0x0020, 10, "ed a0 80");
    QTest::newRow("cut character") << 0x0020 << patched(0x0020, 11, "e2 82");
    QTest::newRow("text of another length") << 0x0020 << patched(0x0020, 8, "02 00");
    QTest::newRow("text beyond the body") << 0x0020 << patched(0x0020, 8, "ff ff");
    QTest::newRow("set beyond the body") << 0x0005 << patched(0x0005, 32, "ff ff ff ff");
    QTest::newRow("no such verdict") << 0x0061 << patched(0x0061, 4, "05");
    QTest::newRow("verdict 0") << 0x0061 << patched(0x0061, 4, "00");
    QTest::newRow("in use neither 0 nor 1") << 0x0061 << patched(0x0061, 5, "02");
    QTest::newRow("no such way") << 0x0062 << patched(0x0062, 4, "04");
    QTest::newRow("way 0") << 0x0063 << patched(0x0063, 4, "00");
    QTest::newRow("padding beyond the body") << 0x0062 << patched(0x0062, 17, "05");
    QTest::newRow("padding that ends before the body") << 0x0062 << patched(0x0062, 17, "03");
    auto tooLong = bytesOf("88 77 66 55 44 33 22 11 01 01");
    tooLong.resize(tooLong.size() + 257, std::byte{'a'});
    QTest::newRow("reason of 257 bytes") << 0x0020 << tooLong;
    auto software = bytesOf((tokenHex + hashHex80 + QStringLiteral("00 41 00")).toStdString());
    software.resize(software.size() + 65, std::byte{'a'});
    QTest::newRow("software of 65 bytes") << 0x0003 << software;
    auto set = bytesOf((hashHex80 + QStringLiteral("01 00 04 00")).toStdString());
    set.resize(set.size() + 262145, std::byte{' '});
    QTest::newRow("set over 256 KiB") << 0x0005 << set;
}

void SessionMessagesTest::refusesMalformedBodies()
{
    QFETCH(int, number);
    QFETCH(std::vector<std::byte>, body);
    QVERIFY(!decodeSessionMessage(static_cast<std::uint16_t>(number), body));
}

void SessionMessagesTest::takesEveryDeclaredValue_data()
{
    QTest::addColumn<int>("number");
    QTest::addColumn<int>("offset");
    QTest::addColumn<int>("value");
    for (int reason = 1; reason <= 12; ++reason)
        QTest::addRow("reason %d", reason) << 0x0007 << 8 << reason;
    for (int state = 1; state <= 7; ++state)
        QTest::addRow("state %d", state) << 0x0010 << 33 << state;
    for (int cause = 1; cause <= 5; ++cause)
        QTest::addRow("cause %d", cause) << 0x0040 << 16 << cause;
    for (int verdict = 1; verdict <= 4; ++verdict)
        QTest::addRow("verdict %d", verdict) << 0x0061 << 4 << verdict;
    for (int way = 1; way <= 3; ++way)
        QTest::addRow("way %d", way) << 0x0063 << 4 << way;
}

void SessionMessagesTest::takesEveryDeclaredValue()
{
    QFETCH(int, number);
    QFETCH(int, offset);
    QFETCH(int, value);
    auto bytes = goldenBytes(static_cast<std::uint16_t>(number));
    bytes[static_cast<std::size_t>(offset)] = static_cast<std::byte>(value);
    const auto decoded = decodeSessionMessage(static_cast<std::uint16_t>(number), bytes);
    QVERIFY(decoded);
    QVERIFY(encodeSessionMessage(*decoded) == bytes);
}

void SessionMessagesTest::takesTextOfTheGreatestLength()
{
    const Rejected rejected{token, RejectReason::Busy, {std::string(512, 'x')}};
    const auto bytes = encodeSessionMessage(rejected);
    QCOMPARE(bytes.size(), *maximumSessionBody(Rejected::number));
    QVERIFY(decodeSessionMessage(Rejected::number, bytes) == SessionMessage(rejected));
}

void SessionMessagesTest::cutsOwnTextAtACharacter()
{
    const Disengagement message{token, {std::string(255, 'x') + "\xC3\xB6"}};
    const auto bytes = encodeSessionMessage(message);
    const auto decoded = decodeSessionMessage(Disengagement::number, bytes);
    QVERIFY(decoded);
    QCOMPARE(std::get<Disengagement>(*decoded).reason.value, std::string(255, 'x'));
}

void SessionMessagesTest::takesTheLargestSet()
{
    const MessageSetAnswer answer{Sha256::of(std::string_view("a set")), filled(262144, 0x20)};
    const auto bytes = encodeSessionMessage(answer);
    QCOMPARE(bytes.size(), *maximumSessionBody(MessageSetAnswer::number));
    QVERIFY(decodeSessionMessage(MessageSetAnswer::number, bytes) == SessionMessage(answer));
}

QTEST_APPLESS_MAIN(SessionMessagesTest)
#include "session_messages_test.moc"
