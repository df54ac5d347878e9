// No key and no control of the console's window raises the speed, the scale or the limit of the force while the robot moves: each is tried
// once, and what the robot hears is looked at.
//
// The scale by its own keys is tried by system.never_by_hand.
#include "never_possible_stage.hpp"

#include <QApplication>
#include <QDeadlineTimer>
#include <QTemporaryDir>
#include <QWheelEvent>

using namespace console;
using console::test::controlsOf;
using console::test::Theatre;
using Stage = console::test::NeverStage;

namespace {

constexpr int patience = Theatre::patience;

/// Those that end motion, or let go of what it needs, are tried by system.never_possible and others; D and Up are held.
bool endsMotion(int key)
{
    const bool view = key >= Qt::Key_F1 && key <= Qt::Key_F7 && key != Qt::Key_F5;
    return view || key == Qt::Key_F12 || key == Qt::Key_Escape || key == Qt::Key_F || key == Qt::Key_D || key == Qt::Key_Up;
}

std::vector<int> keysOfAKeyboard()
{
    std::vector<int> keys;
    const auto add = [&keys](int first, int last) {
        for (int key = first; key <= last; ++key)
            if (!endsMotion(key))
                keys.push_back(key);
    };
    add(Qt::Key_Space, Qt::Key_AsciiTilde);
    add(Qt::Key_F1, Qt::Key_F35);
    add(Qt::Key_Home, Qt::Key_PageUp); // Left, Right and Down among them
    add(Qt::Key_VolumeDown, Qt::Key_TrebleDown);
    add(Qt::Key_Backspace, Qt::Key_Delete);
    return keys;
}

void turnWheel(QWidget& widget)
{
    const QPoint spot = widget.rect().center();
    QWheelEvent turn(spot, widget.mapToGlobal(spot), {}, {0, 120}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&widget, &turn);
}

/// What must not become more.
struct Bounds {
    double speed = 0;
    double scale = 0;
    RobotLimits limits;

    explicit Bounds(const Stage& stage)
        : speed(std::abs(stage.theatre.models().hand.reading().motion.guidewireVelocity)),
          scale(stage.theatre.models().hand.reading().scale),
          limits(stage.theatre.models().instrument.limits())
    {}

    bool hold(const Stage& stage) const
    {
        const auto& hand = stage.theatre.models().hand.reading();
        const auto& now = stage.theatre.models().instrument.limits();
        return stage.robot.fastest() <= speed + 1e-3 && std::abs(hand.motion.guidewireVelocity) <= speed && hand.scale <= scale &&
               now.forceStop <= limits.forceStop && now.forceWarn <= limits.forceWarn && now.forceNearZero <= limits.forceNearZero;
    }
};

} // namespace

class NeverRaisedTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        auto wishes = console::test::puppetWishes();
        wishes.preferences.pictureFolder = m_pictures.path(); // Save is tried, too
        m_stage = console::test::openStage(wishes);
        QVERIFY(m_stage);
    }

    void cleanupTestCase() { m_stage.reset(); }

    // Rule 15.

    void noKeyRaisesSpeedOrForceWhileEngaged()
    {
        Stage& stage = *m_stage;
        QVERIFY2(moves(), qPrintable(stage.theatre.story()));
        const Bounds bounds(stage);
        int tried = 0;
        for (const int key : keysOfAKeyboard()) {
            for (const auto modifier : {Qt::NoModifier, Qt::ShiftModifier, Qt::ControlModifier, Qt::AltModifier}) {
                if (key == Qt::Key_Comma && modifier == Qt::ControlModifier)
                    continue; // the preferences: a view ends motion
                if (!stage.mayMove())
                    QVERIFY2(moves(), qPrintable(stage.theatre.story())); // a busy computer paints too late, and motion ends
                strike(key, modifier);
                ++tried;
                QVERIFY2(bounds.hold(stage), qPrintable(described(key)));
            }
        }
        QVERIFY(tried > 300);
        QVERIFY2(heardMore() && bounds.hold(stage), qPrintable(stage.theatre.story()));
        QVERIFY2(theForceStillStops(), qPrintable(stage.theatre.story()));
        stage.theatre.releaseAll();
    }

    void noControlRaisesSpeedOrForceWhileEngaged()
    {
        Stage& stage = *m_stage;
        QVERIFY2(moves(), qPrintable(stage.theatre.story()));
        const Bounds bounds(stage);
        int tried = 0;
        for (const auto& control : controlsOf(stage.theatre.window())) {
            if (!stage.mayMove())
                QVERIFY2(moves(), qPrintable(stage.theatre.story()));
            if (!control || !control->isVisible() || !control->isEnabled())
                continue;
            const auto name = control->accessibleName();
            QTest::mouseClick(control, Qt::LeftButton);
            if (control)
                turnWheel(*control);
            ++tried;
            QVERIFY(stage.settles()); // what came of it has been heard, or its session is closed
            QVERIFY2(bounds.hold(stage), qPrintable(name));
        }
        QVERIFY(tried > 10);
        QVERIFY2(heardMore() && bounds.hold(stage), qPrintable(stage.theatre.story()));
        stage.theatre.releaseAll();
    }

private:
    /// QTest's own names for keys do not reach all of them.
    void strike(int key, Qt::KeyboardModifier modifier)
    {
        const auto text = key < Qt::Key_AsciiTilde ? QString(QChar(key)) : QString();
        for (const auto action : {QTest::Press, QTest::Release})
            QTest::sendKeyEvent(action, m_stage->theatre.keyTarget(), Qt::Key(key), text, modifier);
    }

    static QString described(int key) { return QStringLiteral("key 0x%1").arg(key, 0, 16); }

    /// With all that the hand may ask for: the soft start is over. A busy computer paints too late, and motion ends.
    bool moves()
    {
        Stage& stage = *m_stage;
        const auto set = [&stage] { return std::abs(stage.theatre.models().hand.reading().motion.guidewireVelocity); };
        const auto whole = [&] { return set() > 0 && stage.robot.fastest() > 0.99 * set(); };
        const QDeadlineTimer deadline(3 * patience);
        while (!deadline.hasExpired()) {
            stage.theatre.strike(Qt::Key_F1); // what was tried may have brought a view, or closed a link
            if (!stage.theatre.models().sessions.allOpen() && !stage.open())
                return false;
            if (stage.theatre.armAndMove() && stage.whileItMayMove(whole))
                return true;
        }
        return false;
    }

    /// The robot heard what became of the last. After so many in a row the console may have stood still, which ends motion.
    bool heardMore()
    {
        QCoreApplication::processEvents(); // by which it has noticed
        const QDeadlineTimer deadline(3 * patience);
        while (!deadline.hasExpired()) {
            if (!m_stage->mayMove() && !moves())
                return false;
            const int before = m_stage->robot.movements();
            if (m_stage->whileItMayMove([&] { return m_stage->robot.movements() > before + 20; }))
                return true;
        }
        return false;
    }

    bool theForceStillStops()
    {
        Stage& stage = *m_stage;
        stage.robot.setForce(2.1);
        const bool stops = QTest::qWaitFor([&stage] { return !stage.mayMove(); }, patience);
        stage.robot.setForce(0);
        return stops;
    }

    QTemporaryDir m_pictures;
    std::unique_ptr<Stage> m_stage;
};

QTEST_MAIN(NeverRaisedTest)
#include "never_raised_test.moc"
