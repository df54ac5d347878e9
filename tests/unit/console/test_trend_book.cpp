// Slots of a minute and of ten, and the loss of a second.
#include "model/trend_book.hpp"

#include <QTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

const Instant start = Instant{} + 1h;

TrendReading roundTrip(double milliseconds)
{
    TrendReading reading;
    reading.roundTripMs = milliseconds;
    return reading;
}

TrendReading heartbeats(quint64 received, quint64 missed)
{
    TrendReading reading;
    reading.heartbeatsReceived = received;
    reading.heartbeatsMissed = missed;
    return reading;
}

} // namespace

class TestTrendBook : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void keepsTheLeastAndTheMostOfASlot()
    {
        TrendBook book;
        for (int i = 0; i < 10; ++i)
            book.note(roundTrip(i == 4 ? 90 : 10 + i), start + i * 100ms);
        const auto& minute = book.slots(TrendFigure::RoundTrip, TrendSpan::Minute);
        QCOMPARE(minute.size(), std::size_t{10});
        QCOMPARE(minute.at(4).most.value(), 90.0);
        const auto& tenMinutes = book.slots(TrendFigure::RoundTrip, TrendSpan::TenMinutes);
        QCOMPARE(tenMinutes.size(), std::size_t{1});
        QCOMPARE(tenMinutes.front().least.value(), 10.0);
        QCOMPARE(tenMinutes.front().most.value(), 90.0);
        QCOMPARE(book.latest(TrendFigure::RoundTrip).value(), 19.0);
    }

    /// As a picture's age does: it grows until the next one comes.
    void tellsTheMostOfTheLastSecond()
    {
        TrendBook book;
        QVERIFY(!book.mostOfSecond(TrendFigure::PictureAge));
        const auto note = [&book](std::optional<double> age, Duration at) {
            TrendReading reading;
            reading.pictureAgeMs = age;
            book.note(reading, start + at);
        };
        for (int i = 0; i < 30; ++i)
            note(i == 12 ? 300 : 80 + 20 * (i % 3), i * 100ms);
        QCOMPARE(book.latest(TrendFigure::PictureAge).value(), 120.0);
        note(80, 3000ms);
        QCOMPARE(book.mostOfSecond(TrendFigure::PictureAge).value(), 120.0);
        note(std::nullopt, 3100ms);
        QVERIFY(!book.mostOfSecond(TrendFigure::PictureAge)); // what was known before is not known now
    }

    void tellsHowAFigureLay()
    {
        TrendBook book;
        QVERIFY(!book.summary(TrendFigure::RoundTrip, TrendSpan::Minute));
        for (int i = 1; i <= 100; ++i) {
            TrendReading reading;
            reading.roundTripMs = i;
            book.note(reading, start + i * 100ms);
        }
        const auto summary = book.summary(TrendFigure::RoundTrip, TrendSpan::Minute);
        QCOMPARE(summary->p50, 50.0);
        QCOMPARE(summary->p99, 99.0);
        QVERIFY(!book.summary(TrendFigure::Force, TrendSpan::Minute));
    }

    void keepsTenMinutesAndNoMore()
    {
        TrendBook book;
        for (int i = 0; i < 9000; ++i)
            book.note(roundTrip(i), start + i * 100ms);
        const auto last = start + 8999 * 100ms;
        for (const auto span : {TrendSpan::Minute, TrendSpan::TenMinutes}) {
            const auto& slots = book.slots(TrendFigure::RoundTrip, span);
            QCOMPARE(slots.size(), TrendBook::mostSlots);
            QVERIFY(last - slots.front().begin <= length(span));
            QVERIFY(last - slots.front().begin > length(span) - 2s);
        }
    }

    void whatIsNotKnownIsNoValue()
    {
        TrendBook book;
        book.note(roundTrip(5), start);
        book.note({}, start + 100ms);
        const auto& slots = book.slots(TrendFigure::RoundTrip, TrendSpan::Minute);
        QVERIFY(!slots.back().most);
        QVERIFY(!book.latest(TrendFigure::RoundTrip));
        QCOMPARE(book.slots(TrendFigure::RoundTrip, TrendSpan::TenMinutes).back().most.value(), 5.0);
        QVERIFY(!book.slots(TrendFigure::Force, TrendSpan::Minute).back().most);
    }

    void lossIsThatOfTheLastSecond()
    {
        TrendBook book;
        book.note(heartbeats(1000, 500), start); // before the trend began
        QVERIFY(!book.latest(TrendFigure::Loss));
        book.note(heartbeats(1045, 505), start + 1s);
        QCOMPARE(book.latest(TrendFigure::Loss).value(), 10.0);
        book.note(heartbeats(1070, 505), start + 1500ms);
        QCOMPARE(book.latest(TrendFigure::Loss).value(), 10.0);
        book.note(heartbeats(1095, 505), start + 2s);
        QCOMPARE(book.latest(TrendFigure::Loss).value(), 0.0);
    }

    void lossBeginsAnewWithASession()
    {
        TrendBook book;
        book.note(heartbeats(1000, 0), start);
        book.note(heartbeats(10, 0), start + 1s);
        QVERIFY(!book.latest(TrendFigure::Loss));
        book.note({}, start + 2s);
        book.note(heartbeats(60, 50), start + 3s);
        QVERIFY(!book.latest(TrendFigure::Loss));
        book.note(heartbeats(60, 50), start + 4s); // nothing came in a whole second
        QCOMPARE(book.latest(TrendFigure::Loss).value(), 100.0);
    }

    void forceIsAMagnitude()
    {
        TrendBook book;
        TrendReading pull;
        pull.force = -0.7;
        book.note(pull, start);
        QCOMPARE(book.latest(TrendFigure::Force).value(), 0.7);
    }
};

QTEST_GUILESS_MAIN(TestTrendBook)
#include "test_trend_book.moc"
