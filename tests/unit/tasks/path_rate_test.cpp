// The rate of bulk on a path in virtual time: a bottleneck with a queue before it.
#include "tasks/path_rate.hpp"

#include "support/milliseconds_of.hpp"
#include "support/virtual_path.hpp"

#include <QTest>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

using namespace liena::tasks;
using namespace std::chrono_literals;
using liena::test::millisecondsOf;
using Nanoseconds = std::chrono::nanoseconds;
using Path = liena::test::VirtualPath;

namespace {

constexpr double gigabit = 125e6; // bytes per second

} // namespace

class PathRateTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void findsWhatThePathCarriesAndKeepsItsQueueShort_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("roundTripUs");
        for (const double megabits : {20.0, 100.0, 400.0, 1000.0, 10000.0})
            for (const int roundTrip : {100, 2000, 40000})
                QTest::addRow("%.0f Mbit/s, %d us", megabits, roundTrip) << megabits * 125'000 << roundTrip;
    }

    void findsWhatThePathCarriesAndKeepsItsQueueShort()
    {
        QFETCH(double, capacity);
        QFETCH(int, roundTripUs);
        Path path(capacity, std::chrono::microseconds(roundTripUs));
        path.run(4s);
        path.forget();
        path.run(10s);
        QVERIFY2(path.sent() > 0.88 * capacity * 10, qPrintable(QString::number(path.sent() / capacity / 10)));
        const auto segment = std::chrono::duration<double>(static_cast<double>(path.rate.segment()) / capacity);
        const auto bound = 2ms + 3 * std::chrono::duration_cast<Nanoseconds>(segment) + std::chrono::microseconds(roundTripUs / 4);
        QVERIFY2(path.longestWait < bound, millisecondsOf(path.longestWait, "ms").constData());
        QVERIFY(path.rate.known().has_value());
    }

    void findsItFromFramesWithPausesBetweenThem_data()
    {
        QTest::addColumn<int>("roundTripMs");
        for (const int roundTrip : {0, 1, 10, 40, 100})
            QTest::addRow("%d ms", roundTrip) << roundTrip;
    }

    void findsItFromFramesWithPausesBetweenThem()
    {
        QFETCH(int, roundTripMs);
        Path path(gigabit, 200us + std::chrono::milliseconds(roundTripMs));
        const auto frame = [&] { // two megabytes, fifteen times a second
            path.forget();
            return path.frame(2.1e6, 66ms);
        };
        for (int i = 0; i < 60; ++i)
            frame();
        Nanoseconds slowest{};
        Nanoseconds longestWait{};
        for (int i = 0; i < 150; ++i) {
            slowest = std::max(slowest, frame());
            longestWait = std::max(longestWait, path.longestWait);
        }
        QVERIFY2(slowest <= 20ms, millisecondsOf(slowest, "ms, of at least 17").constData());
        QVERIFY2(longestWait < 4ms, millisecondsOf(longestWait, "ms").constData());
    }

    void besideFramesNinetyNineOfAHundredCommandsHardlyWait_data()
    {
        QTest::addColumn<double>("megabits");
        QTest::addColumn<int>("mostUs");
        for (const auto& [megabits, most] : {std::pair{100.0, 650}, {400.0, 750}, {1000.0, 600}})
            QTest::addRow("%.0f Mbit/s", megabits) << megabits << most;
    }

    /// Frames of half of what the path carries, thirty a second, and a command every two milliseconds. It waits for the piece that has just
    /// left, too, which takes 230 us at 100 Mbit/s.
    void besideFramesNinetyNineOfAHundredCommandsHardlyWait()
    {
        QFETCH(double, megabits);
        QFETCH(int, mostUs);
        const double capacity = megabits * 125'000;
        Path path(capacity, 200us);
        std::vector<Nanoseconds> waits;
        for (int frame = 0; frame < 600; ++frame) {
            const bool counts = frame >= 150;
            path.give(capacity / 60);
            for (int i = 0; i < 17; ++i) {
                path.goOn(2ms);
                if (counts)
                    waits.push_back(path.waiting());
            }
        }
        const auto late = waits.begin() + static_cast<std::ptrdiff_t>(waits.size() * 99 / 100);
        std::nth_element(waits.begin(), late, waits.end());
        QVERIFY2(*late < std::chrono::microseconds(mostUs), millisecondsOf(*late, "ms").constData());
    }

    void yieldsAtOnceWhenThePathCollapsesToATenth()
    {
        Path path(gigabit, 200us);
        path.run(4s);
        path.capacity = gigabit / 10;
        path.forget();
        path.run(10s);
        QVERIFY2(path.late < 50ms, millisecondsOf(path.late, "ms over 2 ms").constData());
        QVERIFY(path.sent() > 0.85 * gigabit / 10 * 10);
        QVERIFY(path.rate.known().value() < gigabit / 10 * 1.1);
    }

    /// Where a segment takes milliseconds the network's queue must not be longer than one: a command waits for both.
    void onASlowPathTheQueueIsHardlyEverLongerThanASegment()
    {
        Path path(gigabit / 10, 200us);
        path.run(4s);
        path.capacity = gigabit / 100;
        path.run(1s);
        path.forget();
        path.tooLong = path.carrying(4096);
        path.run(20s);
        QVERIFY2(path.late < 200ms, millisecondsOf(path.late, "ms of 20 s").constData());
        QVERIFY2(path.sent() > 0.8 * path.capacity * 20, qPrintable(QString::number(path.sent() / path.capacity / 20)));
        path.capacity = gigabit / 10;
        path.run(5s);
        QVERIFY2(path.rate.rate() > 0.85 * gigabit / 10, qPrintable(QString::number(path.rate.rate() / gigabit * 10)));
    }

    void whileAQueueDrainsOnASlowPathLittleIsSent_data()
    {
        QTest::addColumn<double>("megabits");
        QTest::addColumn<int>("roundTripUs");
        QTest::addColumn<double>("part");
        QTest::newRow("slow and short") << 10.0 << 200 << 0.125;
        QTest::newRow("slow and long: known late that it is gone") << 10.0 << 40'000 << 0.25;
        QTest::newRow("fast and short") << 100.0 << 200 << 0.25;
    }

    void whileAQueueDrainsOnASlowPathLittleIsSent()
    {
        QFETCH(double, megabits);
        QFETCH(int, roundTripUs);
        Path path(megabits * 125'000, std::chrono::microseconds(roundTripUs));
        path.run(4s); // what it carries is known, and found again and again
        double least = 1;
        for (int i = 0; i < 40'000; ++i) {
            path.run(250us);
            least = std::min(least, path.rate.rate() / path.rate.steady());
        }
        QTEST(least, "part");
    }

    /// Behind a token bucket no piece is late by itself: a queue is noticed before it is a segment long.
    void onASlowPathBehindATokenBucketNoAttemptCostsASegment_data()
    {
        QTest::addColumn<double>("megabits");
        QTest::addColumn<int>("unrestMs");
        for (const double megabits : {4.0, 10.0})
            for (const int unrest : {0, 1})
                QTest::addRow("%.0f Mbit/s, unrest %d ms", megabits, unrest) << megabits << unrest;
    }

    void onASlowPathBehindATokenBucketNoAttemptCostsASegment()
    {
        QFETCH(double, megabits);
        QFETCH(int, unrestMs);
        Path path(megabits * 125'000, 200us);
        path.bucket = 8192;
        path.mostUnrest = std::chrono::milliseconds(unrestMs);
        path.run(6s);
        path.forget();
        path.tooLong = path.carrying(2 * 2854); // besides the piece that has just left
        path.run(20s);
        QVERIFY2(path.late < 20ms, millisecondsOf(path.late, "ms of 20 s").constData());
        QVERIFY2(path.sent() > 0.9 * path.capacity * 20, qPrintable(QString::number(path.sent() / path.capacity / 20)));
        path.capacity *= 10;
        path.run(3s); // the next attempt may be 2 s away
        QVERIFY2(path.rate.rate() > 0.85 * path.capacity, qPrintable(QString::number(path.rate.rate() / path.capacity)));
    }

    /// What was met twice is the path: a step beyond it is a queue of milliseconds, and is not tried every second.
    void onASlowPathWhatWasMetTwiceIsSeldomTriedAgain()
    {
        Path path(gigabit / 100, 200us);
        path.run(4s);
        path.forget();
        int rises = 0;
        bool high = false;
        for (int i = 0; i < 30'000; ++i) {
            path.run(1ms);
            const bool now = path.rate.steady() > path.capacity;
            rises += now && !high ? 1 : 0;
            high = now;
        }
        QVERIFY2(rises >= 5 && rises <= 25, qPrintable(QString::number(rises)));
        QVERIFY2(path.sent() > 0.85 * path.capacity * 30, qPrintable(QString::number(path.sent() / path.capacity / 30)));
    }

    void usesAPathThatHealsWithinASecond()
    {
        Path path(gigabit / 10, 200us);
        path.run(4s);
        path.capacity = gigabit;
        path.run(1s);
        QVERIFY2(path.rate.rate() > 0.85 * gigabit, qPrintable(QString::number(path.rate.rate() / gigabit)));
    }

    /// Thirty kilobytes fifteen times a second are nothing to the path before, and too much to the path after.
    void yieldsWithSmallFramesOnAPathThatHasBecomeNarrow()
    {
        Path path(gigabit, 200us);
        const auto frame = [&] { path.frame(30e3, 66ms); };
        for (int i = 0; i < 30; ++i)
            frame();
        path.capacity = 250e3; // 2 Mbit/s
        for (int i = 0; i < 5; ++i)
            frame();
        QVERIFY2(path.rate.rate() < 250e3, qPrintable(QString::number(path.rate.rate())));
        QVERIFY2(path.waiting() < 100ms, millisecondsOf(path.waiting(), "ms").constData());
        path.capacity = gigabit;
        for (int i = 0; i < 75; ++i)
            frame();
        QVERIFY2(path.rate.rate() > 30e3 / 0.066, qPrintable(QString::number(path.rate.rate())));
    }

    void whatYieldedDoesNotFallOnAndOn_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("roundTripUs");
        QTest::addColumn<bool>("frames");
        for (const double megabits : {100.0, 200.0, 400.0, 1000.0})
            for (const int roundTrip : {200, 1000, 2000, 5000, 9000})
                for (const bool frames : {false, true})
                    QTest::addRow("%.0f Mbit/s, %d us, %s", megabits, roundTrip, frames ? "frames" : "a stream")
                        << megabits * 125'000 << roundTrip << frames;
    }

    /// While a queue drains little is sent, and then less was delivered than is soon under way. Frames of 0.8 of the path, thirty a second,
    /// or a stream, from several rates on: the lowest rate in the 0.7 s after the path is known, in the mean.
    void whatYieldedDoesNotFallOnAndOn()
    {
        QFETCH(double, capacity);
        QFETCH(int, roundTripUs);
        QFETCH(bool, frames);
        double mean = 0;
        constexpr int beginnings = 40;
        for (int i = 0; i < beginnings; ++i) {
            Path path(capacity, std::chrono::microseconds(roundTripUs));
            path.rate.beginAt(capacity * (0.05 + 0.02 * i));
            const auto goOn = [&] { frames ? (void)path.frame(capacity * 0.0267, 33'250us) : path.run(33'250us); };
            for (int k = 0; k < 60 && path.rate.steady() < 0.9 * capacity; ++k)
                goOn();
            double least = 1;
            for (int k = 0; k < 20; ++k) {
                goOn();
                least = std::min(least, path.rate.steady() / capacity);
            }
            mean += least / beginnings;
        }
        QVERIFY2(mean > 0.85, qPrintable(QString::number(mean)));
    }

    void smallFramesAtALowRateShowWhatThePathCarries_data()
    {
        QTest::addColumn<double>("bytes");
        QTest::addColumn<int>("roundTripUs");
        QTest::addColumn<double>("takes"); // seconds, at the rate of the beginning
        for (const double bytes : {2.9e3, 6e3, 9.5e3, 14.6e3, 20e3})
            for (const int roundTrip : {100, 300, 1000, 5000})
                for (const double takes : {0.015, 0.02, 0.025, 0.03})
                    QTest::addRow("%.0f bytes, %d us, in %.1f ms", bytes, roundTrip, takes * 1e3) << bytes << roundTrip << takes;
    }

    /// A window of two milliseconds may be one between two pieces of it, and they may be too few for a queue: the whole frame tells all the
    /// same.
    void smallFramesAtALowRateShowWhatThePathCarries()
    {
        QFETCH(double, bytes);
        QFETCH(int, roundTripUs);
        Path path(gigabit / 10, std::chrono::microseconds(roundTripUs));
        QFETCH(double, takes);
        path.rate.beginAt(bytes / takes);
        for (int i = 0; i < 60; ++i)
            path.frame(bytes, 33'250us);
        QVERIFY2(path.rate.steady() > 3 * bytes / takes, qPrintable(QString::number(path.rate.steady() * takes / bytes)));
    }

    void isBackSoonAfterAMomentWithoutAnyDelivery_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("stalled");
        QTest::addColumn<int>("after");
        for (const auto& [stalled, after] : std::initializer_list<std::pair<int, int>>{{3, 100}, {5, 100}, {10, 500}, {20, 500}}) {
            QTest::addRow("1 Gbit/s, %d ms", stalled) << gigabit << stalled << after;
            QTest::addRow("400 Mbit/s, %d ms", stalled) << 0.4 * gigabit << stalled << after;
        }
    }

    /// A processor that stands still looks like a path that carries nothing. Frames thirty times a second must not suffer for long.
    void isBackSoonAfterAMomentWithoutAnyDelivery()
    {
        QFETCH(double, capacity);
        QFETCH(int, stalled);
        QFETCH(int, after);
        Path path(capacity, 200us);
        path.run(4s);
        path.stalled = true;
        path.run(std::chrono::milliseconds(stalled));
        path.stalled = false;
        path.run(std::chrono::milliseconds(after));
        QVERIFY2(path.rate.rate() > 0.85 * capacity, qPrintable(QString::number(path.rate.rate() / capacity)));
    }

    void looksOnceMoreWhetherAPathHasReallyFallen()
    {
        Path path(gigabit, 200us);
        path.run(4s);
        path.capacity = 0.1 * gigabit;
        path.run(200ms); // what the fall itself left is gone
        path.forget();
        path.run(10s);
        QVERIFY2(path.longestWait < 3ms, millisecondsOf(path.longestWait, "ms").constData());
        QVERIFY2(path.late < 100ms, millisecondsOf(path.late, "ms late").constData());
        QVERIFY2(path.rate.rate() > 0.08 * gigabit, qPrintable(QString::number(path.rate.rate() / gigabit)));
    }

    void doesNotGrowWhenTheReceiverIsTheLimit()
    {
        Path path(10 * gigabit, 200us);
        path.run(1s);
        path.receiverLimits = true;
        const double before = path.rate.rate();
        path.run(1s);
        QVERIFY(path.rate.rate() <= before);
    }

    /// TCP counts its SYN among what is acknowledged: in the end that is a byte more than was sent.
    void whatIsAllAcknowledgedIsNoQueueHoweverOldTheRoundTripIs()
    {
        PathRate rate;
        auto now = PathRate::Instant{1h};
        for (std::uint64_t sent = 100'000; sent < 2'000'000; sent += 25'000, now += 2ms)
            rate.observe({44ms, 200us, sent, sent + 1, {}, 0}, now);
        QVERIFY(rate.rate() >= PathRate::first);
        QVERIFY(!rate.known());
    }

    /// What a path carried long ago is not what it carries.
    void tellsWhenThePathWasFilledLast()
    {
        Path path(gigabit / 10, 200us);
        path.run(4s);
        path.run(10s, false);
        const auto filled = path.rate.shown();
        path.run(60s, false);
        QVERIFY(path.rate.known());
        QVERIFY(path.rate.shown() == filled);
        path.run(1s);
        QVERIFY(path.rate.shown() - filled >= 70s);
    }

    /// Held below what it would send, it fills nothing of its own, and yet the limit is what the path carries.
    void whatFillsALimitShowsIt()
    {
        Path path(gigabit / 10, 200us);
        path.run(4s);
        path.rate.limit(gigabit / 40);
        path.run(20s);
        const auto filled = path.rate.shown();
        path.run(5s);
        QVERIFY(path.rate.known() == gigabit / 40);
        QVERIFY(path.rate.shown() - filled >= 4s);
    }

    void makesSegmentsSmallerOnSlowerPaths()
    {
        Path fast(gigabit, 200us);
        Path slow(gigabit / 10, 200us);
        fast.run(4s);
        slow.run(4s);
        QCOMPARE(fast.rate.segment(), std::size_t{8562});
        QCOMPARE(slow.rate.segment(), std::size_t{2854});
    }
};

QTEST_GUILESS_MAIN(PathRateTest)
#include "path_rate_test.moc"
