// A device dies or freezes: everybody stands by, and only a person's re-open leads out.
#include "child_process.hpp"
#include "test_system.hpp"

#include <QTest>

#include <algorithm>
#include <atomic>

using namespace liena;
using namespace liena::test;
using Kind = SessionEvent::Kind;

namespace {

/// A hand at the cockpit that arms the robot and moves it, as often as the robot is ready.
class Hand {
public:
    void build(DistributedSystem& system)
    {
        const auto subscribed = system.subscribe("RobotStatus", [this, &system](const Message& status) { hear(system, status); });
        if (!subscribed)
            throw std::runtime_error(subscribed.error().what);
        system.every(std::chrono::milliseconds(10), [this, &system] { move(system); });
    }

    std::atomic<bool> armed{false};         ///< it wishes to be
    std::atomic<bool> moves{false};         ///< the robot's newest report says that it moves
    std::atomic<bool> holds{false};         ///< and that it holds
    std::atomic<std::uint64_t> reports{0};  ///< heard
    std::atomic<std::uint64_t> commands{0}; ///< of motion that left so far
    std::atomic<std::uint64_t> applied{0};  ///< of those by the robot, as it reports

private:
    void hear(DistributedSystem& system, const Message& status)
    {
        const auto state = status.get<std::string_view>("state");
        const bool isArmed = state == "Armed" || state == "Engaged";
        m_permit = status.get<std::uint32_t>("permit");
        m_armedReports = isArmed ? m_armedReports + 1 : 0;
        moves = state == "Engaged";
        holds = status.get<bool>("hold_confirmed");
        applied = status.get<std::uint64_t>("applied_commands");
        ++reports;
        if (armed && state == "Ready") {
            auto request = system.command(m_robot, "PermitRequest").value();
            request.set("request", std::string_view("arm")).set("permit", m_permit);
            (void)system.send(m_robot, std::move(request));
        }
    }

    /// As long as it knows of no hold: while the robot is frozen, it goes on.
    void move(DistributedSystem& system)
    {
        if (!armed || m_armedReports == 0)
            return;
        const bool engaged = m_armedReports > 3; // the first command of a permit is neutral
        auto command = system.command(m_robot, "MotionCommand").value();
        command.set("permit", m_permit).set("sequence", ++m_sequence).set("engaged", engaged);
        command.set("guidewire_velocity", engaged ? 1.0 : 0.0);
        ++commands; // before it can have arrived
        if (!system.send(m_robot, std::move(command)))
            --commands;
    }

    DeviceId m_robot = DeviceId::fromString(reference::robot.id).value();
    std::uint32_t m_permit = 0;
    std::uint32_t m_sequence = 0;
    int m_armedReports = 0; ///< one after another
};

/// Cockpit and arm in this process, the robot as a process of its own that can be killed.
class Triangle {
public:
    explicit Triangle(const TestDevice::Setup& atCockpit = {})
        : files({reference::cockpit, reference::robot, reference::arm}, {"cockpit robot", "cockpit arm", "arm robot"}),
          robotProcess(startRobot()),
          cockpit(files.settingsOf("cockpit"), atCockpit),
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
        std::atomic<bool> isKnown = false; // the incident, to who hears of the loss
        Triangle system([&](DistributedSystem& device) {
            device.subscribe([&](const SessionEvent& event) {
                const auto known = device.incidents();
                if (event.kind == Kind::Lost)
                    isKnown = std::ranges::any_of(known, [&](const Incident& one) { return one.id == event.incident.id; });
            });
        });
        system.openAll();
        QTRY_VERIFY(system.sendMotion(false));
        system.arm->confirmHold(true);
        system.robotProcess->kill();

        QTRY_VERIFY2(system.cockpit.heard(Kind::Lost, system.robotId), system.cockpit.story().c_str());
        QTRY_VERIFY2(system.arm.heard(Kind::Lost, system.robotId), system.arm.story().c_str());
        QVERIFY2(isKnown, "a loss is told before its incident can be asked for");
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
        // Another look finds it there again; what is known of the loss is told with that as well.
        const auto loss = system.cockpit.events(Kind::Lost)[0].diagnosis;
        QVERIFY(system.cockpit->probe(system.robotId));
        QTRY_COMPARE(system.cockpit.events(Kind::Diagnosed).size(), std::size_t{2});
        const auto looked = system.cockpit.events(Kind::Diagnosed)[1].diagnosis;
        QCOMPARE(words(looked.probe), words(ProbeResult::Reachable));
        QCOMPARE(words(looked.cause), words(loss.cause));
        QVERIFY(loss.heartbeatsExpected > 0 && looked.heartbeatsExpected == loss.heartbeatsExpected && looked.silence == loss.silence);

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
        Hand hand;
        Triangle system([&hand](DistributedSystem& cockpit) { hand.build(cockpit); });
        system.openAll();
        hand.armed = true;
        QTRY_VERIFY2(hand.moves && hand.applied > 20, qPrintable(system.robotProcess->output()));
        system.robotProcess->freeze();
        // No more than these can have come in time. What is sent from now on is under its permit, follows on the last, and waits for it in
        // its kernel.
        const std::uint64_t inTime = hand.commands;
        QTRY_VERIFY2(system.cockpit.heard(Kind::Lost, system.robotId), system.cockpit.story().c_str());
        hand.armed = false;
        QVERIFY(hand.commands > inTime + 20);
        QCOMPARE(words(system.cockpit.events(Kind::Lost)[0].diagnosis.cause), words(LossCause::HeartbeatLost));
        QTRY_VERIFY(system.cockpit.heard(Kind::Diagnosed));
        QCOMPARE(words(system.cockpit.events(Kind::Diagnosed)[0].diagnosis.probe), words(ProbeResult::PeerSilent));
        system.robotProcess->thaw();

        const std::uint64_t before = hand.reports;
        QVERIFY(system.cockpit->reopenChannel(system.robotId));
        QTRY_VERIFY2(system.cockpit.heard(Kind::ReOpened, system.robotId), system.cockpit.story().c_str());
        QTRY_VERIFY(hand.reports > before);
        QVERIFY2(hand.applied > 0 && hand.applied <= inTime,
                 qPrintable(QStringLiteral("%1 applied, %2 in time\n").arg(hand.applied).arg(inTime) + system.robotProcess->output()));
        QVERIFY(hand.holds);
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
        std::atomic<bool> pressed = false;
        unsigned repeats = 0; // this and the next are of the network thread
        std::uint32_t press = 1;
        TestDevice cockpit(system.settingsOf("cockpit"), [&](DistributedSystem& device) {
            device.every(std::chrono::milliseconds(50), [&] {
                // The foot comes up now and then: a press counts only if it was heard up some time after the stand-by.
                const bool down = pressed && ++repeats % 20 != 0;
                auto command = device.command(xrayId, "AcquisitionCommand").value();
                command.set("mode", "fluoroscopy").set("pulse_rate", 2.0).set("pedal", down).set("press", press);
                (void)device.send(xrayId, command);
                press += down ? 0 : 1;
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
        pressed = true;
        QTRY_VERIFY2(!newestHold()->holding, cockpit.story().c_str());
        pressed = false;
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
