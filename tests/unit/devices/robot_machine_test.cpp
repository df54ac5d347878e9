// The robot's state machine: every state against every event, and the ways that lead to motion. What a second person beside the robot
// says is tried by unit.devices_two_persons.
#include "driven_robot.hpp"

#include <QTest>

using namespace liena;
using namespace liena::devices;
using namespace liena::test;
using namespace std::chrono_literals;
using Robot = DrivenRobot;

namespace {

RobotState by(const char* name)
{
    for (const auto state : {RobotState::Off, RobotState::Hold, RobotState::Ready, RobotState::Armed, RobotState::Engaged,
                             RobotState::EmergencyStop, RobotState::Fault})
        if (toString(state) == name)
            return state;
    qFatal("no state %s", name);
}

} // namespace

class RobotMachineTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
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
        const RobotActions actions = robot.give(eventNamed(given, robot));
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

    void knowsARepeatOfAStopInForce()
    {
        Robot robot;
        robot.bring(RobotState::Ready);
        QVERIFY(!robot.machine.isInForce({cockpit, 1}));
        robot.give(EmergencyStopCommanded{cockpit, 1});
        robot.give(EmergencyStopCommanded{otherCockpit, 2});
        QVERIFY(robot.machine.isInForce({cockpit, 1}));
        QVERIFY(robot.machine.isInForce({otherCockpit, 2}));
        QVERIFY(!robot.machine.isInForce({cockpit, 2}));
        robot.give(ResetCommanded{cockpit, 1});
        QVERIFY(!robot.machine.isInForce({cockpit, 1}));
        robot.give(EmergencyStopCommanded{otherCockpit, 3});
        QVERIFY(!robot.machine.isInForce({otherCockpit, 2}));
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
};

QTEST_GUILESS_MAIN(RobotMachineTest)
#include "robot_machine_test.moc"
