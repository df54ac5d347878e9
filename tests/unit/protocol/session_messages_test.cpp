// Golden bytes of every session message, as section 7 of the protocol lays them out, and what is no such message.
#include "protocol/session_messages.hpp"
#include "support/hex.hpp"

#include <QTest>

#include <set>

using namespace liena;
using namespace liena::protocol;
using namespace liena::test;

namespace {

constexpr std::uint64_t token = 0x1122334455667788ULL;
const auto tokenHex = QStringLiteral("88 77 66 55 44 33 22 11");

/// Bytes first, first + 1, … as a hash, and the same in hex.
Sha256 hashFrom(unsigned first)
{
    Sha256 hash;
    for (unsigned i = 0; i < 32; ++i)
        hash.bytes[i] = static_cast<std::uint8_t>(first + i);
    return hash;
}

const auto hashHex00 = QStringLiteral("00 01 02 03 04 05 06 07 08 09 0a 0b 0c 0d 0e 0f 10 11 12 13 14 15 16 17 18 19 1a 1b 1c 1d 1e 1f");
const auto hashHex80 = QStringLiteral("80 81 82 83 84 85 86 87 88 89 8a 8b 8c 8d 8e 8f 90 91 92 93 94 95 96 97 98 99 9a 9b 9c 9d 9e 9f");
const auto lienaHex = QStringLiteral("05 00 6c 69 65 6e 61"); // "liena"

struct Golden {
    const char* name;
    std::uint16_t number;
    SessionMessage message;
    QString hex;
    std::size_t maximum; ///< body in bytes
};

std::vector<Golden> golden()
{
    const Handshake handshake{token, hashFrom(0x00), hashFrom(0x80), {"liena"}};
    const HandshakeCommit commit{token, hashFrom(0x80), true, {"liena"}};
    const auto handshakeHex = tokenHex + hashHex00 + hashHex80 + lienaHex;
    const auto commitHex = tokenHex + hashHex80 + QStringLiteral("01") + lienaHex;
    return {
        {"Attach", 0x0001, Attach{1, token, 3}, QStringLiteral("01 00") + tokenHex + QStringLiteral("03"), 11},
        {"Handshake", 0x0002, handshake, handshakeHex, 8 + 32 + 32 + 2 + 64},
        {"HandshakeCommit", 0x0003, commit, commitHex, 8 + 32 + 1 + 2 + 64},
        {"MessageSetRequest", 0x0004, MessageSetRequest{hashFrom(0x80)}, hashHex80, 32},
        {"MessageSet", 0x0005, MessageSetAnswer{hashFrom(0x00), bytesOfText("<a/>")}, hashHex00 + QStringLiteral("04 00 00 00 3c 61 2f 3e"),
         32 + 4 + 262144},
        {"ChannelOpened", 0x0006, ChannelOpened{token}, tokenHex, 8},
        {"Rejected", 0x0007, Rejected{token, RejectReason::StandBy, {"h\xC3\xB6"}}, tokenHex + QStringLiteral("06 03 00 68 c3 b6"),
         8 + 1 + 2 + 512},
        {"Heartbeat", 0x0010,
         Heartbeat{0x01020304U, 0x1112131415161718ULL, 0x21222324U, 0x3132333435363738ULL, 0x4142434445464748ULL, 0x51, SessionState::Open,
                   0x6162, 0x71727374U},
         QStringLiteral("04 03 02 01  18 17 16 15 14 13 12 11  24 23 22 21  38 37 36 35 34 33 32 31  48 47 46 45 44 43 42 41"
                        "51 02 62 61 74 73 72 71"),
         40},
        {"Disengagement", 0x0020, Disengagement{token, {"bye"}}, tokenHex + QStringLiteral("03 00 62 79 65"), 8 + 2 + 256},
        {"DisengagementCommit", 0x0021, DisengagementCommit{token}, tokenHex, 8},
        {"ChannelClosed", 0x0022, ChannelClosed{token}, tokenHex, 8},
        {"DiagnosisHandshake", 0x0030, DiagnosisHandshake{handshake, 0x0102030405060708ULL},
         handshakeHex + QStringLiteral("08 07 06 05 04 03 02 01"), 8 + 32 + 32 + 2 + 64 + 8},
        {"DiagnosisHandshakeCommit", 0x0031, DiagnosisHandshakeCommit{commit, 0x0102030405060708ULL},
         commitHex + QStringLiteral("08 07 06 05 04 03 02 01"), 8 + 32 + 1 + 2 + 64 + 8},
        {"ChannelReOpened", 0x0032, ChannelReOpened{token, 0x0102030405060708ULL, DeviceId(0x00008208U), DeviceId(0x40018208U)},
         tokenHex + QStringLiteral("08 07 06 05 04 03 02 01 08 82 00 00 08 82 01 40"), 24},
        {"StandBy", 0x0040, StandBy{token, DeviceId(0x00008208U), DeviceId(0x40018208U), LossCause::LocalStall, 0x0102030405060708ULL},
         tokenHex + QStringLiteral("08 82 00 00 08 82 01 40 05 08 07 06 05 04 03 02 01"), 25},
        {"StandByReport", 0x0041, StandByReport{token, DeviceId(0x60008208U), true, 0x0102030405060708ULL},
         tokenHex + QStringLiteral("08 82 00 60 01 08 07 06 05 04 03 02 01"), 21},
        {"IncidentDismissed", 0x0042, IncidentDismissed{token, DeviceId(0x60008208U), {"gone"}},
         tokenHex + QStringLiteral("08 82 00 60 04 00 67 6f 6e 65"), 8 + 4 + 2 + 256},
        {"LinkReport", 0x0050,
         LinkReport{0x01020304U, 0x1112131415161718ULL, 0x2122232425262728ULL, 0x3132333435363738ULL, 0x4142434445464748ULL,
                    0x5152535455565758ULL, 0x6162636465666768ULL, 0x71727374U},
         QStringLiteral("04 03 02 01  18 17 16 15 14 13 12 11  28 27 26 25 24 23 22 21  38 37 36 35 34 33 32 31  48 47 46 45 44 43 42 41"
                        "58 57 56 55 54 53 52 51  68 67 66 65 64 63 62 61  74 73 72 71"),
         56},
        {"Abandon", 0x0051, Abandon{0x0203, 0x1112131415161718ULL}, QStringLiteral("03 02 18 17 16 15 14 13 12 11"), 10},
    };
}

std::vector<std::byte> goldenBytes(std::uint16_t number)
{
    for (const auto& entry : golden())
        if (entry.number == number)
            return bytesOf(entry.hex.toStdString());
    return {};
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

private slots:
    void standsOnTheWireAsThePageSays();
    void comesBackAsItLeft();
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

void SessionMessagesTest::standsOnTheWireAsThePageSays()
{
    std::set<std::size_t> kinds;
    for (const auto& entry : golden()) {
        kinds.insert(entry.message.index());
        QCOMPARE(numberOf(entry.message), entry.number);
        QCOMPARE(std::string(nameOf(entry.message)), std::string(entry.name));
        const auto bytes = encodeSessionMessage(entry.message);
        QVERIFY2(bytes == bytesOf(entry.hex.toStdString()), (std::string(entry.name) + ": " + hexOf(bytes)).c_str());
    }
    QCOMPARE(kinds.size(), std::variant_size_v<SessionMessage>);
}

void SessionMessagesTest::comesBackAsItLeft()
{
    for (const auto& entry : golden()) {
        const auto decoded = decodeSessionMessage(entry.number, bytesOf(entry.hex.toStdString()));
        QVERIFY2(decoded.has_value(), entry.name);
        QVERIFY2(*decoded == entry.message, entry.name);
    }
}

void SessionMessagesTest::takesNoBodyThatIsTooShortOrTooLong()
{
    for (const auto& entry : golden()) {
        auto bytes = bytesOf(entry.hex.toStdString());
        for (std::size_t length = 0; length < bytes.size(); ++length)
            QVERIFY2(!decodeSessionMessage(entry.number, std::span(bytes).first(length)), entry.name);
        bytes.push_back(std::byte{0});
        QVERIFY2(!decodeSessionMessage(entry.number, bytes), entry.name);
    }
}

void SessionMessagesTest::knowsTheLongestBodies()
{
    for (const auto& entry : golden()) {
        const auto maximum = maximumSessionBody(entry.number);
        QVERIFY2(maximum.has_value(), entry.name);
        QVERIFY2(*maximum == entry.maximum, entry.name);
    }
}

void SessionMessagesTest::knowsNoOtherNumbers()
{
    std::set<int> numbers;
    for (const auto& entry : golden())
        numbers.insert(entry.number);
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
    const MessageSetAnswer answer{hashFrom(1), filled(262144, 0x20)};
    const auto bytes = encodeSessionMessage(answer);
    QCOMPARE(bytes.size(), *maximumSessionBody(MessageSetAnswer::number));
    QVERIFY(decodeSessionMessage(MessageSetAnswer::number, bytes) == SessionMessage(answer));
}

QTEST_APPLESS_MAIN(SessionMessagesTest)
#include "session_messages_test.moc"
