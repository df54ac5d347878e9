// Tests of when a held button asks the robot for contrast: once, after a whole hold, and never by what was held before.
#include "model/injection_order.hpp"
#include "model/instrument_state.hpp"

#include <QSignalSpy>
#include <QtTest>

#include <functional>

using namespace console;
using namespace std::chrono_literals;

namespace {

const Instant start = Instant{} + 1000s;

InjectionReadings possible(bool held)
{
    InjectionReadings readings;
    readings.held = held;
    readings.armed = true;
    readings.robotFresh = true;
    readings.contrastLeft = 50;
    return readings;
}

/// How often it asks while held so from `from` on for `span`, ten milliseconds a turn.
int asked(InjectionOrder& order, Duration from, Duration span, const InjectionReadings& readings)
{
    int count = 0;
    for (Duration at = from; at <= from + span; at += 10ms)
        count += order.advance(readings, start + at) ? 1 : 0;
    return count;
}

using Spoil = std::function<void(InjectionReadings&)>;

} // namespace
Q_DECLARE_METATYPE(Spoil)

class TestInjectionOrder : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void asksOnceForAHold()
    {
        InjectionOrder order;
        QCOMPARE(asked(order, 0ms, 990ms, possible(true)), 0);
        QVERIFY(order.progress(start + 990ms) > 0.9);
        QCOMPARE(asked(order, 1000ms, 10s, possible(true)), 1);
        QCOMPARE(order.progress(start + 11s), 0.0);
        QVERIFY(!order.advance(possible(false), start + 12s));
        QCOMPARE(asked(order, 13s, 1s, possible(true)), 1);
    }

    void aShortHoldAsksForNothing()
    {
        InjectionOrder order;
        for (int i = 0; i < 5; ++i) {
            QCOMPARE(asked(order, i * 1s, 900ms, possible(true)), 0);
            QVERIFY(!order.advance(possible(false), start + i * 1s + 950ms));
        }
    }

    void nothingIsAskedWhereItIsNotPossible_data()
    {
        QTest::addColumn<Spoil>("spoil");
        QTest::addColumn<int>("bar");
        const auto row = [](const char* name, const Spoil& spoil, InjectionBar bar) { QTest::newRow(name) << spoil << int(bar); };
        row(
            "not armed", [](InjectionReadings& r) { r.armed = false; }, InjectionBar::NotArmed);
        row(
            "robot not heard", [](InjectionReadings& r) { r.robotFresh = false; }, InjectionBar::RobotUnheard);
        row(
            "one is running", [](InjectionReadings& r) { r.running = true; }, InjectionBar::Running);
        row(
            "too little left", [](InjectionReadings& r) { r.contrastLeft = 4.9; }, InjectionBar::NotEnough);
    }

    void nothingIsAskedWhereItIsNotPossible()
    {
        QFETCH(Spoil, spoil);
        QFETCH(int, bar);
        auto spoilt = possible(true);
        spoil(spoilt);
        InjectionOrder order;
        QCOMPARE(asked(order, 0ms, 3s, spoilt), 0);
        QCOMPARE(int(order.bar()), bar);
        // What is held when it becomes possible was not held for that.
        QCOMPARE(asked(order, 3s, 3s, possible(true)), 0);
        QVERIFY(!order.advance(possible(false), start + 7s));
        // Nor does a hold go on that was broken for a moment.
        QCOMPARE(asked(order, 8s, 500ms, possible(true)), 0);
        QVERIFY(!order.advance(spoilt, start + 8600ms));
        QCOMPARE(asked(order, 8610ms, 3s, possible(true)), 0);
    }

    void waitsForTheRobotsWord()
    {
        InjectionOrder order;
        order.note(41, start);
        order.advance(possible(false), start + 100ms);
        QCOMPARE(int(order.bar()), int(InjectionBar::Running));
        QVERIFY(!order.unanswered(start + 500ms));
        QVERIFY(order.unanswered(start + 501ms));
        order.hear({40, 0, InjectionProgress::Accepted, {}});
        QVERIFY(order.unanswered(start + 501ms));
        order.hear({41, 0, InjectionProgress::Accepted, {}});
        QVERIFY(!order.unanswered(start + 501ms) && !order.awaited());
        order.advance(possible(false), start + 600ms);
        QCOMPARE(int(order.bar()), int(InjectionBar::None));
    }

    /// Else it would count as running for ever, and no other could be asked for.
    void whatRanWhenTheRobotWasLostHasStopped()
    {
        InstrumentState instrument;
        QSignalSpy changes(&instrument, &InstrumentState::injectionChanged);
        instrument.endWatch(start);
        QCOMPARE(changes.count(), 0);
        instrument.receiveInjection({7, 2.5, InjectionProgress::Running, {}}, start);
        QVERIFY(instrument.injecting());
        instrument.endWatch(start + 3s);
        QVERIFY(!instrument.injecting());
        QCOMPARE(changes.count(), 2);
        QCOMPARE(instrument.injections().back().progress, InjectionProgress::Stopped);
        QCOMPARE(instrument.injections().back().delivered, 2.5);
        QVERIFY(!instrument.injections().back().reason.isEmpty());
        QCOMPARE(instrument.injectionHeard(), std::optional<Instant>(start + 3s));
    }
};

QTEST_APPLESS_MAIN(TestInjectionOrder)
#include "test_injection_order.moc"
