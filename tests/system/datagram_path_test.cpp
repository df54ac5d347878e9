// Heartbeats and commands by UDP between real devices, and packets of strangers.
#include "test_system.hpp"

#include <QHostAddress>
#include <QNetworkProxy>
#include <QTest>
#include <QUdpSocket>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

LinkStatus linkTo(TestDevice& device, DeviceId peer)
{
    for (const auto& link : device->links())
        if (link.peer == peer)
            return link;
    throw std::logic_error("no such link");
}

Message motion(DistributedSystem& system, DeviceId robot, std::uint32_t sequence)
{
    auto message = system.command(robot, "MotionCommand").value();
    message.set("sequence", sequence).set("engaged", true).set("guidewire_velocity", 2.5);
    return message;
}

} // namespace

class DatagramPathTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void carriesHeartbeatsAndCommands_data()
    {
        QTest::addColumn<QString>("mode");
        QTest::newRow("tls") << "tls";
        QTest::newRow("none") << "none";
    }
    void carriesHeartbeatsAndCommands()
    {
        QFETCH(QString, mode);
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"}, {mode.toStdString()});
        const auto robotId = system.idOf("robot");
        const auto cockpitId = system.idOf("cockpit");
        TestDevice robot(system.settingsOf("robot"));
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(robotId));
        QTRY_VERIFY2(linkTo(cockpit, robotId).packetsHeardByPeer > 0 && linkTo(robot, cockpitId).packetsHeardByPeer > 0,
                     (cockpit.story() + robot.story()).c_str());
        const auto before = linkTo(robot, cockpitId);
        // More packets than heartbeats fit into the window: the others are the commands.
        std::uint32_t sequence = 0;
        const auto morePacketsThanHeartbeats = [&] {
            for (int i = 0; i < 4; ++i)
                if (!cockpit->send(robotId, motion(*cockpit, robotId, ++sequence)))
                    return false;
            return linkTo(robot, cockpitId).packetsHeard > 12;
        };
        QTRY_VERIFY2(morePacketsThanHeartbeats(), (cockpit.story() + robot.story()).c_str());
        QTRY_VERIFY(!robot.messages("MotionCommand").empty());
        const auto received = robot.messages("MotionCommand");
        for (std::size_t i = 1; i < received.size(); ++i)
            QVERIFY(received[i].get<std::uint32_t>("sequence") > received[i - 1].get<std::uint32_t>("sequence"));
        QCOMPARE(linkTo(robot, cockpitId).epoch, before.epoch);
        QVERIFY2(!robot.heard(Kind::Lost), robot.story().c_str());
    }

    void packetsOfStrangersChangeNothing()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        const auto robotId = system.idOf("robot");
        const auto cockpitId = system.idOf("cockpit");
        TestDevice robot(system.settingsOf("robot"));
        TestDevice cockpit(system.settingsOf("cockpit"));
        QVERIFY(cockpit->openChannel(robotId));
        QTRY_VERIFY(linkTo(robot, cockpitId).packetsHeardByPeer > 0);
        const auto beats = linkTo(robot, cockpitId).heartbeatsReceived;
        QUdpSocket stranger;
        stranger.setProxy(QNetworkProxy::NoProxy);
        for (int length = 0; length < 2000; ++length) {
            const QByteArray packet(length, static_cast<char>(length));
            stranger.writeDatagram(packet, QHostAddress::LocalHost, system.portOf("robot"));
        }
        QTRY_VERIFY(linkTo(robot, cockpitId).heartbeatsReceived > beats + 3);
        QCOMPARE(words(robot.state(cockpitId)), words(SessionState::Open));
        QVERIFY2(robot.events(Kind::MessagesDropped).empty(), robot.story().c_str()); // with no token of ours they concern nobody
    }

    void saysWhoHasThePort()
    {
        TestSystem system({reference::cockpit, reference::robot}, {"cockpit robot"});
        QUdpSocket other;
        other.setProxy(QNetworkProxy::NoProxy);
        QVERIFY(other.bind(QHostAddress::LocalHost, system.portOf("robot"), QAbstractSocket::DontShareAddress));
        const auto made = DistributedSystem::create(system.settingsOf("robot"));
        QVERIFY(!made);
        QVERIFY2(made.error().what.find("cannot bind UDP 127.0.0.1:" + std::to_string(system.portOf("robot"))) != std::string::npos,
                 made.error().what.c_str());
        QVERIFY(made.error().what.find("another program has this port") != std::string::npos);
    }
};

QTEST_GUILESS_MAIN(DatagramPathTest)
#include "datagram_path_test.moc"
