// What may leave for the robot and for the X-ray system: a screen that stands still moves nothing and exposes nobody.
#include "model/latest_value.hpp"
#include "model/motion_order.hpp"
#include "model/pedal_order.hpp"
#include "model/soft_start.hpp"

#include <QTest>

#include <thread>

using namespace console;
using namespace std::chrono_literals;

namespace {

const Instant start = Instant{} + 1h;

MotionSnapshot moving(Instant now)
{
    MotionSnapshot s;
    s.stream = MotionStream::Motion;
    s.permit = 9;
    s.engagedSince = now - 10s;
    s.motion.guidewireVelocity = 10;
    s.guiTick = now;
    s.shownCapture = now - 100ms;
    s.pictureLimit = 250ms;
    return s;
}

/// The orders that begin a press, up to the first of the exposure.
void begin(PedalGate& gate, const PedalSnapshot& down)
{
    for (int order = 0; order < PedalGate::starts; ++order)
        QVERIFY(!gate.compose(down, start)->pedal);
}

} // namespace

class TestMotionGate : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void sendsNothingWithoutAStream()
    {
        MotionGate gate;
        QVERIFY(!gate.compose({}, start));
    }

    void sendsZeroWhileArmed()
    {
        MotionGate gate;
        auto snapshot = moving(start);
        snapshot.stream = MotionStream::Zero;
        const auto order = gate.compose(snapshot, start);
        QVERIFY(order);
        QVERIFY(!order->engaged);
        QVERIFY(order->motion.isZero());
    }

    void countsTheCommandsOfEachPermit()
    {
        MotionGate gate;
        auto snapshot = moving(start);
        QCOMPARE(gate.compose(snapshot, start)->sequence, 1U);
        QCOMPARE(gate.compose(snapshot, start)->sequence, 2U);
        snapshot.permit = 10;
        QCOMPARE(gate.compose(snapshot, start)->sequence, 1U);
    }

    void movesWithAScreenThatRunsAndAPictureThatIsYoung_data()
    {
        QTest::addColumn<int>("guiMs");
        QTest::addColumn<int>("pictureMs");
        QTest::addColumn<bool>("engaged");
        QTest::newRow("both young") << 100 << 250 << true;
        QTest::newRow("screen stands") << 101 << 50 << false;
        QTest::newRow("picture old") << 0 << 251 << false;
        QTest::newRow("no picture") << 0 << -1 << false;
    }

    void movesWithAScreenThatRunsAndAPictureThatIsYoung()
    {
        QFETCH(int, guiMs);
        QFETCH(int, pictureMs);
        QFETCH(bool, engaged);
        MotionGate gate;
        auto snapshot = moving(start);
        snapshot.guiTick = start - std::chrono::milliseconds(guiMs);
        snapshot.shownCapture = pictureMs < 0 ? std::nullopt : std::optional<Instant>(start - std::chrono::milliseconds(pictureMs));
        const auto order = gate.compose(snapshot, start);
        QVERIFY(order);
        QCOMPARE(order->engaged, engaged);
        QCOMPARE(order->motion.isZero(), !engaged);
        const bool byPicture = guiMs <= 100; // else a screen that stood still is why
        QVERIFY(gate.blockedPermit() == (engaged ? std::nullopt : std::optional(BlockedPermit{snapshot.permit, byPicture})));
    }

    void permitThatStoodStillOnceNeverMovesAgain()
    {
        MotionGate gate;
        auto snapshot = moving(start);
        QVERIFY(gate.compose(snapshot, start + 50ms)->engaged);
        QVERIFY(!gate.compose(snapshot, start + 2s)->engaged);
        snapshot = moving(start + 3s); // the screen is back, the dead-man still down
        QVERIFY(!gate.compose(snapshot, start + 3s)->engaged);
        snapshot.permit = 10;
        QVERIFY(gate.compose(snapshot, start + 3s)->engaged);
    }

    void startsSoftly()
    {
        MotionGate gate;
        auto snapshot = moving(start);
        snapshot.engagedSince = start;
        QCOMPARE(gate.compose(snapshot, start)->motion.guidewireVelocity, 2.5);
        snapshot.guiTick = start + 1s;
        snapshot.shownCapture = start + 1s;
        QCOMPARE(gate.compose(snapshot, start + 1s)->motion.guidewireVelocity, 6.25);
        QCOMPARE(softStart(-1s), 0.25);
        QCOMPARE(softStart(2s), 1.0);
        QCOMPARE(softStart(1h), 1.0);
    }

    void saysThatThePedalWasUpBeforeEachPress()
    {
        PedalGate gate;
        for (const quint32 press : {5U, 6U}) { // also where the foot came up and went down again between two orders
            for (int order = 0; order < PedalGate::starts; ++order) {
                const auto up = gate.compose({true, press, 15, start}, start);
                QVERIFY(!up->pedal);
                QCOMPARE(up->press, press - 1);
            }
            const auto down = gate.compose({true, press, 15, start}, start);
            QVERIFY(down->pedal);
            QCOMPARE(down->press, press);
        }
    }

    /// The X-ray system exposes where it heard up and then down; one order that comes too late or is superseded it does not hear.
    void aPressIsHeardThoughOneOfItsOrdersIsLost()
    {
        for (int lost = 0; lost < 5; ++lost) {
            PedalGate gate;
            bool heardUp = false;
            bool exposes = false;
            for (int order = 0; order < 6; ++order) {
                const auto said = gate.compose({true, 5, 15, start}, start);
                if (order == lost)
                    continue;
                exposes = heardUp && said->pedal;
                heardUp = heardUp || !said->pedal;
            }
            QVERIFY2(exposes, qPrintable(QString::number(lost)));
        }
    }

    void aPressThatEndsWhileItBeginsStopsAndExposesNobody()
    {
        PedalGate gate;
        QVERIFY(!gate.compose({true, 5, 15, start}, start)->pedal);
        for (int repeat = 0; repeat < PedalGate::stops; ++repeat)
            QVERIFY(!gate.compose({false, 5, 15, start}, start)->pedal);
        QVERIFY(!gate.compose({false, 5, 15, start}, start));
        begin(gate, {true, 6, 15, start}); // as many as ever
        QVERIFY(gate.compose({true, 6, 15, start}, start)->pedal);
    }

    void repeatsThePedalWhileItIsDownAndThenStops()
    {
        PedalGate gate;
        QVERIFY(!gate.compose({false, 0, 15, start}, start));
        const PedalSnapshot down{true, 5, 15, start};
        begin(gate, down);
        for (int repeat = 0; repeat < 3; ++repeat)
            QVERIFY(gate.compose(down, start)->pedal);
        const PedalSnapshot up{false, 5, 15, start};
        for (int repeat = 0; repeat < PedalGate::stops; ++repeat)
            QVERIFY(!gate.compose(up, start)->pedal);
        QVERIFY(!gate.compose(up, start));
    }

    void exposureOfAHungScreenEndsAndStaysEnded()
    {
        PedalGate gate;
        begin(gate, {true, 5, 15, start});
        QVERIFY(gate.compose({true, 5, 15, start}, start + 200ms)->pedal);
        QVERIFY(!gate.compose({true, 5, 15, start}, start + 201ms)->pedal);
        QVERIFY(!gate.compose({true, 5, 15, start + 1s}, start + 1s)->pedal);
        begin(gate, {true, 6, 15, start + 1s});
        QVERIFY(gate.compose({true, 6, 15, start + 1s}, start + 1s)->pedal);
    }

    void aPressThatHungBeforeItBeganStaysEndedWhenItsStopIsRefused()
    {
        PedalGate gate;
        gate.compose({true, 5, 15, start}, start);
        QVERIFY(!gate.compose({true, 6, 15, start}, start + 201ms)->pedal);
        gate.refused();
        for (int order = 0; order <= PedalGate::starts; ++order) {
            const auto now = gate.compose({true, 6, 15, start + 1s}, start + 1s);
            QVERIFY(!now || !now->pedal);
        }
    }

    void aPressThatWasHeldBeforeTheLinkOpensExposesNobody_data()
    {
        QTest::addColumn<int>("sent"); // orders until the link is lost
        QTest::newRow("never open") << 0;
        QTest::newRow("lost at the first order") << 1;
        QTest::newRow("lost while it is repeated") << 5;
    }

    void aPressThatWasHeldBeforeTheLinkOpensExposesNobody()
    {
        QFETCH(int, sent);
        PedalGate gate;
        const PedalSnapshot held{true, 5, 15, start};
        for (int order = 0; order < sent; ++order)
            QVERIFY(gate.compose(held, start));
        QVERIFY(gate.compose(held, start));
        gate.refused();
        for (int order = 0; order < 10; ++order) { // and now it is open again
            const auto now = gate.compose(held, start);
            QVERIFY(!now || !now->pedal);
        }
        begin(gate, {true, 6, 15, start});
        QVERIFY(gate.compose({true, 6, 15, start}, start)->pedal);
    }

    void newestValueCrossesThreadsWhole()
    {
        struct Pair {
            quint64 a = 0;
            quint64 b = 0;
        };
        LatestValue<Pair> value;
        constexpr quint64 writes = 20000;
        std::jthread writer([&value] {
            for (quint64 n = 1; n <= writes; ++n)
                value.write({n, ~n});
        });
        quint64 last = 0;
        bool whole = true;
        while (last < writes && whole) {
            const auto pair = value.read();
            whole = pair.a == 0 || (pair.b == ~pair.a && pair.a >= last);
            last = pair.a;
            std::this_thread::yield();
        }
        QVERIFY(whole);
    }
};

QTEST_GUILESS_MAIN(TestMotionGate)
#include "test_motion_gate.moc"
