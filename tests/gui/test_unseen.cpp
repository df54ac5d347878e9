// Nobody sees the screen, though the window is the active one for Qt: what the hand holds, by key or by mouse, is let go at once, nothing
// is taken up meanwhile, and nothing comes back with the sight.
//
// Who tells of it is tried by system.seat_watch, and what comes of it at the robot by system.never_unseen.
#include "cockpit_stage.hpp"
#include "model/present_readings.hpp"
#include "widgets/hold_button.hpp"

#include <QSignalSpy>

using namespace console;
using namespace console::test;

namespace {

const QString locked = QStringLiteral("Screen is locked");

struct Stage : CockpitStage {
    QSignalSpy hand{&window, &CockpitWindow::handFocusChanged};
    QSignalSpy pressed{&window, &CockpitWindow::handKeyPressed};
    QSignalSpy pedal{&window, &CockpitWindow::pedalChanged};

    bool readyWithKeys()
    {
        if (!ready())
            return false;
        window.setFocus();
        return QTest::qWaitFor([this] { return window.handHasKeys(); });
    }

    static QList<bool> told(const QSignalSpy& spy)
    {
        QList<bool> all;
        for (const auto& arguments : spy)
            all << arguments.front().toBool();
        return all;
    }

    GuardLine keysLine() const
    {
        const auto readings = guardReadings(cockpit.models, robotId, window.handHasKeys(), cockpit.now);
        return checkGuards(readings).at(std::size_t(Guard::WindowActive));
    }

    HoldButton* holdButton(const QString& begin) const
    {
        for (auto* button : window.findChildren<HoldButton*>())
            if (button->isVisible() && button->accessibleName().startsWith(begin))
                return button;
        return nullptr;
    }
};

} // namespace

class TestUnseen : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void theHandHasNoKeysUntilSomebodyMaySeeItAgain()
    {
        Stage stage;
        QVERIFY(stage.readyWithKeys());
        QVERIFY(stage.keysLine().met);
        QTest::keyPress(&stage.window, Qt::Key_D);
        QCOMPARE(stage.pressed.count(), 1);
        stage.pressed.clear();
        stage.hand.clear();

        stage.window.setUnseen(locked);
        QVERIFY(stage.window.isActiveWindow() && QApplication::focusWidget() == &stage.window); // as far as Qt knows
        QVERIFY(!stage.window.handHasKeys());
        QCOMPARE(stage.told(stage.hand), QList<bool>{false});
        QVERIFY(!stage.keysLine().met);
        QCOMPARE(stage.keysLine().text, locked);
        QTest::keyPress(&stage.window, Qt::Key_Up);
        QTest::mouseClick(&stage.window, Qt::LeftButton, {}, stage.window.regionGeometry(Region::Status).center());
        QTest::keyClick(&stage.window, Qt::Key_F1);
        QVERIFY(!stage.window.handHasKeys());
        QCOMPARE(stage.pressed.count(), 0);

        stage.window.setUnseen(QStringLiteral("Another session is on this screen"));
        QCOMPARE(stage.keysLine().text, QStringLiteral("Another session is on this screen"));
        QCOMPARE(stage.hand.count(), 1);

        stage.window.setUnseen({});
        QVERIFY(stage.window.handHasKeys() && stage.keysLine().met);
        QCOMPARE(stage.hand.count(), 2);
        QTest::keyRelease(&stage.window, Qt::Key_D); // what was down before counts for nothing
        QTest::keyRelease(&stage.window, Qt::Key_Up);
        QCOMPARE(stage.pressed.count(), 0);
        QTest::keyPress(&stage.window, Qt::Key_D);
        QCOMPARE(stage.pressed.count(), 1);
    }

    /// Wherever the keys are: the mouse needs none.
    void whatTheMouseHoldsIsLetGo_data()
    {
        QTest::addColumn<bool>("view");
        QTest::newRow("the cockpit has the keys") << false;
        QTest::newRow("a view has them") << true;
    }

    void whatTheMouseHoldsIsLetGo()
    {
        QFETCH(bool, view);
        Stage stage;
        QVERIFY(stage.readyWithKeys());
        if (view)
            stage.window.showView(View::Topology);
        auto* pedal = stage.holdButton(QStringLiteral("X-ray pedal:"));
        QVERIFY(pedal != nullptr);
        QTest::mousePress(pedal, Qt::LeftButton);
        QCOMPARE(stage.told(stage.pedal), QList<bool>{true});
        stage.window.setUnseen(locked);
        QVERIFY(!pedal->isHeld());
        QCOMPARE(stage.told(stage.pedal), (QList<bool>{true, false}));
        stage.window.setUnseen({}); // still down
        stage.refresh();
        QVERIFY(!pedal->isHeld());
        QTest::mouseRelease(pedal, Qt::LeftButton);
        QCOMPARE(stage.pedal.count(), 2);
    }

    void nothingCanBeHeldMeanwhile_data()
    {
        QTest::addColumn<QString>("name");
        for (const char* name : {"Arm:", "X-ray pedal:", "Inject contrast:", "Reset the emergency stop:"})
            QTest::newRow(name) << QString::fromLatin1(name);
    }

    void nothingCanBeHeldMeanwhile()
    {
        QFETCH(QString, name);
        Stage stage;
        stage.cockpit.openAll();
        if (name == QLatin1String("Reset the emergency stop:")) {
            auto status = stage.cockpit.status(RobotState::EmergencyStop);
            status.emergencyStopToken = 99;
            stage.cockpit.models.instrument.receiveRobot(status, std::chrono::steady_clock::now());
        }
        QVERIFY(stage.readyWithKeys());
        stage.refresh();
        auto* button = stage.holdButton(name);
        QVERIFY(button != nullptr);
        button->setEnabled(true); // as when nothing else stands in the way
        QSignalSpy held(button, &HoldButton::holdChanged);
        stage.window.setUnseen(locked);
        QTest::mousePress(button, Qt::LeftButton);
        QTest::mouseRelease(button, Qt::LeftButton);
        stage.window.setResetHeld(true);
        stage.window.setResetHeld(false);
        QCOMPARE(held.count(), 0);
        stage.window.setUnseen({});
        QTest::mousePress(button, Qt::LeftButton);
        QVERIFY(button->isHeld());
        QTest::mouseRelease(button, Qt::LeftButton);
        QCOMPARE(held.count(), 2);
    }

    /// Whoever comes to a locked console can still stop the robot with what reaches it.
    void whatStopsCountsAllTheSame()
    {
        Stage stage;
        QVERIFY(stage.readyWithKeys());
        QSignalSpy stop(&stage.window, &CockpitWindow::emergencyStopRequested);
        QSignalSpy hold(&stage.window, &CockpitWindow::panicHoldRequested);
        stage.window.setUnseen(locked);
        QTest::keyClick(&stage.window, Qt::Key_F12);
        QTest::keyClick(&stage.window, Qt::Key_Escape);
        QCOMPARE(hold.count(), 1);
        QCOMPARE(stop.count(), 1);
    }
};

QTEST_MAIN(TestUnseen)
#include "test_unseen.moc"
