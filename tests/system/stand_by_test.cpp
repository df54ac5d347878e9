// A device dies or freezes: everybody stands by, and only a person's re-open leads out.
#include "child_process.hpp"
#include "test_system.hpp"

#include <QTest>

#include <atomic>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

/// Cockpit and arm in this process, the robot as a process of its own that can be killed.
class Triangle {
public:
    Triangle()
        : files({reference::cockpit, reference::robot, reference::arm}, {"cockpit robot", "cockpit arm", "arm robot"}),
          robotProcess(startRobot()),
          cockpit(files.settingsOf("cockpit")),
          arm(files.settingsOf("arm"))
    {}

    std::unique_ptr<ChildProcess> startRobot()
    {
        auto process = std::make_unique<ChildProcess>(QStringLiteral("liena-device"),
                                                      QStringList{QStringLiteral("robot")} + files.argumentsOf("robot"));
        if (!process->waitForLine(QStringLiteral("listening on")))
            throw std::runtime_error(process->output().toStdString());
        return process;
    }

    void openAll()
    {
        QVERIFY(cockpit->openChannel(robotId));
        QVERIFY(cockpit->openChannel(armId));
        QVERIFY(arm->openChannel(robotId));
        QTRY_COMPARE(words(cockpit.state(robotId)), words(SessionState::Open));
        QTRY_COMPARE(words(cockpit.state(armId)), words(SessionState::Open));
        QTRY_COMPARE(words(arm.state(robotId)), words(SessionState::Open));
        QTRY_VERIFY(arm.heard(Kind::Opened, cockpitId));
    }

    Result<void> sendMotion(bool engaged)
    {
        auto message = cockpit->command(robotId, "MotionCommand").value();
        message.set("sequence", ++sequence).set("engaged", engaged).set("guidewire_velocity", 1.0);
        return cockpit->send(robotId, message);
    }

    TestSystem files;
    std::unique_ptr<ChildProcess> robotProcess;
    TestDevice cockpit;
    TestDevice arm;
    DeviceId robotId = files.idOf("robot");
    DeviceId armId = files.idOf("arm");
    DeviceId cockpitId = files.idOf("cockpit");
    std::uint32_t sequence = 0;
};

} // namespace

class StandByTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aKilledDevicePutsEverybodyInStandByUntilAPersonReopens()
    {
        Triangle system;
        system.openAll();
        QTRY_VERIFY(system.sendMotion(false));
        system.arm->confirmHold(true);
        system.robotProcess->kill();

        QTRY_VERIFY2(system.cockpit.heard(Kind::Lost, system.robotId), system.cockpit.story().c_str());
        QTRY_VERIFY2(system.arm.heard(Kind::Lost, system.robotId), system.arm.story().c_str());
        // Each end names the lost link, and both links are known to both who live.
        QTRY_COMPARE(system.cockpit->incidents().size(), std::size_t{2});
        QTRY_COMPARE(system.arm->incidents().size(), std::size_t{2});
        QTRY_VERIFY2(system.cockpit.heard(Kind::HoldReported), "the arm's hold reaches the cockpit");
        QCOMPARE(system.cockpit.events(Kind::HoldReported)[0].hold.device, system.armId);
        QVERIFY(system.cockpit.events(Kind::HoldReported)[0].hold.holding);

        QTRY_VERIFY(system.cockpit.heard(Kind::Diagnosed));
        QCOMPARE(words(system.cockpit.events(Kind::Diagnosed)[0].diagnosis.probe), words(ProbeResult::ConnectionRefused));

        // Commands are refused everywhere, reports go on.
        auto command = system.cockpit->command(system.armId, "ArmCommand").value();
        QCOMPARE(words(system.cockpit->send(system.armId, command).error().code), words(Errc::StandBy));
        QVERIFY(system.cockpit->send(system.armId, system.cockpit->report("CockpitStatus").value()));
        QCOMPARE(words(system.cockpit->openChannel(system.robotId).error().code), words(Errc::StandBy));

        // A re-open without the device fails and changes nothing.
        QVERIFY(system.cockpit->reopenChannel(system.robotId));
        QTRY_VERIFY(system.cockpit.heard(Kind::OpenFailed, system.robotId));
        QTRY_COMPARE(words(system.cockpit.state(system.robotId)), words(SessionState::StandBy));

        system.robotProcess = system.startRobot();
        QVERIFY(system.cockpit->reopenChannel(system.robotId));
        QTRY_VERIFY2(system.cockpit.heard(Kind::ReOpened, system.robotId), system.cockpit.story().c_str());
        // The arm's link is still lost: the system stands by as long as one incident is left.
        QTRY_COMPARE(system.cockpit->incidents().size(), std::size_t{1});
        QCOMPARE(words(system.sendMotion(false).error().code), words(Errc::StandBy));
        QVERIFY(system.arm->reopenChannel(system.robotId));
        QTRY_VERIFY2(system.cockpit.heard(Kind::StandByEnded), system.cockpit.story().c_str());
        QTRY_VERIFY(system.arm.heard(Kind::StandByEnded));
        QTRY_VERIFY(system.sendMotion(false));
    }

    void aFrozenDeviceIsLostAndAppliesNothingStale()
    {
        Triangle system;
        system.openAll();
        QTRY_VERIFY(!system.cockpit.messages("RobotStatus").empty());
        system.robotProcess->freeze();
        // What the kernel takes now is stale when the robot wakes.
        for (int i = 0; i < 20; ++i)
            (void)system.sendMotion(true);
        QTRY_VERIFY2(system.cockpit.heard(Kind::Lost, system.robotId), system.cockpit.story().c_str());
        QCOMPARE(words(system.cockpit.events(Kind::Lost)[0].diagnosis.cause), words(LossCause::HeartbeatLost));
        QTRY_VERIFY(system.cockpit.heard(Kind::Diagnosed));
        QCOMPARE(words(system.cockpit.events(Kind::Diagnosed)[0].diagnosis.probe), words(ProbeResult::PeerSilent));
        system.robotProcess->thaw();

        const auto before = system.cockpit.messages("RobotStatus").size();
        QVERIFY(system.cockpit->reopenChannel(system.robotId));
        QTRY_VERIFY2(system.cockpit.heard(Kind::ReOpened, system.robotId), system.cockpit.story().c_str());
        QTRY_VERIFY(system.cockpit.messages("RobotStatus").size() > before);
        const auto status = system.cockpit.messages("RobotStatus").back();
        QCOMPARE(status.get<std::uint64_t>("applied_commands"), std::uint64_t{0});
        QVERIFY(status.get<bool>("hold_confirmed"));
    }

    void aDismissedIncidentEndsStandByAndLeavesTheLinkClosed()
    {
        Triangle system;
        system.openAll();
        system.robotProcess->kill();
        QTRY_COMPARE(system.cockpit->incidents().size(), std::size_t{2});
        QTRY_COMPARE(system.arm->incidents().size(), std::size_t{2});
        for (const auto& incident : system.cockpit->incidents())
            QVERIFY(system.cockpit->dismissIncident(incident.id, "the robot will not come back today"));
        QTRY_VERIFY(system.arm->incidents().empty());
        QTRY_VERIFY(system.arm.heard(Kind::StandByEnded));
        QTRY_COMPARE(words(system.cockpit.state(system.robotId)), words(SessionState::Closed));
        QTRY_COMPARE(words(system.arm.state(system.robotId)), words(SessionState::Closed));
        const auto ended = system.arm.events(Kind::IncidentEnded);
        QVERIFY(std::all_of(ended.begin(), ended.end(), [](const SessionEvent& event) { return event.dismissed; }));
    }

    void aPlainOpenOfARestartedDeviceIsRefused()
    {
        Triangle system;
        system.openAll();
        system.robotProcess->kill();
        QTRY_COMPARE(words(system.cockpit.state(system.robotId)), words(SessionState::StandBy));
        system.robotProcess = system.startRobot();
        system.robotProcess->say(QStringLiteral("open cockpit"));
        QVERIFY2(system.robotProcess->waitForLine(QStringLiteral("stand-by")), qPrintable(system.robotProcess->output()));
        QCOMPARE(words(system.cockpit.state(system.robotId)), words(SessionState::StandBy));
    }

    void aRestartedDeviceIsReopenedByItsOwnPerson()
    {
        TestSystem system({reference::robot, reference::arm}, {"arm robot"});
        const auto start = [&](const char* role) {
            return std::make_unique<ChildProcess>(QStringLiteral("liena-device"),
                                                  QStringList{QString::fromLatin1(role)} + system.argumentsOf(role));
        };
        auto robot = start("robot");
        QVERIFY2(robot->waitForLine(QStringLiteral("listening on")), qPrintable(robot->output()));
        auto arm = start("arm"); // it opens its link to the robot by itself
        QVERIFY2(arm->waitForLine(QStringLiteral("opening -> open")), qPrintable(arm->output()));
        arm->kill();
        QVERIFY2(robot->waitForLine(QStringLiteral("stand-by began")), qPrintable(robot->output()));
        arm = start("arm");
        QVERIFY2(arm->waitForLine(QStringLiteral("opening -> stand-by")), qPrintable(arm->output() + robot->output()));
        arm->say(QStringLiteral("reopen robot"));
        QVERIFY2(arm->waitForLine(QStringLiteral("re-opening -> open")), qPrintable(arm->output() + robot->output()));
        QVERIFY2(robot->waitForLine(QStringLiteral("stand-by ended")), qPrintable(robot->output()));
    }

    /// It holds none of the incidents, and hears only that the cockpit re-opened it.
    void aRestartedDeviceFollowsTheSurgeonsReopen()
    {
        TestSystem system({reference::cockpit, reference::robot, reference::arm}, {"cockpit robot", "cockpit arm", "arm robot"});
        const DeviceId armId = system.idOf("arm");
        const auto start = [&] {
            return std::make_unique<ChildProcess>(QStringLiteral("liena-device"),
                                                  QStringList{QStringLiteral("arm")} + system.argumentsOf("arm"));
        };
        TestDevice cockpit(system.settingsOf("cockpit"));
        TestDevice robot(system.settingsOf("robot"));
        auto arm = start(); // it opens its link to the robot by itself
        QVERIFY2(arm->waitForLine(QStringLiteral("opening -> open")), qPrintable(arm->output()));
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QVERIFY(cockpit->openChannel(armId));
        QTRY_COMPARE(words(cockpit.state(system.idOf("robot"))), words(SessionState::Open));
        QTRY_COMPARE(words(cockpit.state(armId)), words(SessionState::Open));
        arm->kill();
        QTRY_COMPARE(cockpit->incidents().size(), std::size_t{2});
        QTRY_COMPARE(robot->incidents().size(), std::size_t{2});

        arm = start();
        QVERIFY2(arm->waitForLine(QStringLiteral("opening -> stand-by")), qPrintable(arm->output()));
        QCOMPARE(words(robot.state(armId)), words(SessionState::StandBy));
        QVERIFY(cockpit->reopenChannel(armId));
        QTRY_VERIFY2(robot.heard(Kind::ReOpened, armId), qPrintable(arm->output() + QString::fromStdString(robot.story())));
        QTRY_VERIFY2(cockpit.heard(Kind::StandByEnded), cockpit.story().c_str());
        QTRY_VERIFY2(robot.heard(Kind::StandByEnded), robot.story().c_str());
    }

    /// In stand-by a new press of the pedal turns the beam on: "holds" is not true meanwhile.
    void theXraySystemTakesItsHoldBackWhileTheBeamIsOn()
    {
        TestSystem system({reference::cockpit, reference::robot, reference::xray}, {"cockpit robot", "cockpit xray"});
        const DeviceId xrayId = system.idOf("xray");
        const auto start = [&](const char* role, const QStringList& more) {
            return std::make_unique<ChildProcess>(QStringLiteral("liena-device"),
                                                  QStringList{QString::fromLatin1(role)} + system.argumentsOf(role) + more);
        };
        auto robot = start("robot", {});
        QVERIFY2(robot->waitForLine(QStringLiteral("listening on")), qPrintable(robot->output()));
        auto xray = start("xray", {QStringLiteral("--size"), QStringLiteral("256")});
        QVERIFY2(xray->waitForLine(QStringLiteral("listening on")), qPrintable(xray->output()));
        std::atomic<bool> pedal = false;
        TestDevice cockpit(system.settingsOf("cockpit"), [&](DistributedSystem& device) {
            device.every(std::chrono::milliseconds(50), [&] {
                auto command = device.command(xrayId, "AcquisitionCommand").value();
                command.set("mode", "fluoroscopy").set("pulse_rate", 2.0).set("pedal", pedal.load()).set("press", pedal ? 2U : 1U);
                (void)device.send(xrayId, command);
            });
        });
        const auto newestHold = [&]() -> std::optional<HoldReport> {
            for (const auto& incident : cockpit->incidents())
                for (const auto& hold : incident.holds)
                    if (hold.device == xrayId)
                        return hold;
            return std::nullopt;
        };
        QVERIFY(cockpit->openChannel(system.idOf("robot")));
        QVERIFY(cockpit->openChannel(xrayId));
        QTRY_COMPARE(words(cockpit.state(system.idOf("robot"))), words(SessionState::Open));
        QTRY_COMPARE(words(cockpit.state(xrayId)), words(SessionState::Open));
        robot->kill();
        QTRY_VERIFY2(newestHold() && newestHold()->holding, cockpit.story().c_str());
        const auto first = newestHold()->confirmed;
        pedal = true;
        QTRY_VERIFY2(!newestHold()->holding, cockpit.story().c_str());
        pedal = false;
        QTRY_VERIFY2(newestHold()->holding, cockpit.story().c_str());
        QVERIFY(newestHold()->confirmed > first);
    }

    void endsCleanlyOnSigterm()
    {
        Triangle system;
        system.openAll();
        QCOMPARE(system.robotProcess->terminate(), 0);
        QTRY_VERIFY2(system.cockpit.heard(Kind::Closed, system.robotId), system.cockpit.story().c_str());
        QVERIFY(system.cockpit->incidents().empty());
    }
};

QTEST_GUILESS_MAIN(StandByTest)
#include "stand_by_test.moc"
