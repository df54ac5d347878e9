// A master that is lost ends motion: masters, model and permit together.
#include "app/hand_desk.hpp"
#include "input/simulated_haptic_master.hpp"
#include "invented_cockpit.hpp"
#include "plugged_master.hpp"

#include <QTest>

#include <algorithm>
#include <chrono>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

/// A desk whose hand drives the permit of an armed cockpit, as the console's loop does. Its clock runs ahead of the real one, never behind.
struct Stage {
    InventedCockpit cockpit;
    Options options;
    HandDesk desk{options, cockpit.models};
    PluggedMaster pad{MasterKind::GamePad};
    Instant now = cockpit.now;

    Stage()
    {
        desk.rack().add(pad);
        QObject::connect(&desk, &HandDesk::lifeChanged, [this] { check(); });
        QObject::connect(&desk, &HandDesk::deadManChanged, [this](bool pressed) {
            PermitEvent event;
            event.kind = pressed ? PermitEventKind::DeadManPressed : PermitEventKind::DeadManReleased;
            if (cockpit.models.permit.apply(event, now).rezero)
                desk.rezero(now);
        });
        desk.setListening(true);
        pad.plug(true);
        turn();
    }

    PermitPhase phase() const { return cockpit.models.permit.phase(); }
    const HandReading& hand() const { return cockpit.models.hand.reading(); }

    void check()
    {
        auto readings = cockpit.goodReadings();
        const bool armed = phase() == PermitPhase::Armed || phase() == PermitPhase::Engaged;
        readings.robotState = armed ? RobotState::Armed : RobotState::Ready;
        readings.handAlive = hand().alive;
        readings.handMissing = desk.missing();
        readings.windowActive = desk.listening();
        readings.deadMan = hand().deadMan;
        cockpit.models.permit.check(readings, now);
    }

    void turn(Duration time = 10ms)
    {
        now = std::max(now, std::chrono::steady_clock::now()) + time;
        desk.poll(now);
        check();
    }

    void armWithPad()
    {
        cockpit.openAll();
        desk.choose(MasterKind::GamePad);
        turn();
        QVERIFY(hand().alive);
        cockpit.arm();
        QCOMPARE(phase(), PermitPhase::Armed);
    }

    void engageWithPad()
    {
        armWithPad();
        pad.controls.deadMan = true;
        turn();
        QCOMPARE(phase(), PermitPhase::Engaged);
        pad.controls.motion.guidewireVelocity = 10;
        pad.controls.axesAtRest = false;
        turn();
        QVERIFY(!hand().motion.isZero());
    }
};

/// Engaged by the simulated haptic master on the keyboard.
struct HapticStage {
    InventedCockpit cockpit;
    Options options;
    HandDesk desk{options, cockpit.models};
    SimulatedHapticMaster master{desk.keyboard()};
    Instant now = cockpit.now;

    HapticStage()
    {
        desk.rack().add(master);
        desk.rack().begin(MasterKind::HapticSimulated);
        desk.setListening(true);
        cockpit.openAll();
        cockpit.arm();
        cockpit.engage();
        desk.keyboard().press(Qt::Key_D);
    }

    /// The force that the hand is offered when the robot reported `status` a moment ago, and goes on doing so.
    double after(Duration time, const std::optional<RobotStatus>& status)
    {
        for (const Instant end = now + time; now < end;) {
            now += 10ms;
            if (status)
                cockpit.models.instrument.receiveRobot(*status, now);
            desk.poll(now);
        }
        return cockpit.models.hand.reading().forceToHand.value_or(-99);
    }
};

} // namespace

class TestHandDesk : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aMasterThatIsLostEndsInHold_data()
    {
        QTest::addColumn<QString>("how");
        QTest::addColumn<bool>("engaged");
        for (const auto* how : {"pulled out", "silent", "replaced", "window lost"}) {
            QTest::addRow("%s while armed", how) << QString::fromLatin1(how) << false;
            QTest::addRow("%s while engaged", how) << QString::fromLatin1(how) << true;
        }
    }

    void aMasterThatIsLostEndsInHold()
    {
        QFETCH(QString, how);
        QFETCH(bool, engaged);
        Stage stage;
        engaged ? stage.engageWithPad() : stage.armWithPad();
        if (QTest::currentTestFailed())
            return;
        if (how == QLatin1String("pulled out")) {
            stage.pad.plug(false);
        } else if (how == QLatin1String("silent")) {
            stage.turn(ConnectedMaster::lateLimit + 1ms);
        } else if (how == QLatin1String("replaced")) {
            const auto held = stage.pad.controls;
            stage.pad.plug(false);
            stage.pad.plug(true);
            stage.pad.controls = held;
        } else {
            stage.desk.setListening(false);
        }
        QCOMPARE(stage.phase(), PermitPhase::Hold);
        QCOMPARE(stage.cockpit.models.permit.state().stream(), MotionStream::None);
        QVERIFY(stage.hand().motion.isZero());
        for (int i = 0; i < 20; ++i)
            stage.turn();
        QCOMPARE(stage.phase(), PermitPhase::Hold);
    }

    void lettingGoEndsInArmedNotInHold()
    {
        Stage stage;
        stage.engageWithPad();
        stage.pad.controls = {};
        stage.turn();
        QCOMPARE(stage.phase(), PermitPhase::Armed);
    }

    void anotherMasterIsNotTakenWhileArmedOrEngaged()
    {
        Stage stage;
        stage.armWithPad();
        stage.desk.choose(MasterKind::Keyboard);
        QCOMPARE(stage.cockpit.models.hand.masterInUse()->kind, MasterKind::GamePad);
        QCOMPARE(stage.phase(), PermitPhase::Armed);
        stage.pad.controls.deadMan = true;
        stage.turn();
        QCOMPARE(stage.phase(), PermitPhase::Engaged);
        stage.desk.choose(MasterKind::Keyboard);
        QCOMPARE(stage.cockpit.models.hand.masterInUse()->kind, MasterKind::GamePad);
        QCOMPARE(stage.phase(), PermitPhase::Engaged);
    }

    void aMasterThatWasNotLetGoDoesNotLetArm()
    {
        Stage stage;
        stage.cockpit.openAll();
        QCOMPARE(stage.phase(), PermitPhase::Ready);
        stage.pad.controls.axesAtRest = false; // a stuck axis
        stage.pad.controls.motion.guidewireVelocity = 4;
        stage.turn();
        stage.desk.choose(MasterKind::GamePad);
        stage.turn();
        QCOMPARE(stage.phase(), PermitPhase::Standby);
        QVERIFY(stage.hand().motion.isZero());
        QVERIFY2(stage.cockpit.models.permit.unmetText().contains(QStringLiteral("let go first")),
                 qPrintable(stage.cockpit.models.permit.unmetText()));
    }

    void aDeflectionAtTheEngageMovesOnlyAfterItWasAtRest()
    {
        Stage stage;
        stage.armWithPad();
        stage.pad.controls.motion.guidewireVelocity = 10;
        stage.pad.controls.axesAtRest = false;
        stage.turn();
        stage.pad.controls.deadMan = true;
        stage.turn();
        QCOMPARE(stage.phase(), PermitPhase::Engaged);
        stage.turn();
        QVERIFY(stage.hand().deadMan && stage.hand().motion.isZero());
        const auto pushed = stage.pad.controls;
        stage.pad.controls.motion = {};
        stage.pad.controls.axesAtRest = true;
        stage.turn();
        stage.pad.controls = pushed;
        stage.turn();
        QVERIFY(!stage.hand().motion.isZero());
    }

    void onlyAMasterWithForceOffersOne()
    {
        Stage stage;
        QVERIFY(!stage.hand().forceToHand);
    }

    void theHandFeelsTheRobotWhileItMovesIt()
    {
        HapticStage stage;
        auto status = stage.cockpit.status(RobotState::Engaged);
        status.guidewireForce = 0.8;
        QCOMPARE(stage.after(1s, status), 0.8);
        QCOMPARE(stage.after(InstrumentState::statusLimit, std::nullopt), 0.8); // not yet stale
    }

    void theHandFeelsNothingOtherwise_data()
    {
        QTest::addColumn<QString>("how");
        for (const auto* how : {"stale", "robot not engaged", "robot holds", "dead-man let go", "hold", "link suspect", "link lost"})
            QTest::newRow(how) << QString::fromLatin1(how);
    }

    void theHandFeelsNothingOtherwise()
    {
        QFETCH(QString, how);
        HapticStage stage;
        auto status = stage.cockpit.status(RobotState::Engaged);
        status.guidewireForce = 2.9;
        QCOMPARE(stage.after(1s, status), 2.9);
        std::optional<RobotStatus> then = status;
        auto& models = stage.cockpit.models;
        PermitEvent event;
        if (how == QLatin1String("stale")) {
            then.reset();
            stage.after(InstrumentState::statusLimit, then);
        } else if (how == QLatin1String("robot not engaged")) {
            then->engaged = false;
        } else if (how == QLatin1String("robot holds")) {
            then->state = RobotState::Hold;
        } else if (how == QLatin1String("dead-man let go")) {
            event.kind = PermitEventKind::DeadManReleased;
            models.permit.apply(event, stage.now);
        } else if (how == QLatin1String("hold")) {
            event.kind = PermitEventKind::PanicHold;
            models.permit.apply(event, stage.now);
        } else if (how == QLatin1String("link suspect")) {
            models.sessions.setLinkState(robotId, LinkState::Suspect, stage.now);
        } else {
            models.sessions.setLinkState(robotId, LinkState::StandBy, stage.now);
        }
        QCOMPARE(stage.after(100ms, then), 0.0);
    }

    void anotherScaleIsSaidForAMomentAndLogged()
    {
        Stage stage;
        stage.armWithPad();
        QVERIFY(!stage.hand().scaleBefore);
        stage.desk.keyboard().press(Qt::Key_PageDown);
        stage.desk.keyboard().press(Qt::Key_PageDown);
        stage.turn();
        QCOMPARE(stage.hand().scale, 0.8);
        QCOMPARE(stage.hand().scaleBefore, std::optional(1.0)); // two steps, one change
        QCOMPARE(stage.cockpit.models.log.lines().back().text, QStringLiteral("scale 0.80 : 1, before 0.90 : 1"));
        stage.turn(HandDesk::scaleAnnounced);
        QVERIFY(!stage.hand().scaleBefore);
    }

    void aScaleThatCannotGrowIsNotSaidToHaveGrown()
    {
        Stage stage;
        stage.engageWithPad();
        const auto lines = stage.cockpit.models.log.lines().size();
        stage.desk.keyboard().press(Qt::Key_PageUp); // engaged
        stage.turn();
        QCOMPARE(stage.hand().scale, 1.0);
        QVERIFY(!stage.hand().scaleBefore);
        QCOMPARE(stage.cockpit.models.log.lines().size(), lines);
    }

    void theLogSaysWhatBecameOfTheMaster()
    {
        Stage stage;
        stage.engageWithPad();
        stage.pad.plug(false);
        const auto& lines = stage.cockpit.models.log.lines();
        const auto said = std::any_of(lines.begin(), lines.end(),
                                      [](const LogLine& line) { return line.text == QLatin1String("hand: Test master, gone"); });
        QVERIFY(said);
    }

    void theLogSaysOnceWhyAMasterIsNotThere()
    {
        Stage stage;
        const auto said = [&stage](const QString& text) {
            const auto& lines = stage.cockpit.models.log.lines();
            return std::count_if(lines.begin(), lines.end(), [&](const LogLine& line) { return line.text == text; });
        };
        stage.pad.plug(false);
        for (const auto* remark : {"refused", "refused too", "refused"}) {
            stage.pad.remark = QString::fromLatin1(remark);
            for (int i = 0; i < 3; ++i)
                stage.turn();
            QCOMPARE(stage.cockpit.models.hand.masters().back().note, stage.pad.remark);
        }
        QCOMPARE(said(QStringLiteral("Test master: refused")), 1);
        QCOMPARE(said(QStringLiteral("Test master: refused too")), 1);
    }
};

QTEST_GUILESS_MAIN(TestHandDesk)
#include "test_hand_desk.moc"
