// What a hand must never be able to do, tried through the console's own window and seen at the robot: arm or move by a key that repeats, a
// click, a wheel or a key with another, make up for what was missed, jump into motion, raise a limit, inject by chance.
//
// Masters besides the keyboard: system.never_by_master.
#include "never_possible_stage.hpp"

#include <QApplication>
#include <QDeadlineTimer>
#include <QMouseEvent>
#include <QWheelEvent>

#include <utility>

using namespace console;
using console::test::rampAt;
using console::test::Theatre;
using Stage = console::test::NeverStage;

namespace {

constexpr int patience = Theatre::patience;

void turnWheel(QWidget& widget, QPoint spot)
{
    QWheelEvent turn(spot, widget.mapToGlobal(spot), {}, {0, 120}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&widget, &turn);
}

/// What a mouse does in passing, where nothing is pressed on purpose.
void fumble(Stage& stage)
{
    auto& window = stage.theatre.window();
    for (const auto region : {Region::Live, Region::Robot, Region::Dose, Region::Trends}) {
        const auto spot = window.regionGeometry(region).center();
        auto* under = window.childAt(spot);
        auto& widget = under != nullptr ? *under : window;
        const auto there = widget.mapFrom(&window, spot);
        for (int i = 0; i < 20; ++i)
            turnWheel(widget, there);
        QTest::mouseDClick(&widget, Qt::LeftButton, {}, there);
    }
}

/// Visible, and a person can give it the focus by mouse or by key.
std::vector<QWidget*> focusable(QWidget& window)
{
    std::vector<QWidget*> found;
    for (auto* widget : window.findChildren<QWidget*>())
        if (widget->isVisible() && widget->isEnabled() && widget->focusPolicy() != Qt::NoFocus)
            found.push_back(widget);
    return found;
}

/// With each of these no hand holds ARM, though the key comes.
const std::vector<const char*>& waysToArm()
{
    static const std::vector<const char*> all{"repeated key", "click",       "double click", "wheel",
                                              "Space",        "Enter",       "Return",       "key under another view",
                                              "Ctrl and key", "Alt and key", "sticky keys",  "mouse keys"};
    return all;
}

/// A modifier that was struck before stands for the next press only: what the key repeats then comes without it.
void pressAfterStickyModifiers(Stage& stage)
{
    constexpr std::pair<Qt::Key, Qt::KeyboardModifier> sticky[] = {
        {Qt::Key_Control, Qt::ControlModifier}, {Qt::Key_Alt, Qt::AltModifier}, {Qt::Key_Meta, Qt::MetaModifier}};
    for (const auto& [key, modifier] : sticky) {
        stage.theatre.strike(key);
        QTest::keyPress(stage.theatre.keyTarget(), Qt::Key_R, modifier);
        stage.repeat(Qt::Key_R, 30);
    }
}

/// The key pad's keys move the pointer, click while one of them is held, and lock a button: a pointer that creeps off with it holds
/// nothing.
void pressByMouseKeys(HoldButton& arm)
{
    const auto drag = [&arm](QPoint to) {
        QMouseEvent move(QEvent::MouseMove, to, arm.mapToGlobal(to), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
        QCoreApplication::sendEvent(&arm, &move);
    };
    const auto spot = arm.rect().center();
    for (int i = 0; i < 50; ++i)
        QTest::mouseClick(&arm, Qt::LeftButton, {}, spot + QPoint(i % 5, 0));
    QTest::mousePress(&arm, Qt::LeftButton, {}, spot);
    for (int x = spot.x(); x <= arm.width() + 10; x += 4)
        drag({x, spot.y()});
    for (int x = arm.width() + 10; x >= spot.x(); x -= 4)
        drag({x, spot.y()});
}

void tryToArm(Stage& stage, HoldButton& arm, const QString& how)
{
    const auto spot = arm.rect().center();
    if (how == QStringLiteral("repeated key")) {
        stage.repeat(Qt::Key_R, 100);
    } else if (how == QStringLiteral("click")) {
        for (int i = 0; i < 5; ++i)
            QTest::mouseClick(&arm, Qt::LeftButton, {}, spot);
    } else if (how == QStringLiteral("double click")) {
        QTest::mouseDClick(&arm, Qt::LeftButton, {}, spot);
    } else if (how == QStringLiteral("wheel")) {
        for (int i = 0; i < 20; ++i)
            turnWheel(arm, spot);
    } else if (how == QStringLiteral("key under another view")) {
        stage.theatre.strike(Qt::Key_F4);
        stage.theatre.hold(Qt::Key_R);
    } else if (how == QStringLiteral("Ctrl and key")) {
        QTest::keyPress(stage.theatre.keyTarget(), Qt::Key_R, Qt::ControlModifier);
    } else if (how == QStringLiteral("Alt and key")) {
        QTest::keyPress(stage.theatre.keyTarget(), Qt::Key_R, Qt::AltModifier);
    } else if (how == QStringLiteral("sticky keys")) {
        pressAfterStickyModifiers(stage);
    } else if (how == QStringLiteral("mouse keys")) {
        pressByMouseKeys(arm);
    } else {
        arm.setFocus();
        QTest::keyPress(&arm, how == QStringLiteral("Space")   ? Qt::Key_Space
                              : how == QStringLiteral("Enter") ? Qt::Key_Enter
                                                               : Qt::Key_Return);
    }
}

} // namespace

class NeverByHandTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        m_stage = console::test::openStage();
        QVERIFY(m_stage);
    }

    void cleanupTestCase() { m_stage.reset(); }

    // Rules 7 and 8.

    void armWantsAPersonWhoHoldsIt_data()
    {
        QTest::addColumn<QString>("how");
        for (const char* how : waysToArm())
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
        tryToArm(stage, *arm, how);
        QVERIFY(stage.phase() != PermitPhase::Arming);
        QVERIFY2(stage.staysUnarmed(220), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.robot.armRequests(), asked);
        QTest::mouseRelease(arm, Qt::LeftButton);
        stage.theatre.strike(Qt::Key_F1);
        stage.theatre.window().setFocus();
        stage.theatre.releaseAll();
    }

    /// ARM is held all the time, and then the last condition comes true.
    void armThatWasHeldBeforeTheConditionsCameTrueArmsNothing()
    {
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.makeReady(), qPrintable(stage.theatre.story()));
        stage.robot.setForce(0.5);
        QTRY_VERIFY2_WITH_TIMEOUT(stage.phase() == PermitPhase::Standby, qPrintable(stage.theatre.story()), patience);
        const int asked = stage.robot.armRequests();
        stage.theatre.hold(Qt::Key_R);
        stage.robot.setForce(0);
        QTRY_VERIFY2_WITH_TIMEOUT(stage.phase() == PermitPhase::Ready, qPrintable(stage.theatre.story()), patience);
        stage.repeat(Qt::Key_R, 100);
        QVERIFY2(stage.staysUnarmed(320), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.robot.armRequests(), asked);
        QTRY_COMPARE_WITH_TIMEOUT(stage.phase(), PermitPhase::Ready, patience); // it was not for want of a condition
        stage.theatre.releaseAll();
    }

    void whatOnlyRepeatsOrTurnsGivesNoMotionBack()
    {
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.armAndMove(), qPrintable(stage.theatre.story()));
        stage.theatre.strike(Qt::Key_F12);
        QTRY_VERIFY_WITH_TIMEOUT(!stage.mayMove(), patience);
        QVERIFY(stage.settles());
        const int moved = stage.robot.movements();
        const int asked = stage.robot.armRequests();
        for (const auto key : {Qt::Key_D, Qt::Key_Up, Qt::Key_R})
            stage.repeat(key, 50);
        fumble(stage);
        QVERIFY2(stage.staysUnarmed(220), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.robot.movements(), moved);
        QCOMPARE(stage.robot.armRequests(), asked);
        stage.theatre.releaseAll();
    }

    /// The same while it is armed: the dead-man is a key that is pressed, alone.
    void whatOnlyRepeatsOrTurnsEngagesNothing()
    {
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.arm(), qPrintable(stage.theatre.story()));
        const int moved = stage.robot.movements();
        const int rested = stage.robot.engagedAtRest();
        stage.repeat(Qt::Key_D, 50);
        stage.repeat(Qt::Key_Up, 50);
        fumble(stage);
        QVERIFY(stage.phase() != PermitPhase::Engaged);
        for (const auto modifier : {Qt::ControlModifier, Qt::AltModifier, Qt::MetaModifier}) {
            QTest::keyPress(stage.theatre.keyTarget(), Qt::Key_D, modifier);
            QVERIFY(stage.phase() != PermitPhase::Engaged);
            QTest::keyPress(stage.theatre.keyTarget(), Qt::Key_Up, modifier);
            QVERIFY(stage.settles());
            QTest::keyRelease(stage.theatre.keyTarget(), Qt::Key_Up);
            QTest::keyRelease(stage.theatre.keyTarget(), Qt::Key_D, modifier); // and the modifier, once
        }
        QCOMPARE(stage.robot.movements(), moved);
        QCOMPARE(stage.robot.engagedAtRest(), rested);
        stage.theatre.releaseAll();
    }

    // Rule 3.

    void whatTheHandDidBeforeItEngagedIsNotMadeUpFor()
    {
        Stage& stage = *m_stage;
        const auto attempt = [&stage](bool& over) {
            QVERIFY2(stage.theatre.arm(), qPrintable(stage.theatre.story()));
            const int moved = stage.robot.movements();
            const int rested = stage.robot.engagedAtRest();
            stage.theatre.hold(Qt::Key_Up);
            stage.theatre.hold(Qt::Key_D);
            const bool lasted = stage.whileItMayMove([&] { return stage.robot.engagedAtRest() > rested + 50; });
            QCOMPARE(stage.robot.movements(), moved);
            stage.theatre.release(Qt::Key_Up);
            stage.theatre.hold(Qt::Key_Up);
            over = lasted && stage.whileItMayMove([&] { return stage.robot.movements() > moved; });
        };
        QVERIFY2(stage.tryWhileItMoves(attempt), qPrintable(stage.theatre.story()));
        stage.theatre.releaseAll();
    }

    /// From a quarter of what is set to all of it in two seconds, as the robot hears it.
    void motionBeginsSoftly()
    {
        using namespace std::chrono_literals;
        Stage& stage = *m_stage;
        const auto heard = [&stage](std::chrono::nanoseconds time) {
            const auto movements = stage.robot.newestMovements();
            return !movements.empty() && movements.back().engagedFor > time;
        };
        const QDeadlineTimer deadline(3 * patience); // a busy computer paints too late, and motion ends
        bool whole = false;
        while (!whole && !deadline.hasExpired()) {
            QVERIFY2(stage.theatre.arm(), qPrintable(stage.theatre.story()));
            stage.theatre.hold(Qt::Key_D);
            stage.theatre.hold(Qt::Key_Up);
            whole = QTest::qWaitFor([&] { return heard(2500ms) || !stage.mayMove(); }, patience) && stage.mayMove();
        }
        QVERIFY2(whole, qPrintable(stage.theatre.story()));
        const double set = stage.theatre.models().hand.reading().motion.guidewireVelocity;
        const auto movements = stage.robot.newestMovements();
        stage.theatre.releaseAll();
        QVERIFY(set > 0);
        constexpr auto underway = 100ms; // what the first command that the robot heard may have been late
        const auto& first = movements.front();
        QVERIFY2(first.engagedFor > underway || first.velocity <= 0.33 * set, qPrintable(QString::number(first.velocity / set)));
        for (const auto& one : movements)
            QVERIFY2(one.velocity <= set * rampAt(one.engagedFor + underway) + 1e-3,
                     qPrintable(QStringLiteral("%1 of %2 after %3 ns").arg(one.velocity).arg(set).arg(one.engagedFor.count())));
        QVERIFY(std::abs(movements.back().velocity - set) < 0.01 * set);
    }

    // Rule 5, the other way round.

    /// While the hand has its keys no control that has the focus keeps one for itself: a dead-man that comes up is never unheard.
    void noControlKeepsAKeyOfTheHand()
    {
        Stage& stage = *m_stage;
        auto& theatre = stage.theatre;
        const auto& hand = theatre.models().hand;
        int asked = 0;
        for (auto* control : focusable(theatre.window())) {
            control->setFocus(Qt::TabFocusReason);
            if (QApplication::focusWidget() != control || !theatre.window().handHasKeys())
                continue;
            ++asked;
            const auto name = QStringLiteral("%1 \"%2\"").arg(QLatin1String(control->metaObject()->className()), control->accessibleName());
            theatre.hold(Qt::Key_D);
            QTRY_VERIFY2_WITH_TIMEOUT(hand.reading().deadMan, qPrintable(name), patience);
            for (const auto key : {Qt::Key_Up, Qt::Key_Down, Qt::Key_Left, Qt::Key_Right}) {
                theatre.hold(key);
                QTRY_VERIFY2_WITH_TIMEOUT(!hand.reading().motion.isZero(), qPrintable(name), 2000);
                theatre.release(key);
                QTRY_VERIFY2_WITH_TIMEOUT(hand.reading().motion.isZero(), qPrintable(name), 2000);
                QVERIFY2(QApplication::focusWidget() == control, qPrintable(name));
            }
            theatre.release(Qt::Key_D);
            QTRY_VERIFY2_WITH_TIMEOUT(!hand.reading().deadMan, qPrintable(name), patience);
        }
        QVERIFY(asked > 3);
        theatre.strike(Qt::Key_F1);
        theatre.window().setFocus();
        theatre.releaseAll();
    }

    // Rule 15.

    void theScaleIsNotRaisedWhileEngaged()
    {
        Stage& stage = *m_stage;
        const auto scale = [&stage] { return stage.theatre.models().hand.reading().scale; };
        stage.theatre.strike(Qt::Key_PageDown);
        stage.theatre.strike(Qt::Key_PageDown);
        const auto attempt = [&](bool& over) {
            QVERIFY2(stage.theatre.arm(), qPrintable(stage.theatre.story()));
            stage.theatre.hold(Qt::Key_D);
            if (!stage.whileItMayMove([&] { return stage.phase() == PermitPhase::Engaged; }))
                return;
            const double before = scale();
            for (int i = 0; i < 5; ++i)
                stage.theatre.strike(Qt::Key_PageUp);
            const int rested = stage.robot.engagedAtRest();
            if (!stage.whileItMayMove([&] { return stage.robot.engagedAtRest() > rested; }))
                return;
            QCOMPARE(stage.phase(), PermitPhase::Engaged);
            QCOMPARE(scale(), before);
            stage.theatre.strike(Qt::Key_PageDown); // less is always allowed
            QTRY_VERIFY_WITH_TIMEOUT(scale() < before, patience);
            over = true;
        };
        QVERIFY2(stage.tryWhileItMoves(attempt), qPrintable(stage.theatre.story()));
        stage.theatre.releaseAll();
    }

    // Contrast: what is given cannot be taken back.

    void contrastIsGivenOnlyWhileArmed()
    {
        Stage& stage = *m_stage;
        const auto attempt = [&stage](bool& over) {
            QVERIFY2(stage.theatre.makeReady(), qPrintable(stage.theatre.story()));
            stage.theatre.hold(Qt::Key_G);
            QVERIFY(stage.staysDry(150));
            // Held on into the arming it counts for nothing either: it must be let go of first.
            stage.theatre.hold(Qt::Key_R);
            (void)QTest::qWaitFor([&stage] { return stage.mayMove() || stage.phase() < PermitPhase::Ready; }, patience);
            stage.theatre.release(Qt::Key_R);
            const bool armed = stage.mayMove();
            QVERIFY(stage.staysDry(150));
            over = armed && stage.mayMove();
        };
        QVERIFY2(stage.tryWhileItMoves(attempt), qPrintable(stage.theatre.story()));
        stage.theatre.releaseAll();
    }

    void oneHoldGivesContrastOnce()
    {
        Stage& stage = *m_stage;
        const auto attempt = [&stage](bool& over) {
            QVERIFY2(stage.theatre.arm(), qPrintable(stage.theatre.story()));
            const int before = stage.robot.injections();
            stage.theatre.hold(Qt::Key_G);
            if (!stage.whileItMayMove([&] { return stage.robot.injections() > before; }))
                return;
            QCOMPARE(stage.robot.injections(), before + 1);
            stage.repeat(Qt::Key_G, 20);
            QVERIFY(stage.staysDry(250));
            stage.theatre.release(Qt::Key_G);
            stage.theatre.hold(Qt::Key_G);
            over = stage.whileItMayMove([&] { return stage.robot.injections() > before + 1; });
            QVERIFY(stage.robot.injections() <= before + 2);
        };
        QVERIFY2(stage.tryWhileItMoves(attempt), qPrintable(stage.theatre.story()));
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
        stage.theatre.strike(Qt::Key_F12);
        QVERIFY(stage.staysDry(150));
        QTest::mouseRelease(button, Qt::LeftButton);
        QCOMPARE(stage.robot.injections(), before);
        stage.theatre.releaseAll();
    }

private:
    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(NeverByHandTest)
#include "never_by_hand_test.moc"
