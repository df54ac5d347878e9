// Datagrams by UDP that were recorded, forged, changed or taken from elsewhere: none of them commands anything.
#include "hostile_stage.hpp"

#include <QTest>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;
using wire::Bytes;
using wire::Words;
namespace number = wire::number;

namespace {

constexpr std::uint16_t motion = 0x0101;

Bytes command(ScriptedPeer& peer, std::uint32_t sequence) { return peer.control(motion, motionFields(1, sequence, 1), peer.guard(motion)); }

/// How often the robot's application was told of a cause.
std::size_t told(HostileStage& stage, const std::string& cause)
{
    const auto events = stage.robot.events(Kind::MessagesDropped, stage.xrayId);
    return static_cast<std::size_t>(std::count_if(
        events.begin(), events.end(), [&](const SessionEvent& event) { return event.detail.find(cause) != std::string::npos; }));
}

struct Wrong {
    const char* name;
    std::function<Bytes(HostileStage&)> datagram; ///< to be sealed as it should be
    std::string told;
};

Bytes withHeader(HostileStage& s, std::uint16_t number, const Bytes& body, const std::function<void(wire::Header&)>& change)
{
    auto head = s.peer.header(number);
    head.length = static_cast<std::uint16_t>(body.size());
    change(head);
    return Words().raw(wire::encoded(head)).raw(body);
}

std::vector<Wrong> drops()
{
    return {
        {"target of another device",
         [](HostileStage& s) { return withHeader(s, motion, Bytes(41), [&](wire::Header& h) { h.target = s.armId.value(); }); },
         "target is another device"},
        {"more to come", [](HostileStage& s) { return withHeader(s, motion, Bytes(41), [](wire::Header& h) { h.more = true; }); },
         "does not fill its UDP packet"},
        {"length too small", [](HostileStage& s) { return withHeader(s, motion, Bytes(41), [](wire::Header& h) { h.length = 40; }); },
         "does not fill its UDP packet"},
        {"length too great", [](HostileStage& s) { return withHeader(s, motion, Bytes(40), [](wire::Header& h) { h.length = 41; }); },
         "does not fill its UDP packet"},
        {"half a header", [](HostileStage&) { return Bytes(19); }, "without a whole header"},
        {"no datagram at all", [](HostileStage&) { return Bytes(); }, "without a whole header"},
        {"Disengagement", [](HostileStage& s) { return s.peer.said(number::disengagement, Words().u64(s.peer.token()).text("")); },
         "does not travel by UDP"},
        {"Rejected", [](HostileStage& s) { return s.peer.said(number::rejected, wire::rejected(s.peer.token(), 8, "")); },
         "does not travel by UDP"},
        {"StandBy to everybody",
         [](HostileStage& s) {
             return withHeader(s, number::standBy, wire::standBy(7, s.xrayId.value(), s.armId.value(), 1, 1, s.xrayId.value()),
                               [](wire::Header& h) { h.target = wire::everyone; });
         },
         "does not travel by UDP"},
        {"a message that has no path by UDP", [](HostileStage& s) { return s.peer.said(0x0104, Words().u64(1).text("").text("")); },
         "does not travel by UDP"},
        {"an undefined number", [](HostileStage& s) { return s.peer.said(0x0FFE, Bytes(4)); }, "unknown message number"},
        {"a reserved number", [](HostileStage& s) { return s.peer.said(0xFFFF, Bytes(4)); }, "reserved"},
        {"a command to everybody",
         [](HostileStage& s) { return withHeader(s, motion, Bytes(41), [](wire::Header& h) { h.target = wire::everyone; }); }, "broadcast"},
        {"a wrong check sum", [](HostileStage& s) { return s.peer.said(motion, Bytes(41)); }, "check sum"},
    };
}

} // namespace

class HostilePacketsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aReplayIsDroppedCountedAndToldOnce()
    {
        HostileStage stage;
        stage.openPeer();
        QVERIFY2(eventually([&] { return stage.linkOf(stage.xrayId).packetsHeard > 0; }), stage.story().c_str());
        const auto first = stage.peer.packet(command(stage.peer, 1));
        stage.peer.sendPacket(first);
        const auto beats = stage.peer.lastPacket() + 4;
        QVERIFY2(eventually([&] { return stage.motions().size() == 1 && stage.peer.lastPacket() >= beats; }), stage.story().c_str());
        stage.peer.habits.datagrams = false;
        auto recorded = stage.peer.sentPackets();
        recorded.erase(recorded.begin(), std::find(recorded.begin(), recorded.end(), first)); // all of these were heard
        QVERIFY(recorded.size() > 3);
        std::size_t replayed = 0;
        for (int round = 0; round < 5; ++round) {
            for (const auto& packet : recorded)
                stage.peer.sendPacket(packet);
            replayed += recorded.size();
            QVERIFY2(eventually([&] { return stage.dropped() >= replayed; }), std::to_string(stage.dropped()).c_str());
        }
        QCOMPARE(stage.dropped(), replayed);
        QCOMPARE(told(stage, "old number"), std::size_t{1});
        QCOMPARE(stage.motions().size(), std::size_t{1});
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void takesEachNumberOnceWithinItsWindow()
    {
        HostileStage stage;
        stage.peer.habits.datagrams = false; // their numbers would soon be far behind
        stage.openPeer();
        std::uint32_t sequence = 0;
        const auto taken = [&](std::uint64_t packet) {
            const auto before = stage.motions().size();
            const auto drops = stage.dropped();
            stage.peer.sendPacket(stage.peer.packetNumbered(packet, command(stage.peer, ++sequence)));
            if (!eventually([&] { return stage.motions().size() > before || stage.dropped() > drops; }))
                return QByteArray("lost");
            return stage.motions().size() > before ? QByteArray("taken") : QByteArray("dropped");
        };
        QCOMPARE(taken(0), QByteArray("dropped"));
        QCOMPARE(taken(5000), QByteArray("taken"));
        QCOMPARE(taken(5000), QByteArray("dropped"));
        QCOMPARE(taken(5000 - 1024), QByteArray("taken"));
        QCOMPARE(taken(5000 - 1025), QByteArray("dropped"));
        QCOMPARE(taken(4999), QByteArray("taken"));
        QCOMPARE(taken(1), QByteArray("dropped"));
        QCOMPARE(taken(5001), QByteArray("taken"));
        QCOMPARE(told(stage, "old number"), std::size_t{1});
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    /// Also not to the window: a forged number far ahead must not make the genuine ones old.
    void aChangedByteMakesAPacketWorthNothing()
    {
        HostileStage stage;
        stage.peer.habits.datagrams = false;
        stage.openPeer();
        const auto genuine = stage.peer.packet(command(stage.peer, 1));
        std::size_t sent = 0;
        for (std::size_t at = 8; at < genuine.size(); ++at) { // before that is the token: a packet for nobody
            auto changed = genuine;
            changed[at] ^= static_cast<std::uint8_t>(1U << (at % 8));
            stage.peer.sendPacket(changed);
            ++sent;
        }
        QVERIFY2(eventually([&] { return stage.dropped() >= sent; }), std::to_string(stage.dropped()).c_str());
        QCOMPARE(told(stage, "has not sealed"), std::size_t{1});
        QVERIFY(stage.motions().empty());
        stage.peer.sendPacket(genuine);
        QVERIFY2(eventually([&] { return stage.motions().size() == 1; }), stage.story().c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void garbageUnderTheRightTokenIsDropped()
    {
        HostileStage stage;
        stage.openPeer();
        const auto before = stage.dropped();
        std::size_t sent = 0;
        for (std::size_t length = 0; length < 1300; length += 7) {
            Bytes packet = Words().u64(stage.peer.token()).u64(stage.peer.lastPacket() + 1000 + length);
            packet.resize(16 + length, static_cast<std::uint8_t>(length));
            stage.peer.sendPacket(packet);
            if (++sent % 20 == 0)
                QVERIFY2(eventually([&] { return stage.dropped() >= before + sent - 5; }), std::to_string(stage.dropped()).c_str());
        }
        for (std::size_t length = 0; length < 16; ++length) // less than its own prefix
            stage.peer.sendPacket(Bytes(length, 0xFF));
        QCOMPARE(told(stage, "has not sealed"), std::size_t{1});
        QCOMPARE(words(stage.robot.state(stage.xrayId)), words(SessionState::Open));
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void packetsOfAnotherSessionAreNotTaken()
    {
        HostileStage stage;
        ScriptedPeer other(roleOf(stage.system, "arm", "robot"));
        other.open();
        stage.openPeer();
        const auto theirs = other.packet(command(other, 1));
        auto renamed = theirs;
        const Bytes ours = Words().u64(stage.peer.token());
        std::copy(ours.begin(), ours.end(), renamed.begin());
        stage.peer.sendPacket(renamed);
        QVERIFY2(eventually([&] { return stage.dropped() == 1; }), stage.story().c_str());
        QVERIFY(stage.motions().empty());
        // Before the loss, and again after the re-opening under another token.
        const auto recorded = stage.peer.packet(command(stage.peer, 1));
        stage.peer.send(stage.peer.attach(stage.peer.token())); // a violation
        QVERIFY2(eventually([&] { return stage.robot.state(stage.xrayId) == SessionState::StandBy; }), stage.story().c_str());
        stage.peer.sendPacket(recorded);
        stage.openPeer();
        stage.peer.sendPacket(recorded);
        auto moved = recorded;
        const Bytes now = Words().u64(stage.peer.token());
        std::copy(now.begin(), now.end(), moved.begin());
        const auto before = stage.dropped();
        stage.peer.sendPacket(moved);
        QVERIFY2(eventually([&] { return stage.dropped() > before; }), stage.story().c_str());
        QVERIFY(stage.motions().empty());
        other.sendPacket(theirs); // which was genuine all the time
        QVERIFY2(eventually([&] { return stage.motions().size() == 1; }), stage.story().c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void genuinePacketsThatDoNotBelongHereAreDropped()
    {
        HostileStage stage;
        stage.openPeer();
        for (const auto& wrong : drops()) {
            const auto before = stage.dropped();
            stage.peer.sendPacket(stage.peer.packet(wrong.datagram(stage)));
            QVERIFY2(eventually([&] { return stage.dropped() > before; }), wrong.name);
            QVERIFY2(stage.toldOf(wrong.told), (wrong.name + ("\n" + stage.story())).c_str());
        }
        QCOMPARE(words(stage.robot.state(stage.xrayId)), words(SessionState::Open));
        QVERIFY(stage.robot->incidents().empty());
        QVERIFY(stage.motions().empty());
        stage.peer.sendPacket(stage.peer.packet(command(stage.peer, 1)));
        QVERIFY2(eventually([&] { return stage.motions().size() == 1; }), stage.story().c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void aGenuinePacketCanBeAViolation_data()
    {
        QTest::addColumn<bool>("origin");
        QTest::newRow("in another's name") << true;
        QTest::newRow("longer than its definition") << false;
    }
    void aGenuinePacketCanBeAViolation()
    {
        QFETCH(bool, origin);
        HostileStage stage;
        stage.openPeer();
        auto datagram = origin ? withHeader(stage, motion, Bytes(41), [&](wire::Header& h) { h.origin = stage.cockpitId.value(); })
                               : stage.peer.said(motion, Bytes(42));
        stage.peer.sendPacket(stage.peer.packet(datagram));
        QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Lost, stage.xrayId); }), stage.story().c_str());
        QCOMPARE(words(stage.robot.events(Kind::Lost)[0].diagnosis.cause), words(LossCause::ProtocolViolation));
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void aCommandByBothWaysIsDeliveredOnce()
    {
        HostileStage stage;
        stage.openPeer();
        for (std::uint32_t i = 1; i <= 20; ++i) {
            const auto datagram = command(stage.peer, i);
            const auto before = stage.dropped();
            stage.peer.sendPacket(stage.peer.packet(datagram));
            stage.peer.send(datagram);
            QVERIFY2(eventually([&] { return stage.dropped() > before && stage.motions().size() == i; }), stage.story().c_str());
        }
        QCOMPARE(stage.motions().size(), std::size_t{20});
        QVERIFY2(stage.toldOf("newer one was delivered"), stage.story().c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }
};

QTEST_GUILESS_MAIN(HostilePacketsTest)
#include "hostile_packets_test.moc"
