// CRC-32C against published values, and the 16 bytes before every control message.
#include "protocol/crc32c.hpp"
#include "protocol/safety_record.hpp"
#include "support/hex.hpp"

#include <QTest>

using namespace liena;
using namespace liena::protocol;
using namespace liena::test;

namespace {

std::vector<std::byte> ascending(unsigned count)
{
    std::vector<std::byte> bytes;
    for (unsigned i = 0; i < count; ++i)
        bytes.push_back(static_cast<std::byte>(i));
    return bytes;
}

/// Bit by bit, from the definition of the polynomial: the reference for the table or the instruction in use.
std::uint32_t slowCrc(std::span<const std::byte> bytes)
{
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const auto byte : bytes) {
        crc ^= static_cast<std::uint32_t>(byte);
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 1U) != 0 ? crc >> 1U ^ 0x82F63B78U : crc >> 1U;
    }
    return ~crc;
}

const DatagramHeader header{{DeviceId(0x40018208U), 0x0101}, DeviceId(0x00008208U), Timestamp{0x1122334455667788ULL}, 20, false};
const SafetyRecord record{0x01020304U, 0x11121314U, 0x21222324U, 0x31323334U};

} // namespace

Q_DECLARE_METATYPE(std::vector<std::byte>)

class SafetyRecordTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void givesPublishedValues_data();
    void givesPublishedValues();
    void agreesWithTheBitwiseDefinition();
    void continuesOverPieces();
    void standsOnTheWireAsThePageSays();
    void coversHeaderRecordAndFields();
    void takesTheLengthAsForOneSegment();
    void anyFlippedBitShows();
};

void SafetyRecordTest::givesPublishedValues_data()
{
    QTest::addColumn<std::vector<std::byte>>("bytes");
    QTest::addColumn<quint32>("crc");
    QTest::newRow("nothing") << std::vector<std::byte>() << 0x00000000U;
    QTest::newRow("32 zeros") << filled(32, 0x00) << 0x8A9136AAU;
    QTest::newRow("32 ones") << filled(32, 0xFF) << 0x62A8AB43U;
    QTest::newRow("ascending") << ascending(32) << 0x46DD794EU;
    QTest::newRow("123456789") << bytesOfText("123456789") << 0xE3069283U;
}

void SafetyRecordTest::givesPublishedValues()
{
    QFETCH(std::vector<std::byte>, bytes);
    QFETCH(quint32, crc);
    QCOMPARE(crc32c(bytes), crc);
}

void SafetyRecordTest::agreesWithTheBitwiseDefinition()
{
    const auto bytes = ascending(300);
    for (std::size_t length = 0; length <= bytes.size(); ++length) {
        QCOMPARE(crc32c(std::span(bytes).first(length)), slowCrc(std::span(bytes).first(length)));
        QCOMPARE(crc32cByTables(std::span(bytes).first(length)), slowCrc(std::span(bytes).first(length)));
    }
}

void SafetyRecordTest::continuesOverPieces()
{
    const auto bytes = ascending(100);
    for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
        QCOMPARE(crc32c(std::span(bytes).subspan(cut), crc32c(std::span(bytes).first(cut))), slowCrc(bytes));
        QCOMPARE(crc32cByTables(std::span(bytes).subspan(cut), crc32c(std::span(bytes).first(cut))), slowCrc(bytes));
    }
}

void SafetyRecordTest::standsOnTheWireAsThePageSays()
{
    QCOMPARE(QString::fromStdString(hexOf(encodeSafetyRecord(record))), QStringLiteral("04 03 02 01 14 13 12 11 24 23 22 21 34 33 32 31"));
    QVERIFY(decodeSafetyRecord(encodeSafetyRecord(record)) == record);
}

void SafetyRecordTest::coversHeaderRecordAndFields()
{
    // 20 header bytes with DLC 16 + 4, the record's first 12 bytes, the fields.
    const auto covered = bytesOf("01 01 08 82 01 40  08 82 00 00  88 77 66 55 44 33 22 11  14 00"
                                 "04 03 02 01  14 13 12 11  24 23 22 21   aa bb cc dd");
    QCOMPARE(safetyCrc(header, record, bytesOf("aa bb cc dd")), slowCrc(covered));
}

void SafetyRecordTest::takesTheLengthAsForOneSegment()
{
    auto asSent = header;
    asSent.length = 7;
    asSent.moreSegments = true;
    const auto fields = bytesOf("aa bb cc dd");
    QCOMPARE(safetyCrc(asSent, record, fields), safetyCrc(header, record, fields));
}

void SafetyRecordTest::anyFlippedBitShows()
{
    const auto fields = bytesOf("00 11 22 33");
    const auto crc = safetyCrc(header, record, fields);
    for (std::size_t bit = 0; bit < 8 * 18; ++bit) {
        auto bytes = encodeHeader(header);
        bytes[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
        QVERIFY(safetyCrc(decodeHeader(bytes), record, fields) != crc);
    }
    for (std::size_t bit = 0; bit < 8 * 12; ++bit) {
        auto bytes = encodeSafetyRecord(record);
        bytes[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
        QVERIFY(safetyCrc(header, decodeSafetyRecord(bytes), fields) != crc);
    }
    for (std::size_t bit = 0; bit < 8 * fields.size(); ++bit) {
        auto changed = fields;
        changed[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
        QVERIFY(safetyCrc(header, record, changed) != crc);
    }
    auto signedOver = record;
    signedOver.crc = ~record.crc;
    QCOMPARE(safetyCrc(header, signedOver, fields), crc);
}

QTEST_APPLESS_MAIN(SafetyRecordTest)
#include "safety_record_test.moc"
