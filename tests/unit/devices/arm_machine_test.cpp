// The arm: it moves only while the robot holds.
#include "arm_machine.hpp"

#include <QTest>

#include <cmath>

using namespace liena;
using namespace liena::devices;
using namespace std::chrono_literals;

namespace {

const DeviceId cockpit(0x40018208);
const DeviceId otherCockpit(0x40018209);
const DeviceId robot(0x00008208);
const SteadyTime start{1h};

struct Rig {
    ArmMachine arm;
    SteadyTime now = start;
    Joints goal{0.5, -0.6, 1.1, 0, 0.7, 0};

    Rig() { hold(); }

    bool move(DeviceId origin = cockpit) { return arm.command({origin, true, goal, 1.0}, now); }
    bool hold(DeviceId origin = cockpit) { return arm.command({origin, false, {}, 0}, now); }

    // One round of 5 ms: the robot's report, the cockpit's command, a step.
    void round(bool robotHolds = true, bool commanded = true)
    {
        now += 5ms;
        arm.robotReported(robotHolds, now);
        if (commanded)
            move();
        arm.step(now);
    }
    void moveFor(int rounds)
    {
        while (rounds-- > 0)
            round();
    }
};

} // namespace

class ArmMachineTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void reachesItsTargetsWithinItsSpeed()
    {
        Rig rig;
        for (int count = 0; count < 1000 && (count < 2 || rig.arm.state() == ArmState::Moving); ++count) {
            const double before = rig.arm.positions()[0];
            rig.round();
            QVERIFY(std::abs(rig.arm.positions()[0] - before) <= 0.6 * 0.005 + 1e-12);
        }
        QVERIFY(std::abs(rig.arm.positions()[0] - 0.5) < 1e-3);
        QVERIFY(rig.arm.holding());
        QVERIFY(rig.arm.brake());
    }

    void refusesWhileTheRobotDoesNotHold()
    {
        Rig rig;
        QVERIFY(!rig.move()); // never heard
        QVERIFY(rig.hold());
        rig.arm.robotReported(false, rig.now);
        QVERIFY(!rig.move());
        QCOMPARE(rig.arm.refusedCommands(), 2U);
        QVERIFY(rig.hold());
        rig.arm.robotReported(true, rig.now);
        QVERIFY(rig.move());
    }

    void refusedStreamWantsAHoldWhateverBarredIt_data()
    {
        QTest::addColumn<int>("bar");
        QTest::newRow("the robot's hold was never reported") << 0;
        QTest::newRow("the robot did not hold: a force stop or a failed drive makes it") << 1;
        QTest::newRow("the robot's report was old") << 2;
        QTest::newRow("stand-by") << 3;
    }

    void refusedStreamWantsAHoldWhateverBarredIt()
    {
        QFETCH(int, bar);
        Rig rig;
        if (bar >= 1)
            rig.arm.robotReported(bar != 1, rig.now);
        if (bar == 2)
            rig.now += 101ms;
        rig.arm.setStandBy(bar == 3);
        QVERIFY(rig.hold());
        QVERIFY(!rig.move());
        rig.arm.setStandBy(false);
        rig.arm.robotReported(true, rig.now);
        for (int repeat = 0; repeat < 3; ++repeat) {
            QVERIFY(!rig.move());
            QCOMPARE(rig.arm.state(), ArmState::Hold);
        }
        QVERIFY(rig.hold());
        QVERIFY(rig.move());
    }

    void streamRefusedForAnotherCockpitWantsAHold_data()
    {
        QTest::addColumn<bool>("arrives");
        QTest::newRow("the other says hold") << false;
        QTest::newRow("the other's targets are reached") << true;
    }

    void streamRefusedForAnotherCockpitWantsAHold()
    {
        QFETCH(bool, arrives);
        Rig rig;
        QVERIFY(rig.hold(otherCockpit));
        rig.moveFor(20);
        QVERIFY(!rig.move(otherCockpit));
        for (int count = 0; arrives && count < 1000 && rig.arm.state() == ArmState::Moving; ++count)
            rig.round();
        QVERIFY(arrives || rig.hold());
        QCOMPARE(rig.arm.state(), ArmState::Hold);
        QVERIFY(!rig.move(otherCockpit));
        QCOMPARE(rig.arm.state(), ArmState::Hold);
        QVERIFY(rig.hold(otherCockpit));
        QVERIFY(rig.move(otherCockpit));
    }

    void holdOfAnotherCockpitIsNotUndoneByTheStream()
    {
        Rig rig;
        rig.moveFor(20);
        QVERIFY(rig.hold(otherCockpit));
        QVERIFY(!rig.move());
        QCOMPARE(rig.arm.state(), ArmState::Hold);
        QVERIFY(rig.hold());
        QVERIFY(rig.move());
    }

    void refusesWhenTheRobotsReportIsOld()
    {
        Rig rig;
        rig.arm.robotReported(true, rig.now);
        rig.now += 101ms;
        QVERIFY(!rig.move());
    }

    void stopsWhenTheRobotMoves()
    {
        Rig rig;
        rig.moveFor(100);
        QVERIFY(!rig.arm.still());
        for (int count = 0; count < 40; ++count)
            rig.round(false);
        QVERIFY(rig.arm.still());
        QVERIFY(rig.arm.holding());
        QVERIFY(rig.arm.refusedCommands() > 0);
    }

    void stopsWhenTheRobotFallsSilent()
    {
        Rig rig;
        rig.moveFor(100);
        for (int count = 0; count < 60; ++count) {
            rig.now += 5ms;
            rig.move();
            rig.arm.step(rig.now);
        }
        QVERIFY(rig.arm.holding());
    }

    void stopsWhenTheCommandsEnd()
    {
        Rig rig;
        rig.moveFor(100);
        for (int count = 0; count < 40; ++count)
            rig.round(true, false);
        QVERIFY(!rig.arm.still()); // 200 ms are not over
        for (int count = 0; count < 20; ++count)
            rig.round(true, false);
        QVERIFY(rig.arm.holding());
    }

    void stoppedArmWantsAHoldFirst_data()
    {
        QTest::addColumn<int>("cause");
        QTest::newRow("robot moved") << 0;
        QTest::newRow("session lost") << 1;
        QTest::newRow("stand-by") << 2;
        QTest::newRow("stall") << 3;
        QTest::newRow("silence") << 4;
    }

    void stoppedArmWantsAHoldFirst()
    {
        QFETCH(int, cause);
        Rig rig;
        rig.moveFor(20);
        if (cause == 0)
            rig.arm.robotReported(false, rig.now);
        if (cause == 1)
            rig.arm.sessionLost(cockpit);
        if (cause == 2)
            rig.arm.setStandBy(true);
        if (cause == 3)
            rig.arm.lock("stall");
        if (cause == 4)
            for (int count = 0; count < 60; ++count)
                rig.round(true, false);
        rig.arm.setStandBy(false);
        rig.arm.robotReported(true, rig.now);
        QVERIFY(!rig.move());
        QCOMPARE(rig.arm.state(), ArmState::Hold);
        QVERIFY(rig.hold());
        QVERIFY(rig.move());
    }

    void streamOfBeforeTheSessionMovesNothing_data()
    {
        QTest::addColumn<int>("cause");
        QTest::newRow("the arm was started anew") << 0;
        QTest::newRow("session lost while it held") << 1;
        QTest::newRow("stand-by while it held") << 2;
    }

    void streamOfBeforeTheSessionMovesNothing()
    {
        QFETCH(int, cause);
        Rig rig;
        if (cause == 0)
            rig.arm = ArmMachine();
        if (cause == 1)
            rig.arm.sessionLost(cockpit);
        rig.arm.setStandBy(cause == 2);
        rig.arm.setStandBy(false);
        rig.arm.robotReported(true, rig.now);
        QVERIFY(!rig.move());
        QVERIFY(rig.hold(otherCockpit)); // which says nothing of our hand
        QVERIFY(!rig.move());
        QCOMPARE(rig.arm.state(), ArmState::Hold);
        QVERIFY(rig.hold());
        QVERIFY(rig.move());
    }

    void stopDoesNotSetAStreamGoing()
    {
        Rig rig;
        rig.arm.robotReported(false, rig.now);
        rig.arm.lock("stop at the patient's side");
        rig.arm.robotReported(true, rig.now); // for it was stopped as well
        QVERIFY(!rig.move());
        QCOMPARE(rig.arm.state(), ArmState::Hold);
        QVERIFY(rig.hold());
        QVERIFY(rig.move());
    }

    void stopOfTheRobotDoesNotSetAStreamGoing()
    {
        Rig rig;
        for (const std::uint64_t stop : {7U, 8U}) {
            QVERIFY(rig.hold());
            rig.arm.robotReported(false, rig.now);
            rig.arm.robotNamesStop(stop);
            rig.arm.robotReported(true, rig.now);
            QVERIFY(!rig.move());
        }
        QVERIFY(rig.hold());
        rig.arm.robotNamesStop(8);
        QVERIFY(rig.move()); // the stop that is in force was there before that hold
        rig.arm.robotNamesStop(0);
        QCOMPARE(rig.arm.state(), ArmState::Moving);
        rig.arm.robotNamesStop(9);
        QCOMPARE(rig.arm.state(), ArmState::Hold);
        QVERIFY(!rig.move());
    }

    void refusesInStandBy()
    {
        Rig rig;
        rig.arm.setStandBy(true);
        rig.arm.robotReported(true, rig.now);
        QVERIFY(rig.hold());
        QVERIFY(!rig.move());
    }

    void anotherSessionsLossDoesNotStopIt()
    {
        Rig rig;
        rig.moveFor(20);
        rig.arm.sessionLost(otherCockpit);
        QCOMPARE(rig.arm.state(), ArmState::Moving);
    }

    void onlyOneCockpitMovesIt()
    {
        Rig rig;
        rig.moveFor(20);
        QVERIFY(!rig.move(otherCockpit));
        QVERIFY(!rig.move(robot));
        QCOMPARE(rig.arm.state(), ArmState::Moving);
    }

    void refusesTargetsOutsideTheirBounds()
    {
        Rig rig;
        rig.arm.robotReported(true, rig.now);
        rig.goal[3] = 3.2;
        QVERIFY(!rig.move());
        rig.goal[3] = std::nan("");
        QVERIFY(!rig.move());
    }

    void lateStepIsNotMadeUpFor()
    {
        Rig rig;
        rig.moveFor(100);
        const double before = rig.arm.positions()[0];
        rig.now += 90ms;
        rig.arm.step(rig.now);
        QVERIFY(std::abs(rig.arm.positions()[0] - before) <= 0.6 * 0.02 + 1e-9);
    }
};

QTEST_GUILESS_MAIN(ArmMachineTest)
#include "arm_machine_test.moc"
