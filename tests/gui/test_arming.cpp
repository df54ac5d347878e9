// ARM, the pedal and the emergency stop under a person's hands.
#include "cockpit_stage.hpp"
#include "widgets/hold_button.hpp"
#include "widgets/permit_block.hpp"
#include "widgets/stop_button.hpp"

#include <QPushButton>
#include <QSignalSpy>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

/// The window's ARM drives a real permit, on a clock of the test's own.
struct Arming : CockpitStage {
    Instant clock = cockpit.now;
    bool asked = false;

    Arming()
    {
        cockpit.openAll();
        tell(PermitEventKind::RobotReported);
        QObject::connect(&window, &CockpitWindow::armHoldChanged, &window,
                         [this](bool held) { tell(held ? PermitEventKind::ArmPressed : PermitEventKind::ArmReleased); });
    }

    void tell(PermitEventKind kind)
    {
        PermitEvent event;
        event.kind = kind;
        event.robot = RobotState::Ready;
        event.holdConfirmed = true;
        event.permit = permitNumber;
        asked = cockpit.models.permit.apply(event, clock).requestArm || asked;
    }

    void pass(Duration time)
    {
        clock += time;
        tell(PermitEventKind::Tick);
        refresh();
    }

    PermitPhase phase() const { return cockpit.models.permit.phase(); }
    HoldButton* arm() const { return named<HoldButton>(QStringLiteral("Arm: hold for one and a half seconds")); }
};

/// The robot may tell of an emergency stop. What the hand's key for its reset does comes by setResetHeld().
struct Stopping : CockpitStage {
    QSignalSpy asked{&window, &CockpitWindow::emergencyStopResetRequested};

    Stopping() { cockpit.openAll(); }

    void tell(bool stopped, quint64 token = 99)
    {
        RobotStatus status = cockpit.status(stopped ? RobotState::EmergencyStop : RobotState::Ready);
        status.emergencyStopToken = stopped ? token : 0;
        cockpit.models.instrument.receiveRobot(status, std::chrono::steady_clock::now());
        refresh();
    }

    /// How often it was asked for when what is held now goes on being held.
    int askedIn(Duration time)
    {
        window.refresh(std::chrono::steady_clock::now() + time);
        return int(asked.count());
    }
};

} // namespace

class TestArming : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void aWindowThatEndsLetsGoOfArm()
    {
        QList<bool> told;
        QObject listener;
        {
            Arming stage;
            QVERIFY(stage.ready());
            stage.refresh();
            QObject::disconnect(&stage.window, &CockpitWindow::armHoldChanged, &stage.window, nullptr); // the permit ends before the window
            QObject::connect(&stage.window, &CockpitWindow::armHoldChanged, &listener, [&told](bool held) { told.append(held); });
            QTest::mousePress(stage.arm(), Qt::LeftButton);
            QCOMPARE(told, QList<bool>{true});
        }
        QCOMPARE(told, (QList<bool>{true, false}));
    }

    void holdingArmAsksTheRobot()
    {
        Arming stage;
        QVERIFY(stage.ready());
        stage.refresh();
        QCOMPARE(stage.phase(), PermitPhase::Ready);
        QTest::mousePress(stage.arm(), Qt::LeftButton);
        QCOMPARE(stage.phase(), PermitPhase::Arming);
        stage.pass(1400ms);
        QVERIFY(!stage.asked);
        stage.pass(200ms);
        QVERIFY(stage.asked);
        QTest::mouseRelease(stage.arm(), Qt::LeftButton);
    }

    void clickNeverArms()
    {
        Arming stage;
        QVERIFY(stage.ready());
        stage.refresh();
        QTest::mouseClick(stage.arm(), Qt::LeftButton);
        stage.pass(5s);
        QCOMPARE(stage.phase(), PermitPhase::Ready);
        QVERIFY(!stage.asked);
    }

    void doubleClickHeldDownNeverArms()
    {
        Arming stage;
        QVERIFY(stage.ready());
        stage.refresh();
        QTest::mouseClick(stage.arm(), Qt::LeftButton);
        QMouseEvent second(QEvent::MouseButtonDblClick, QPointF(20, 20), stage.arm()->mapToGlobal(QPointF(20, 20)), Qt::LeftButton,
                           Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(stage.arm(), &second);
        stage.pass(5s);
        QCOMPARE(stage.phase(), PermitPhase::Ready);
        QVERIFY(!stage.asked);
    }

    void keysNeverArm_data()
    {
        QTest::addColumn<int>("key");
        QTest::newRow("Enter") << int(Qt::Key_Enter);
        QTest::newRow("Return") << int(Qt::Key_Return);
        QTest::newRow("Space") << int(Qt::Key_Space);
        QTest::newRow("Select") << int(Qt::Key_Select);
    }

    void keysNeverArm()
    {
        QFETCH(int, key);
        Arming stage;
        QVERIFY(stage.ready());
        stage.refresh();
        stage.arm()->setFocus();
        QVERIFY(stage.arm()->hasFocus());
        QSignalSpy held(&stage.window, &CockpitWindow::armHoldChanged);
        QTest::keyPress(stage.arm(), Qt::Key(key));
        stage.pass(5s);
        QTest::keyRelease(stage.arm(), Qt::Key(key));
        QCOMPARE(held.count(), 0);
        QCOMPARE(stage.phase(), PermitPhase::Ready);
    }

    void lettingGoEndsTheHold_data()
    {
        QTest::addColumn<QString>("how");
        for (const char* how : {"release", "pointer leaves", "hidden", "disabled", "window loses the screen"})
            QTest::newRow(how) << QString::fromLatin1(how);
    }

    void lettingGoEndsTheHold()
    {
        QFETCH(QString, how);
        HoldButton button;
        button.setTexts(QStringLiteral("ARM"), QStringLiteral("hold"));
        button.resize(200, 80);
        button.show();
        QVERIFY(QTest::qWaitForWindowActive(&button));
        QSignalSpy held(&button, &HoldButton::holdChanged);
        QTest::mousePress(&button, Qt::LeftButton);
        QVERIFY(button.isHeld());
        if (how == QLatin1String("release"))
            QTest::mouseRelease(&button, Qt::LeftButton);
        else if (how == QLatin1String("pointer leaves"))
            QTest::mouseMove(&button, QPoint(500, 300));
        else if (how == QLatin1String("hidden"))
            button.hide();
        else if (how == QLatin1String("disabled"))
            button.setEnabled(false);
        else {
            QEvent lost(QEvent::WindowDeactivate);
            QCoreApplication::sendEvent(&button, &lost);
        }
        QVERIFY(!button.isHeld());
        QCOMPARE(held.count(), 2);
        QCOMPARE(held.last().first().toBool(), false);
    }

    void armIsNotOfferedBeforeReady()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.refresh();
        auto* arm = stage.named<HoldButton>(QStringLiteral("Arm: hold for one and a half seconds"));
        QSignalSpy held(&stage.window, &CockpitWindow::armHoldChanged);
        QTest::mousePress(arm, Qt::LeftButton);
        QTest::mouseRelease(arm, Qt::LeftButton);
        QCOMPARE(held.count(), 0);
    }

    void pedalIsDownWhileHeld()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        auto* pedal = stage.named<HoldButton>(QStringLiteral("X-ray pedal: fluoroscopy while held"));
        QSignalSpy changed(&stage.window, &CockpitWindow::pedalChanged);
        QTest::mousePress(pedal, Qt::LeftButton);
        QCOMPARE(changed.takeFirst().first().toBool(), true);
        QTest::mouseRelease(pedal, Qt::LeftButton);
        QCOMPARE(changed.takeFirst().first().toBool(), false);
    }

    void aRestingForceIsAcceptedByAClickAndOnlyBeforeArming()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        const auto name = QStringLiteral("Accept this force");
        const auto feel = [&stage](double newtons, RobotState state) {
            auto status = stage.cockpit.status(state);
            status.guidewireForce = newtons;
            stage.cockpit.models.instrument.receiveRobot(status, std::chrono::steady_clock::now());
            stage.refresh();
        };
        feel(0.1, RobotState::Ready);
        QVERIFY(!stage.named<QPushButton>(name));
        feel(0.43, RobotState::Ready);
        auto* accept = stage.named<QPushButton>(name);
        QVERIFY(accept != nullptr);
        QVERIFY2(accept->text().contains(QStringLiteral("0.43")), qPrintable(accept->text()));
        QSignalSpy accepted(&stage.window, &CockpitWindow::forceAccepted);
        QTest::mouseClick(accept, Qt::LeftButton);
        QCOMPARE(accepted.count(), 0); // that was meant for what stood there before
        const auto press = [&] {
            feel(0.43, RobotState::Ready);
            QTest::mouseClick(accept, Qt::LeftButton);
            return !accepted.isEmpty();
        };
        QVERIFY(QTest::qWaitFor(press));
        QCOMPARE(accepted.count(), 1);
        QCOMPARE(accepted.first().first().toDouble(), 0.43);
        QVERIFY(stage.window.handHasKeys()); // the hand has them again
        // While a finger is on it, it stays what it was.
        QTest::mousePress(accept, Qt::LeftButton);
        const auto pressed = std::chrono::steady_clock::now();
        const auto held = [&] {
            feel(0.85, RobotState::Ready);
            return std::chrono::steady_clock::now() - pressed > 1500ms;
        };
        QTRY_VERIFY(held());
        QTest::mouseRelease(accept, Qt::LeftButton);
        QCOMPARE(accepted.count(), 2);
        QCOMPARE(accepted.last().first().toDouble(), 0.43);
        feel(1.4, RobotState::Ready);
        QVERIFY(!stage.named<QPushButton>(name)); // a force that warns is not accepted
        stage.cockpit.arm();
        feel(0.43, RobotState::Armed);
        QVERIFY(!stage.named<QPushButton>(name));
    }

    void holdNamesTheConditionThatFailedAlsoWhenItIsMetAgain()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.arm();
        stage.cockpit.engage();
        auto& permit = stage.cockpit.models.permit;
        QCOMPARE(permit.phase(), PermitPhase::Engaged);
        auto readings = stage.cockpit.goodReadings();
        readings.robotState = RobotState::Engaged;
        readings.carried = 30ms;
        readings.usualRoundTrip = 62ms;
        permit.keep(readings, stage.cockpit.now);
        QCOMPARE(permit.phase(), PermitPhase::Hold);
        QCOMPARE(permit.holdReasons().size(), 1);
        permit.check(stage.cockpit.goodReadings(), stage.cockpit.now);
        stage.refresh();
        const auto* block = stage.window.findChild<PermitBlock*>();
        const auto was = QStringLiteral("Held because: Commands take 62 ms there and back"); // they no longer do
        QVERIFY2(block->accessibleDescription().contains(was), qPrintable(block->accessibleDescription()));
    }

    void emergencyStopActsAtThePress()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        auto* stop = stage.named<StopButton>(QStringLiteral("Emergency stop"));
        QSignalSpy asked(&stage.window, &CockpitWindow::emergencyStopRequested);
        QTest::mousePress(stop, Qt::LeftButton);
        QCOMPARE(asked.count(), 1);
        QTest::mouseRelease(stop, Qt::LeftButton);
        QCOMPARE(asked.count(), 1);
    }

    void emergencyStopIsNeverDisabled()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        auto* stop = stage.named<StopButton>(QStringLiteral("Emergency stop"));
        QVERIFY(stop->isEnabled());
        stage.cockpit.openAll();
        stage.cockpit.loseRobot();
        stage.refresh();
        QVERIFY(stop->isEnabled() && stop->isVisible());
    }

    void resetOfTheStopIsOfferedOnlyThen()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        const QString name = QStringLiteral("Reset the emergency stop: hold for one and a half seconds");
        stage.cockpit.openAll();
        stage.refresh();
        QVERIFY(!stage.named<HoldButton>(name));
        RobotStatus stopped = stage.cockpit.status(RobotState::EmergencyStop);
        stopped.emergencyStopToken = 99;
        stage.cockpit.models.instrument.receiveRobot(stopped, std::chrono::steady_clock::now());
        stage.refresh();
        auto* reset = stage.named<HoldButton>(name);
        QVERIFY(reset);
        QSignalSpy asked(&stage.window, &CockpitWindow::emergencyStopResetRequested);
        QTest::mouseClick(reset, Qt::LeftButton);
        stage.window.refresh(std::chrono::steady_clock::now() + 3s);
        QCOMPARE(asked.count(), 0);
        QTest::mousePress(reset, Qt::LeftButton);
        stage.window.refresh(std::chrono::steady_clock::now() + 2s);
        stage.window.refresh(std::chrono::steady_clock::now() + 3s);
        QCOMPARE(asked.count(), 1);
        QTest::mouseRelease(reset, Qt::LeftButton);
    }

    /// What comes while the reset is held is another reason to look at the patient.
    void aNewerStopIsNotResetByAHoldThatWasBegunBefore()
    {
        Stopping stage;
        QVERIFY(stage.ready());
        stage.tell(true);
        stage.window.setResetHeld(true);
        stage.tell(true, 100);
        QCOMPARE(stage.askedIn(3s), 0);
        stage.window.setResetHeld(false);
        stage.window.setResetHeld(true);
        QCOMPARE(stage.askedIn(3s), 1);
        stage.window.setResetHeld(false);
    }

    void resetOfTheStopByItsKeyIsHeldAsLong()
    {
        Stopping stage;
        QVERIFY(stage.ready());
        stage.tell(true);
        stage.window.setResetHeld(true);
        stage.window.setResetHeld(false);
        QCOMPARE(stage.askedIn(3s), 0);
        stage.window.setResetHeld(true);
        QCOMPARE(stage.askedIn(1400ms), 0);
        QCOMPARE(stage.askedIn(2s), 1);
        QCOMPARE(stage.askedIn(9s), 1); // held on, it asks no second time
    }

    void resetKeyThatWasDownBeforeTheStopCountsForNothing()
    {
        Stopping stage;
        QVERIFY(stage.ready());
        stage.tell(false);
        stage.window.setResetHeld(true);
        stage.tell(true);
        QCOMPARE(stage.askedIn(3s), 0);
        stage.window.setResetHeld(false);
        stage.window.setResetHeld(true);
        stage.tell(false); // somebody else's reset ends the hold
        stage.tell(true);
        QCOMPARE(stage.askedIn(3s), 0);
    }

    void anObserversKeyResetsNoStop()
    {
        Stopping stage;
        QVERIFY(stage.ready());
        stage.cockpit.models.role = OperatorRole::Observer;
        stage.tell(true);
        stage.window.setResetHeld(true);
        QCOMPARE(stage.askedIn(3s), 0);
    }
};

QTEST_MAIN(TestArming)
#include "test_arming.moc"
