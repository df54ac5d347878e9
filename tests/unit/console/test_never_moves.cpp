// What must never give the permission to move back.
#include "permit_run.hpp"

#include <QTest>

using namespace permit_run;

class TestNeverMoves : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void healedInterruptionGivesNothingBack();
    void holdEndsOnlyWithRobotsWordAndReleasedDeadMan();
    void holdDoesNotEndUnderTheSpentPermit();
    void reopenedSessionNeedsGuardsForASecondAndANewArm();
    void nothingButTheWholeWayLeadsToMotion();
};

void TestNeverMoves::healedInterruptionGivesNothingBack()
{
    auto run = in(Phase::Engaged);
    run.feed(Kind::SessionInterrupted);
    QCOMPARE(run.state.phase, Phase::Hold);
    run.feed(Kind::SessionOpen);
    run.feed(guards(true, true));
    run.feed(Kind::DeadManPressed);
    QCOMPARE(run.state.stream(), MotionStream::None);
    run.feed(Kind::DeadManReleased);
    run.feed(robot(RobotState::Ready, permit + 1));
    run.feed(Kind::DeadManPressed);
    run.feed(guards(true, true));
    QVERIFY(run.state.phase == Phase::Standby || run.state.phase == Phase::Ready);
    QCOMPARE(run.state.stream(), MotionStream::None);
}

void TestNeverMoves::holdEndsOnlyWithRobotsWordAndReleasedDeadMan()
{
    auto run = in(Phase::Hold);
    run.feed(robot(RobotState::Ready, permit + 1));
    QCOMPARE(run.state.phase, Phase::Hold); // the dead-man is still down
    run.feed(Kind::DeadManReleased);
    QCOMPARE(run.state.phase, Phase::Standby);

    auto other = in(Phase::Hold);
    other.feed(Kind::DeadManReleased);
    QCOMPARE(other.state.phase, Phase::Hold); // the robot has not said that it holds
    other.feed(robot(RobotState::Hold, permit + 1, false));
    QCOMPARE(other.state.phase, Phase::Hold);
    other.feed(robot(RobotState::Hold, permit + 1, true));
    QCOMPARE(other.state.phase, Phase::Standby);
}

void TestNeverMoves::holdDoesNotEndUnderTheSpentPermit()
{
    auto run = in(Phase::Hold);
    run.feed(Kind::DeadManReleased);
    run.feed(robot(RobotState::Hold, permit, true));
    QCOMPARE(run.state.phase, Phase::Hold);
}

void TestNeverMoves::reopenedSessionNeedsGuardsForASecondAndANewArm()
{
    auto run = in(Phase::Verifying);
    run.feed(robot(RobotState::Ready, permit + 1));
    run.feed(guards(true, true));
    run.wait(999ms);
    run.feed(guards(true, true));
    QCOMPARE(run.state.phase, Phase::Verifying);
    run.feed(guards(false, true)); // the second starts anew
    run.wait(999ms);
    run.feed(guards(true, true));
    run.wait(999ms);
    run.feed(Kind::Tick);
    QCOMPARE(run.state.phase, Phase::Verifying);
    run.wait(1ms);
    run.feed(Kind::Tick);
    QCOMPARE(run.state.phase, Phase::Standby);
    run.feed(guards(true, true));
    QCOMPARE(run.state.phase, Phase::Ready);
    run.feed(Kind::DeadManPressed);
    QCOMPARE(run.state.stream(), MotionStream::None);
}

/// Seeded walks through the machine: whenever it streams motion, the whole way lies behind it since the last thing that ends motion.
void TestNeverMoves::nothingButTheWholeWayLeadsToMotion()
{
    std::uint32_t seed = 12345;
    const auto next = [&seed](std::uint32_t below) {
        seed = seed * 1664525U + 1013904223U;
        return (seed >> 8U) % below;
    };
    int engagements = 0;
    for (int walk = 0; walk < 5000; ++walk) {
        Run run;
        bool armHeldInFull = false, robotArmed = false, releasedSince = false;
        for (int move = 0; move < 200; ++move) {
            run.wait(std::chrono::milliseconds(next(600)));
            auto e = told(static_cast<Kind>(next(permitEventCount)));
            if (e.kind == Kind::RobotReported) {
                constexpr std::array states{RobotState::Ready, RobotState::Armed, RobotState::Engaged, RobotState::Hold};
                e.robot = states.at(next(4));
                e.own = next(8) != 0;
                if (run.state.phase == Phase::Arming && !run.state.awaitingRobot && next(4) != 0)
                    e.robot = RobotState::Ready; // or few would get farther
                e.permit = next(8) == 0 ? permit + next(3) : run.state.robotPermit == 0 ? permit : run.state.robotPermit;
            }
            if (e.kind == Kind::GuardsChecked && next(20) == 0)
                e.kept.reset();
            // Ends of motion are rare, or no walk would get anywhere.
            if ((e.kind <= Kind::SystemStandsBy && e.kind != Kind::SessionOpen) || e.kind == Kind::PanicHold || e.kind == Kind::Stalled ||
                e.kind == Kind::GateClosed || e.kind == Kind::ArmReleased)
                if (next(8) != 0)
                    continue;
            const auto before = run.state;
            const auto actions = run.feed(e);
            const auto phase = run.state.phase;
            if (phase != Phase::Arming && phase != Phase::Armed && phase != Phase::Engaged)
                armHeldInFull = robotArmed = releasedSince = false;
            if (actions.requestArm) {
                armHeldInFull = true;
                QVERIFY(run.now - before.since >= 1500ms);
            }
            if (phase == Phase::Armed && before.phase == Phase::Arming) {
                QVERIFY(armHeldInFull);
                QVERIFY(e.kind == Kind::RobotReported && e.robot == RobotState::Armed && e.own && e.permit == run.state.permit);
                robotArmed = true;
                releasedSince = !run.state.deadMan;
            }
            if (e.kind == Kind::DeadManReleased)
                releasedSince = robotArmed;
            if (phase == Phase::Engaged && before.phase != Phase::Engaged) {
                QVERIFY(armHeldInFull && robotArmed && releasedSince);
                QCOMPARE(e.kind, Kind::DeadManPressed);
                ++engagements;
            }
            if (run.state.stream() == MotionStream::Motion)
                QVERIFY(run.state.deadMan && run.state.permit != 0);
        }
    }
    QVERIFY2(engagements > 20, qPrintable(QString::number(engagements)));
}

QTEST_GUILESS_MAIN(TestNeverMoves)
#include "test_never_moves.moc"
