// The force that a hand is offered, and the hand that feels it: bounded, without a jump, and never what moves the robot.
#include "input/force_feedback.hpp"
#include "input/keyboard_master.hpp"
#include "input/master_rack.hpp"
#include "input/simulated_haptic_master.hpp"

#include <QTest>

#include <cmath>
#include <limits>
#include <random>

using namespace console;
using namespace std::chrono_literals;

namespace {

constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();
constexpr auto turn = 10ms;
const Instant start = Instant{} + 1h;

double after(ForceFeedback& feedback, const RobotForce& robot, Instant& now, Duration time)
{
    double force = feedback.force();
    for (const Instant end = now + time; now < end;) {
        now += turn;
        force = feedback.update(robot, now);
    }
    return force;
}

/// The master on the keyboard that its hand wants by.
struct Haptic {
    KeyboardMaster keyboard;
    SimulatedHapticMaster master{keyboard};
    Instant now = start;

    Haptic() { keyboard.setListening(true); }

    /// The speed of the handle after a while under that force.
    double after(Duration time, const RobotForce& robot)
    {
        double speed = 0;
        for (const Instant end = now + time; now < end;) {
            now += turn;
            master.feel(robot, now);
            speed = master.read(now).motion.guidewireVelocity;
        }
        return speed;
    }
};

} // namespace

class TestHaptic : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void forceFollowsTheRobotsWithoutAJump()
    {
        ForceFeedback feedback;
        Instant now = start;
        feedback.update({}, now);
        double last = 0;
        for (int i = 0; i < 100; ++i) {
            now += turn;
            const double force = feedback.update({1.5, true}, now);
            QVERIFY(force >= last && force - last <= ForceFeedback::rate * seconds(turn) + 1e-9);
            last = force;
        }
        QCOMPARE(last, 1.5);
        QCOMPARE(after(feedback, {-0.5, true}, now, 1s), -0.5);
    }

    void forceIsBounded_data()
    {
        QTest::addColumn<double>("robot");
        QTest::addColumn<double>("offered");
        QTest::newRow("much") << 1e9 << ForceFeedback::most;
        QTest::newRow("much, back") << -1e9 << -ForceFeedback::most;
        QTest::newRow("no number") << noNumber << 0.0;
        QTest::newRow("endless") << endless << 0.0;
    }

    void forceIsBounded()
    {
        QFETCH(double, robot);
        QFETCH(double, offered);
        ForceFeedback feedback;
        Instant now = start;
        QCOMPARE(after(feedback, {robot, true}, now, 2s), offered);
    }

    void aForceThatIsNotGivenFadesWithinATenthOfASecond()
    {
        ForceFeedback feedback;
        Instant now = start;
        QCOMPARE(after(feedback, {9, true}, now, 1s), ForceFeedback::most);
        QVERIFY(std::abs(feedback.update({9, false}, now + turn)) < ForceFeedback::most);
        now += turn;
        QCOMPARE(after(feedback, {9, false}, now, 90ms), 0.0);
        QCOMPARE(after(feedback, {9, false}, now, 1s), 0.0);
    }

    void aGapIsNoJumpUpwards()
    {
        ForceFeedback feedback;
        feedback.update({}, start);
        QVERIFY(feedback.update({3, true}, start + 10s) <= ForceFeedback::rate * 0.02 + 1e-9);
        QCOMPARE(feedback.update({3, false}, start + 20s), 0.0);
    }

    void aHandWithoutForceMovesAsItWants()
    {
        HapticHand hand;
        double speed = 0;
        for (int i = 0; i <= 100; ++i)
            speed = hand.move(10, 0, start + i * turn);
        QVERIFY2(std::abs(speed - 10) < 0.1, qPrintable(QString::number(speed)));
    }

    void aHandYieldsToForce()
    {
        HapticHand free;
        HapticHand held;
        double way = 0;
        for (int i = 0; i <= 20; ++i)
            way += free.move(10, 0, start + i * turn) - held.move(10, 1, start + i * turn);
        QVERIFY2(way > 50, qPrintable(QString::number(way))); // mm/s of 10 ms each: more than 0.5 mm behind
    }

    void forceNeverMovesAHand_data()
    {
        QTest::addColumn<double>("force");
        for (const double force : {3.0, -3.0, 1e6, -1e6, noNumber, endless})
            QTest::addRow("%g", force) << force;
    }

    void forceNeverMovesAHand()
    {
        QFETCH(double, force);
        HapticHand hand;
        for (int i = 0; i < 100; ++i)
            QCOMPARE(hand.move(0, force, start + i * turn), 0.0);
    }

    /// Whatever the force does, the hand goes the way it wants to or not at all, and no faster.
    void theHandStaysBetweenRestAndWhatItWants()
    {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> speeds(-40, 40);
        std::uniform_real_distribution<double> forces(-5, 5);
        HapticHand hand;
        Instant now = start;
        for (int i = 0; i < 20'000; ++i) {
            const double wanted = i % 7 == 0 ? 0 : speeds(random);
            now += std::chrono::milliseconds(random() % 120);
            const double speed = hand.move(wanted, forces(random), now);
            QVERIFY(std::isfinite(speed));
            QVERIFY2(speed * wanted >= 0 && std::abs(speed) <= std::abs(wanted) + 1e-9,
                     qPrintable(QStringLiteral("%1 of %2").arg(speed).arg(wanted)));
        }
    }

    void withTheDeadManUpNothingIsAskedWhateverTheForce()
    {
        Haptic haptic;
        haptic.keyboard.press(Qt::Key_Up);
        for (const double force : {3.0, -3.0}) {
            QCOMPARE(haptic.after(500ms, {force, true}), 0.0);
            QVERIFY(!haptic.master.read(haptic.now).deadMan);
        }
    }

    void withoutAWishNothingIsAskedWhateverTheForce()
    {
        Haptic haptic;
        haptic.keyboard.press(Qt::Key_D);
        for (const double force : {3.0, -3.0}) {
            QCOMPARE(haptic.after(500ms, {force, true}), 0.0);
            QVERIFY(haptic.master.read(haptic.now).motion.isZero());
            QCOMPARE(haptic.master.forceToHand(), std::optional<double>(force));
        }
    }

    void theHandMovesTheGuidewireAgainstTheForce()
    {
        Haptic haptic;
        haptic.keyboard.press(Qt::Key_D);
        haptic.keyboard.press(Qt::Key_Up);
        const double freely = haptic.after(200ms, {0, true});
        QVERIFY2(freely > 5, qPrintable(QString::number(freely)));
        const double against = haptic.after(100ms, {2.5, true});
        QVERIFY2(against < freely / 2, qPrintable(QString::number(against)));
    }

    void lettingGoForgetsTheSpringsTension()
    {
        Haptic haptic;
        haptic.keyboard.press(Qt::Key_D);
        haptic.keyboard.press(Qt::Key_Up);
        haptic.after(1s, {3, true});
        haptic.keyboard.release(Qt::Key_D);
        QCOMPARE(haptic.after(20ms, {}), 0.0);
        haptic.keyboard.press(Qt::Key_D);
        haptic.master.rezero(haptic.now);
        const double first = haptic.master.read(haptic.now).motion.guidewireVelocity;
        QCOMPARE(first, 0.0);
    }

    void itsDeadManIsTheKeyboards()
    {
        Haptic haptic;
        MasterRack rack(haptic.keyboard);
        rack.add(haptic.master);
        rack.begin(MasterKind::HapticSimulated);
        rack.setListening(true);
        QVERIFY(rack.read(start).alive && !rack.read(start).deadMan);
        haptic.keyboard.press(Qt::Key_D);
        QVERIFY(rack.read(start).deadMan);
        rack.setListening(false);
        QVERIFY(!rack.read(start).alive && !rack.read(start).deadMan);
    }

    void onlyTheMasterInUseFeels()
    {
        Haptic haptic;
        MasterRack rack(haptic.keyboard);
        rack.add(haptic.master);
        rack.setListening(true);
        for (int i = 0; i < 50; ++i)
            rack.feel({2, true}, start + i * turn);
        QCOMPARE(haptic.master.forceToHand(), std::optional<double>(0.0));
        rack.begin(MasterKind::HapticSimulated);
        for (int i = 50; i < 100; ++i)
            rack.feel({2, true}, start + i * turn);
        QCOMPARE(haptic.master.forceToHand(), std::optional<double>(2.0));
    }
};

QTEST_GUILESS_MAIN(TestHaptic)
#include "test_haptic.moc"
