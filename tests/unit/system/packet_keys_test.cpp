// Packets while lanes 0 are made anew, each with a key of its own: which of them open, and for how long.
#include "system/datagram_path.hpp"

#include <QTest>

#include <boost/asio.hpp>

using namespace liena;
using namespace liena::system;
using namespace std::chrono_literals;

namespace {

constexpr std::uint64_t token = 7;
const session::Instant start{1h};

DatagramPath::Key key(int number)
{
    security::DatagramKey made;
    made.key.fill(static_cast<std::byte>(number));
    made.iv.fill(static_cast<std::byte>(0x40 + number));
    return made;
}

/// Two ends of a session; what one of them sends comes to the other when the test asks for it.
class Line {
public:
    Line()
        : m_socket(
              m_io, [](std::span<std::byte>) {}, LogSink()),
          m_there(m_io, boost::asio::ip::udp::endpoint(boost::asio::ip::address_v4::loopback(), 0)),
          sender(m_socket, m_there.local_endpoint().port(), true),
          receiver(m_socket, 1, true)
    {
        if (!m_socket.listen(host, 0, 0))
            throw std::runtime_error("no UDP socket");
    }

    void sendingBy(int number, session::Instant now) { sender.outgoingUp(token, key(number), host, now); }
    void openingBy(int number, session::Instant now) { receiver.incomingUp(token, key(number), now); }

    std::vector<std::byte> packet(session::Instant now)
    {
        protocol::EncodedMessage message;
        message.part.resize(32);
        if (!sender.send(message, now))
            return {};
        std::vector<std::byte> packet(protocol::maximumPacket);
        packet.resize(m_there.receive(boost::asio::buffer(packet)));
        return packet;
    }

    std::optional<DatagramPath::Fault> open(std::vector<std::byte> packet, session::Instant now)
    {
        return receiver.open(packet, now).fault;
    }

private:
    const boost::asio::ip::address host = boost::asio::ip::address_v4::loopback();
    boost::asio::io_context m_io;
    transport::UdpSocket m_socket;
    boost::asio::ip::udp::socket m_there;

public:
    DatagramPath sender;
    DatagramPath receiver;
};

} // namespace

class PacketKeysTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void everyRecentKeyOpens_data()
    {
        QTest::addColumn<int>("newer");
        QTest::addColumn<bool>("opens");
        for (int newer = 0; newer <= 4; ++newer)
            QTest::addRow("%d newer", newer) << newer << true;
        QTest::newRow("5 newer") << 5 << false;
    }

    /// A peer whose lane 0 is cut again and again still seals with the key of the first.
    void everyRecentKeyOpens()
    {
        QFETCH(int, newer);
        QFETCH(bool, opens);
        Line line;
        line.sendingBy(0, start);
        line.openingBy(0, start);
        const auto packet = line.packet(start);
        QVERIFY(!packet.empty());
        for (int number = 1; number <= newer; ++number)
            line.openingBy(number, start + number * 40ms);
        QCOMPARE(line.open(packet, start + 300ms), opens ? std::nullopt : std::optional(DatagramPath::Fault::NotGenuine));
    }

    void anOldKeyOpensForASecond()
    {
        for (const auto& [later, opens] : {std::pair(999ms, true), std::pair(1000ms, false)}) {
            Line line;
            line.sendingBy(0, start);
            line.openingBy(0, start);
            const auto packet = line.packet(start);
            line.openingBy(1, start);
            QCOMPARE(!line.open(packet, start + later), opens);
        }
    }

    /// A packet is faster than the Attach of the lane whose key it would have.
    void theNewKeySealsAfterAWhile()
    {
        Line line;
        line.sendingBy(0, start);
        line.openingBy(0, start);
        line.sendingBy(1, start);
        QVERIFY(!line.open(line.packet(start + 199ms), start + 199ms));
        const auto packet = line.packet(start + 200ms);
        QCOMPARE(line.open(packet, start + 200ms), std::optional(DatagramPath::Fault::NotGenuine));
        line.openingBy(1, start + 200ms);
        QVERIFY(!line.open(packet, start + 200ms));
    }

    void eachNumberCountsOnce()
    {
        Line line;
        line.sendingBy(0, start);
        line.openingBy(0, start);
        const auto packet = line.packet(start);
        QVERIFY(!line.open(packet, start));
        QCOMPARE(line.open(packet, start), std::optional(DatagramPath::Fault::NotNew));
    }

    /// What is refused must not be able to use a number up.
    void aForgedPacketTakesNoNumber()
    {
        Line line;
        line.sendingBy(0, start);
        line.openingBy(0, start);
        const auto packet = line.packet(start);
        auto forged = packet;
        forged.back() ^= std::byte{1};
        QCOMPARE(line.open(forged, start), std::optional(DatagramPath::Fault::NotGenuine));
        QVERIFY(!line.open(packet, start));
    }

    void theNextSessionKnowsNoneOfTheseKeys()
    {
        Line line;
        line.sendingBy(0, start);
        line.openingBy(0, start);
        const auto packet = line.packet(start);
        line.receiver.end();
        QCOMPARE(line.open(packet, start), std::optional(DatagramPath::Fault::NotGenuine));
        line.openingBy(1, start);
        QCOMPARE(line.open(packet, start), std::optional(DatagramPath::Fault::NotGenuine));
    }
};

QTEST_APPLESS_MAIN(PacketKeysTest)
#include "packet_keys_test.moc"
