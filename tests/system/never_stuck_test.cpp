// What must never be possible by the keyboard itself: that a key of the hand counts as held when no finger is on it, since it was called
// otherwise when it came up, or that a stop is not heard for what is held beside it.
#include "never_possible_stage.hpp"
#include "support/keyboard_key.hpp"

#include <QApplication>

using namespace console;
using console::test::Theatre;
using Stage = console::test::NeverStage;
namespace altGr = console::test::altGr;
namespace scan = console::test::scan;

namespace {

constexpr int patience = Theatre::patience;

} // namespace

class NeverStuckTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        m_stage = console::test::openStage();
        QVERIFY(m_stage);
    }

    void cleanupTestCase() { m_stage.reset(); }

    /// AltGr is held when the finger leaves it.
    void aDeadManThatComesUpUnderAnotherNameIsUp()
    {
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.armAndMove(hand()), qPrintable(stage.theatre.story()));
        QVERIFY(reading().deadMan);
        up(scan::d, Qt::Key_ETH);
        QTRY_VERIFY_WITH_TIMEOUT(!reading().deadMan, patience);
        QTRY_VERIFY_WITH_TIMEOUT(stage.phase() != PermitPhase::Engaged, patience);
        QVERIFY(stage.settles());
        const int moved = stage.robot.movements();
        const auto begun = stage.robot.turns();
        QTRY_VERIFY_WITH_TIMEOUT(stage.robot.turns() > begun + 50, patience);
        QCOMPARE(stage.robot.movements(), moved);
        letGo();
    }

    /// Num Lock was struck meanwhile.
    void anArrowThatComesUpAsAFigureIsUp()
    {
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.armAndMove(hand()), qPrintable(stage.theatre.story()));
        QVERIFY(!reading().motion.isZero());
        up(scan::padUp, Qt::Key_8);
        QTRY_VERIFY_WITH_TIMEOUT(reading().motion.isZero(), patience);
        QVERIFY(reading().deadMan);
        letGo();
    }

    void aPedalThatComesUpUnderAnotherNameIsUp()
    {
        Stage& stage = *m_stage;
        letGo();
        const auto& xray = stage.theatre.models().xray;
        QTRY_VERIFY(stage.theatre.window().handHasKeys());
        down(scan::f, Qt::Key_F);
        QTRY_VERIFY2_WITH_TIMEOUT(xray.beamOn(), qPrintable(stage.theatre.story()), patience);
        up(scan::f, altGr::f);
        QTRY_VERIFY_WITH_TIMEOUT(!xray.pedalDown(), patience);
        QTRY_VERIFY_WITH_TIMEOUT(!xray.beamOn(), patience);
    }

    void aStopIsHeardWhateverIsHeldBesideIt_data()
    {
        QTest::addColumn<int>("key");
        QTest::addColumn<int>("modifiers");
        QTest::newRow("hold, Shift") << int(Qt::Key_F12) << int(Qt::ShiftModifier);
        QTest::newRow("hold, Ctrl, Alt and Meta") << int(Qt::Key_F12) << int(Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier);
        QTest::newRow("emergency stop, Shift") << int(Qt::Key_Escape) << int(Qt::ShiftModifier); // last: nobody resets it
    }

    void aStopIsHeardWhateverIsHeldBesideIt()
    {
        QFETCH(int, key);
        QFETCH(int, modifiers);
        Stage& stage = *m_stage;
        QVERIFY2(stage.theatre.armAndMove(hand()), qPrintable(stage.theatre.story()));
        const auto stops = stage.robot.stops().size();
        QTest::keyClick(stage.theatre.keyTarget(), Qt::Key(key), Qt::KeyboardModifiers(modifiers));
        QTRY_VERIFY_WITH_TIMEOUT(!stage.mayMove(), patience);
        if (key == Qt::Key_Escape)
            QTRY_VERIFY_WITH_TIMEOUT(stage.robot.stops().size() > stops, patience);
        letGo();
    }

private:
    const HandReading& reading() const { return m_stage->theatre.models().hand.reading(); }

    void down(quint32 scanCode, int code) { console::test::sendKey(m_stage->theatre.keyTarget(), QEvent::KeyPress, scanCode, code); }
    void up(quint32 scanCode, int code) { console::test::sendKey(m_stage->theatre.keyTarget(), QEvent::KeyRelease, scanCode, code); }

    void letGo()
    {
        up(scan::padUp, Qt::Key_Up);
        up(scan::d, Qt::Key_D);
        m_stage->theatre.releaseAll();
    }

    Theatre::Hand hand()
    {
        return {[this] { down(scan::d, Qt::Key_D); }, [this] { down(scan::padUp, Qt::Key_Up); }, [this] { letGo(); }};
    }

    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(NeverStuckTest)
#include "never_stuck_test.moc"
