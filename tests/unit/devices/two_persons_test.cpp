// A robot that waits for the word of the person beside it before it may be armed.
#include "driven_robot.hpp"

#include <QTest>

using namespace liena;
using namespace liena::devices;
using namespace liena::test;
using namespace std::chrono_literals;
using Robot = DrivenRobot;

class TwoPersonsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
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
        robot.give(eventNamed(given, robot));
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

QTEST_GUILESS_MAIN(TwoPersonsTest)
#include "two_persons_test.moc"
