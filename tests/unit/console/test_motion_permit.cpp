// The motion permit: every phase against every event, and what must never be possible.
#include "model/motion_permit.hpp"

#include <QTest>

using namespace console;
using namespace std::chrono_literals;
using Kind = PermitEventKind;
using Phase = PermitPhase;

namespace {

constexpr quint32 permit = 7;
const Instant start = Instant{} + 1h;

GuardSet all() { return ~GuardSet{}; }

PermitEvent told(Kind kind)
{
    PermitEvent e;
    e.kind = kind;
    e.armable = all();
    e.kept = all();
    e.robot = RobotState::Ready;
    e.holdConfirmed = true;
    e.permit = permit;
    return e;
}

PermitEvent robot(RobotState state, quint32 number = permit, bool confirmed = true)
{
    auto e = told(Kind::RobotReported);
    e.robot = state;
    e.permit = number;
    e.holdConfirmed = confirmed;
    return e;
}

PermitEvent guards(bool armable, bool kept)
{
    auto e = told(Kind::GuardsChecked);
    e.armable = armable ? all() : GuardSet{};
    e.kept = kept ? all() : GuardSet{};
    return e;
}

/// Drives the machine as its caller does, and keeps what was asked for.
struct Run {
    PermitState state;
    PermitActions last;
    Instant now = start;

    PermitActions feed(const PermitEvent& e)
    {
        const auto next = step(state, e, now);
        state = next.state;
        last = next.actions;
        return last;
    }
    PermitActions feed(Kind kind) { return feed(told(kind)); }
    void wait(Duration duration) { now += duration; }

    void openSession()
    {
        feed(Kind::SessionOpen);
        feed(robot(RobotState::Ready));
    }
    void makeReady()
    {
        openSession();
        feed(guards(true, true));
    }
    void hold()
    {
        makeReady();
        feed(Kind::ArmPressed);
    }
    void ask()
    {
        hold();
        wait(1500ms);
        feed(Kind::Tick);
    }
    void arm()
    {
        ask();
        feed(robot(RobotState::Armed));
    }
    void engage()
    {
        arm();
        feed(Kind::DeadManPressed);
    }
    void fallIntoHold()
    {
        engage();
        feed(Kind::PanicHold);
    }
    void standBy()
    {
        engage();
        feed(Kind::SystemStandsBy);
    }
    void verify()
    {
        standBy();
        feed(Kind::DeadManReleased);
        feed(Kind::SessionOpen);
    }
};

Run in(Phase phase)
{
    Run run;
    switch (phase) {
    case Phase::Off:
        break;
    case Phase::Standby:
        run.openSession();
        break;
    case Phase::Ready:
        run.makeReady();
        break;
    case Phase::Arming:
        run.hold();
        break;
    case Phase::Armed:
        run.arm();
        break;
    case Phase::Engaged:
        run.engage();
        break;
    case Phase::Hold:
        run.fallIntoHold();
        break;
    case Phase::Incident:
        run.standBy();
        break;
    case Phase::Verifying:
        run.verify();
        break;
    }
    return run;
}

const std::array allPhases{Phase::Off,     Phase::Standby, Phase::Ready,    Phase::Arming,   Phase::Armed,
                           Phase::Engaged, Phase::Hold,    Phase::Incident, Phase::Verifying};

} // namespace

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
    void sendsNothingBeforeArmedAndZeroThere();
    void engagesOnlyOnAPressAfterARelease();
    void rezeroesOnEachEngage();
    void returnsToArmedWhenTheDeadManIsReleased();
    void givesThePermitBackWhenUnused();
    void stopsWhenTheRobotWithdraws_data();
    void stopsWhenTheRobotWithdraws();

    void healedInterruptionGivesNothingBack();
    void holdEndsOnlyWithRobotsWordAndReleasedDeadMan();
    void holdDoesNotEndUnderTheSpentPermit();
    void reopenedSessionNeedsGuardsForASecondAndANewArm();
    void nothingButTheWholeWayLeadsToMotion();
};

void TestMotionPermit::leavesEveryPhaseAsTheTableSays_data()
{
    QTest::addColumn<Phase>("phase");
    QTest::addColumn<Kind>("kind");
    QTest::addColumn<Phase>("expected");
    // Columns in the order of PermitEventKind: closed, open, interrupted, stand-by, guards all met, ARM down, ARM up, dead-man down, up,
    // robot ready with the same permit, panic, stalled, tick after the ARM hold's time.
    using Row = std::array<Phase, permitEventCount>;
    constexpr auto O = Phase::Off, S = Phase::Standby, R = Phase::Ready, G = Phase::Arming, A = Phase::Armed, E = Phase::Engaged,
                   H = Phase::Hold, I = Phase::Incident, V = Phase::Verifying;
    const std::array<Row, permitPhaseCount> table{{
        {O, S, O, I, O, O, O, O, O, O, O, O, O}, // Off
        {O, S, S, I, R, S, S, S, S, S, S, S, S}, // Standby
        {O, R, S, I, R, G, R, S, R, R, R, R, R}, // Ready
        {O, G, H, I, G, G, R, S, G, G, S, S, G}, // Arming
        {O, A, H, I, A, A, A, E, A, H, H, H, A}, // Armed
        {O, E, H, I, E, E, E, E, A, H, H, H, E}, // Engaged
        {O, H, H, I, H, H, H, H, H, H, H, H, H}, // Hold
        {O, V, I, I, I, I, I, I, I, I, I, I, I}, // Incident
        {O, V, V, I, V, V, V, V, V, V, V, V, V}, // Verifying
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

void TestMotionPermit::stopsWhenTheRobotWithdraws_data()
{
    QTest::addColumn<Phase>("phase");
    QTest::addColumn<RobotState>("state");
    QTest::addColumn<quint32>("number");
    for (const auto phase : {Phase::Armed, Phase::Engaged}) {
        for (const auto state : {RobotState::Off, RobotState::Hold, RobotState::Ready, RobotState::EmergencyStop, RobotState::Fault})
            QTest::addRow("%s, robot %s", qPrintable(word(phase)), qPrintable(word(state))) << phase << state << permit;
        QTest::addRow("%s, robot under another permit", qPrintable(word(phase))) << phase << RobotState::Engaged << permit + 1;
    }
}

void TestMotionPermit::stopsWhenTheRobotWithdraws()
{
    QFETCH(Phase, phase);
    QFETCH(RobotState, state);
    QFETCH(quint32, number);
    auto run = in(phase);
    const auto actions = run.feed(robot(state, number));
    QCOMPARE(run.state.phase, Phase::Hold);
    QCOMPARE(run.state.cause, HoldCause::RobotWithdrew);
    QVERIFY(actions.release);
    QCOMPARE(actions.permit, permit);
}

void TestMotionPermit::healedInterruptionGivesNothingBack()
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

void TestMotionPermit::holdEndsOnlyWithRobotsWordAndReleasedDeadMan()
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

void TestMotionPermit::holdDoesNotEndUnderTheSpentPermit()
{
    auto run = in(Phase::Hold);
    run.feed(Kind::DeadManReleased);
    run.feed(robot(RobotState::Hold, permit, true));
    QCOMPARE(run.state.phase, Phase::Hold);
}

void TestMotionPermit::reopenedSessionNeedsGuardsForASecondAndANewArm()
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
void TestMotionPermit::nothingButTheWholeWayLeadsToMotion()
{
    std::uint32_t seed = 12345;
    const auto next = [&seed](std::uint32_t below) {
        seed = seed * 1664525U + 1013904223U;
        return (seed >> 8U) % below;
    };
    int engagements = 0;
    for (int walk = 0; walk < 3000; ++walk) {
        Run run;
        bool armHeldInFull = false, robotArmed = false, releasedSince = false;
        for (int move = 0; move < 200; ++move) {
            run.wait(std::chrono::milliseconds(next(600)));
            auto e = told(static_cast<Kind>(next(permitEventCount)));
            if (e.kind == Kind::RobotReported) {
                constexpr std::array states{RobotState::Ready, RobotState::Armed, RobotState::Engaged, RobotState::Hold};
                e.robot = states.at(next(4));
                e.permit = next(8) == 0 ? permit + next(3) : run.state.robotPermit == 0 ? permit : run.state.robotPermit;
            }
            if (e.kind == Kind::GuardsChecked && next(20) == 0)
                e.kept.reset();
            // Ends of motion are rare, or no walk would get anywhere.
            if ((e.kind <= Kind::SystemStandsBy && e.kind != Kind::SessionOpen) || e.kind == Kind::PanicHold || e.kind == Kind::Stalled ||
                e.kind == Kind::ArmReleased)
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
                QVERIFY(e.kind == Kind::RobotReported && e.robot == RobotState::Armed && e.permit == run.state.permit);
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

QTEST_GUILESS_MAIN(TestMotionPermit)
#include "test_motion_permit.moc"
