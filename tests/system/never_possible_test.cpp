// What must never be possible, tried through the console's own window: keys, clicks, focus, other views, a screen that is gone or stands
// still, and a robot and an X-ray system that lie.
//
// Others of these rules need a device that dies or a file that differs and are tried elsewhere: a killed and a frozen robot, a pad that is
// pulled out (system.cockpit), commands from before a loss (system.stand_by, the simulation), reductions that nobody tells of
// (system.reduced_pictures), certificates and topologies that differ (system.certificates, hostile_*), a GUI that hangs (system.watchdog).
#include "puppet_theatre.hpp"
#include "widgets/hold_button.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QScopeGuard>
#include <QTest>
#include <QThread>
#include <QWheelEvent>

using namespace console;
using console::test::PuppetTheatre;
using console::test::puppetWishes;
using console::test::Theatre;
using liena::test::PuppetRobot;
using liena::test::PuppetXray;
using Pictures = PuppetXray::Pictures;
using RobotClaim = PuppetRobot::Claim;
using Said = PuppetRobot::State;

namespace {

constexpr int patience = Theatre::patience;

struct Stage : PuppetTheatre {
    std::unique_ptr<QWidget> other; ///< another window, in front

    bool open() { return theatre.openAll(); }
    PermitPhase phase() const { return theatre.phase(); }
    bool mayMove() const { return phase() == PermitPhase::Armed || phase() == PermitPhase::Engaged; }

    /// Waits for so many of the robot's turns, ten milliseconds each; false when the console was armed at any time between.
    bool staysUnarmed(std::uint64_t turns)
    {
        bool armed = mayMove();
        const auto watch = QObject::connect(
            &theatre.models().permit, &PermitModel::phaseChanged, &theatre.window(),
            [&armed](PermitPhase, PermitPhase to) { armed = armed || to == PermitPhase::Armed || to == PermitPhase::Engaged; });
        const auto begun = robot.turns();
        const bool passed = QTest::qWaitFor([&] { return robot.turns() >= begun + turns; }, patience);
        QObject::disconnect(watch);
        return passed && !armed;
    }

    void key(QEvent::Type type, Qt::Key key, bool autoRepeat)
    {
        QKeyEvent event(type, key, Qt::NoModifier, QString(), autoRepeat);
        QCoreApplication::sendEvent(&theatre.window(), &event);
    }

    HoldButton* holdButton(const QString& name)
    {
        for (auto* button : theatre.window().findChildren<HoldButton*>())
            if (button->isVisible() && button->accessibleName().startsWith(name))
                return button;
        return nullptr;
    }

    HoldButton* arm() { return holdButton(QStringLiteral("Arm:")); }
    HoldButton* inject() { return holdButton(QStringLiteral("Inject contrast:")); }

    /// Waits for so many of the robot's turns; whether no further injection was asked of it.
    bool staysDry(std::uint64_t turns)
    {
        const int before = robot.injections();
        const auto begun = robot.turns();
        return QTest::qWaitFor([&] { return robot.turns() >= begun + turns; }, patience) && robot.injections() == before;
    }
};

/// Something that is done to the cockpit, and how it is undone.
struct Attempt {
    const char* name;
    void (*make)(Stage&);
    void (*undo)(Stage&);
};

void addRows(const std::vector<Attempt>& attempts)
{
    QTest::addColumn<int>("number");
    for (std::size_t i = 0; i < attempts.size(); ++i)
        QTest::newRow(attempts[i].name) << int(i);
}

void leaveNothing(Stage&) {}

template <Pictures P>
void show(Stage& stage)
{
    stage.xray.show(P);
}

template <Qt::Key K>
void press(Stage& stage)
{
    QTest::keyClick(&stage.theatre.window(), K);
}

void backToCockpit(Stage& stage) { QTest::keyClick(&stage.theatre.window(), Qt::Key_F1); }

void silence(Stage& stage) { stage.robot.setSilent(true); }
void speak(Stage& stage) { stage.robot.setSilent(false); }
void beTrue(Stage& stage) { stage.robot.claim(std::nullopt); }

void comeToTheFront(Stage& stage)
{
    stage.theatre.window().activateWindow();
    (void)QTest::qWaitForWindowActive(&stage.theatre.window());
    QTest::keyClick(&stage.theatre.window(), Qt::Key_F1); // the hand has its keys again
}

/// A locked screen or another program: this window has the keyboard no more.
void putAnotherInFront(Stage& stage)
{
    stage.other = std::make_unique<QWidget>();
    stage.other->show();
    stage.other->activateWindow();
    (void)QTest::qWaitForWindowActive(stage.other.get());
}

void takeItAway(Stage& stage)
{
    stage.other.reset();
    comeToTheFront(stage);
}

void hide(Stage& stage) { stage.theatre.window().hide(); }

void showAgain(Stage& stage)
{
    stage.theatre.window().show();
    putAnotherInFront(stage); // Qt's offscreen platform takes the hidden window for the active one all the time
    takeItAway(stage);
}

void standStill(Stage&) { QThread::msleep(300); }

void resetStop(Stage& stage)
{
    HoldButton* reset = nullptr;
    const auto find = [&] {
        for (auto* button : stage.theatre.window().findChildren<HoldButton*>())
            if (button->isVisible() && button->accessibleName().startsWith(QStringLiteral("Reset")))
                reset = button;
        return reset != nullptr;
    };
    if (!QTest::qWaitFor(find, patience))
        return;
    QTest::mousePress(reset, Qt::LeftButton);
    (void)QTest::qWaitFor([&] { return stage.theatre.robotStatus().emergencyStopToken == 0; }, patience);
    QTest::mouseRelease(reset, Qt::LeftButton);
}

/// Each ends motion, and what ended does not come back by itself.
const std::vector<Attempt>& interruptions()
{
    static const std::vector<Attempt> all{
        {"picture freezes", show<Pictures::None>, show<Pictures::Good>},
        {"picture repeats itself", show<Pictures::Repeated>, show<Pictures::Good>},
        {"picture is a recording", show<Pictures::Recorded>, show<Pictures::Good>},
        {"picture is old", show<Pictures::Old>, show<Pictures::Good>},
        {"robot's reports end", silence, speak},
        {"robot speaks of another permit",
         [](Stage& stage) {
             stage.robot.claim(RobotClaim{Said::Engaged, 1, false});
         },
         beTrue},
        {"robot says that it holds",
         [](Stage& stage) {
             stage.robot.claim(RobotClaim{Said::Hold, 0, true});
         },
         beTrue},
        {"force at the stop", [](Stage& stage) { stage.robot.setForce(2.1); }, [](Stage& stage) { stage.robot.setForce(0); }},
        {"topology in front", press<Qt::Key_F2>, backToCockpit},
        {"log in front", press<Qt::Key_F4>, backToCockpit},
        {"preferences in front", press<Qt::Key_F6>, backToCockpit},
        {"window hidden", hide, showAgain},
        {"another window in front", putAnotherInFront, takeItAway},
        {"console stands still", standStill, leaveNothing},
        {"panic key", press<Qt::Key_F12>, leaveNothing},
        {"emergency stop and its reset", press<Qt::Key_Escape>, resetStop},
    };
    return all;
}

/// With each of these ARM is held for twice its time, and the robot hears nothing of it.
const std::vector<Attempt>& obstacles()
{
    static const std::vector<Attempt> all{
        {"picture freezes", show<Pictures::None>, show<Pictures::Good>},
        {"picture repeats itself", show<Pictures::Repeated>, show<Pictures::Good>},
        {"picture is a recording", show<Pictures::Recorded>, show<Pictures::Good>},
        {"picture is old", show<Pictures::Old>, show<Pictures::Good>},
        {"robot's reports end", silence, speak},
        {"robot is armed by another",
         [](Stage& stage) {
             stage.robot.claim(RobotClaim{Said::Armed, 0, false});
         },
         beTrue},
        {"robot does not hold",
         [](Stage& stage) {
             stage.robot.claim(RobotClaim{Said::Ready, 0, false});
         },
         beTrue},
        {"force", [](Stage& stage) { stage.robot.setForce(0.5); }, [](Stage& stage) { stage.robot.setForce(0); }},
        {"dead-man down", [](Stage& stage) { stage.theatre.hold(Qt::Key_D); }, [](Stage& stage) { stage.theatre.release(Qt::Key_D); }},
    };
    return all;
}

} // namespace

class NeverPossibleTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance()));
        m_stage = std::make_unique<Stage>();
        QVERIFY(m_stage->open());
    }

    void cleanupTestCase() { m_stage.reset(); }

    // Rules 1, 4, 5 and 6.

    void whatEndedMotionDoesNotGiveItBack_data() { addRows(interruptions()); }

    void whatEndedMotionDoesNotGiveItBack()
    {
        QFETCH(int, number);
        const auto& attempt = interruptions().at(std::size_t(number));
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.armAndMove(), qPrintable(stage.theatre.story()));
        attempt.make(stage);
        QTRY_VERIFY2_WITH_TIMEOUT(!stage.mayMove(), qPrintable(stage.theatre.story()), patience);
        // What was under way when it ended may still arrive, for as long as a command lives.
        const auto ended = stage.robot.turns();
        QTRY_VERIFY_WITH_TIMEOUT(stage.robot.turns() > ended + 10, patience);
        const int moved = stage.robot.movements();
        QVERIFY2(stage.staysUnarmed(30), qPrintable(stage.theatre.story()));
        attempt.undo(stage);
        // Every key is still down, and is even pressed again: all but ARM.
        stage.theatre.hold(Qt::Key_F);
        stage.theatre.hold(Qt::Key_D);
        stage.theatre.hold(Qt::Key_Up);
        QVERIFY2(stage.staysUnarmed(150), qPrintable(stage.theatre.story()));
        stage.theatre.release(Qt::Key_D);
        stage.theatre.hold(Qt::Key_D);
        QVERIFY2(stage.staysUnarmed(50), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.robot.movements(), moved);
        stage.theatre.releaseAll();
    }

    // Rules 4, 6 and 12.

    void nobodyArmsWith_data() { addRows(obstacles()); }

    void nobodyArmsWith()
    {
        QFETCH(int, number);
        const auto& attempt = obstacles().at(std::size_t(number));
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.makeReady(), qPrintable(stage.theatre.story()));
        const int asked = stage.robot.armRequests();
        attempt.make(stage);
        QTRY_VERIFY2_WITH_TIMEOUT(stage.phase() != PermitPhase::Ready, qPrintable(stage.theatre.story()), patience);
        stage.theatre.hold(Qt::Key_R);
        QVERIFY2(stage.staysUnarmed(320), qPrintable(stage.theatre.story()));
        stage.theatre.release(Qt::Key_R);
        QCOMPARE(stage.robot.armRequests(), asked);
        attempt.undo(stage);
        stage.theatre.releaseAll();
    }

    void aPermitThatWasSpentArmsNoMore()
    {
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.armAndMove(), qPrintable(stage.theatre.story()));
        // The robot goes on naming the permit of the armed time, and says that it is ready again.
        const auto spent = stage.robot.permit();
        QTest::keyClick(&stage.theatre.window(), Qt::Key_F12);
        QTRY_VERIFY_WITH_TIMEOUT(stage.robot.permit() != spent, patience);
        const auto back = static_cast<std::uint32_t>(spent - stage.robot.permit());
        stage.robot.claim(RobotClaim{Said::Ready, back, true});
        stage.theatre.releaseAll();
        stage.theatre.acknowledgeAlarms();
        stage.theatre.testAlarms();
        QVERIFY2(stage.theatre.models().selfTest.passed(), qPrintable(stage.theatre.story())); // it is not for want of that
        stage.theatre.hold(Qt::Key_F);
        const int asked = stage.robot.armRequests();
        stage.theatre.hold(Qt::Key_R);
        QVERIFY2(stage.staysUnarmed(320), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.robot.armRequests(), asked);
        stage.robot.claim(std::nullopt);
        stage.theatre.releaseAll();
    }

    /// What was accepted was accepted for one arming, and for the force that was looked at.
    void anAcceptedForceArmsOnce()
    {
        Stage& stage = *m_stage;
        const auto force = [&stage] { return stage.theatre.models().permit.checklist().at(std::size_t(Guard::ForceNearZero)); };
        const auto meets = [&force](bool met) { return QTest::qWaitFor([&] { return force().met == met; }, patience); };
        QVERIFY2(stage.theatre.makeReady(), qPrintable(stage.theatre.story()));
        stage.robot.setForce(0.43);
        QVERIFY(meets(false));
        const auto button = [&stage] { return stage.theatre.button(QStringLiteral("Accept 0.43")); };
        const auto accept = [&] { // a press at once is not taken: nobody can have read it yet
            return QTest::qWaitFor(
                [&] {
                    if (auto* there = button(); there != nullptr)
                        QTest::mouseClick(there, Qt::LeftButton);
                    return force().met;
                },
                patience);
        };
        QVERIFY2(accept(), qPrintable(stage.theatre.story()));
        stage.robot.setForce(0.6); // another one
        QVERIFY(meets(false));
        stage.robot.setForce(0.43);
        QVERIFY(meets(true));
        auto hand = stage.theatre.keyboardHand();
        hand.letGo = [&] { // as often as a condition fails on the way
            if (button() != nullptr)
                (void)accept();
        };
        QVERIFY2(stage.theatre.armAndMove(hand), qPrintable(stage.theatre.story()));
        QTest::keyClick(&stage.theatre.window(), Qt::Key_F12);
        QTRY_VERIFY_WITH_TIMEOUT(!stage.mayMove(), patience);
        stage.theatre.releaseAll();
        QVERIFY2(meets(false), qPrintable(stage.theatre.story()));
        const int asked = stage.robot.armRequests();
        stage.theatre.acknowledgeAlarms();
        stage.theatre.testAlarms();
        stage.theatre.hold(Qt::Key_F);
        stage.theatre.hold(Qt::Key_R);
        QVERIFY2(stage.staysUnarmed(320), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.robot.armRequests(), asked);
        stage.theatre.releaseAll();
        stage.robot.setForce(0);
    }

    /// A command is as old as the robot's heartbeat that it echoes: with one each 50 ms and a max-age of 50 ms no line is short enough.
    void nobodyArmsOverALineThatTheRobotsMaxAgeDoesNotCarry()
    {
        const auto back = qScopeGuard([this] { comeToTheFront(*m_stage); }); // another window is in front for a while
        auto slow = puppetWishes();
        slow.system.timing = R"(heartbeat="50ms" suspect="500ms" lost="800ms" reconnect="2s")";
        PuppetTheatre stage(slow);
        Theatre& theatre = stage.theatre;
        QVERIFY(theatre.openAll());
        theatre.acknowledgeAlarms();
        theatre.testAlarms();
        theatre.hold(Qt::Key_F);
        const auto& permit = theatre.models().permit;
        // All but this one.
        QTRY_VERIFY2_WITH_TIMEOUT(permit.unmetCount() == 1, qPrintable(theatre.story()), patience);
        const auto line = permit.checklist().at(std::size_t(Guard::CommandsQuick));
        QVERIFY2(!line.met && line.text.contains(QStringLiteral("up to 0 ms")), qPrintable(line.text));
        theatre.hold(Qt::Key_R);
        QVERIFY(!theatre.reaches(PermitPhase::Arming));
        QCOMPARE(stage.robot.armRequests(), 0);
        theatre.releaseAll();
    }

    // Rules 7 and 8.

    void armWantsAPersonWhoHoldsIt_data()
    {
        QTest::addColumn<QString>("how");
        for (const char* how : {"repeated key", "click", "double click", "wheel", "Space", "Enter", "Return", "key under another view"})
            QTest::newRow(how) << QString::fromLatin1(how);
    }

    void armWantsAPersonWhoHoldsIt()
    {
        QFETCH(QString, how);
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.makeReady(), qPrintable(stage.theatre.story()));
        const int asked = stage.robot.armRequests();
        HoldButton* arm = stage.arm();
        QVERIFY(arm != nullptr);
        const auto spot = arm->rect().center();
        if (how == QStringLiteral("repeated key")) {
            for (int i = 0; i < 100; ++i)
                stage.key(QEvent::KeyPress, Qt::Key_R, true);
        } else if (how == QStringLiteral("click")) {
            for (int i = 0; i < 5; ++i)
                QTest::mouseClick(arm, Qt::LeftButton, {}, spot);
        } else if (how == QStringLiteral("double click")) {
            QTest::mouseDClick(arm, Qt::LeftButton, {}, spot);
        } else if (how == QStringLiteral("wheel")) {
            for (int i = 0; i < 20; ++i) {
                QWheelEvent turn(spot, arm->mapToGlobal(spot), {}, {0, 120}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
                QCoreApplication::sendEvent(arm, &turn);
            }
        } else if (how == QStringLiteral("key under another view")) {
            QTest::keyClick(&stage.theatre.window(), Qt::Key_F4);
            QTest::keyPress(QApplication::focusWidget(), Qt::Key_R);
        } else {
            arm->setFocus();
            QTest::keyPress(arm, how == QStringLiteral("Space")   ? Qt::Key_Space
                                 : how == QStringLiteral("Enter") ? Qt::Key_Enter
                                                                  : Qt::Key_Return);
        }
        QVERIFY2(stage.staysUnarmed(220), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.robot.armRequests(), asked);
        QTest::keyClick(&stage.theatre.window(), Qt::Key_F1);
        stage.theatre.window().setFocus();
        stage.theatre.releaseAll();
    }

    // Rule 3.

    void whatTheHandDidBeforeItEngagedIsNotMadeUpFor()
    {
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.arm(), qPrintable(stage.theatre.story()));
        const int moved = stage.robot.movements();
        const int rested = stage.robot.engagedAtRest();
        stage.theatre.hold(Qt::Key_Up);
        stage.theatre.hold(Qt::Key_D);
        QTRY_VERIFY2_WITH_TIMEOUT(stage.robot.engagedAtRest() > rested + 50, qPrintable(stage.theatre.story()), patience);
        QCOMPARE(stage.robot.movements(), moved);
        stage.theatre.release(Qt::Key_Up);
        stage.theatre.hold(Qt::Key_Up);
        QTRY_VERIFY2_WITH_TIMEOUT(stage.robot.movements() > moved, qPrintable(stage.theatre.story()), patience);
        stage.theatre.releaseAll();
    }

    // Rule 15.

    void theScaleIsNotRaisedWhileEngaged()
    {
        Stage& stage = *m_stage;
        const auto scale = [&stage] { return stage.theatre.models().hand.reading().scale; };
        QVERIFY2(stage.theatre.arm(), qPrintable(stage.theatre.story()));
        QTest::keyClick(&stage.theatre.window(), Qt::Key_PageDown);
        QTest::keyClick(&stage.theatre.window(), Qt::Key_PageDown);
        stage.theatre.hold(Qt::Key_D);
        QTRY_COMPARE_WITH_TIMEOUT(stage.phase(), PermitPhase::Engaged, patience);
        const double before = scale();
        for (int i = 0; i < 5; ++i)
            QTest::keyClick(&stage.theatre.window(), Qt::Key_PageUp);
        const int rested = stage.robot.engagedAtRest();
        QTRY_VERIFY_WITH_TIMEOUT(stage.robot.engagedAtRest() > rested, patience);
        QCOMPARE(stage.phase(), PermitPhase::Engaged);
        QCOMPARE(scale(), before);
        QTest::keyClick(&stage.theatre.window(), Qt::Key_PageDown); // less is always allowed
        QTRY_VERIFY_WITH_TIMEOUT(scale() < before, patience);
        stage.theatre.releaseAll();
    }

    // Rule 10.

    void alarmsCannotBeSilencedForGoodWhileEngaged()
    {
        Stage& stage = *m_stage;
        const auto& alarms = stage.theatre.models().alarms;
        const auto pauseLeft = [&alarms] { return alarms.audioPauseLeft(std::chrono::steady_clock::now()); };
        QVERIFY2(stage.theatre.arm(), qPrintable(stage.theatre.story()));
        stage.theatre.hold(Qt::Key_D);
        QTRY_COMPARE_WITH_TIMEOUT(stage.phase(), PermitPhase::Engaged, patience);
        if (!pauseLeft())
            QTest::keyClick(&stage.theatre.window(), Qt::Key_F9);
        QVERIFY(pauseLeft() && *pauseLeft() <= AlarmList::mostAudioPause);
        stage.xray.show(Pictures::None);
        QTRY_VERIFY2_WITH_TIMEOUT(alarms.unacknowledgedHigh(), qPrintable(stage.theatre.story()), patience);
        QVERIFY(!pauseLeft()); // a new high alarm ends it
        QVERIFY(!stage.mayMove());
        stage.xray.show(Pictures::Good);
        stage.theatre.releaseAll();
    }

    // Rule 1: the console itself is started anew, with the dead-man held all the time.

    // Contrast: what is given cannot be taken back.

    void contrastIsGivenOnlyWhileArmed()
    {
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.makeReady(), qPrintable(stage.theatre.story()));
        stage.theatre.hold(Qt::Key_G);
        QVERIFY(stage.staysDry(150));
        // Held on into the arming it counts for nothing either: it must be let go of first.
        stage.theatre.hold(Qt::Key_R);
        QVERIFY2(stage.theatre.reaches(PermitPhase::Armed), qPrintable(stage.theatre.story()));
        stage.theatre.release(Qt::Key_R);
        QVERIFY(stage.staysDry(150));
        stage.theatre.releaseAll();
    }

    void oneHoldGivesContrastOnce()
    {
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.arm(), qPrintable(stage.theatre.story()));
        const int before = stage.robot.injections();
        stage.theatre.hold(Qt::Key_G);
        QTRY_COMPARE_WITH_TIMEOUT(stage.robot.injections(), before + 1, patience);
        for (int i = 0; i < 20; ++i)
            stage.key(QEvent::KeyPress, Qt::Key_G, true);
        QVERIFY(stage.staysDry(250));
        stage.theatre.release(Qt::Key_G);
        stage.theatre.hold(Qt::Key_G);
        QTRY_COMPARE_WITH_TIMEOUT(stage.robot.injections(), before + 2, patience);
        stage.theatre.releaseAll();
    }

    void noClickGivesContrast()
    {
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.arm(), qPrintable(stage.theatre.story()));
        auto* button = stage.inject();
        QVERIFY(button != nullptr);
        QTRY_VERIFY_WITH_TIMEOUT(button->isEnabled(), patience);
        const int before = stage.robot.injections();
        QTest::mouseClick(button, Qt::LeftButton);
        QTest::mouseDClick(button, Qt::LeftButton);
        for (const auto key : {Qt::Key_Return, Qt::Key_Enter, Qt::Key_Space})
            QTest::keyPress(button, key);
        QVERIFY(stage.staysDry(150));
        for (const auto key : {Qt::Key_Return, Qt::Key_Enter, Qt::Key_Space})
            QTest::keyRelease(button, key);
        // A hold of the robot's in its midst ends it.
        QTest::mousePress(button, Qt::LeftButton);
        QTest::keyClick(&stage.theatre.window(), Qt::Key_F12);
        QVERIFY(stage.staysDry(150));
        QTest::mouseRelease(button, Qt::LeftButton);
        QCOMPARE(stage.robot.injections(), before);
        stage.theatre.releaseAll();
    }

    void aConsoleThatIsStartedAnewMovesNothing()
    {
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.armAndMove(), qPrintable(stage.theatre.story()));
        stage.theatre.restartConsole();
        const int moved = stage.robot.movements();
        const int asked = stage.robot.armRequests();
        QVERIFY2(stage.open(), qPrintable(stage.theatre.story()));
        stage.theatre.hold(Qt::Key_F);
        stage.theatre.hold(Qt::Key_D);
        stage.theatre.hold(Qt::Key_Up);
        QVERIFY2(stage.staysUnarmed(200), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.robot.movements(), moved);
        QCOMPARE(stage.robot.armRequests(), asked);
        stage.theatre.releaseAll();
        QVERIFY2(stage.theatre.armAndMove(), qPrintable(stage.theatre.story())); // and it can be used
        stage.theatre.releaseAll();
    }

private:
    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(NeverPossibleTest)
#include "never_possible_test.moc"
