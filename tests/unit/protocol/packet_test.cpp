// The prefix of a UDP packet.
#include "protocol/packet.hpp"

#include "support/hex.hpp"

#include <QTest>

using namespace liena::protocol;
using namespace liena::test;

class PacketTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void writesTokenAndNumberLittleEndian()
    {
        const auto bytes = encodePacketPrefix({0x1122334455667788U, 3});
        QCOMPARE(hexOf(bytes), hexOf(bytesOf("88 77 66 55 44 33 22 11 03 00 00 00 00 00 00 00")));
    }
    void readsWhatItWrites()
    {
        const PacketPrefix prefix{0xFEDCBA9876543210U, 0x0102030405060708U};
        const auto bytes = encodePacketPrefix(prefix);
        const auto read = decodePacketPrefix(bytes);
        QVERIFY(read.has_value());
        QVERIFY(*read == prefix);
    }
    void refusesAPacketShorterThanItsPrefix()
    {
        const auto bytes = encodePacketPrefix({1, 1});
        QVERIFY(!decodePacketPrefix(std::span(bytes).first(15)));
        QVERIFY(!decodePacketPrefix({}));
    }
    void aPacketNeverExceedsWhatAnEthernetFrameCarries() { QVERIFY(maximumPacket + 28 <= 1500); } // UDP and IPv4 headers
};

QTEST_APPLESS_MAIN(PacketTest)
#include "packet_test.moc"
