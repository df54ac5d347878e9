// More than one finger on the cockpit: what stops or is held takes each of them, and nothing else does.
#include "cockpit_stage.hpp"
#include "touching_hand.hpp"
#include "widgets/guard_list.hpp"
#include "widgets/hold_button.hpp"
#include "widgets/log_lines.hpp"
#include "widgets/motion_bar.hpp"
#include "widgets/stop_button.hpp"

#include <QApplication>
#include <QScopeGuard>
#include <QScrollBar>
#include <QSignalSpy>
#include <QWindow>

#include <initializer_list>

using namespace console;
using namespace console::test;

namespace {

/// The window's buttons that stop or are held, with all that is in the way of none of them.
struct MotionStage : CockpitStage {
    Hand hand{window};
    QSignalSpy stops{&window, &CockpitWindow::emergencyStopRequested};
    StopButton* stop = window.findChild<StopButton*>();
    HoldButton* arm = named<HoldButton>(QStringLiteral("Arm: hold for one and a half seconds"));
    HoldButton* pedal = named<HoldButton>(QStringLiteral("X-ray pedal: fluoroscopy while held"));

    MotionStage()
    {
        cockpit.openAll();
        PermitEvent event;
        event.kind = PermitEventKind::RobotReported;
        event.robot = RobotState::Ready;
        event.holdConfirmed = true;
        cockpit.models.permit.apply(event, cockpit.now);
        refresh();
    }
};

} // namespace

class TestFingers : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    /// The stop takes whichever finger comes, at its press.
    void aFingerThatScrollsDoesNotKeepTheStopFromTheNext()
    {
        MotionStage stage;
        for (int line = 0; line < 300; ++line)
            stage.cockpit.models.log.append(LogKind::Note, QStringLiteral("line %1").arg(line), 1000 + line);
        QVERIFY(stage.ready());
        stage.window.showView(View::Log);
        auto* lines = stage.log->findChild<LogLines*>();
        const QPoint from = stage.hand.middle(*lines->viewport());
        stage.hand.press(from);
        stage.hand.move(from + QPoint(0, 40));
        stage.hand.move(from + QPoint(0, 80));
        QVERIFY(lines->verticalScrollBar()->value() < lines->verticalScrollBar()->maximum());
        stage.hand.pressAnother(stage.hand.middle(*stage.stop));
        QCOMPARE(stage.stops.count(), 1);
        stage.hand.releaseAnother(stage.hand.middle(*stage.stop));
        stage.hand.release(from + QPoint(0, 80));
        QCOMPARE(stage.stops.count(), 1);
    }

    void aPalmBesideItDoesNotKeepTheStopFromAFinger()
    {
        MotionStage stage;
        QVERIFY(stage.ready());
        auto* bar = stage.window.findChild<MotionBar*>();
        stage.hand.press(stage.hand.at(*bar, {2, 1})); // the stop is on what it touches
        QCOMPARE(stage.window.childAt(stage.hand.at(*bar, {2, 1})), static_cast<QWidget*>(bar));
        stage.hand.pressAnother(stage.hand.middle(*stage.stop));
        QCOMPARE(stage.stops.count(), 1);
        stage.hand.releaseAnother(stage.hand.middle(*stage.stop));
        stage.hand.release(stage.hand.at(*bar, {2, 1}));
    }

    void aTouchStopsOnce()
    {
        MotionStage stage;
        QVERIFY(stage.ready());
        stage.hand.press(stage.hand.middle(*stage.stop));
        QCOMPARE(stage.stops.count(), 1);
        stage.hand.release(stage.hand.middle(*stage.stop));
        QCOMPARE(stage.stops.count(), 1);
    }

    void twoFingersHoldTwoButtons()
    {
        MotionStage stage;
        QVERIFY(stage.ready());
        QVERIFY(stage.arm->isEnabled() && stage.pedal->isEnabled());
        stage.hand.press(stage.hand.middle(*stage.pedal));
        QVERIFY(stage.pedal->isHeld());
        stage.hand.pressAnother(stage.hand.middle(*stage.arm));
        QVERIFY(stage.pedal->isHeld() && stage.arm->isHeld());
        stage.hand.releaseAnother(stage.hand.middle(*stage.arm));
        QVERIFY(stage.pedal->isHeld() && !stage.arm->isHeld());
        const auto interval = qScopeGuard([time = QApplication::doubleClickInterval()] { QApplication::setDoubleClickInterval(time); });
        QApplication::setDoubleClickInterval(0); // another wish, and no double click
        stage.hand.pressAnother(stage.hand.middle(*stage.arm));
        QVERIFY(stage.arm->isHeld());
        QTest::touchEvent(&stage.window, touchScreen())
            .release(0, stage.hand.middle(*stage.pedal), &stage.window)
            .move(1, stage.hand.middle(*stage.arm), &stage.window);
        QVERIFY(!stage.pedal->isHeld() && stage.arm->isHeld());
        QTest::touchEvent(&stage.window, touchScreen()).release(1, stage.hand.middle(*stage.arm), &stage.window);
        QVERIFY(!stage.arm->isHeld());
    }

    void aFurtherFingerLetsGoAsTheMouseDoes_data()
    {
        QTest::addColumn<bool>("leaves");
        QTest::newRow("it slides off the button") << true;
        QTest::newRow("the system takes it") << false;
    }

    void aFurtherFingerLetsGoAsTheMouseDoes()
    {
        QFETCH(bool, leaves);
        MotionStage stage;
        QVERIFY(stage.ready());
        const QPoint palm = stage.hand.middle(*stage.live);
        stage.hand.press(palm);
        stage.hand.pressAnother(stage.hand.middle(*stage.arm));
        QVERIFY(stage.arm->isHeld());
        if (leaves) {
            stage.hand.moveAnother(stage.hand.middle(*stage.arm) - QPoint(0, 400));
            QVERIFY(!stage.arm->isHeld());
            stage.hand.moveAnother(stage.hand.middle(*stage.arm));
        } else {
            QTouchEvent cancel(QEvent::TouchCancel, touchScreen());
            QCoreApplication::sendEvent(stage.window.windowHandle(), &cancel);
        }
        QVERIFY(!stage.arm->isHeld());
        if (!leaves)
            return;
        stage.hand.releaseAnother(stage.hand.middle(*stage.arm));
        stage.hand.release(palm);
    }

    /// A nervous hand shall not arm, with whichever finger.
    void theSecondTouchOfTwoHoldsNothing()
    {
        MotionStage stage;
        QVERIFY(stage.ready());
        const QPoint palm = stage.hand.middle(*stage.live);
        const QPoint arm = stage.hand.middle(*stage.arm);
        stage.hand.press(palm);
        stage.hand.pressAnother(arm);
        stage.hand.releaseAnother(arm);
        stage.hand.pressAnother(arm);
        QVERIFY(!stage.arm->isHeld());
        stage.hand.releaseAnother(arm);
        stage.hand.release(palm);
    }

    void aFurtherFingerPressesNothingElse()
    {
        MotionStage stage;
        QVERIFY(stage.ready());
        const QSignalSpy views(&stage.window, &CockpitWindow::viewRequested);
        const QPoint palm = stage.hand.middle(*stage.live);
        // Each of them shows another view to the mouse, and the second one lies among those that are held.
        for (QWidget* control : std::initializer_list<QWidget*>{stage.named<QAbstractButton>(QStringLiteral("Show the topology")),
                                                                stage.window.findChild<GuardList*>()}) {
            QVERIFY(control != nullptr && control->isVisible());
            stage.hand.press(palm);
            stage.hand.pressAnother(stage.hand.middle(*control));
            stage.hand.releaseAnother(stage.hand.middle(*control));
            stage.hand.release(palm);
        }
        QCOMPARE(views.count(), 0);
        stage.cockpit.models.role = OperatorRole::Observer; // who gives no beam
        stage.refresh();
        stage.hand.press(palm);
        stage.hand.pressAnother(stage.hand.middle(*stage.pedal));
        QVERIFY(!stage.pedal->isEnabled() && !stage.pedal->isHeld());
        stage.hand.releaseAnother(stage.hand.middle(*stage.pedal));
        stage.hand.release(palm);
    }
};

QTEST_MAIN(TestFingers)
#include "test_fingers.moc"
