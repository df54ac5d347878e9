// Commands of a compromised peer that are repeated, old, forged or out of order, and clocks that cannot be.
#include "hostile_stage.hpp"

#include <QTest>

#include <limits>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;
using wire::Bytes;
using wire::Words;
using Guard = ScriptedPeer::Guard;
namespace number = wire::number;

namespace {

constexpr std::uint16_t gripper = 0x0103; // control, on lane 0 only

Bytes fields(std::uint8_t which = 1) { return Words().u32(1).u8(which).u8(1); }

struct Game {
    const char* name;
    std::function<Bytes(ScriptedPeer&)> datagram;
    std::string told;
};

std::vector<Game> games()
{
    const auto guarded = [](const char* name, auto change, const char* told) {
        return Game{name,
                    [change](ScriptedPeer& peer) {
                        auto guard = peer.guard(gripper);
                        change(guard);
                        return peer.control(gripper, fields(), guard);
                    },
                    told};
    };
    const auto spoilt = [](const char* name, std::size_t at) {
        return Game{name,
                    [at](ScriptedPeer& peer) {
                        auto bytes = peer.control(gripper, fields(), peer.guard(gripper));
                        bytes[at] ^= 1U;
                        return bytes;
                    },
                    "check sum wrong"};
    };
    return {
        guarded(
            "used sequence", [](Guard& g) { g.sequence = 1; }, "not newer"),
        guarded(
            "sequence 0", [](Guard& g) { g.sequence = 0; }, "not newer"),
        guarded(
            "epoch 0", [](Guard& g) { g.epoch = 0; }, "before the epoch rose"),
        guarded(
            "epoch to come", [](Guard& g) { ++g.epoch; }, "never announced"),
        guarded(
            "last epoch of all", [](Guard& g) { g.epoch = ~0U; }, "never announced"),
        guarded(
            "echo of no heartbeat", [](Guard& g) { g.echo = 0; }, "echoes a heartbeat that was not sent"),
        guarded(
            "echo of a heartbeat to come", [](Guard& g) { g.echo += 500; }, "echoes a heartbeat that was not sent"),
        spoilt("stamp changed", 12),
        spoilt("sequence changed", 24),
        spoilt("check sum changed", 32),
        spoilt("field changed", 40),
    };
}

} // namespace

class HostileControlTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void deliversNoneOfTheseCommands()
    {
        HostileStage stage;
        stage.openPeer();
        QVERIFY(stage.peer.command(gripper, fields()));
        QVERIFY2(eventually([&] { return stage.robot.messages("GripperCommand").size() == 1; }), stage.story().c_str());
        std::size_t delivered = 1;
        for (const auto& game : games()) {
            if (stage.robot.state(stage.xrayId) != SessionState::Open) // more than ten within a second
                stage.openPeer();
            const auto before = stage.dropped();
            QVERIFY(stage.peer.send(game.datagram(stage.peer)));
            QVERIFY2(eventually([&] { return stage.dropped() > before; }), game.name);
            QVERIFY2(stage.toldOf(game.told), (game.name + ("\n" + stage.story())).c_str());
            QCOMPARE(stage.robot.messages("GripperCommand").size(), delivered);
        }
        if (stage.robot.state(stage.xrayId) != SessionState::Open)
            stage.openPeer();
        QVERIFY(stage.peer.command(gripper, fields()));
        QVERIFY2(eventually([&] { return stage.robot.messages("GripperCommand").size() == delivered + 1; }), stage.story().c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void tenFaultsAreDroppedAndElevenEndTheSession_data()
    {
        QTest::addColumn<int>("faults");
        QTest::newRow("ten") << 10;
        QTest::newRow("eleven") << 11;
    }
    void tenFaultsAreDroppedAndElevenEndTheSession()
    {
        QFETCH(int, faults);
        HostileStage stage;
        stage.openPeer();
        Words burst;
        for (int i = 0; i < faults; ++i)
            burst.raw(stage.peer.said(gripper, Bytes(22)));
        stage.peer.send(burst); // at once, so that they are judged within a second
        QVERIFY2(eventually([&] { return stage.dropped() == static_cast<std::size_t>(faults); }), stage.story().c_str());
        if (faults > 10) {
            QVERIFY2(eventually([&] { return stage.robot.heard(Kind::Lost, stage.xrayId); }), stage.story().c_str());
            QCOMPARE(words(stage.robot.events(Kind::Lost)[0].diagnosis.cause), words(LossCause::ProtocolViolation));
        } else {
            QVERIFY(stage.peer.command(gripper, fields()));
            QVERIFY2(eventually([&] { return stage.robot.messages("GripperCommand").size() == 1; }), stage.story().c_str());
            QVERIFY(!stage.robot.heard(Kind::Lost));
        }
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    void deliversNothingThatWasRecordedBefore()
    {
        HostileStage stage;
        stage.openPeer();
        std::vector<Bytes> recorded;
        for (std::uint8_t i = 0; i < 8; ++i) {
            recorded.push_back(stage.peer.control(gripper, fields(), stage.peer.guard(gripper)));
            QVERIFY(stage.peer.send(recorded.back()));
        }
        QVERIFY2(eventually([&] { return stage.robot.messages("GripperCommand").size() == 8; }), stage.story().c_str());
        const auto replay = [&] {
            const auto before = stage.dropped();
            for (const auto& bytes : recorded)
                stage.peer.send(bytes);
            return eventually([&] { return stage.dropped() == before + recorded.size(); });
        };
        QVERIFY2(replay(), stage.story().c_str());
        stage.peer.send(stage.peer.attach(stage.peer.token())); // a violation
        QVERIFY2(eventually([&] { return stage.robot.state(stage.xrayId) == SessionState::StandBy; }), stage.story().c_str());
        stage.openPeer();
        QVERIFY2(replay(), stage.story().c_str());
        QCOMPARE(stage.robot.messages("GripperCommand").size(), std::size_t{8});
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }

    /// A peer's stamps are any numbers: sums of them must not overflow, and nobody else may suffer.
    void clocksThatCannotBeHarmNobody()
    {
        HostileStage stage;
        stage.openPeer();
        stage.peer.habits.heartbeats = false;
        constexpr auto last = std::numeric_limits<std::uint64_t>::max();
        const std::vector<std::uint64_t> stamps{0, 1, last, last / 2, last / 2 + 1, last / 4 * 3, 1ULL << 62};
        std::uint32_t sequence = 100000;
        for (const auto sent : stamps)
            for (const auto echoed : stamps)
                for (const auto received : stamps)
                    stage.peer.say(number::heartbeat, wire::heartbeat({.sequence = ++sequence,
                                                                       .sent = sent,
                                                                       .echoSequence = sequence,
                                                                       .echoSent = echoed,
                                                                       .echoReceived = received,
                                                                       .state = wire::state::open}));
        for (const auto stamp : stamps) {
            auto head = stage.peer.header(0x0101);
            head.timestamp = stamp;
            const auto guard = stage.peer.guard(0x0101);
            stage.peer.send(wire::datagram(head, wire::guarded(head, guard.epoch, guard.sequence, guard.echo, motionFields(1, 1, 1))));
        }
        stage.peer.say(number::heartbeat, wire::heartbeat({.sequence = ~0U, .state = wire::state::open})); // and no number is left
        QVERIFY2(eventually([&] { return stage.linkOf(stage.xrayId).heartbeatsReceived >= 343; }), stage.story().c_str());
        QVERIFY2(stage.honestSessionLives(), stage.story().c_str());
    }
};

QTEST_GUILESS_MAIN(HostileControlTest)
#include "hostile_control_test.moc"
