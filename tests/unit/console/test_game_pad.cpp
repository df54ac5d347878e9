// Which button of a game pad does what, and what a pad that comes held, goes or is replaced may not do.
#include "input/game_pad_master.hpp"

#include <QSignalSpy>
#include <QTest>

#include <limits>

using namespace console;
using namespace std::chrono_literals;

namespace {

/// Says what a test puts into it.
class WrittenPads : public PadSource {
public:
    std::vector<PadStep> poll() override { return std::exchange(next, {}); }
    QString name() const override { return QStringLiteral("Written"); }
    QStringList others() const override { return more; }
    QString trouble() const override { return {}; }

    std::vector<PadStep> next;
    QStringList more;
};

PadState with(PadAxis axis, double value, PadState state = {})
{
    state.axes.at(std::size_t(axis)) = value;
    return state;
}

PadState with(PadButton button, PadState state = {})
{
    state.buttons.at(std::size_t(button)) = true;
    return state;
}

const PadState held = with(PadAxis::LeftTrigger, 1.0);

struct Pad {
    WrittenPads* source = new WrittenPads;
    GamePadMaster master{std::unique_ptr<PadSource>(source)};
    Instant now = Instant{} + 1h;

    explicit Pad(const PadState& first = {})
    {
        master.setListening(true);
        says({{PadStep::What::Came, first}});
    }

    void says(std::vector<PadStep> steps)
    {
        source->next = std::move(steps);
        now += 10ms;
        master.poll(now);
    }

    void says(const PadState& state) { says({{PadStep::What::Changed, state}}); }
    MasterReading read() { return master.read(now); }
};

} // namespace

class TestGamePad : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void sticksMoveWhatTheySay_data()
    {
        QTest::addColumn<PadAxis>("axis");
        QTest::addColumn<double>("value");
        QTest::addColumn<QVector<double>>("signs");
        QTest::newRow("left up") << PadAxis::LeftY << -1.0 << QVector<double>{1, 0, 0, 0};
        QTest::newRow("left down") << PadAxis::LeftY << 1.0 << QVector<double>{-1, 0, 0, 0};
        QTest::newRow("left right") << PadAxis::LeftX << 1.0 << QVector<double>{0, 1, 0, 0};
        QTest::newRow("right up") << PadAxis::RightY << -1.0 << QVector<double>{0, 0, 1, 0};
        QTest::newRow("right left") << PadAxis::RightX << -1.0 << QVector<double>{0, 0, 0, -1};
        QTest::newRow("worn") << PadAxis::LeftY << -0.14 << QVector<double>{0, 0, 0, 0};
        QTest::newRow("no number") << PadAxis::LeftY << std::numeric_limits<double>::quiet_NaN() << QVector<double>{0, 0, 0, 0};
    }

    void sticksMoveWhatTheySay()
    {
        QFETCH(PadAxis, axis);
        QFETCH(double, value);
        QFETCH(QVector<double>, signs);
        Pad pad;
        pad.says(with(axis, value, held));
        const auto m = pad.read().motion;
        const auto sign = [](double v) { return double(v > 0) - double(v < 0); };
        QCOMPARE(
            (QVector<double>{sign(m.guidewireVelocity), sign(m.guidewireRotation), sign(m.catheterVelocity), sign(m.catheterRotation)}),
            signs);
    }

    void deadManLastsWhileTheTriggerIsHeld()
    {
        Pad pad;
        QSignalSpy changes(&pad.master, &MasterDevice::deadManChanged);
        pad.says(with(PadAxis::LeftTrigger, 0.5));
        QVERIFY(!pad.read().deadMan);
        pad.says(held);
        QVERIFY(pad.read().alive && pad.read().deadMan);
        pad.says(with(PadAxis::LeftTrigger, 0.5));
        QVERIFY(pad.read().deadMan);
        pad.says(with(PadAxis::LeftTrigger, 0.3));
        QVERIFY(!pad.read().deadMan);
        QCOMPARE(changes.size(), 2);
    }

    void lettingGoBetweenTwoPollsIsNotLost()
    {
        Pad pad;
        pad.says(held);
        QSignalSpy changes(&pad.master, &MasterDevice::deadManChanged);
        pad.says({{PadStep::What::Changed, {}}, {PadStep::What::Changed, held}});
        QCOMPARE(changes.size(), 2);
        QCOMPARE(changes.first().first().toBool(), false);
    }

    void buttonsDoWhatTheySay()
    {
        Pad pad;
        QSignalSpy arm(&pad.master, &MasterDevice::armHeldChanged);
        QSignalSpy scale(&pad.master, &MasterDevice::scaleStepRequested);
        QSignalSpy hold(&pad.master, &MasterDevice::holdRequested);
        pad.says(with(PadButton::RightShoulder, held));
        QVERIFY(pad.read().clutch);
        pad.says(with(PadButton::Start));
        pad.says(with(PadButton::Start));
        QCOMPARE(arm.size(), 1);
        pad.says(PadState{});
        QCOMPARE(arm.last().first().toBool(), false);
        pad.says(with(PadButton::Up));
        pad.says(with(PadButton::Up));
        pad.says(with(PadButton::Down));
        QCOMPARE(scale.size(), 2);
        QCOMPARE(scale.first().first().toInt(), 1);
        QCOMPARE(scale.last().first().toInt(), -1);
        pad.says(with(PadButton::East));
        QCOMPARE(hold.size(), 1);
    }

    void aPadThatComesHeldDoesNothing_data()
    {
        QTest::addColumn<PadState>("state");
        QTest::newRow("trigger") << held;
        QTest::newRow("start") << with(PadButton::Start);
        QTest::newRow("stuck stick") << with(PadAxis::LeftY, -0.6);
        QTest::newRow("stuck stick on the other side") << with(PadAxis::RightX, 1);
    }

    void aPadThatComesHeldDoesNothing()
    {
        QFETCH(PadState, state);
        Pad pad(state);
        QSignalSpy deadMan(&pad.master, &MasterDevice::deadManChanged);
        QSignalSpy arm(&pad.master, &MasterDevice::armHeldChanged);
        for (int i = 0; i < 5; ++i) {
            pad.says(with(PadAxis::LeftTrigger, 1, with(PadButton::Start, state)));
            QVERIFY(!pad.read().alive && !pad.read().deadMan && pad.read().motion.isZero());
        }
        QCOMPARE(deadMan.size() + arm.size(), 0);
        QCOMPARE(pad.master.life(pad.now), MasterLife::Unreleased);
        pad.says(PadState{});
        QVERIFY(pad.read().alive);
        pad.says(held);
        QVERIFY(pad.read().deadMan);
    }

    void withoutTheWindowThePadIsNotHeard()
    {
        Pad pad;
        pad.master.setListening(false);
        QSignalSpy deadMan(&pad.master, &MasterDevice::deadManChanged);
        QSignalSpy arm(&pad.master, &MasterDevice::armHeldChanged);
        QSignalSpy scale(&pad.master, &MasterDevice::scaleStepRequested);
        pad.says(with(PadAxis::LeftY, -1, with(PadButton::Start, with(PadButton::Up, held))));
        QVERIFY(!pad.read().alive && !pad.read().deadMan && pad.read().motion.isZero());
        QCOMPARE(deadMan.size() + arm.size() + scale.size(), 0);
    }

    void aReplacedPadMustBeLetGo()
    {
        Pad pad;
        pad.says(held);
        QSignalSpy life(&pad.master, &MasterDevice::lifeChanged);
        pad.says({{PadStep::What::Went, {}}, {PadStep::What::Came, held}});
        QVERIFY(life.size() >= 1);
        QVERIFY(!pad.read().alive && !pad.read().deadMan);
        QCOMPARE(pad.master.life(pad.now), MasterLife::Unreleased);
    }

    void aPadAtRestIsAliveAgainAfterALatePoll()
    {
        Pad pad;
        pad.now += 1s;
        pad.says(std::vector<PadStep>{}); // nothing changed: nothing is told
        QVERIFY(pad.read().alive);
        pad.says(held);
        pad.now += 1s;
        pad.says(std::vector<PadStep>{});
        QVERIFY(!pad.read().alive && !pad.read().deadMan);
    }

    void otherPadsAreNamed()
    {
        Pad pad;
        QCOMPARE(pad.master.name(), QStringLiteral("Game pad Written"));
        pad.source->more = {QStringLiteral("Second"), QStringLiteral("Third")};
        QCOMPARE(pad.master.name(), QStringLiteral("Game pad Written (+2)"));
        QVERIFY(pad.master.note().contains(QStringLiteral("Second, Third")));
    }
};

QTEST_GUILESS_MAIN(TestGamePad)
#include "test_game_pad.moc"
