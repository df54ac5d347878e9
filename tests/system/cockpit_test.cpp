// The whole system: the real console and the real devices as processes, operated by clicks and keys.
#include "app/cockpit_application.hpp"
#include "child_process.hpp"
#include "test_system.hpp"
#include "unit/console/virtual_pad.hpp"
#include "widgets/cockpit_window.hpp"
#include "widgets/diagnosis_sheet.hpp"
#include "widgets/theme.hpp"

#include <QAbstractButton>
#include <QApplication>
#include <QDeadlineTimer>
#include <QFile>
#include <QTest>

#include <functional>

using namespace liena::test;
using namespace console;
using console::test::VirtualPad;

namespace {

constexpr int patience = 30000;

/// Console, robot, arm and X-ray system over the links of the reference topology.
class Theatre {
public:
    explicit Theatre(MasterKind master = MasterKind::Keyboard)
        : files({reference::cockpit, reference::robot, reference::arm, reference::xray},
                {"cockpit robot", "cockpit arm", "cockpit xray", "arm robot", "xray robot"})
    {
        robot = start("robot");
        arm = start("arm");
        xray = start("xray", {QStringLiteral("--size"), QStringLiteral("256")}); // small pictures: sanitizers are slow
        const auto settings = files.settingsOf("cockpit");
        const auto text = [](const std::filesystem::path& path) { return QString::fromStdString(path.string()); };
        Options options;
        options.topology = text(settings.topology);
        options.device = QStringLiteral("cockpit");
        options.registry = {text(settings.registry.front())};
        options.store = text(settings.store);
        options.certificate = text(settings.certificate);
        options.key = text(settings.key);
        options.authority = text(settings.authority);
        options.alarmLog = text(files.folder() / "alarms");
        options.watchdog = QStringLiteral(LIENA_PROGRAM_DIR "/liena-console-watchdog");
        options.size = QSize(1366, 768);
        options.profile = PictureProfile::Coronary;
        options.master = master;
        cockpit = std::make_unique<CockpitApplication>(options);
        QString error;
        if (!cockpit->prepare(&error))
            throw std::runtime_error(error.toStdString());
        cockpit->show();
    }

    std::unique_ptr<ChildProcess> start(const std::string& role, const QStringList& options = {})
    {
        auto process = std::make_unique<ChildProcess>(QStringLiteral("liena-device"),
                                                      QStringList{QString::fromStdString(role)} + files.argumentsOf(role) + options);
        if (!process->waitForLine(QStringLiteral("listening on")))
            throw std::runtime_error(process->output().toStdString());
        return process;
    }

    CockpitWindow& window() { return cockpit->window(); }
    const ConsoleModels& models() const { return cockpit->models(); }
    PermitPhase phase() const { return models().permit.phase(); }
    LinkState link(const std::string& name) const { return models().sessions.state(files.idOf(name).value()); }
    const RobotStatus& robotStatus() const { return models().instrument.robot().value; }

    QAbstractButton* button(const QString& text, QWidget* within = nullptr)
    {
        for (auto* candidate : (within != nullptr ? within : &window())->findChildren<QAbstractButton*>())
            if (candidate->isVisible() && candidate->text().remove(QLatin1Char('&')).startsWith(text))
                return candidate;
        return nullptr;
    }

    void click(const QString& text, QWidget* within = nullptr)
    {
        QAbstractButton* found = nullptr;
        QTRY_VERIFY2_WITH_TIMEOUT((found = button(text, within)) != nullptr && found->isEnabled(), qPrintable(text), patience);
        QTest::mouseClick(found, Qt::LeftButton);
    }

    void openAll()
    {
        QVERIFY(QTest::qWaitForWindowActive(&window()));
        QTest::keyClick(&window(), Qt::Key_F2);
        click(QStringLiteral("Open all"));
        QTRY_VERIFY_WITH_TIMEOUT(models().sessions.allOpen(), patience);
        QTest::keyClick(&window(), Qt::Key_F1);
    }

    void hold(int key) { QTest::keyPress(&window(), static_cast<Qt::Key>(key)); }
    void release(int key) { QTest::keyRelease(&window(), static_cast<Qt::Key>(key)); }

    /// What presses the dead-man, what then moves, and what lets both go again.
    struct Hand {
        std::function<void()> press, move, letGo;
    };

    Hand keyboardHand()
    {
        return {[this] { hold(Qt::Key_D); }, [this] { hold(Qt::Key_Up); }, [] {}};
    }

    void armAndMove() { armAndMove(keyboardHand()); }

    /// Pedal, hold to arm, dead-man, and advance; ends with the robot moving. A condition that fails on the way (a busy computer paints
    /// too late, say) sends a person back to the start, and so this.
    void armAndMove(const Hand& hand)
    {
        const QDeadlineTimer deadline(3 * patience);
        const auto before = robotStatus().guidewirePosition;
        const auto moved = [&] { return robotStatus().guidewirePosition > before + 0.5; };
        while (!moved()) {
            QVERIFY2(!deadline.hasExpired(), qPrintable(story()));
            releaseAll();
            hand.letGo();
            acknowledgeAlarms();
            readAccount();
            testAlarms();
            hold(Qt::Key_F);
            if (!reaches(PermitPhase::Ready))
                continue;
            hold(Qt::Key_R);
            if (!reaches(PermitPhase::Armed))
                continue;
            release(Qt::Key_R);
            hand.press();
            if (!reaches(PermitPhase::Engaged))
                continue;
            hand.move();
            (void)QTest::qWaitFor([&] { return moved() || phase() != PermitPhase::Engaged; }, patience);
        }
    }

    /// Before each arming: look at the colours, listen, and say so. A high alarm that comes between ends the test.
    void testAlarms()
    {
        const auto& test = models().selfTest;
        auto* begin = button(QStringLiteral("Alarm self-test"));
        if (begin == nullptr)
            return;
        QTest::mouseClick(begin, Qt::LeftButton);
        QVERIFY(QTest::qWaitFor([&] { return !test.signal().has_value(); }, patience));
        if (auto* right = button(QStringLiteral("Test seen")); right != nullptr)
            QTest::mouseClick(right, Qt::LeftButton);
    }

    /// What happened while the system stood by, once it can be read.
    void readAccount()
    {
        auto* read = button(QStringLiteral("I have read this"));
        if (read != nullptr && QTest::qWaitFor([read] { return read->isEnabled(); }))
            QTest::mouseClick(read, Qt::LeftButton);
    }

    void acknowledgeAlarms()
    {
        constexpr int most = 16;
        for (int i = 0; i < most && models().alarms.unacknowledgedHigh(); ++i)
            if (auto* acknowledge = button(QStringLiteral("Acknowledge")); acknowledge != nullptr && acknowledge->isEnabled())
                QTest::mouseClick(acknowledge, Qt::LeftButton);
    }

    /// What the console shows and noted last, for a failing test's output.
    QString story() const
    {
        constexpr std::size_t most = 20; // a failure's text is cut at about a thousand letters
        QString text = word(phase()) + QStringLiteral(": ") + models().permit.unmetText(9) + QLatin1Char('\n');
        for (const auto& alarm : models().alarms.alarms())
            text += word(alarm.priority) + QStringLiteral(": ") + alarm.text + QLatin1Char('\n');
        const auto& lines = models().log.lines();
        for (std::size_t i = lines.size() - std::min(most, lines.size()); i < lines.size(); ++i)
            text += lines[i].text + QLatin1Char('\n');
        return text;
    }

    bool stands(AlarmCondition condition) const
    {
        const auto& alarms = models().alarms.alarms();
        return std::any_of(alarms.begin(), alarms.end(),
                           [condition](const Alarm& alarm) { return alarm.condition == condition && alarm.present; });
    }

    bool logContains(const QString& text) const
    {
        const auto& lines = models().log.lines();
        return std::any_of(lines.begin(), lines.end(), [&text](const LogLine& line) { return line.text == text; });
    }

    /// The alarm log's file as it is on the disk now.
    QByteArray keptAlarms() const
    {
        QFile file(QString::fromStdString((files.folder() / "alarms").string()) +
                   QStringLiteral("/alarms-%1.jsonl").arg(models().sessions.self()->idText()));
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    }

    bool reaches(PermitPhase wanted)
    {
        return QTest::qWaitFor([&] { return phase() == wanted; }, 6000);
    }

    void releaseAll()
    {
        for (const int key : {Qt::Key_Up, Qt::Key_D, Qt::Key_R, Qt::Key_F})
            release(key);
    }

    TestSystem files;
    std::unique_ptr<ChildProcess> robot;
    std::unique_ptr<ChildProcess> arm;
    std::unique_ptr<ChildProcess> xray;
    std::unique_ptr<CockpitApplication> cockpit;
};

} // namespace

class CockpitTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance())); }

    void aKilledRobotIsReopenedByClickAndMovesOnlyAfterANewArming()
    {
        Theatre theatre;
        theatre.openAll();
        theatre.armAndMove();
        QVERIFY(!QTest::currentTestFailed());
        theatre.robot->kill();

        QTRY_VERIFY_WITH_TIMEOUT(theatre.link("robot") == LinkState::StandBy, patience);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.phase() == PermitPhase::Incident, patience);
        QVERIFY2(theatre.arm->waitForLine(QStringLiteral("stand-by")), qPrintable(theatre.arm->output()));
        QVERIFY2(theatre.xray->waitForLine(QStringLiteral("stand-by")), qPrintable(theatre.xray->output()));
        auto* sheet = theatre.window().findChild<DiagnosisSheet*>();
        QTRY_VERIFY_WITH_TIMEOUT((sheet = theatre.window().findChild<DiagnosisSheet*>()) != nullptr && sheet->isVisible(), patience);

        theatre.robot = theatre.start("robot");
        // The hand still holds every key: nothing of that may move the robot that comes back.
        theatre.click(QStringLiteral("Re-open channel"), sheet);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.link("robot") == LinkState::Open, patience);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.models().incidents.empty(), qPrintable(theatre.arm->output() + theatre.xray->output()), patience);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.models().instrument.robotFresh(std::chrono::steady_clock::now()), patience);
        QVERIFY(theatre.phase() != PermitPhase::Armed && theatre.phase() != PermitPhase::Engaged);
        QCOMPARE(theatre.robotStatus().appliedCommands, quint64{0});
        QVERIFY(!theatre.models().interruption.settled());
        QVERIFY(theatre.button(QStringLiteral("I have read this")) != nullptr);

        theatre.releaseAll();
        theatre.armAndMove();
        QVERIFY(theatre.robotStatus().appliedCommands > 0);
        theatre.releaseAll();
        QTRY_VERIFY_WITH_TIMEOUT(theatre.robotStatus().holdConfirmed, patience);
    }

    void aGamePadThatIsPulledOutWhileItMovesTheRobotEndsInHold()
    {
        Theatre theatre(MasterKind::GamePad);
        VirtualPad pad;
        theatre.openAll();
        const Theatre::Hand hand{[&] { pad.trigger(1); }, [&] { pad.stick(SDL_CONTROLLER_AXIS_LEFTY, -1); },
                                 [&] {
                                     pad.trigger(0);
                                     pad.stick(SDL_CONTROLLER_AXIS_LEFTY, 0);
                                 }};
        theatre.armAndMove(hand);
        QVERIFY(!QTest::currentTestFailed());
        pad.unplug();
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.logContains(QStringLiteral("ENGAGED -> HOLD: a condition for motion was no longer met")),
                                  qPrintable(theatre.story()), patience);
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

    void everyArmingAsksForTheSelfTestAnew()
    {
        Theatre theatre;
        theatre.openAll();
        theatre.armAndMove();
        QVERIFY(!QTest::currentTestFailed());
        const auto before = theatre.models().selfTest.passedInAll();
        QTest::keyClick(&theatre.window(), Qt::Key_F12);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.phase() != PermitPhase::Engaged, patience);
        theatre.releaseAll();
        QVERIFY(!theatre.models().selfTest.passed());
        QTRY_VERIFY_WITH_TIMEOUT(theatre.button(QStringLiteral("Alarm self-test")) != nullptr, patience);
        theatre.armAndMove();
        QVERIFY(!QTest::currentTestFailed());
        QVERIFY(theatre.models().selfTest.passedInAll() > before);
        theatre.releaseAll();
    }

    void aLostXraySystemIsAnAlarmOfItsOwnAndIsKept()
    {
        Theatre theatre;
        theatre.openAll();
        QTRY_VERIFY_WITH_TIMEOUT(theatre.logContains(QStringLiteral("the watchdog watches")), patience);
        theatre.xray->kill();
        QTRY_VERIFY_WITH_TIMEOUT(theatre.stands(AlarmCondition::ImageLost), patience);
        QVERIFY(!theatre.stands(AlarmCondition::LinkLost));
        QVERIFY(!theatre.stands(AlarmCondition::WatchdogGone) && !theatre.stands(AlarmCondition::RecorderStopped));
        QTRY_VERIFY_WITH_TIMEOUT(theatre.keptAlarms().contains("picture link lost"), patience);
    }

    void aFrozenRobotAppliesNothingStaleWhenItWakes()
    {
        Theatre theatre;
        theatre.openAll();
        theatre.armAndMove();
        QVERIFY(!QTest::currentTestFailed());
        theatre.robot->freeze();
        QTRY_VERIFY_WITH_TIMEOUT(theatre.link("robot") == LinkState::StandBy, patience);
        const auto frozen = theatre.robotStatus();
        theatre.robot->thaw();
        QVERIFY2(theatre.robot->waitForLine(QStringLiteral("did not run")), qPrintable(theatre.robot->output()));
        DiagnosisSheet* sheet = nullptr;
        QTRY_VERIFY_WITH_TIMEOUT((sheet = theatre.window().findChild<DiagnosisSheet*>()) != nullptr && sheet->isVisible(), patience);
        theatre.click(QStringLiteral("Re-open channel"), sheet);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.link("robot") == LinkState::Open, patience);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.models().instrument.robotFresh(std::chrono::steady_clock::now()), patience);
        // What it had applied and not yet reported is at most one report's worth; everything later was stale.
        QVERIFY(theatre.robotStatus().appliedCommands <= frozen.appliedCommands + 25);
        QVERIFY(theatre.robotStatus().holdConfirmed);
        QVERIFY(theatre.phase() != PermitPhase::Armed && theatre.phase() != PermitPhase::Engaged);
        theatre.releaseAll();
    }
};

QTEST_MAIN(CockpitTest)
#include "cockpit_test.moc"
