// The examples of liena/PROTOCOL.md are what the library writes.
#include "liena/message.hpp"
#include "protocol/datagram.hpp"
#include "protocol/information_part.hpp"
#include "protocol/safety_record.hpp"
#include "protocol/session_messages.hpp"

#include <QFile>
#include <QTest>

using namespace liena;
using namespace liena::protocol;

class ProtocolExamplesTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void showsTheAttachAsItIsWritten();
    void showsTheHeartbeatAsItIsWritten();
    void showsTheMotionCommandAsItIsWritten();

private:
    void isShown(DatagramHeader header, std::span<const std::byte> part) const;

    QByteArray m_page; ///< without white space
};

namespace {

constexpr DeviceId cockpit(0x40018208);
constexpr DeviceId robot(0x00008208);
constexpr std::uint64_t newYear = 1767225600000000000; // 2026-01-01 00:00 UTC

DatagramHeader headerOf(std::uint16_t number, DeviceId origin, DeviceId target, std::uint64_t sinceNewYear)
{
    DatagramHeader header;
    header.message = {origin, number};
    header.target = target;
    header.timestamp = {newYear + sinceNewYear};
    return header;
}

} // namespace

void ProtocolExamplesTest::initTestCase()
{
    QFile page(QStringLiteral(LIENA_SOURCE_DIR "/liena/PROTOCOL.md"));
    QVERIFY2(page.open(QIODevice::ReadOnly), "liena/PROTOCOL.md cannot be read");
    m_page = page.readAll().replace('\n', "").replace(' ', "");
}

void ProtocolExamplesTest::isShown(DatagramHeader header, std::span<const std::byte> part) const
{
    header.length = static_cast<std::uint16_t>(part.size());
    const auto bytes = encodeHeader(header);
    QByteArray datagram(reinterpret_cast<const char*>(bytes.data()), static_cast<qsizetype>(bytes.size()));
    datagram.append(reinterpret_cast<const char*>(part.data()), static_cast<qsizetype>(part.size()));
    QVERIFY2(m_page.contains(datagram.toHex()), datagram.toHex(' ').constData());
}

void ProtocolExamplesTest::showsTheAttachAsItIsWritten()
{
    isShown(headerOf(Attach::number, cockpit, robot, 0), encodeSessionMessage(Attach{1, 0x1122334455667788, 0}));
}

void ProtocolExamplesTest::showsTheHeartbeatAsItIsWritten()
{
    Heartbeat heartbeat;
    heartbeat.sequence = 3;
    heartbeat.sentNs = newYear + 60'000'000;
    heartbeat.echoSequence = 2;
    heartbeat.echoSentNs = newYear + 39'000'000;
    heartbeat.echoReceivedNs = newYear + 39'400'000;
    heartbeat.state = SessionState::Open;
    heartbeat.epoch = 1;
    isShown(headerOf(Heartbeat::number, robot, cockpit, 60'000'000), encodeSessionMessage(heartbeat));
}

void ProtocolExamplesTest::showsTheMotionCommandAsItIsWritten()
{
    const auto set = MessageSet::load(LIENA_SOURCE_DIR "/resources/devices/vascular-robot.xml");
    QVERIFY(set);
    const auto* definition = set.value()->find("MotionCommand");
    QVERIFY(definition != nullptr);
    Message message(set.value(), *definition);
    message.set("permit", 7U).set("sequence", 1U).set("engaged", true).set("guidewire_velocity", 2.5);
    const auto fields = message.fieldBytes();
    QVERIFY(!checkFields(*definition, fields));
    const auto header = headerOf(definition->number, cockpit, robot, 61'000'000);
    SafetyRecord record{1, 1, 3, 0};
    record.crc = safetyCrc(header, record, fields);
    const auto guard = encodeSafetyRecord(record);
    std::vector<std::byte> part(guard.begin(), guard.end());
    part.insert(part.end(), fields.begin(), fields.end());
    isShown(header, part);
}

QTEST_GUILESS_MAIN(ProtocolExamplesTest)
#include "protocol_examples_test.moc"
