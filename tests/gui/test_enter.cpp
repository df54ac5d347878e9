// Enter on the cockpit's buttons, on a desktop that takes it for a press: what acts on links, alarms or motion does not, only the emergency
// stop does. The others say so themselves (gui.diagnosis_sheet, gui.start_view, gui.log_view).
#include "cockpit_stage.hpp"
#include "widgets/master_row.hpp"
#include "widgets/stop_button.hpp"
#include "widgets/touch_button.hpp"

#include <QApplication>
#include <QKeyEvent>
#include <QSignalSpy>

#include <functional>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

struct Case {
    const char* name;
    std::function<void(CockpitStage&)> bring;
    const char* button; ///< its accessible name
};

void raiseAlarm(CockpitStage& stage)
{
    stage.cockpit.models.alarms.update({{AlarmCondition::ForceWarn, robotId, AlarmPriority::Medium, false, QStringLiteral("Force"),
                                         QStringLiteral("Advance no further.")}},
                                       stage.cockpit.now, 0);
}

void askAboutTheTest(CockpitStage& stage)
{
    auto& test = stage.cockpit.models.selfTest;
    Instant at = stage.cockpit.now;
    for (test.begin(at); test.step() != AlarmSelfTest::Step::Asking; at += 100ms)
        test.update(false, at);
}

const std::vector<Case>& cases()
{
    static const auto nothing = [](CockpitStage&) {};
    static const auto open = [](CockpitStage& stage) { stage.cockpit.openAll(); };
    static const std::vector<Case> all{
        {"a card that opens", nothing, "Open the link to Vascular robot"},
        {"a card that closes", open, "Close the link to Vascular robot"},
        {"a card that re-opens", [](CockpitStage& stage) { stage.cockpit.openAll(), stage.cockpit.loseRobot(); },
         "Re-open the link to Vascular robot"},
        {"Open all", nothing, "Open all closed links, one after the other"},
        {"the topology", nothing, "Show the topology"},
        {"Acknowledge", raiseAlarm, "Acknowledge the alarm shown"},
        {"Pause", raiseAlarm, "Pause the alarm sound for a while, or end the pause"},
        {"Incident", nothing, "Mark this moment in both logs as an incident"},
        {"the self-test", nothing, "Begin the alarm self-test: three colours and three sounds"},
        {"seen and heard", askAboutTheTest, "All three alarm colours were seen, and the sounds heard"},
        {"not right", askAboutTheTest, "An alarm colour or a sound was missing"},
    };
    return all;
}

/// As where Enter presses whatever button has the focus: Qt's own way to it that is the same on every desktop.
void takeEnterForAPress(QPushButton& button) { button.setAutoDefault(true); }

} // namespace

class TestEnter : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    /// Else all that is below would say nothing.
    void pressesAPlainButtonHere()
    {
        QPushButton plain;
        takeEnterForAPress(plain);
        plain.show();
        QSignalSpy clicked(&plain, &QPushButton::clicked);
        QTest::keyClick(&plain, Qt::Key_Return);
        QTest::keyClick(&plain, Qt::Key_Enter);
        QCOMPARE(clicked.count(), 2);
    }

    void pressesNothingThatActs_data()
    {
        QTest::addColumn<int>("which");
        for (std::size_t i = 0; i < cases().size(); ++i)
            QTest::newRow(cases()[i].name) << int(i);
    }

    void pressesNothingThatActs()
    {
        QFETCH(int, which);
        const Case& wanted = cases().at(std::size_t(which));
        CockpitStage stage;
        QVERIFY(stage.ready());
        wanted.bring(stage);
        stage.refresh();
        auto* button = stage.named<QPushButton>(QString::fromLatin1(wanted.button));
        QVERIFY(button != nullptr && button->isEnabled());
        takeEnterForAPress(*button);
        button->setFocus(Qt::TabFocusReason);
        QCOMPARE(QApplication::focusWidget(), static_cast<QWidget*>(button));
        QSignalSpy pressed(button, &QPushButton::pressed);
        QSignalSpy clicked(button, &QPushButton::clicked);
        for (const Qt::Key key : {Qt::Key_Return, Qt::Key_Enter})
            QTest::keyClick(button, key);
        QCOMPARE(pressed.count(), 0);
        QCOMPARE(clicked.count(), 0);
        QCOMPARE(QApplication::focusWidget(), static_cast<QWidget*>(button));
        QTest::keyClick(button, Qt::Key_Space);
        QCOMPARE(clicked.count(), 1);
    }

    void opensNoLinksFromTheTopology()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.window.showView(View::Topology);
        stage.topology->refresh(stage.cockpit.now);
        QSignalSpy asked(stage.topology, &TopologyView::openAllRequested);
        QPushButton* openAll = nullptr;
        for (auto* button : stage.topology->findChildren<QPushButton*>())
            if (button->accessibleName() == QStringLiteral("Open all closed links, one after the other"))
                openAll = button;
        QVERIFY(openAll != nullptr && openAll->isVisible() && openAll->isEnabled());
        takeEnterForAPress(*openAll);
        openAll->setFocus(Qt::TabFocusReason);
        for (const Qt::Key key : {Qt::Key_Return, Qt::Key_Enter})
            QTest::keyClick(openAll, key);
        QCOMPARE(asked.count(), 0);
        QTest::keyClick(openAll, Qt::Key_Space);
        QCOMPARE(asked.count(), 1);
    }

    /// A plain QPushButton would do as the desktop does.
    void everyButtonSaysItself()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        const auto buttons = stage.window.findChildren<QPushButton*>();
        QVERIFY(buttons.size() > 20);
        for (const auto* button : buttons)
            QVERIFY2(qobject_cast<const TouchButton*>(button) != nullptr, qPrintable(button->accessibleName()));
    }

    void isTheButtonsOwnWhereItIsIgnored_data()
    {
        QTest::addColumn<int>("key");
        QTest::newRow("Return") << int(Qt::Key_Return);
        QTest::newRow("Enter") << int(Qt::Key_Enter);
    }

    /// No way is left to what Qt does with it.
    void isTheButtonsOwnWhereItIsIgnored()
    {
        QFETCH(int, key);
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.losePad();
        stage.refresh();
        MasterChip* chip = nullptr;
        for (auto* candidate : stage.window.findChildren<MasterChip*>())
            if (candidate->isVisible() && candidate->isEnabled())
                chip = candidate;
        QVERIFY(chip != nullptr);
        QSignalSpy chosen(&stage.window, &CockpitWindow::masterChosen);
        chip->setFocus(Qt::TabFocusReason);
        for (const auto type : {QEvent::KeyPress, QEvent::KeyRelease}) {
            QKeyEvent event(type, key, Qt::NoModifier);
            QCoreApplication::sendEvent(chip, &event);
            QVERIFY(event.isAccepted()); // a plain button of Qt leaves it to the window, or is pressed by it
        }
        QCOMPARE(chosen.count(), 0);
        QTest::keyClick(chip, Qt::Key_Space);
        QCOMPARE(chosen.count(), 1);
    }

    void stopsOnEveryDesktop()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        auto* stop = stage.window.findChild<StopButton*>();
        QSignalSpy asked(&stage.window, &CockpitWindow::emergencyStopRequested);
        stop->setFocus(Qt::TabFocusReason);
        for (const Qt::Key key : {Qt::Key_Return, Qt::Key_Enter, Qt::Key_Space})
            QTest::keyClick(stop, key);
        QCOMPARE(asked.count(), 3);
        QKeyEvent repeated(QEvent::KeyPress, Qt::Key_Return, Qt::NoModifier, QString(), true);
        QCoreApplication::sendEvent(stop, &repeated);
        QCOMPARE(asked.count(), 3); // a key that is held is one wish
    }
};

QTEST_MAIN(TestEnter)
#include "test_enter.moc"
