// The robot's state machine: every state against every event, and the ways that lead to motion.
#include "robot_machine.hpp"

#include <QTest>

using namespace liena;
using namespace liena::devices;
using namespace std::chrono_literals;

namespace {

const DeviceId cockpit(0x40018208);
const DeviceId otherCockpit(0x40018209);
const DeviceId arm(0x60008208);
const SteadyTime start{1h};
constexpr std::uint64_t stopToken = 77;

struct Robot {
    RobotMachine machine{100};
    SteadyTime now = start;
    std::uint32_t sequence = 0;

    RobotActions give(const RobotEvent& event) { return machine.handle(event, now); }
    RobotActions motion(bool engaged, double velocity = 0, DeviceId origin = cockpit)
    {
        return give(MotionCommanded{origin, machine.permit(), ++sequence, engaged, {velocity, 0, 0, 0}});
    }
    RobotActions arm(DeviceId origin = cockpit) { return give(ArmRequested{origin, machine.permit()}); }

    void wait(std::chrono::nanoseconds duration)
    {
        now += duration;
        give(Ticked{});
    }

    void bring(RobotState state)
    {
        if (state == RobotState::Off)
            return;
        give(SwitchedOn{});
        if (state == RobotState::Hold)
            return;
        give(SessionOpened{cockpit});
        wait(RobotMachine::leastHold);
        if (state == RobotState::EmergencyStop)
            give(EmergencyStopCommanded{cockpit, stopToken});
        if (state == RobotState::Fault)
            give(DrivesChecked{false, true});
        if (state == RobotState::Armed || state == RobotState::Engaged) {
            arm();
            motion(false);
        }
        if (state == RobotState::Engaged)
            motion(true, 5);
    }
};

QByteArray name(RobotState state)
{
    const auto text = toString(state);
    return QByteArray(text.data(), static_cast<qsizetype>(text.size()));
}

RobotState by(const char* name)
{
    for (const auto state : {RobotState::Off, RobotState::Hold, RobotState::Ready, RobotState::Armed, RobotState::Engaged,
                             RobotState::EmergencyStop, RobotState::Fault})
        if (toString(state) == name)
            return state;
    qFatal("no state %s", name);
}

} // namespace

Q_DECLARE_METATYPE(liena::devices::RobotState)

class RobotMachineTest : public QObject {
    Q_OBJECT

    // The event by its name in the table, for a robot that stands in some state.
    static RobotEvent event(const QString& name, const Robot& robot)
    {
        const std::uint32_t permit = robot.machine.permit();
        if (name == "arm")
            return ArmRequested{cockpit, permit};
        if (name == "arm by another")
            return ArmRequested{otherCockpit, permit};
        if (name == "arm, old permit")
            return ArmRequested{cockpit, permit - 1};
        if (name == "release")
            return ReleaseRequested{cockpit, permit};
        if (name == "neutral")
            return MotionCommanded{cockpit, permit, 1000, false, {}};
        if (name == "engaged")
            return MotionCommanded{cockpit, permit, 1000, true, {5, 0, 0, 0}};
        if (name == "engaged, old permit")
            return MotionCommanded{cockpit, permit - 1, 1000, true, {5, 0, 0, 0}};
        if (name == "engaged by another")
            return MotionCommanded{otherCockpit, permit, 1000, true, {5, 0, 0, 0}};
        if (name == "emergency stop")
            return EmergencyStopCommanded{cockpit, stopToken};
        if (name == "reset")
            return ResetCommanded{cockpit, stopToken};
        if (name == "reset, wrong token")
            return ResetCommanded{cockpit, stopToken + 1};
        if (name == "cockpit lost")
            return SessionLost{cockpit};
        if (name == "cockpit's session over")
            return SessionLost{cockpit, true};
        if (name == "arm's session over")
            return SessionLost{::arm, true};
        if (name == "arm lost")
            return SessionLost{::arm};
        if (name == "stand-by")
            return StandByBegan{};
        if (name == "stall")
            return ProcessStalled{};
        if (name == "force stop")
            return GateStopped{StopCause::ForceStop};
        if (name == "drive fault")
            return DrivesChecked{false, true};
        if (name == "drives well")
            return DrivesChecked{true, true};
        qFatal("no event");
    }

private slots:
    void answersEveryEventInEveryState_data()
    {
        QTest::addColumn<RobotState>("state");
        QTest::addColumn<QString>("given");
        QTest::addColumn<RobotState>("expected");
        QTest::addColumn<bool>("accepted");
        struct Row {
            const char* event;
            const char* results[7]; // Off Hold Ready Armed Engaged EmergencyStop Fault; a leading '-' means refused
        };
        const Row rows[] = {
            {"arm", {"-Off", "-Hold", "Armed", "-Armed", "-Engaged", "-EmergencyStop", "-Fault"}},
            {"arm by another", {"-Off", "-Hold", "-Ready", "-Armed", "-Engaged", "-EmergencyStop", "-Fault"}},
            {"arm, old permit", {"-Off", "-Hold", "-Ready", "-Armed", "-Engaged", "-EmergencyStop", "-Fault"}},
            {"release", {"-Off", "-Hold", "-Ready", "Hold", "Hold", "-EmergencyStop", "-Fault"}},
            {"neutral", {"-Off", "-Hold", "-Ready", "Armed", "Armed", "-EmergencyStop", "-Fault"}},
            {"engaged", {"-Off", "-Hold", "-Ready", "Engaged", "Engaged", "-EmergencyStop", "-Fault"}},
            {"engaged, old permit", {"-Off", "-Hold", "-Ready", "-Hold", "-Hold", "-EmergencyStop", "-Fault"}},
            {"engaged by another", {"-Off", "-Hold", "-Ready", "-Armed", "-Engaged", "-EmergencyStop", "-Fault"}},
            {"emergency stop",
             {"EmergencyStop", "EmergencyStop", "EmergencyStop", "EmergencyStop", "EmergencyStop", "EmergencyStop", "EmergencyStop"}},
            {"reset", {"-Off", "-Hold", "-Ready", "-Armed", "-Engaged", "Hold", "-Fault"}},
            {"reset, wrong token", {"-Off", "-Hold", "-Ready", "-Armed", "-Engaged", "-EmergencyStop", "-Fault"}},
            {"cockpit lost", {"Off", "Hold", "Hold", "Hold", "Hold", "EmergencyStop", "Fault"}},
            {"arm lost", {"Off", "Hold", "Ready", "Armed", "Engaged", "EmergencyStop", "Fault"}},
            {"stand-by", {"Off", "Hold", "Hold", "Hold", "Hold", "EmergencyStop", "Fault"}},
            {"stall", {"Off", "Hold", "Ready", "Hold", "Hold", "EmergencyStop", "Fault"}},
            {"force stop", {"Off", "Hold", "Ready", "Hold", "Hold", "EmergencyStop", "Fault"}},
            {"drive fault", {"Off", "Fault", "Fault", "Fault", "Fault", "EmergencyStop", "Fault"}},
            {"drives well", {"Off", "Hold", "Ready", "Armed", "Engaged", "EmergencyStop", "Hold"}},
        };
        const char* states[] = {"Off", "Hold", "Ready", "Armed", "Engaged", "EmergencyStop", "Fault"};
        for (const Row& row : rows)
            for (int index = 0; index < 7; ++index) {
                const char* result = row.results[index];
                const bool refused = result[0] == '-';
                QTest::addRow("%s in %s", row.event, states[index])
                    << by(states[index]) << QString(row.event) << by(refused ? result + 1 : result) << !refused;
            }
    }

    void answersEveryEventInEveryState()
    {
        QFETCH(RobotState, state);
        QFETCH(QString, given);
        QFETCH(RobotState, expected);
        QFETCH(bool, accepted);
        Robot robot;
        robot.bring(state);
        QCOMPARE(name(robot.machine.state()), name(state));
        const std::uint32_t permit = robot.machine.permit();
        const std::uint64_t refused = robot.machine.refusedCommands();
        const RobotActions actions = robot.give(event(given, robot));
        QCOMPARE(name(robot.machine.state()), name(expected));
        QCOMPARE(actions.accepted, accepted);
        QCOMPARE(robot.machine.refusedCommands(), refused + (accepted ? 0 : 1));
        // A new permit at each entry into Hold, and at no other time.
        const bool enteredHold = expected == RobotState::Hold && state != RobotState::Hold;
        const bool throughHold = expected == RobotState::Fault && state != RobotState::Fault;
        QCOMPARE(robot.machine.permit() != permit, enteredHold || throughHold);
        if (enteredHold) {
            QVERIFY(actions.revokeControl);
            QVERIFY(actions.stopInjection);
            QVERIFY(actions.drives == RobotActions::Drives::Stop);
        }
        const bool drives = actions.drives == RobotActions::Drives::Drive;
        QCOMPARE(drives, expected == RobotState::Engaged && given == "engaged");
    }

    void firstCommandMustBeNeutral()
    {
        Robot robot;
        robot.bring(RobotState::Ready);
        robot.arm();
        QVERIFY(!robot.motion(true, 5).accepted);
        QVERIFY(!robot.motion(true, 0).accepted);
        QVERIFY(!robot.motion(false, 5).accepted);
        QCOMPARE(name(robot.machine.state()), name(RobotState::Armed));
        QVERIFY(robot.motion(false).accepted);
        QVERIFY(robot.motion(true, 5).accepted);
        QCOMPARE(name(robot.machine.state()), name(RobotState::Engaged));
    }

    void afterAHoldEverythingBeginsAgain()
    {
        Robot robot;
        robot.bring(RobotState::Engaged);
        robot.give(SessionLost{cockpit});
        robot.give(SessionOpened{cockpit});
        robot.wait(RobotMachine::leastHold);
        QCOMPARE(name(robot.machine.state()), name(RobotState::Ready));
        QVERIFY(!robot.motion(true, 5).accepted);
        QVERIFY(robot.arm().accepted);
        QVERIFY(!robot.motion(true, 5).accepted); // the dead-man that is still held
        QCOMPARE(name(robot.machine.state()), name(RobotState::Armed));
    }

    void silenceEndsInHold()
    {
        Robot robot;
        robot.bring(RobotState::Engaged);
        robot.wait(50ms);
        QCOMPARE(name(robot.machine.state()), name(RobotState::Engaged));
        robot.wait(1ms);
        QCOMPARE(name(robot.machine.state()), name(RobotState::Hold));
        QCOMPARE(robot.machine.fault(), RobotFault::CommandStreamLost);
    }

    void armedCockpitThatNeverCommandsLosesThePermit()
    {
        Robot robot;
        robot.bring(RobotState::Ready);
        robot.arm();
        robot.wait(RobotMachine::firstCommandWait);
        QCOMPARE(name(robot.machine.state()), name(RobotState::Armed));
        robot.wait(1ms);
        QCOMPARE(name(robot.machine.state()), name(RobotState::Hold));
    }

    void refusedCommandsDoNotBreakTheSilence()
    {
        Robot robot;
        robot.bring(RobotState::Engaged);
        for (int count = 0; count < 11; ++count) {
            robot.motion(true, 5, otherCockpit);
            robot.wait(5ms);
        }
        QCOMPARE(name(robot.machine.state()), name(RobotState::Hold));
    }

    void repeatedSequenceIsRefused()
    {
        Robot robot;
        robot.bring(RobotState::Engaged);
        --robot.sequence;
        QVERIFY(!robot.motion(true, 5).accepted);
        QVERIFY(robot.motion(true, 5).accepted);
    }

    void emergencyStopCutsAndRepeatsAreHarmless()
    {
        Robot robot;
        robot.bring(RobotState::Engaged);
        const RobotActions first = robot.give(EmergencyStopCommanded{cockpit, stopToken});
        QVERIFY(first.drives == RobotActions::Drives::Cut);
        QVERIFY(first.stopInjection);
        QCOMPARE(robot.machine.emergencyStopToken(), stopToken);
        robot.give(EmergencyStopCommanded{cockpit, stopToken});
        QVERIFY(robot.give(ResetCommanded{cockpit, stopToken}).accepted);
        QCOMPARE(name(robot.machine.state()), name(RobotState::Hold));
        QCOMPARE(robot.machine.emergencyStopToken(), 0U);
    }

    void everyStopNeedsItsOwnReset()
    {
        Robot robot;
        robot.bring(RobotState::Ready);
        robot.give(EmergencyStopCommanded{cockpit, 1});
        robot.give(EmergencyStopCommanded{otherCockpit, 2});
        QCOMPARE(robot.machine.emergencyStopToken(), 2U);
        robot.give(ResetCommanded{cockpit, 1});
        QCOMPARE(name(robot.machine.state()), name(RobotState::EmergencyStop));
        robot.give(ResetCommanded{cockpit, 2});
        QCOMPARE(name(robot.machine.state()), name(RobotState::Hold));
    }

    /// However often it was pressed: one reset ends it, and none that was sent before the last press.
    void aNewerStopTakesThePlaceOfTheLastFromThere()
    {
        Robot robot;
        robot.bring(RobotState::Ready);
        robot.give(EmergencyStopCommanded{cockpit, 1});
        robot.give(EmergencyStopCommanded{cockpit, 2});
        QVERIFY(!robot.give(ResetCommanded{cockpit, 1}).accepted);
        QCOMPARE(name(robot.machine.state()), name(RobotState::EmergencyStop));
        robot.give(ResetCommanded{cockpit, 2});
        QCOMPARE(name(robot.machine.state()), name(RobotState::Hold));
    }

    /// Of two that arrive between two reports only one is named; who was not named repeats, and is named then.
    void namesTheStopThatItHeardLast()
    {
        Robot robot;
        robot.bring(RobotState::Ready);
        robot.give(EmergencyStopCommanded{cockpit, 1});
        robot.give(EmergencyStopCommanded{otherCockpit, 2});
        robot.give(EmergencyStopCommanded{cockpit, 1});
        QCOMPARE(robot.machine.emergencyStopToken(), 1U);
        robot.give(ResetCommanded{cockpit, 1});
        QCOMPARE(robot.machine.emergencyStopToken(), 2U);
        QCOMPARE(name(robot.machine.state()), name(RobotState::EmergencyStop));
    }

    void onlyACockpitResets()
    {
        Robot robot;
        robot.bring(RobotState::EmergencyStop);
        QVERIFY(!robot.give(ResetCommanded{arm, stopToken}).accepted);
        QCOMPARE(name(robot.machine.state()), name(RobotState::EmergencyStop));
    }

    void stopGivenAgainAfterItsResetStopsAgain()
    {
        Robot robot;
        robot.bring(RobotState::EmergencyStop);
        robot.give(ResetCommanded{cockpit, stopToken});
        robot.give(EmergencyStopCommanded{cockpit, stopToken});
        QCOMPARE(name(robot.machine.state()), name(RobotState::EmergencyStop));
    }

    void onlyACockpitArms()
    {
        Robot robot;
        robot.bring(RobotState::Ready);
        robot.give(SessionOpened{arm});
        QVERIFY(!robot.arm(arm).accepted);
        QVERIFY(!robot.arm(otherCockpit).accepted); // not in session
        robot.give(SessionOpened{otherCockpit});
        QVERIFY(robot.arm(otherCockpit).accepted);
        QVERIFY(!robot.arm(cockpit).accepted);
    }

    void confirmsTheHoldWhenTheDrivesStand()
    {
        Robot robot;
        robot.bring(RobotState::Engaged);
        QVERIFY(!robot.machine.holdConfirmed());
        robot.give(DrivesChecked{true, false});
        QVERIFY(!robot.give(StandByBegan{}).confirmHold.has_value());
        QVERIFY(!robot.machine.holdConfirmed());
        QCOMPARE(robot.give(DrivesChecked{true, true}).confirmHold, std::optional(true));
        QVERIFY(robot.machine.holdConfirmed());
        robot.give(StandByEnded{});
        robot.wait(RobotMachine::leastHold);
        QCOMPARE(robot.arm().confirmHold, std::optional(false));
    }

    void isNotReadyBeforeTheDrivesStand()
    {
        Robot robot;
        robot.bring(RobotState::Engaged);
        robot.give(DrivesChecked{true, false});
        robot.give(ReleaseRequested{cockpit, robot.machine.permit()});
        robot.wait(1s);
        QCOMPARE(name(robot.machine.state()), name(RobotState::Hold));
        robot.give(DrivesChecked{true, true});
        QCOMPARE(name(robot.machine.state()), name(RobotState::Ready));
    }

    void grippersAreWorkedOnlyStanding()
    {
        Robot robot;
        robot.bring(RobotState::Armed);
        QVERIFY(robot.give(GripperCommanded{cockpit, robot.machine.permit()}).accepted);
        robot.motion(true, 5);
        QVERIFY(!robot.give(GripperCommanded{cockpit, robot.machine.permit()}).accepted);
    }

    void injectionNeedsThePermit()
    {
        Robot robot;
        robot.bring(RobotState::Ready);
        QVERIFY(!robot.give(InjectionCommanded{cockpit, robot.machine.permit()}).accepted);
        robot.arm();
        QVERIFY(!robot.give(InjectionCommanded{cockpit, robot.machine.permit() - 1}).accepted);
        QVERIFY(!robot.give(InjectionCommanded{otherCockpit, robot.machine.permit()}).accepted);
        QVERIFY(robot.give(InjectionCommanded{cockpit, robot.machine.permit()}).accepted);
    }

    // Two persons: the robot waits for the word of the one beside it.

    void isNotReadyBeforeTheSecondPersonSaysSo()
    {
        Robot robot;
        QCOMPARE(robot.machine.clearance(), Clearance::NotAsked);
        robot.machine = RobotMachine(100, ArmingRule::TwoPersons);
        robot.bring(RobotState::Ready);
        QCOMPARE(robot.machine.clearance(), Clearance::Awaited);
        QCOMPARE(name(robot.machine.state()), QByteArray("Hold"));
        const auto refused = robot.arm();
        QVERIFY(!refused.accepted);
        QVERIFY2(refused.reason.find("beside the robot") != std::string_view::npos, std::string(refused.reason).c_str());
        QVERIFY(robot.give(ClearanceSaid{true}).accepted);
        QCOMPARE(name(robot.machine.state()), QByteArray("Ready"));
        robot.arm();
        robot.motion(false);
        robot.motion(true, 5);
        QCOMPARE(name(robot.machine.state()), QByteArray("Engaged"));
    }

    void holdsWhenTheSecondPersonTakesTheWordBack_data()
    {
        QTest::addColumn<RobotState>("state");
        for (const auto state : {RobotState::Ready, RobotState::Armed, RobotState::Engaged})
            QTest::newRow(name(state).constData()) << state;
    }

    void holdsWhenTheSecondPersonTakesTheWordBack()
    {
        QFETCH(RobotState, state);
        Robot robot{RobotMachine(100, ArmingRule::TwoPersons)};
        robot.bring(RobotState::Hold);
        robot.give(SessionOpened{cockpit});
        QVERIFY(robot.give(ClearanceSaid{true}).accepted);
        robot.bring(state);
        QCOMPARE(name(robot.machine.state()), name(state));
        const auto permit = robot.machine.permit();
        robot.give(ClearanceSaid{false});
        QCOMPARE(name(robot.machine.state()), QByteArray("Hold"));
        QVERIFY(robot.machine.permit() != permit);
        robot.wait(1s);
        QCOMPARE(name(robot.machine.state()), QByteArray("Hold"));
        QVERIFY(!robot.arm().accepted);
    }

    void theWordEndsWithWhatItWasSaidOf_data()
    {
        QTest::addColumn<QString>("given");
        QTest::addColumn<bool>("ends");
        QTest::newRow("stand-by") << QStringLiteral("stand-by") << true;
        QTest::newRow("emergency stop") << QStringLiteral("emergency stop") << true;
        QTest::newRow("drive fault") << QStringLiteral("drive fault") << true;
        QTest::newRow("release") << QStringLiteral("release") << false;
        QTest::newRow("force stop") << QStringLiteral("force stop") << false;
        QTest::newRow("stall") << QStringLiteral("stall") << false;
        QTest::newRow("session interrupted") << QStringLiteral("cockpit lost") << false;
        QTest::newRow("session over") << QStringLiteral("cockpit's session over") << true;
        QTest::newRow("arm's session over") << QStringLiteral("arm's session over") << false;
    }

    void theWordEndsWithWhatItWasSaidOf()
    {
        QFETCH(QString, given);
        QFETCH(bool, ends);
        Robot robot{RobotMachine(100, ArmingRule::TwoPersons)};
        robot.bring(RobotState::Hold);
        robot.give(SessionOpened{cockpit});
        QVERIFY(robot.give(ClearanceSaid{true}).accepted);
        robot.bring(RobotState::Engaged);
        QCOMPARE(name(robot.machine.state()), QByteArray("Engaged"));
        robot.give(event(given, robot));
        QCOMPARE(robot.machine.clearance(), ends ? Clearance::Awaited : Clearance::Given);
    }

    void theWordIsNotTakenForARobotThatCannotBeArmed_data()
    {
        QTest::addColumn<RobotState>("state");
        for (const auto state : {RobotState::Off, RobotState::EmergencyStop, RobotState::Fault})
            QTest::newRow(name(state).constData()) << state;
    }

    void theWordIsNotTakenForARobotThatCannotBeArmed()
    {
        QFETCH(RobotState, state);
        Robot robot{RobotMachine(100, ArmingRule::TwoPersons)};
        robot.bring(state);
        QVERIFY(!robot.give(ClearanceSaid{true}).accepted);
        QCOMPARE(robot.machine.clearance(), Clearance::Awaited);

        Robot standing{RobotMachine(100, ArmingRule::TwoPersons)};
        standing.bring(RobotState::Hold);
        standing.give(StandByBegan{});
        QVERIFY(!standing.give(ClearanceSaid{true}).accepted);

        Robot alone{RobotMachine(100, ArmingRule::TwoPersons)};
        alone.bring(RobotState::Hold);
        QVERIFY(!alone.give(ClearanceSaid{true}).accepted); // nobody is in session who could arm
        QVERIFY(alone.give(ClearanceSaid{false}).accepted);

        Robot unasked;
        unasked.bring(RobotState::Hold);
        QVERIFY(!unasked.give(ClearanceSaid{true}).accepted);
    }
};

QTEST_GUILESS_MAIN(RobotMachineTest)
#include "robot_machine_test.moc"
