// A peer written from PROTOCOL.md alone holds honest sessions with a device: what the page says is what the library does.
#include "hostile_stage.hpp"

#include <QTest>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;
namespace number = wire::number;

class ScriptedPeerTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void reproducesTheExamplesOfThePage()
    {
        const std::string digits = "123456789";
        QCOMPARE(wire::crc32c({reinterpret_cast<const std::uint8_t*>(digits.data()), digits.size()}), 0xE3069283U);
        const wire::Header motion{.number = 0x0101, .origin = 0x40018208U, .target = 0x00008208U, .timestamp = 0x18867251F19CC940U};
        const auto body = wire::guarded(motion, 1, 1, 3, motionFields(7, 1, 2.5F));
        QCOMPARE(wire::Reader(wire::ByteSpan(body).subspan(12)).u32(), 0xFA0CA48AU);
        QCOMPARE(wire::datagram(motion, body).size(), std::size_t{20 + 41});
    }

    void opensCommandsAndCloses()
    {
        HostileStage stage;
        stage.peer.open();
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Opened, stage.xrayId); }), stage.robot.story().c_str());
        QVERIFY(stage.peer.command(0x0101, motionFields(7, 1, 2.5F)));
        QVERIFY2(eventually([&] { return !stage.motions().empty(); }), stage.robot.story().c_str());
        QCOMPARE(stage.motions()[0].get<float>("guidewire_velocity"), 2.5F);
        QVERIFY(eventually([&] { return stage.peer.packetsHeard() > 0; }));
        QVERIFY(eventually([&] { return stage.linkOf(stage.xrayId).packetsHeard > 0; }));
        stage.peer.close();
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Closed, stage.xrayId); }), stage.robot.story().c_str());
        QVERIFY(stage.robot->incidents().empty());
        QVERIFY2(stage.robot.events(Kind::MessagesDropped).empty(), stage.robot.story().c_str());
        QVERIFY2(stage.honestSessionUntouched(), stage.story().c_str());
    }

    void commandsByUdp()
    {
        HostileStage stage;
        stage.peer.open();
        const auto guard = stage.peer.guard(0x0101);
        stage.peer.sendPacket(stage.peer.packet(stage.peer.control(0x0101, motionFields(7, 9, 1.5F), guard)));
        QVERIFY2(eventually([&] { return !stage.motions().empty(); }), stage.robot.story().c_str());
        QCOMPARE(stage.motions()[0].get<std::uint32_t>("sequence"), 9U);
    }

    void isOpenedByADevice()
    {
        HostileStage stage;
        QVERIFY(stage.robot->openChannel(stage.xrayId));
        stage.peer.awaitOpen();
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Opened, stage.xrayId); }), stage.robot.story().c_str());
        QVERIFY(stage.peer.command(0x0101, motionFields(7, 1, 2.5F)));
        QVERIFY2(eventually([&] { return !stage.motions().empty(); }), stage.robot.story().c_str());
    }

    void reOpensAfterALoss()
    {
        HostileStage stage;
        stage.peer.open();
        QVERIFY(stage.peer.say(number::channelOpened, wire::tokenOnly(stage.peer.token()))); // not when the session is open
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Lost, stage.xrayId); }), stage.story().c_str());
        stage.peer.open(true);
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::ReOpened, stage.xrayId); }), stage.story().c_str());
        QVERIFY(eventually([&] { return stage.robot->incidents().empty(); }));
        QVERIFY2(stage.honestSessionUntouched(), stage.story().c_str());
    }
};

QTEST_GUILESS_MAIN(ScriptedPeerTest)
#include "scripted_peer_test.moc"
