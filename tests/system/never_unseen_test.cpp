// A console that nobody sees, though its window is the active one for Qt: its screen is locked, another session is on it, or the screen
// saver is. A game pad is heard all the same, and moves nothing; seen at the robot and at the X-ray system, and told on buses of the test's
// own.
//
// What else is heard there is tried by system.seat_watch, what the window makes of it by gui.unseen.
#include "never_possible_stage.hpp"
#include "support/fake_desktop.hpp"
#include "support/private_bus.hpp"
#include "unit/console/virtual_pad.hpp"

using namespace console;
using console::test::FakeLogind;
using console::test::FakeSaver;
using console::test::logTells;
using console::test::PrivateBus;
using console::test::Theatre;
using console::test::VirtualPad;
using Stage = console::test::NeverStage;

namespace {

constexpr int patience = Theatre::patience;

/// A computer whose desktop says what the test tells it, and a console on it that is moved by a pad.
struct Desktop {
    PrivateBus bus; ///< both
    FakeLogind logind{bus.address()};
    FakeSaver saver{bus.address()};
    Stage stage{wishes(bus)};
    VirtualPad pad;

    static Theatre::Wishes wishes(const PrivateBus& bus)
    {
        auto value = console::test::puppetWishes();
        value.master = MasterKind::GamePad;
        value.seat = {bus.address(), bus.address()};
        return value;
    }

    Theatre::Hand hand()
    {
        return {[this] { pad.trigger(1); }, [this] { push(1); },
                [this] {
                    pad.trigger(0);
                    push(0);
                }};
    }

    void push(double part) { pad.stick(SDL_CONTROLLER_AXIS_LEFTY, -part); }

    GuardLine keysLine() const { return stage.theatre.models().permit.checklist().at(std::size_t(Guard::WindowActive)); }
};

/// A way to be hidden, its end, and the words for it.
struct Cover {
    const char* name;
    void (*make)(Desktop&);
    void (*undo)(Desktop&);
    const char* words;
};

const std::vector<Cover>& covers()
{
    static const std::vector<Cover> all{
        {"locked", [](Desktop& desktop) { desktop.logind.set("LockedHint", true); },
         [](Desktop& desktop) { desktop.logind.set("LockedHint", false); }, "Screen is locked"},
        {"asked to lock", [](Desktop& desktop) { desktop.logind.askToLock(); }, [](Desktop& desktop) { desktop.logind.askToUnlock(); },
         "Screen is locked"},
        {"another session", [](Desktop& desktop) { desktop.logind.set("Active", false); },
         [](Desktop& desktop) { desktop.logind.set("Active", true); }, "Another session is on this screen"},
        {"screen saver", [](Desktop& desktop) { desktop.saver.turn(true); }, [](Desktop& desktop) { desktop.saver.turn(false); },
         "Screen saver is on"},
    };
    return all;
}

void addCovers()
{
    QTest::addColumn<int>("number");
    for (std::size_t i = 0; i < covers().size(); ++i)
        QTest::newRow(covers()[i].name) << int(i);
}

} // namespace

class NeverUnseenTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        if (const auto missing = PrivateBus::missing(); !missing.isEmpty())
            QSKIP(qPrintable(missing));
        theme::apply(*qobject_cast<QApplication*>(QCoreApplication::instance()));
        m_desktop = std::make_unique<Desktop>();
        QVERIFY(m_desktop->pad.sound());
        QVERIFY2(m_desktop->stage.open(), qPrintable(m_desktop->stage.theatre.story()));
        QTRY_VERIFY_WITH_TIMEOUT(m_desktop->saver.asked() > 0, patience); // and so logind has answered
    }

    void cleanupTestCase() { m_desktop.reset(); }

    // Rule 5.

    void aPadMovesNothingThatNobodySees_data() { addCovers(); }

    void aPadMovesNothingThatNobodySees()
    {
        QFETCH(int, number);
        const auto& cover = covers().at(std::size_t(number));
        const auto words = QString::fromLatin1(cover.words);
        Desktop& desktop = *m_desktop;
        Stage& stage = desktop.stage;
        Theatre& theatre = stage.theatre;
        QVERIFY2(theatre.armAndMove(desktop.hand()), qPrintable(theatre.story()));
        QVERIFY(theatre.models().xray.pedalDown());

        cover.make(desktop);
        QTRY_VERIFY2_WITH_TIMEOUT(!stage.mayMove(), qPrintable(theatre.story()), patience);
        QVERIFY(theatre.window().isActiveWindow()); // for Qt it is as before
        QVERIFY(!theatre.models().xray.pedalDown() && !theatre.models().hand.reading().deadMan);
        QTRY_COMPARE_WITH_TIMEOUT(desktop.keysLine().text, words, patience);
        QVERIFY(!desktop.keysLine().met);
        QVERIFY2(logTells(theatre, QStringLiteral("the hand has no keys: ") + words), qPrintable(theatre.story()));
        QVERIFY(stage.settles());

        // Nor is anything taken up while it is hidden.
        const int moved = stage.robot.movements();
        const int asked = stage.robot.armRequests();
        const int pedals = stage.xray.pedalsHeard();
        desktop.hand().letGo();
        desktop.pad.button(SDL_CONTROLLER_BUTTON_START, true);
        QTest::mousePress(stage.pedal(), Qt::LeftButton);
        theatre.hold(Qt::Key_F);
        desktop.hand().press();
        desktop.hand().move();
        QVERIFY2(stage.staysUnarmed(100), qPrintable(theatre.story()));
        QVERIFY(!theatre.models().xray.pedalDown());
        QCOMPARE(stage.xray.pedalsHeard(), pedals);

        // All of that is still held when it is seen again.
        cover.undo(desktop);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.window().handHasKeys(), patience);
        QVERIFY2(stage.staysUnarmed(200), qPrintable(theatre.story()));
        QVERIFY(!theatre.models().xray.pedalDown());
        desktop.pad.button(SDL_CONTROLLER_BUTTON_START, false);
        QTest::mouseRelease(stage.pedal(), Qt::LeftButton);

        // And pressed anew it moves nothing without a new ARM.
        desktop.hand().letGo();
        QVERIFY(stage.settles());
        desktop.hand().press();
        desktop.hand().move();
        QVERIFY2(stage.nothingComesBack(), qPrintable(theatre.story()));
        QCOMPARE(stage.robot.movements(), moved);
        QCOMPARE(stage.robot.armRequests(), asked);
        theatre.releaseAll();
    }

    void theBeamEndsWithTheSight()
    {
        Desktop& desktop = *m_desktop;
        Theatre& theatre = desktop.stage.theatre;
        desktop.hand().letGo();
        theatre.releaseAll();
        theatre.strike(Qt::Key_F1);
        auto* pedal = desktop.stage.pedal();
        QVERIFY(pedal != nullptr);
        QTest::mousePress(pedal, Qt::LeftButton);
        QTRY_VERIFY2_WITH_TIMEOUT(theatre.models().xray.beamOn(), qPrintable(theatre.story()), patience);
        desktop.logind.set("LockedHint", true);
        QTRY_VERIFY2_WITH_TIMEOUT(!theatre.models().xray.beamOn(), qPrintable(theatre.story()), patience);
        QVERIFY(!theatre.models().xray.pedalDown());
        desktop.logind.set("LockedHint", false);
        QTRY_VERIFY_WITH_TIMEOUT(theatre.window().handHasKeys(), patience);
        QTest::mouseRelease(pedal, Qt::LeftButton);
        QVERIFY(!theatre.models().xray.pedalDown());
    }

    /// Last: the buses are gone afterwards.
    void aDesktopThatDiesBehindItsLockGivesNothingBack()
    {
        Desktop& desktop = *m_desktop;
        Stage& stage = desktop.stage;
        QVERIFY2(stage.theatre.armAndMove(desktop.hand()), qPrintable(stage.theatre.story()));
        desktop.logind.set("LockedHint", true);
        QTRY_VERIFY2_WITH_TIMEOUT(!stage.mayMove(), qPrintable(stage.theatre.story()), patience);
        desktop.bus.end();
        QTRY_COMPARE_WITH_TIMEOUT(desktop.keysLine().text, QStringLiteral("Screen was hidden, no word since: restart the console"),
                                  patience);
        QVERIFY(stage.settles());
        const int moved = stage.robot.movements();
        desktop.hand().letGo();
        QVERIFY(stage.settles());
        desktop.hand().press();
        desktop.hand().move();
        QVERIFY2(stage.nothingComesBack(), qPrintable(stage.theatre.story()));
        QCOMPARE(stage.robot.movements(), moved);
        QVERIFY(!stage.theatre.window().handHasKeys());
        stage.theatre.releaseAll();
    }

private:
    std::unique_ptr<Desktop> m_desktop;
};

QTEST_MAIN(NeverUnseenTest)
#include "never_unseen_test.moc"
