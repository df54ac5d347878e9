// The watchdog's judgement, in virtual time.
#include "watchdog/beat_watch.hpp"

#include <QTest>

using namespace console;
using namespace std::chrono_literals;
using State = BeatWatch::State;

namespace {

const Instant start = Instant{} + 1h;

} // namespace

class TestBeatWatch : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void attendedAndSilentForMoreThanTheLimitIsAHang()
    {
        BeatWatch watch(60s);
        watch.take('a', start);
        QCOMPARE(watch.look(start + 250ms), State::Watching);
        QCOMPARE(watch.look(start + 251ms), State::Hung);
        QCOMPARE(watch.look(start + 1h), State::Hung);
        watch.take('a', start + 2h);
        QCOMPARE(watch.look(start + 2h), State::Watching);
    }

    void silenceWhileIdleIsNone()
    {
        BeatWatch watch(60s);
        QCOMPARE(watch.look(start + 1h), State::Watching);
        watch.take('a', start);
        watch.take('i', start + 50ms);
        QCOMPARE(watch.look(start + 1h), State::Watching);
        watch.noteEnd(start + 1h);
        QCOMPARE(watch.look(start + 1h), State::Over);
    }

    void anAttendedDeathIsSoundedForItsTime_data()
    {
        QTest::addColumn<bool>("hung");
        QTest::newRow("while beating") << false;
        QTest::newRow("while hung") << true;
    }

    void anAttendedDeathIsSoundedForItsTime()
    {
        QFETCH(bool, hung);
        BeatWatch watch(60s);
        watch.take('a', start);
        const auto death = start + (hung ? 10s : 20ms);
        QCOMPARE(watch.look(death), hung ? State::Hung : State::Watching);
        watch.noteEnd(death);
        QCOMPARE(watch.look(death + 59s), State::Died);
        QCOMPARE(watch.look(death + 60s), State::Over);
    }

    void goodbyeEndsItWhateverWasBefore()
    {
        BeatWatch watch(60s);
        watch.take('a', start);
        watch.take('q', start + 10ms);
        watch.noteEnd(start + 20ms);
        QCOMPARE(watch.look(start + 1s), State::Over);
    }
};

QTEST_GUILESS_MAIN(TestBeatWatch)
#include "test_beat_watch.moc"
