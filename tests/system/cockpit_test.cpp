// The whole system: the real console and the real devices as processes, operated by clicks and keys.
#include "theatre.hpp"
#include "unit/console/virtual_pad.hpp"
#include "widgets/diagnosis_sheet.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QFile>
#include <QTest>

#include <algorithm>
#include <atomic>
#include <cmath>

using namespace console;
using console::test::Theatre;
using console::test::VirtualPad;

namespace {

constexpr int patience = Theatre::patience;

Theatre::Wishes wishes(MasterKind master = MasterKind::Keyboard)
{
    Theatre::Wishes value;
    value.master = master;
    value.watchdog = QStringLiteral(LIENA_PROGRAM_DIR "/liena-console-watchdog");
    value.player = QStringLiteral(LIENA_PROGRAM_DIR "/liena-console-player");
    return value;
}

bool stands(const Theatre& theatre, AlarmCondition condition)
{
    const auto& alarms = theatre.models().alarms.alarms();
    return std::any_of(alarms.begin(), alarms.end(),
                       [condition](const Alarm& alarm) { return alarm.condition == condition && alarm.present; });
}

bool logTells(const Theatre& theatre, const QString& start)
{
    const auto& lines = theatre.models().log.lines();
    return std::any_of(lines.begin(), lines.end(), [&start](const LogLine& line) { return line.text.startsWith(start); });
}

/// The alarm log's file as it is on the disk now.
QByteArray keptAlarms(const Theatre& theatre)
{
    QFile file(QString::fromStdString((theatre.files.folder() / "alarms").string()) +
               QStringLiteral("/alarms-%1.jsonl").arg(theatre.models().sessions.self()->idText()));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

/// A second cockpit with nobody at it: it never stops asking the robot to retract, under whatever permit the robot tells.
class Rival {
public:
    explicit Rival(Theatre& theatre)
        : m_robot(theatre.files.idOf("robot")),
          m_device(theatre.files.settingsOf("cockpit-2"), [this](liena::DistributedSystem& system) { build(system); })
    {
        (void)m_device->openChannel(m_robot);
    }

    std::atomic<bool> arms{false}; ///< else it gives back what it has

private:
    void build(liena::DistributedSystem& system)
    {
        const auto subscribed = system.subscribe("RobotStatus", [this, &system](const liena::Message& status) {
            m_permit = status.get<std::uint32_t>("permit");
            const auto state = status.get<std::string_view>("state");
            const bool armed = state == "Armed" || state == "Engaged";
            m_armed = armed ? m_armed + 1 : 0;
            if (arms ? state == "Ready" : armed && m_mine)
                request(system, arms ? "arm" : "release");
            m_mine = arms || (m_mine && armed);
        });
        if (!subscribed)
            throw std::runtime_error(subscribed.error().what);
        system.every(std::chrono::milliseconds(10), [this, &system] {
            auto command = system.command(m_robot, "MotionCommand");
            if (!command)
                return;
            const bool engaged = m_armed > 3; // the first command of a permit is neutral
            command.value().set("permit", m_permit).set("sequence", ++m_sequence).set("engaged", engaged);
            command.value().set("guidewire_velocity", engaged || m_armed == 0 ? -10.0 : 0.0);
            (void)system.send(m_robot, std::move(command.value()));
        });
    }

    void request(liena::DistributedSystem& system, std::string_view what)
    {
        auto command = system.command(m_robot, "PermitRequest");
        if (!command)
            return;
        command.value().set("request", what).set("permit", m_permit);
        (void)system.send(m_robot, std::move(command.value()));
    }

    liena::DeviceId m_robot;
    std::uint32_t m_permit = 0;
    std::uint32_t m_sequence = 0;
    int m_armed = 0;                  ///< reports, one after another
    bool m_mine = false;              ///< it may be
    liena::test::TestDevice m_device; ///< last: its thread uses all of the above
};

} // namespace

class CockpitTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance())); }

    void aKilledRobotIsReopenedByClickAndMovesOnlyAfterANewArming()
    {
        Theatre theatre(wishes());
        QVERIFY(theatre.openAll());
        QTRY_VERIFY_WITH_TIMEOUT(theatre.models().instrument.travel().has_value(), patience);
        const InstrumentTravel& way = theatre.models().instrument.travel()->guidewire; // of the vessel that this robot was given
        QVERIFY(way.hard.low < way.soft.low && way.soft.high < way.hard.high && way.hard.high < 1600);
        QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
        theatre.robot->kill();

        QTRY_VERIFY_WITH_TIMEOUT(theatre.link("robot") == LinkState::StandBy, patience);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.phase() == PermitPhase::Incident, patience);
        QVERIFY2(theatre.armDevice->waitForLine(QStringLiteral("stand-by")), qPrintable(theatre.armDevice->output()));
        QVERIFY2(theatre.xray->waitForLine(QStringLiteral("stand-by")), qPrintable(theatre.xray->output()));
        QTRY_VERIFY2_WITH_TIMEOUT(stands(theatre, AlarmCondition::LinkLost), qPrintable(theatre.story()), patience);
        QTRY_VERIFY2_WITH_TIMEOUT(stands(theatre, AlarmCondition::HoldNotConfirmed), qPrintable(theatre.story()), patience);
        auto* sheet = theatre.window().findChild<DiagnosisSheet*>();
        QTRY_VERIFY_WITH_TIMEOUT((sheet = theatre.window().findChild<DiagnosisSheet*>()) != nullptr && sheet->isVisible(), patience);

        theatre.robot = theatre.start("robot");
        // The hand still holds every key: nothing of that may move the robot that comes back.
        QVERIFY(theatre.click(QStringLiteral("Re-open channel"), sheet));
        QTRY_VERIFY_WITH_TIMEOUT(theatre.link("robot") == LinkState::Open, patience);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.models().incidents.empty(), qPrintable(theatre.armDevice->output() + theatre.xray->output()),
                                  patience);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.models().instrument.robotFresh(std::chrono::steady_clock::now()), patience);
        QVERIFY(theatre.phase() != PermitPhase::Armed && theatre.phase() != PermitPhase::Engaged);
        QCOMPARE(theatre.robotStatus().appliedCommands, quint64{0});
        QVERIFY(!theatre.models().interruption.settled());
        QVERIFY(theatre.button(QStringLiteral("I have read this")) != nullptr);

        theatre.releaseAll();
        QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
        QVERIFY(theatre.robotStatus().appliedCommands > 0);
        theatre.releaseAll();
        QTRY_VERIFY_WITH_TIMEOUT(theatre.robotStatus().holdConfirmed, patience);
    }

    void aGamePadThatIsPulledOutWhileItMovesTheRobotEndsInHold()
    {
        Theatre theatre(wishes(MasterKind::GamePad));
        VirtualPad pad;
        QVERIFY(theatre.openAll());
        const Theatre::Hand hand{[&] { pad.trigger(1); }, [&] { pad.stick(SDL_CONTROLLER_AXIS_LEFTY, -1); },
                                 [&] {
                                     pad.trigger(0);
                                     pad.stick(SDL_CONTROLLER_AXIS_LEFTY, 0);
                                 }};
        QVERIFY2(theatre.armAndMove(hand), qPrintable(theatre.story()));
        pad.unplug();
        QTRY_VERIFY2_WITH_TIMEOUT(logTells(theatre, QStringLiteral("ENGAGED -> HOLD: ")), qPrintable(theatre.story()), patience);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.robotStatus().holdConfirmed, patience);
        QVERIFY(!theatre.models().hand.reading().alive);

        // It comes back as it went, held and pushed.
        const auto applied = theatre.robotStatus().appliedCommands;
        VirtualPad again;
        again.trigger(1);
        again.stick(SDL_CONTROLLER_AXIS_LEFTY, -1);
        QTRY_COMPARE_WITH_TIMEOUT(theatre.models().hand.masterInUse()->life, MasterLife::Unreleased, patience);
        QVERIFY(theatre.phase() != PermitPhase::Armed && theatre.phase() != PermitPhase::Engaged);
        QCOMPARE(theatre.robotStatus().appliedCommands, applied);

        // Another master is a person's choice.
        theatre.releaseAll();
        QAbstractButton* keyboard = nullptr;
        for (auto* button : theatre.window().findChildren<QAbstractButton*>())
            if (button->accessibleName().startsWith(QStringLiteral("Use Keyboard")))
                keyboard = button;
        QVERIFY(keyboard != nullptr);
        QTRY_VERIFY_WITH_TIMEOUT(keyboard->isEnabled(), patience);
        QTest::mouseClick(keyboard, Qt::LeftButton);
        QTRY_COMPARE_WITH_TIMEOUT(theatre.models().hand.masterInUse()->kind, MasterKind::Keyboard, patience);
        QVERIFY(theatre.models().hand.reading().alive);
    }

    void anEmergencyStopEndsMotionHereAtThePressAndThenAtTheRobot()
    {
        Theatre theatre(wishes());
        QVERIFY(theatre.openAll());
        QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
        QTest::keyClick(&theatre.window(), Qt::Key_Escape);
        QCOMPARE(theatre.phase(), PermitPhase::Hold); // before anybody answered
        QTRY_VERIFY_WITH_TIMEOUT(theatre.robotStatus().emergencyStopToken != 0, patience);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.robotStatus().holdConfirmed, patience);
        QVERIFY(!theatre.models().instrument.stopUnheard());
        const auto applied = theatre.robotStatus().appliedCommands;
        theatre.releaseAll();
        theatre.hold(Qt::Key_D);
        theatre.hold(Qt::Key_Up);
        const auto reports = theatre.models().instrument.statusCount();
        QTRY_VERIFY_WITH_TIMEOUT(theatre.models().instrument.statusCount() > reports + 10, patience);
        QCOMPARE(theatre.robotStatus().appliedCommands, applied);
        theatre.releaseAll();
        QTRY_VERIFY_WITH_TIMEOUT(theatre.button(QStringLiteral("RESET STOP")) != nullptr, patience);
        theatre.hold(Qt::Key_U); // without a mouse
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.robotStatus().emergencyStopToken == 0, qPrintable(theatre.story()), patience);
        theatre.release(Qt::Key_U);
    }

    void anEmergencyStopThatTheRobotDoesNotHearIsAnAlarmAndIsNotForgotten()
    {
        Theatre theatre(wishes());
        QVERIFY(theatre.openAll());
        QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
        theatre.robot->kill();
        QTest::keyClick(&theatre.window(), Qt::Key_Escape);
        QVERIFY(theatre.phase() != PermitPhase::Engaged);
        const auto alarm = [&theatre] {
            const auto& alarms = theatre.models().alarms.alarms();
            return std::any_of(alarms.begin(), alarms.end(), [](const Alarm& one) {
                return one.condition == AlarmCondition::StopUnheard && one.present && one.priority == AlarmPriority::High;
            });
        };
        QTRY_VERIFY2_WITH_TIMEOUT(alarm(), qPrintable(theatre.story()), patience);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.link("robot") == LinkState::StandBy, patience);
        theatre.releaseAll();
        theatre.robot = theatre.start("robot");
        QVERIFY(theatre.click(QStringLiteral("Re-open channel"), theatre.window().findChild<DiagnosisSheet*>()));
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.robotStatus().emergencyStopToken != 0, qPrintable(theatre.story()), patience);
        QTRY_VERIFY_WITH_TIMEOUT(!alarm(), patience);
    }

    void twoConsolesNeverMoveOneRobot()
    {
        auto wanted = wishes();
        wanted.rival = true;
        Theatre theatre(wanted);
        QVERIFY(theatre.openAll());
        Rival rival(theatre);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.robotStatus().refusedCommands > 10, qPrintable(theatre.story()), patience); // it asks
        QVERIFY2(theatre.makeReady(), qPrintable(theatre.story()));

        // The other one has it: here nobody arms, and nothing that is held here moves it.
        rival.arms = true;
        const auto taken = [&theatre] { return theatre.robotStatus().state == RobotState::Engaged; };
        QTRY_VERIFY2_WITH_TIMEOUT(taken(), qPrintable(theatre.story() + theatre.robot->output()), patience);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.phase() == PermitPhase::Standby, qPrintable(theatre.story()), patience);
        bool armed = false;
        const auto watch = QObject::connect(&theatre.models().permit, &PermitModel::phaseChanged, &theatre.window(),
                                            [&armed](PermitPhase, PermitPhase to) { armed = armed || to != PermitPhase::Standby; });
        const auto applied = theatre.robotStatus().appliedCommands;
        theatre.hold(Qt::Key_R);
        theatre.hold(Qt::Key_D);
        theatre.hold(Qt::Key_Up);
        const double position = theatre.robotStatus().guidewirePosition;
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.robotStatus().appliedCommands > applied + 150, qPrintable(theatre.story()), patience);
        QVERIFY2(!armed && theatre.robotStatus().guidewirePosition <= position, qPrintable(theatre.story()));
        const auto conditions = theatre.models().permit.checklist();
        QVERIFY(conditions.at(std::size_t(Guard::RobotHolds)).text.startsWith(QStringLiteral("Another console has the robot")));
        QObject::disconnect(watch);
        theatre.releaseAll();

        // It gives the robot back: now it is ours, and what the other one goes on asking for is refused.
        rival.arms = false;
        const auto moves = [&theatre] { return theatre.phase() == PermitPhase::Engaged; };
        constexpr int tries = 5; // a computer that stands still ends motion, too
        bool movedOn = false;
        for (int i = 0; i < tries && !movedOn; ++i) {
            QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
            double last = theatre.robotStatus().guidewirePosition;
            bool retracted = false;
            const auto follows = QObject::connect(&theatre.models().instrument, &InstrumentState::robotChanged, &theatre.window(), [&] {
                const double now = theatre.robotStatus().guidewirePosition;
                retracted = retracted || (moves() && now < last); // what holds may give way a little
                last = now;
            });
            const auto refused = theatre.robotStatus().refusedCommands;
            const auto refusedMany = [&theatre, refused] { return theatre.robotStatus().refusedCommands > refused + 100; };
            movedOn = QTest::qWaitFor([&] { return refusedMany() || !moves(); }, patience) && refusedMany() && moves();
            QObject::disconnect(follows);
            QVERIFY2(!retracted && (movedOn || theatre.heldByThisComputer()), qPrintable(theatre.story()));
        }
        QVERIFY2(movedOn, qPrintable(theatre.story()));
        theatre.releaseAll();
    }

    void theSecondPersonDecidesWhetherTheRobotCanBeArmed()
    {
        Theatre theatre(wishes());
        QCOMPARE(theatre.robot->terminate(), 0);
        theatre.robot = theatre.start("robot", {QStringLiteral("--two-person")});
        QVERIFY(theatre.openAll());
        const auto clearance = [&theatre] { return theatre.models().permit.checklist().at(std::size_t(Guard::ClearToArm)); };
        QTRY_VERIFY_WITH_TIMEOUT(theatre.robotStatus().clearance == Clearance::Awaited, patience);
        // The checklist follows the report with the console's next look, not at once.
        QTRY_VERIFY2_WITH_TIMEOUT(clearance().text.contains(QStringLiteral("has not said")), qPrintable(clearance().text), patience);
        QVERIFY(!clearance().met);
        QVERIFY(theatre.robotStatus().state == RobotState::Hold);

        theatre.robot->say(QStringLiteral("clear"));
        QTRY_VERIFY_WITH_TIMEOUT(clearance().met, patience);
        QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));

        theatre.robot->say(QStringLiteral("wait"));
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.phase() != PermitPhase::Engaged, qPrintable(theatre.story()), patience);
        QVERIFY(theatre.robot->waitForLine(QStringLiteral("withdrew the word to arm")));
        theatre.releaseAll();
        QTRY_VERIFY_WITH_TIMEOUT(!clearance().met, patience);

        // Who types hears an answer each time, and the word ends with the cockpit's session.
        theatre.robot->say(QStringLiteral("clear"));
        QTRY_VERIFY_WITH_TIMEOUT(clearance().met, patience);
        theatre.restartConsole();
        QVERIFY2(theatre.robot->waitForLine(QStringLiteral("cockpit: closed")), qPrintable(theatre.robot->output()));
        theatre.robot->say(QStringLiteral("clear"));
        QVERIFY2(theatre.robot->waitForLine(QStringLiteral("no cockpit is in session")), qPrintable(theatre.robot->output()));
        theatre.robot->say(QStringLiteral("status"));
        QVERIFY2(theatre.robot->waitForLine(QStringLiteral("robot: Hold, waits for clear")), qPrintable(theatre.robot->output()));
        QVERIFY(theatre.openAll());
        QTRY_VERIFY_WITH_TIMEOUT(theatre.robotStatus().clearance == Clearance::Awaited, patience);
    }

    void everyArmingAsksForTheSelfTestAnew()
    {
        auto asked = wishes();
        asked.listens = true;
        Theatre theatre(asked);
        QVERIFY(theatre.openAll());
        QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
        const auto before = theatre.models().selfTest.passedInAll();
        QTest::keyClick(&theatre.window(), Qt::Key_F12);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.phase() != PermitPhase::Engaged, patience);
        theatre.releaseAll();
        QVERIFY(!theatre.models().selfTest.passed());
        QTRY_VERIFY_WITH_TIMEOUT(theatre.button(QStringLiteral("Alarm self-test")) != nullptr, patience);
        QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
        QVERIFY(theatre.models().selfTest.passedInAll() > before);
        theatre.releaseAll();
    }

    void aLostXraySystemIsAnAlarmOfItsOwnAndIsKept()
    {
        Theatre theatre(wishes());
        QVERIFY(theatre.openAll());
        QTRY_VERIFY_WITH_TIMEOUT(logTells(theatre, QStringLiteral("the watchdog watches")), patience);
        theatre.xray->kill();
        QTRY_VERIFY_WITH_TIMEOUT(stands(theatre, AlarmCondition::ImageLost), patience);
        QVERIFY(!stands(theatre, AlarmCondition::LinkLost));
        QVERIFY(!stands(theatre, AlarmCondition::WatchdogGone) && !stands(theatre, AlarmCondition::RecorderStopped));
        QTRY_VERIFY_WITH_TIMEOUT(keptAlarms(theatre).contains("picture link lost"), patience);
    }

    /// Whichever device is not heard: nobody sees what it does, and it may be in the way.
    void anArmThatIsNotHeardEndsMotionOfTheRobot()
    {
        Theatre theatre(wishes());
        QVERIFY(theatre.openAll());
        QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
        theatre.armDevice->freeze();
        QTRY_VERIFY2_WITH_TIMEOUT(logTells(theatre, QStringLiteral("ENGAGED -> ")), qPrintable(theatre.story()), patience);
        const auto robotsLink =
            QStringLiteral("ENGAGED -> HOLD: %1 link").arg(theatre.models().sessions.titleOf(theatre.files.idOf("robot").value()));
        QVERIFY2(!logTells(theatre, robotsLink) && !logTells(theatre, QStringLiteral("ENGAGED -> HOLD: the robot link")),
                 qPrintable(theatre.story()));
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.robotStatus().holdConfirmed, qPrintable(theatre.story()), patience);
        const auto applied = theatre.robotStatus().appliedCommands;
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.link("arm") == LinkState::StandBy, qPrintable(theatre.story()), patience);
        QCOMPARE(theatre.robotStatus().appliedCommands, applied);
        theatre.armDevice->thaw();
        theatre.releaseAll();
    }

    void aFrozenRobotAppliesNothingStaleWhenItWakes()
    {
        Theatre theatre(wishes());
        QVERIFY(theatre.openAll());
        QVERIFY2(theatre.armAndMove(), qPrintable(theatre.story()));
        // Just when the console has counted what it sent: only that can have come in time, and all that follows is stale for the robot.
        constexpr quint64 underway = 5; // for the ten milliseconds that the freezing may take
        const auto& hand = theatre.models().hand;
        quint64 inTime = 0;
        const auto watch = QObject::connect(&hand, &HandState::changed, &theatre.window(), [&, before = hand.commandsSent()] {
            if (inTime != 0 || hand.commandsSent() == before)
                return;
            theatre.robot->freeze();
            inTime = hand.commandsSent() + underway;
        });
        QTRY_VERIFY_WITH_TIMEOUT(inTime != 0, patience);
        QObject::disconnect(watch);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.link("robot") == LinkState::StandBy, patience);
        QVERIFY2(hand.commandsSent() > inTime + 3 * underway, qPrintable(theatre.story()));
        theatre.robot->thaw();
        QVERIFY2(theatre.robot->waitForLine(QStringLiteral("did not run")), qPrintable(theatre.robot->output()));
        DiagnosisSheet* sheet = nullptr;
        QTRY_VERIFY_WITH_TIMEOUT((sheet = theatre.window().findChild<DiagnosisSheet*>()) != nullptr && sheet->isVisible(), patience);
        QVERIFY(theatre.click(QStringLiteral("Re-open channel"), sheet));
        QTRY_VERIFY_WITH_TIMEOUT(theatre.link("robot") == LinkState::Open, patience);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.models().instrument.robotFresh(std::chrono::steady_clock::now()), patience);
        QVERIFY(theatre.robotStatus().appliedCommands <= inTime);
        // Nor was it only refused because the robot held by then: that would not help one that was armed again meanwhile. (The drives' last
        // gate may have refused the one that was in hand when the robot froze, since its lease is over; that is a count and no such line.)
        QVERIFY2(!theatre.robot->output().contains(QStringLiteral("command refused")), qPrintable(theatre.robot->output()));
        QVERIFY(theatre.robotStatus().holdConfirmed);
        QVERIFY(theatre.phase() != PermitPhase::Armed && theatre.phase() != PermitPhase::Engaged);
        theatre.releaseAll();
    }
};

QTEST_MAIN(CockpitTest)
#include "cockpit_test.moc"
