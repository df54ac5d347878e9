// What must never be possible while something is not as it must be: motion that goes on or comes back by itself. It is tried through the
// console's own window: keys, focus, other views, a screen that is gone or stands still, and a robot and an X-ray system that lie.
//
// Of the other rules, an arming that must not be is tried by system.never_armed, what a hand does is tried by system.never_by_hand, keys
// that come up under another name by system.never_stuck, a link that heals or is re-opened by system.never_by_link, what is shown by
// system.never_shown, alarms by system.never_silenced; a screen that is really gone by system.vanished_screen, and one that nobody sees by
// system.never_unseen. Some need a device that dies or a file that differs and are tried elsewhere: a killed and a frozen robot, a pad that
// is pulled out, two consoles (system.cockpit), commands from before a loss (system.stand_by, the simulation; the age of each by itself:
// system.timing), certificates and topologies that differ (system.certificates, hostile_*).
#include "never_possible_attempts.hpp"

#include <QApplication>
#include <QFile>
#include <QScopeGuard>
#include <QScreen>
#include <QTemporaryDir>
#include <QThread>

using namespace console;
using namespace console::test;
using Stage = console::test::NeverStage;

namespace {

constexpr int patience = Theatre::patience;

void leaveNothing(Stage&) {}

template <Qt::Key K>
void press(Stage& stage)
{
    stage.theatre.strike(K);
}

void pressForPreferences(Stage& stage) { QTest::keyClick(stage.theatre.keyTarget(), Qt::Key_Comma, Qt::ControlModifier); }

template <View V>
void bring(Stage& stage)
{
    stage.theatre.window().showView(V);
}

void clickAbout(Stage& stage) { (void)stage.theatre.click(QStringLiteral("About")); }

/// The screen that the window is on is pulled out: Qt says so before it moves the window itself.
void loseScreen(Stage& stage) { Q_EMIT qGuiApp->screenRemoved(stage.theatre.window().screen()); }

void clickCockpit(Stage& stage)
{
    auto& window = stage.theatre.window();
    window.activateWindow();
    (void)QTest::qWaitForWindowActive(&window);
    QTest::mouseClick(&window, Qt::LeftButton, {}, window.regionGeometry(Region::Status).center());
}

void backToCockpit(Stage& stage) { stage.theatre.strike(Qt::Key_F1); }

/// Another program: this window has the keyboard no more.
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
    stage.comeToTheFront();
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
        {"pedal let go of", letGoOfThePedal, leaveNothing},
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
        {"plots in front", press<Qt::Key_F3>, backToCockpit},
        {"log in front", press<Qt::Key_F4>, backToCockpit},
        {"conditions in front", press<Qt::Key_F6>, backToCockpit},
        {"preferences in front", pressForPreferences, backToCockpit},
        {"screens in front", press<Qt::Key_F7>, backToCockpit},
        {"about in front", clickAbout, backToCockpit},
        {"start page in front", bring<View::Start>, backToCockpit},
        {"window hidden", hide, showAgain},
        {"screen gone", loseScreen, clickCockpit},
        {"another window in front", putAnotherInFront, takeItAway},
        {"remote desktop", beRemote, beHere},
        {"console stands still", standStill, leaveNothing},
        {"panic key", press<Qt::Key_F12>, leaveNothing},
        {"emergency stop and its reset", press<Qt::Key_Escape>, resetStop},
    };
    return all;
}

} // namespace

class NeverPossibleTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        m_stage = console::test::openStage();
        QVERIFY(m_stage);
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
        QVERIFY(stage.settles());
        const int moved = stage.robot.movements();
        QVERIFY2(stage.staysUnarmed(30), qPrintable(stage.theatre.story()));
        attempt.undo(stage);
        QVERIFY2(stage.nothingComesBack(), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.robot.movements(), moved);
        stage.theatre.releaseAll();
    }

    // Rule 1: the console itself is started anew, with the dead-man held all the time.

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

    // Rule 14.

    /// Nothing of this program can tell it then: another one does, and the robot is not moved meanwhile.
    void aConsoleThatHangsWhileArmedIsToldByItsWatchdog()
    {
        const auto back = qScopeGuard([this] { m_stage->comeToTheFront(); });
        const QTemporaryDir folder;
        const auto said = folder.filePath(QStringLiteral("said"));
        QFile program(folder.filePath(QStringLiteral("watchdog"))); // the real one, heard by this test
        QVERIFY(program.open(QIODevice::WriteOnly));
        program.write("#!/bin/sh\nexec " LIENA_PROGRAM_DIR "/liena-console-watchdog \"$@\" 2>" + said.toLocal8Bit() + "\n");
        program.close();
        QVERIFY(program.setPermissions(QFile::ReadOwner | QFile::ExeOwner));
        const auto timesSaid = [&said](const char* words) {
            QFile file(said);
            return file.open(QIODevice::ReadOnly) ? file.readAll().count(words) : 0;
        };
        auto watched = puppetWishes();
        watched.watchdog = program.fileName();
        Stage stage(watched);
        QVERIFY(stage.open());
        QVERIFY2(stage.theatre.armAndMove(), qPrintable(stage.theatre.story()));
        const auto hung = timesSaid("hangs"); // a busy computer may have let it by itself
        const auto again = timesSaid("beats again");
        const auto before = stage.robot.turns();
        QThread::msleep(1000); // longer than a silent link may be
        const auto after = stage.robot.turns();
        QTRY_VERIFY2_WITH_TIMEOUT(timesSaid("hangs") > hung, qPrintable(stage.theatre.story()), patience);
        QVERIFY(after > before); // only the console stood still
        QTRY_VERIFY2_WITH_TIMEOUT(timesSaid("beats again") > again, qPrintable(stage.theatre.story()), patience);
        QVERIFY2(!stage.mayMove(), qPrintable(stage.theatre.story()));
        QVERIFY(stage.settles());
        QVERIFY2(stage.nothingComesBack(), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.theatre.link("robot"), LinkState::Open); // no socket waits for this thread
        QVERIFY(stage.theatre.models().incidents.incidents().empty());
        stage.theatre.releaseAll();
    }

private:
    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(NeverPossibleTest)
#include "never_possible_test.moc"
