// The motion permit: every phase against every event, and the way to motion.
#include "permit_run.hpp"

#include <QTest>

using namespace permit_run;

class TestMotionPermit : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void leavesEveryPhaseAsTheTableSays_data();
    void leavesEveryPhaseAsTheTableSays();
    void leavesEveryPhaseWhenGuardsFail_data();
    void leavesEveryPhaseWhenGuardsFail();
    void armsOnlyAfterTheButtonWasHeldInFull();
    void asksForTheReportedPermitOnce();
    void staysUnarmedWhenTheRobotAnswersForAnotherPermit();
    void givesUpWhenTheRobotDoesNotAnswer();
    void armsOnlyWhenTheRobotNamesThisConsole_data();
    void armsOnlyWhenTheRobotNamesThisConsole();
    void endsAHoldWhenAnotherConsoleHasTheRobot_data();
    void endsAHoldWhenAnotherConsoleHasTheRobot();
    void endsArmingAtOnceWhenTheRobotIsReadyNoMore();
    void sendsNothingBeforeArmedAndZeroThere();
    void engagesOnlyOnAPressAfterARelease();
    void rezeroesOnEachEngage();
    void returnsToArmedWhenTheDeadManIsReleased();
    void givesThePermitBackWhenUnused();
    void holdsWhenTheGateRefusesItsPermit();
    void stopsWhenTheRobotWithdraws_data();
    void stopsWhenTheRobotWithdraws();
};

void TestMotionPermit::leavesEveryPhaseAsTheTableSays_data()
{
    QTest::addColumn<Phase>("phase");
    QTest::addColumn<Kind>("kind");
    QTest::addColumn<Phase>("expected");
    // Columns in the order of PermitEventKind: closed, open, interrupted, stand-by, guards all met, ARM down, ARM up, dead-man down, up,
    // robot ready with the same permit, panic, stalled, gate closed under this permit, tick after the ARM hold's time.
    using Row = std::array<Phase, permitEventCount>;
    constexpr auto O = Phase::Off, S = Phase::Standby, R = Phase::Ready, G = Phase::Arming, A = Phase::Armed, E = Phase::Engaged,
                   H = Phase::Hold, I = Phase::Incident, V = Phase::Verifying;
    const std::array<Row, permitPhaseCount> table{{
        {O, S, O, I, O, O, O, O, O, O, O, O, O, O}, // Off
        {O, S, S, I, R, S, S, S, S, S, S, S, S, S}, // Standby
        {O, R, S, I, R, G, R, S, R, R, R, R, R, R}, // Ready
        {O, G, H, I, G, G, R, S, G, G, S, S, G, G}, // Arming
        {O, A, H, I, A, A, A, E, A, H, H, H, H, A}, // Armed
        {O, E, H, I, E, E, E, E, A, H, H, H, H, E}, // Engaged
        {O, H, H, I, H, H, H, H, H, H, H, H, H, H}, // Hold
        {O, V, I, I, I, I, I, I, I, I, I, I, I, I}, // Incident
        {O, V, V, I, V, V, V, V, V, V, V, V, V, V}, // Verifying
    }};
    for (int phase = 0; phase < permitPhaseCount; ++phase)
        for (int kind = 0; kind < permitEventCount; ++kind)
            QTest::addRow("%s, event %d", qPrintable(word(static_cast<Phase>(phase))), kind)
                << static_cast<Phase>(phase) << static_cast<Kind>(kind) << table.at(std::size_t(phase)).at(std::size_t(kind));
}

void TestMotionPermit::leavesEveryPhaseAsTheTableSays()
{
    QFETCH(Phase, phase);
    QFETCH(Kind, kind);
    QFETCH(Phase, expected);
    auto run = in(phase);
    QCOMPARE(run.state.phase, phase);
    if (kind == Kind::Tick)
        run.wait(1500ms);
    run.feed(kind);
    QCOMPARE(run.state.phase, expected);
}

void TestMotionPermit::leavesEveryPhaseWhenGuardsFail_data()
{
    QTest::addColumn<Phase>("phase");
    QTest::addColumn<bool>("kept");
    QTest::addColumn<Phase>("expected");
    for (const auto phase : allPhases) {
        auto armableOnly = phase;
        if (phase == Phase::Ready || phase == Phase::Arming)
            armableOnly = Phase::Standby;
        auto keptToo = armableOnly;
        if (phase == Phase::Armed || phase == Phase::Engaged)
            keptToo = Phase::Hold;
        QTest::addRow("%s, a guard to arm fails", qPrintable(word(phase))) << phase << true << armableOnly;
        QTest::addRow("%s, a kept guard fails", qPrintable(word(phase))) << phase << false << keptToo;
    }
}

void TestMotionPermit::leavesEveryPhaseWhenGuardsFail()
{
    QFETCH(Phase, phase);
    QFETCH(bool, kept);
    QFETCH(Phase, expected);
    auto run = in(phase);
    run.feed(guards(false, kept));
    QCOMPARE(run.state.phase, expected);
    if (expected == Phase::Hold && phase != Phase::Hold)
        QCOMPARE(run.state.cause, HoldCause::GuardFailed);
}

void TestMotionPermit::armsOnlyAfterTheButtonWasHeldInFull()
{
    auto run = in(Phase::Arming);
    run.wait(1499ms);
    QVERIFY(!run.feed(Kind::Tick).requestArm);
    QVERIFY(run.state.armProgress(run.now) > 0.99);
    run.feed(Kind::ArmReleased);
    QCOMPARE(run.state.phase, Phase::Ready);
    run.wait(10s);
    QVERIFY(!run.feed(Kind::Tick).requestArm);
    // A second press starts from the beginning.
    run.feed(Kind::ArmPressed);
    run.wait(1400ms);
    QVERIFY(!run.feed(Kind::Tick).requestArm);
    run.wait(100ms);
    QVERIFY(run.feed(Kind::Tick).requestArm);
}

void TestMotionPermit::asksForTheReportedPermitOnce()
{
    Run run;
    run.ask();
    QVERIFY(run.last.requestArm);
    QCOMPARE(run.last.permit, permit);
    run.wait(10ms);
    QCOMPARE(run.feed(Kind::Tick), PermitActions{});
}

void TestMotionPermit::staysUnarmedWhenTheRobotAnswersForAnotherPermit()
{
    Run run;
    run.ask();
    run.feed(robot(RobotState::Armed, permit + 1));
    QCOMPARE(run.state.phase, Phase::Hold);
    QCOMPARE(run.state.cause, HoldCause::RobotWithdrew);
}

void TestMotionPermit::givesUpWhenTheRobotDoesNotAnswer()
{
    Run run;
    run.ask();
    run.wait(999ms);
    run.feed(Kind::Tick);
    QCOMPARE(run.state.phase, Phase::Arming);
    run.wait(1ms);
    QVERIFY(run.feed(Kind::Tick).release);
    QCOMPARE(run.state.phase, Phase::Hold);
    QCOMPARE(run.state.cause, HoldCause::ArmTimedOut);
    // An answer that comes too late arms nothing.
    run.feed(robot(RobotState::Armed));
    QCOMPARE(run.state.phase, Phase::Hold);
    // The permit was never used, so it stays good.
    run.feed(robot(RobotState::Ready));
    QCOMPARE(run.state.phase, Phase::Standby);
}

void TestMotionPermit::armsOnlyWhenTheRobotNamesThisConsole_data()
{
    QTest::addColumn<RobotState>("state");
    QTest::newRow("armed") << RobotState::Armed;
    QTest::newRow("engaged") << RobotState::Engaged;
}

/// Two consoles asked for the same permit at the same moment, and the robot took the other one.
void TestMotionPermit::armsOnlyWhenTheRobotNamesThisConsole()
{
    QFETCH(RobotState, state);
    Run run;
    run.ask();
    run.feed(robotOfAnother(state));
    QCOMPARE(run.state.phase, Phase::Standby);
    QCOMPARE(run.state.permit, 0U);
    run.feed(Kind::DeadManPressed);
    run.feed(robotOfAnother(state));
    QCOMPARE(run.state.stream(), MotionStream::None);
    QCOMPARE(run.state.phase, Phase::Standby);
}

void TestMotionPermit::endsAHoldWhenAnotherConsoleHasTheRobot_data() { armsOnlyWhenTheRobotNamesThisConsole_data(); }

/// It holds no more as long as that one works with it.
void TestMotionPermit::endsAHoldWhenAnotherConsoleHasTheRobot()
{
    QFETCH(RobotState, state);
    auto run = in(Phase::Hold);
    auto report = robotOfAnother(state);
    run.feed(report);
    run.feed(Kind::DeadManReleased);
    QCOMPARE(run.state.phase, Phase::Hold); // under the permit that this console has spent
    report.permit = permit + 1;
    report.own = true;
    run.feed(report);
    QCOMPARE(run.state.phase, Phase::Hold);
    run.feed(Kind::DeadManPressed);
    report.own = false;
    run.feed(report);
    QCOMPARE(run.state.phase, Phase::Hold); // the dead-man is down
    run.feed(Kind::DeadManReleased);
    QCOMPARE(run.state.phase, Phase::Standby);
    run.feed(Kind::DeadManPressed);
    QCOMPARE(run.state.stream(), MotionStream::None);
}

/// The ARM hold may be full before the next look at the guards.
void TestMotionPermit::endsArmingAtOnceWhenTheRobotIsReadyNoMore()
{
    Run run;
    run.hold();
    run.wait(1490ms);
    run.feed(robotOfAnother(RobotState::Armed));
    QCOMPARE(run.state.phase, Phase::Standby);
    run.wait(10ms);
    QVERIFY(!run.feed(Kind::Tick).requestArm);
}

void TestMotionPermit::sendsNothingBeforeArmedAndZeroThere()
{
    for (const auto phase : allPhases) {
        const auto stream = in(phase).state.stream();
        const auto expected = phase == Phase::Engaged ? MotionStream::Motion
                              : phase == Phase::Armed ? MotionStream::Zero
                                                      : MotionStream::None;
        QVERIFY2(stream == expected, qPrintable(word(phase)));
    }
}

void TestMotionPermit::engagesOnlyOnAPressAfterARelease()
{
    Run run;
    run.ask();
    run.feed(Kind::DeadManPressed);
    run.feed(robot(RobotState::Armed));
    QCOMPARE(run.state.phase, Phase::Armed);
    run.feed(Kind::DeadManPressed);
    QCOMPARE(run.state.phase, Phase::Armed);
    run.feed(Kind::DeadManReleased);
    QCOMPARE(run.state.phase, Phase::Armed);
    run.feed(Kind::DeadManPressed);
    QCOMPARE(run.state.phase, Phase::Engaged);
}

void TestMotionPermit::rezeroesOnEachEngage()
{
    auto run = in(Phase::Armed);
    QVERIFY(run.feed(Kind::DeadManPressed).rezero);
    QCOMPARE(run.state.engagement, 1U);
    QVERIFY(!run.feed(Kind::DeadManReleased).rezero);
    QVERIFY(run.feed(Kind::DeadManPressed).rezero);
    QCOMPARE(run.state.engagement, 2U);
}

void TestMotionPermit::returnsToArmedWhenTheDeadManIsReleased()
{
    auto run = in(Phase::Engaged);
    QVERIFY(!run.feed(Kind::DeadManReleased).release);
    QCOMPARE(run.state.phase, Phase::Armed);
    QCOMPARE(run.state.permit, permit);
}

void TestMotionPermit::givesThePermitBackWhenUnused()
{
    auto run = in(Phase::Armed);
    run.wait(119s);
    run.feed(Kind::Tick);
    QCOMPARE(run.state.phase, Phase::Armed);
    run.wait(1s);
    const auto actions = run.feed(Kind::Tick);
    QVERIFY(actions.release);
    QCOMPARE(actions.permit, permit);
    QCOMPARE(run.state.phase, Phase::Ready);
    QCOMPARE(run.state.spentPermit, std::optional<quint32>(permit));
}

/// What the gate refuses nobody may go on calling engaged; a permit that is spent tells nothing of the present one.
void TestMotionPermit::holdsWhenTheGateRefusesItsPermit()
{
    for (const auto phase : {Phase::Armed, Phase::Engaged}) {
        auto run = in(phase);
        auto closed = told(Kind::GateClosed);
        closed.permit = run.state.permit + 1;
        run.feed(closed);
        QCOMPARE(run.state.phase, phase);
        closed.permit = run.state.permit;
        run.feed(closed);
        QCOMPARE(run.state.phase, Phase::Hold);
        QCOMPARE(run.state.cause, HoldCause::GateClosed);
    }
}

void TestMotionPermit::stopsWhenTheRobotWithdraws_data()
{
    QTest::addColumn<Phase>("phase");
    QTest::addColumn<RobotState>("state");
    QTest::addColumn<quint32>("number");
    QTest::addColumn<bool>("own");
    for (const auto phase : {Phase::Armed, Phase::Engaged}) {
        for (const auto state : {RobotState::Off, RobotState::Hold, RobotState::Ready, RobotState::EmergencyStop, RobotState::Fault})
            QTest::addRow("%s, robot %s", qPrintable(word(phase)), qPrintable(word(state))) << phase << state << permit << true;
        QTest::addRow("%s, robot under another permit", qPrintable(word(phase))) << phase << RobotState::Engaged << permit + 1 << true;
        QTest::addRow("%s, robot of another console", qPrintable(word(phase))) << phase << RobotState::Engaged << permit << false;
    }
}

void TestMotionPermit::stopsWhenTheRobotWithdraws()
{
    QFETCH(Phase, phase);
    QFETCH(RobotState, state);
    QFETCH(quint32, number);
    QFETCH(bool, own);
    auto run = in(phase);
    auto report = robot(state, number);
    report.own = own;
    const auto actions = run.feed(report);
    QCOMPARE(run.state.phase, Phase::Hold);
    QCOMPARE(run.state.cause, HoldCause::RobotWithdrew);
    QVERIFY(actions.release);
    QCOMPARE(actions.permit, permit);
}

QTEST_GUILESS_MAIN(TestMotionPermit)
#include "test_motion_permit.moc"
