// Device ids, message ids and stamps.
#include "liena/device_id.hpp"
#include "liena/message_id.hpp"
#include "liena/timestamp.hpp"

#include <QTest>

#include <unordered_set>

using namespace liena;

class IdentifiersTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void takesReferenceIdsApart_data();
    void takesReferenceIdsApart();
    void cutsHigherBitsWhenComposing();
    void keepsEveryBitInItsOwnField();
    void readsOnlyWholeIds_data();
    void readsOnlyWholeIds();
    void knowsWhichIdsADeviceMayHave_data();
    void knowsWhichIdsADeviceMayHave();
    void namesTheBroadcast();
    void namesClasses();
    void namesMessages();
    void sortsMessageNumbersIntoRanges_data();
    void sortsMessageNumbersIntoRanges();
    void stampsFollowTheClock();
    void stampsRiseWhateverTheClockDoes();
};

void IdentifiersTest::takesReferenceIdsApart_data()
{
    QTest::addColumn<quint32>("value");
    QTest::addColumn<int>("deviceClass");
    QTest::addColumn<int>("manufacturer");
    QTest::addColumn<QString>("text");
    QTest::newRow("cockpit") << 0x40018208U << 2 << 3 << QStringLiteral("0x40018208");
    QTest::newRow("robot") << 0x00008208U << 0 << 1 << QStringLiteral("0x00008208");
    QTest::newRow("arm") << 0x60008208U << 3 << 1 << QStringLiteral("0x60008208");
    QTest::newRow("xray") << 0x20010208U << 1 << 2 << QStringLiteral("0x20010208");
}

void IdentifiersTest::takesReferenceIdsApart()
{
    QFETCH(quint32, value);
    QFETCH(int, deviceClass);
    QFETCH(int, manufacturer);
    QFETCH(QString, text);
    const DeviceId id(value);
    QCOMPARE(int(id.classNumber()), deviceClass);
    QCOMPARE(int(id.manufacturer()), manufacturer);
    QCOMPARE(int(id.type()), 1);
    QCOMPARE(int(id.version()), 1);
    QCOMPARE(int(id.index()), 0);
    QCOMPARE(QString::fromStdString(id.toString()), text);
    QVERIFY(DeviceId::compose(static_cast<DeviceClass>(deviceClass), static_cast<std::uint32_t>(manufacturer), 1, 1, 0) == id);
    QVERIFY(DeviceId::fromString(id.toString()) == id);
}

void IdentifiersTest::cutsHigherBitsWhenComposing()
{
    const auto id = DeviceId::compose(DeviceClass::Hand, 0x4000U, 0x40U, 0x40U, 8U);
    QCOMPARE(id.value(), 0U);
    QCOMPARE(DeviceId::compose(DeviceClass::Special, 0x3FFFU, 0x3FU, 0x3FU, 7U).value(), 0xFFFFFFFFU);
}

void IdentifiersTest::keepsEveryBitInItsOwnField()
{
    for (unsigned bit = 0; bit < 32; ++bit) {
        const DeviceId id(1U << bit);
        const int set = (id.classNumber() != 0) + (id.manufacturer() != 0) + (id.type() != 0) + (id.version() != 0) + (id.index() != 0);
        QCOMPARE(set, 1);
        QCOMPARE(id.index() != 0, bit <= 2);
        QCOMPARE(id.version() != 0, bit >= 3 && bit <= 8);
        QCOMPARE(id.type() != 0, bit >= 9 && bit <= 14);
        QCOMPARE(id.manufacturer() != 0, bit >= 15 && bit <= 28);
        QCOMPARE(id.deviceType().value(), bit <= 2 ? 0U : id.value());
    }
}

void IdentifiersTest::readsOnlyWholeIds_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<bool>("isId");
    QTest::newRow("an id") << QStringLiteral("0x40018208") << true;
    QTest::newRow("upper-case digits") << QStringLiteral("0xFFFFFFFF") << true;
    for (const char* wrong : {"", "0x", "40018208", "0x4001820", "0x400182080", "0x4001820g", " 0x40018208", "0x40018208 ", "0X40018208",
                              "0x+4001820", "-x40018208", "0x4001 208"})
        QTest::newRow(wrong) << QString::fromLatin1(wrong) << false;
}

void IdentifiersTest::readsOnlyWholeIds()
{
    QFETCH(QString, text);
    QFETCH(bool, isId);
    QCOMPARE(DeviceId::fromString(text.toStdString()).has_value(), isId);
}

void IdentifiersTest::knowsWhichIdsADeviceMayHave_data()
{
    QTest::addColumn<int>("deviceClass");
    QTest::addColumn<int>("index");
    QTest::addColumn<bool>("valid");
    for (int deviceClass = 0; deviceClass < 8; ++deviceClass)
        for (int index = 0; index < 8; ++index)
            QTest::addRow("class %d index %d", deviceClass, index)
                << deviceClass << index << ((deviceClass <= 3 || deviceClass == 7) && index != 7);
}

void IdentifiersTest::knowsWhichIdsADeviceMayHave()
{
    QFETCH(int, deviceClass);
    QFETCH(int, index);
    QFETCH(bool, valid);
    const DeviceId id(static_cast<std::uint32_t>(deviceClass) << 29U | 0x00018208U | static_cast<std::uint32_t>(index));
    QCOMPARE(id.isValidDevice(), valid);
}

void IdentifiersTest::namesTheBroadcast()
{
    QCOMPARE(DeviceId::broadcast().value(), 0xFFFFFFFFU);
    QVERIFY(DeviceId::broadcast().isBroadcast());
    QVERIFY(!DeviceId::broadcast().isValidDevice());
    QVERIFY(!DeviceId(0xFFFFFFFEU).isBroadcast());
}

void IdentifiersTest::namesClasses()
{
    for (const auto deviceClass : {DeviceClass::Hand, DeviceClass::Eye, DeviceClass::Brain, DeviceClass::Arm, DeviceClass::Special})
        QVERIFY(deviceClassFrom(toString(deviceClass)) == deviceClass);
    QVERIFY(!deviceClassFrom("Hand"));
    QVERIFY(!deviceClassFrom("foot"));
    QVERIFY(!deviceClassFrom(""));
}

void IdentifiersTest::namesMessages()
{
    const MessageId id{DeviceId(0x40018208U), 0x0101};
    QCOMPARE(id.toString(), std::string("0x40018208/0x0101"));
    const std::unordered_set<MessageId> set{id, {DeviceId(0x40018208U), 0x0102}, {DeviceId(0x00008208U), 0x0101}, id};
    QCOMPARE(set.size(), std::size_t{3});
}

void IdentifiersTest::sortsMessageNumbersIntoRanges_data()
{
    QTest::addColumn<int>("number");
    QTest::addColumn<QString>("range");
    QTest::newRow("0x0000") << 0x0000 << QStringLiteral("reserved");
    QTest::newRow("0x0001") << 0x0001 << QStringLiteral("session");
    QTest::newRow("0x00FF") << 0x00FF << QStringLiteral("session");
    QTest::newRow("0x0100") << 0x0100 << QStringLiteral("command");
    QTest::newRow("0x01FF") << 0x01FF << QStringLiteral("command");
    QTest::newRow("0x0200") << 0x0200 << QStringLiteral("report");
    QTest::newRow("0x0FFF") << 0x0FFF << QStringLiteral("report");
    QTest::newRow("0x1000") << 0x1000 << QStringLiteral("reserved");
    QTest::newRow("0xFFFF") << 0xFFFF << QStringLiteral("reserved");
}

void IdentifiersTest::sortsMessageNumbersIntoRanges()
{
    QFETCH(int, number);
    QFETCH(QString, range);
    const MessageId id{DeviceId(1), static_cast<std::uint16_t>(number)};
    QCOMPARE(id.isSessionManagement(), range == QStringLiteral("session"));
    QCOMPARE(id.isCommand(), range == QStringLiteral("command"));
    QCOMPARE(id.isReport(), range == QStringLiteral("report"));
}

void IdentifiersTest::stampsFollowTheClock()
{
    TimestampSource source;
    QCOMPARE(source.next({100}).ns, 100ULL);
    QCOMPARE(source.next({250}).ns, 250ULL);
}

void IdentifiersTest::stampsRiseWhateverTheClockDoes()
{
    TimestampSource source;
    QCOMPARE(source.next({100}).ns, 100ULL);
    QCOMPARE(source.next({100}).ns, 101ULL);
    QCOMPARE(source.next({101}).ns, 102ULL);
    QCOMPARE(source.next({40}).ns, 103ULL);
    QCOMPARE(source.next({0}).ns, 104ULL);
    QCOMPARE(source.next({104}).ns, 105ULL);
    QCOMPARE(source.next({200}).ns, 200ULL);
}

QTEST_APPLESS_MAIN(IdentifiersTest)
#include "identifiers_test.moc"
