// The rate of bulk on a long path in virtual time, whose round trips vary by themselves.
#include "tasks/path_rate.hpp"

#include "support/milliseconds_of.hpp"
#include "support/virtual_frames.hpp"
#include "support/virtual_path.hpp"

#include <QTest>

#include <algorithm>
#include <initializer_list>
#include <utility>

using namespace liena::tasks;
using namespace std::chrono_literals;
using liena::test::millisecondsOf;
using Nanoseconds = std::chrono::nanoseconds;
using Frames = liena::test::VirtualFrames;
using Path = liena::test::VirtualPath;

namespace {

constexpr double gigabit = 125e6; // bytes per second

void calmLongPaths(std::initializer_list<int> unrestUs)
{
    QTest::addColumn<double>("capacity");
    QTest::addColumn<int>("framesPerSecond");
    QTest::addColumn<int>("unrestUs");
    for (const double megabits : {100.0, 400.0, 1000.0})
        for (const int frames : {15, 30})
            for (const int unrest : unrestUs)
                QTest::addRow("%.0f Mbit/s, %d frames/s, %d us", megabits, frames, unrest) << megabits * 125'000 << frames << unrest;
}

/// Of what it is before anything is known.
double lowestRate(double bytesOfAFrame, Nanoseconds unrest, unsigned seed)
{
    Path path(gigabit, 40ms);
    path.random.seed(seed);
    path.mostUnrest = unrest;
    path.lateTogether = 20;
    double lowest = 1;
    for (int i = 0; i < 300; ++i) {
        path.frame(bytesOfAFrame, 33'250us);
        lowest = std::min(lowest, path.rate.steady() / PathRate::first);
    }
    return lowest;
}

} // namespace

class PathRateLongWayTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void takesNoUnrestOfALongPathForAQueue_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("framesPerSecond");
        QTest::addColumn<int>("unrestMs");
        QTest::addColumn<unsigned>("together");
        for (const auto& [megabits, unrest] : {std::pair(100.0, 2), std::pair(100.0, 4), std::pair(400.0, 2), std::pair(400.0, 4),
                                               std::pair(1000.0, 2), std::pair(1000.0, 4)})
            for (const int frames : {15, 30})
                for (const unsigned together : {1U, 20U})
                    QTest::addRow("%.0f Mbit/s, %d frames/s, %d ms, %u together", megabits, frames, unrest, together)
                        << megabits * 125'000 << frames << unrest << together;
    }

    /// Frames of a quarter and of half of what the path carries, over 40 ms there and back; on eight such paths, whose moments are others.
    void takesNoUnrestOfALongPathForAQueue()
    {
        QFETCH(double, capacity);
        QFETCH(int, framesPerSecond);
        QFETCH(int, unrestMs);
        QFETCH(unsigned, together);
        constexpr unsigned paths = 8;
        Nanoseconds all{};
        Nanoseconds longestWait{};
        for (unsigned i = 1; i <= paths; ++i) {
            Path path(capacity, 40ms);
            path.random.seed(i);
            path.mostUnrest = std::chrono::milliseconds(unrestMs);
            path.lateTogether = together;
            Frames frames(path, framesPerSecond);
            for (int frame = 0; frame < 5 * framesPerSecond; ++frame)
                frames.send();
            path.forget();
            for (int frame = 0; frame < 10 * framesPerSecond; ++frame)
                all += frames.send();
            longestWait = std::max(longestWait, path.longestWait);
        }
        const auto mean = all / (10 * framesPerSecond * static_cast<int>(paths));
        QVERIFY2(mean <= 27ms, millisecondsOf(mean, "ms, of at least 17").constData());
        QVERIFY2(longestWait < 12ms, millisecondsOf(longestWait, "ms").constData());
    }

    void commandsHardlyWaitOnACalmLongPath_data() { calmLongPaths({0, 150}); }

    /// From the second second on: in 99 of 100 moments for no longer than a segment and half a millisecond, in 999 of 1000 for a whole one
    /// more.
    void commandsHardlyWaitOnACalmLongPath()
    {
        QFETCH(double, capacity);
        QFETCH(int, framesPerSecond);
        QFETCH(int, unrestUs);
        Path path(capacity, 40ms);
        path.mostUnrest = std::chrono::microseconds(unrestUs);
        path.lateTogether = 20;
        Frames frames(path, framesPerSecond);
        for (int i = 0; i < framesPerSecond; ++i)
            frames.send();
        path.forget();
        const auto segment = path.carrying(static_cast<double>(path.rate.segment()));
        path.tooLong = segment + 500us;
        path.muchTooLong = segment + 1500us;
        Nanoseconds slowest{};
        for (int i = 0; i < 20 * framesPerSecond; ++i)
            slowest = std::max(slowest, frames.send());
        const auto figures = millisecondsOf(path.late, "ms of 20 s, ") + millisecondsOf(path.veryLate, "ms very late");
        QVERIFY2(path.late < 200ms && path.veryLate < 20ms, figures.constData());
        QVERIFY2(slowest < 23ms, millisecondsOf(slowest, "ms, of at least 17").constData());
    }

    void isBackSoonAfterAStandstill_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("framesPerSecond");
        QTest::addColumn<int>("unrestUs");
        QTest::addColumn<bool>("ofTheNetwork");
        for (const double megabits : {100.0, 400.0, 1000.0})
            for (const int frames : {15, 30})
                for (const int unrest : {0, 150, 2000})
                    for (const bool network : {false, true})
                        QTest::addRow("%.0f Mbit/s, %d frames/s, %d us, the %s stands still", megabits, frames, unrest,
                                      network ? "network" : "sender")
                            << megabits * 125'000 << frames << unrest << network;
    }

    /// For 3 to 60 ms, at the beginning, in the middle or at the end of a frame: that is no path that carries less. Frames leave in 17 ms
    /// at least. On an unquiet path, whose moments are others each time, it is their mean over all of it.
    void isBackSoonAfterAStandstill()
    {
        QFETCH(double, capacity);
        QFETCH(int, framesPerSecond);
        QFETCH(int, unrestUs);
        QFETCH(bool, ofTheNetwork);
        Nanoseconds all{};
        unsigned times = 0;
        for (const auto still : {3ms, 8ms, 15ms, 30ms, 60ms})
            for (const auto moment : {2ms, 8ms, 14ms}) {
                Path path(capacity, 40ms);
                path.random.seed(++times);
                path.mostUnrest = std::chrono::microseconds(unrestUs);
                path.lateTogether = 20;
                Frames frames(path, framesPerSecond);
                for (int i = 0; i < 6 * framesPerSecond; ++i)
                    frames.send();
                frames.send(still, moment, ofTheNetwork);
                Nanoseconds after{};
                for (int i = 0; i < 5 * framesPerSecond; ++i)
                    after += frames.send();
                all += after;
                const auto mean = after / (5 * framesPerSecond);
                const auto figures = millisecondsOf(mean, "ms in the five seconds after ") + millisecondsOf(still, "ms, begun after ") +
                                     millisecondsOf(moment, "ms");
                QVERIFY2(unrestUs >= 1000 || mean < 24ms, figures.constData());
            }
        const auto mean = all / (5 * framesPerSecond * static_cast<int>(times));
        QVERIFY2(mean < 26.5ms, millisecondsOf(mean, "ms in the five seconds after").constData());
    }

    void aRestlessComputerMakesHardlyAnyCommandWait_data() { calmLongPaths({0, 150}); }

    /// Eight times a second of sending the sender's computer or the network stands still for 0.5 to 5 ms. What waits because of that itself
    /// is not counted, but whether the rate is a good one all the same: over eight times ten seconds, from the third second on.
    void aRestlessComputerMakesHardlyAnyCommandWait()
    {
        QFETCH(double, capacity);
        QFETCH(int, framesPerSecond);
        QFETCH(int, unrestUs);
        constexpr unsigned times = 8;
        Nanoseconds late{};
        Nanoseconds veryLate{};
        Nanoseconds all{};
        for (unsigned i = 1; i <= times; ++i) {
            Path path(capacity, 40ms);
            path.random.seed(i);
            path.mostUnrest = std::chrono::microseconds(unrestUs);
            path.lateTogether = 20;
            Frames frames(path, framesPerSecond);
            frames.standsStillAtTimes(i);
            for (int frame = 0; frame < 2 * framesPerSecond; ++frame)
                frames.send();
            path.forget();
            const auto segment = path.carrying(static_cast<double>(path.rate.segment()));
            path.tooLong = segment + 500us;
            path.muchTooLong = segment + 1500us;
            for (int frame = 0; frame < 10 * framesPerSecond; ++frame)
                all += frames.send();
            late += path.late;
            veryLate += path.veryLate;
        }
        const auto figures = millisecondsOf(late, "ms of 80 s, ") + millisecondsOf(veryLate, "ms very late");
        QVERIFY2(late < 800ms && veryLate < 240ms, figures.constData());
        const auto mean = all / (10 * framesPerSecond * static_cast<int>(times));
        QVERIFY2(mean < 25ms, millisecondsOf(mean, "ms, of at least 17").constData());
    }

    void commandsHardlyWaitWhileALongAndFastPathIsLearnt_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("framesPerSecond");
        QTest::addColumn<int>("unrestUs");
        for (const double megabits : {400.0, 1000.0})
            for (const int frames : {15, 30})
                for (const int unrest : {0, 150, 300})
                    QTest::addRow("%.0f Mbit/s, %d frames/s, %d us", megabits, frames, unrest) << megabits * 125'000 << frames << unrest;
    }

    /// From the first frame on. What left too fast at once, as a whole frame would, would keep them waiting twice as long.
    void commandsHardlyWaitWhileALongAndFastPathIsLearnt()
    {
        QFETCH(double, capacity);
        QFETCH(int, framesPerSecond);
        QFETCH(int, unrestUs);
        Path path(capacity, 40ms);
        path.mostUnrest = std::chrono::microseconds(unrestUs);
        path.lateTogether = 20;
        path.muchTooLong = path.carrying(8562) + 1500us;
        Frames frames(path, framesPerSecond);
        Nanoseconds last{};
        for (int i = 0; i < 5 * framesPerSecond; ++i)
            last = frames.send();
        const auto figures = millisecondsOf(path.veryLate, "ms of 5 s very late, ") + millisecondsOf(path.longestWait, "ms at the longest");
        QVERIFY2(path.veryLate < (framesPerSecond > 15 ? 12ms : 5ms), figures.constData());
        QVERIFY2(last < 20ms, millisecondsOf(last, "ms for a frame of 17").constData());
    }

    void learnsFromFramesWhatALongAndSlowPathCarries_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("roundTripMs");
        for (const double megabits : {20.0, 40.0, 60.0, 90.0})
            for (const int roundTrip : {12, 20, 40})
                QTest::addRow("%.0f Mbit/s, %d ms", megabits, roundTrip) << megabits * 125'000 << roundTrip;
    }

    /// Slower than a lane begins with, and quiet: what waits there is a queue of ours, however short.
    void learnsFromFramesWhatALongAndSlowPathCarries()
    {
        QFETCH(double, capacity);
        QFETCH(int, roundTripMs);
        Path path(capacity, std::chrono::milliseconds(roundTripMs));
        const double bytes = capacity / 15 * 0.4;
        const auto frame = [&] {
            path.forget();
            path.frame(bytes, 66ms);
        };
        for (int i = 0; i < 150; ++i)
            frame();
        Nanoseconds longestWait{};
        for (int i = 0; i < 150; ++i) {
            frame();
            longestWait = std::max(longestWait, path.longestWait);
        }
        const auto figures = millisecondsOf(longestWait, "ms, ") + QByteArray::number(path.rate.rate() / path.capacity) + " of the path";
        QVERIFY2(path.rate.rate() < 1.25 * path.capacity && path.rate.rate() > 0.7 * path.capacity, figures.constData());
        QVERIFY2(longestWait < 4ms, figures.constData());
    }

    void aPathThatFellTwiceAndHealsIsWideAgain_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<double>("left");
        // 0.32, 0.39 and 0.53 where the second fall takes the place of the first as the one that is doubted.
        QTest::newRow("10 Mbit/s, to a fifth each time") << gigabit / 100 << 0.2;
        QTest::newRow("40 Mbit/s, to a fifth each time") << gigabit / 25 << 0.2;
        QTest::newRow("40 Mbit/s, to 0.3 each time") << gigabit / 25 << 0.3;
    }

    /// The second time soon after the first. What it carried before both is believed again once it carries more than is left.
    void aPathThatFellTwiceAndHealsIsWideAgain()
    {
        QFETCH(double, capacity);
        QFETCH(double, left);
        Path path(capacity, 80ms);
        path.run(4s);
        path.capacity = capacity * left;
        path.run(300ms);
        path.capacity *= left;
        path.run(1s);
        path.capacity = capacity;
        path.forget();
        path.run(3s);
        const double sent = path.sent() / capacity / 3;
        QVERIFY2(sent > 0.58, qPrintable(QString::number(sent)));
    }

    void yieldsOnALongPathThatNarrowsStepByStep_data()
    {
        QTest::addColumn<int>("roundTripMs");
        QTest::addColumn<int>("eachMs");
        for (const int roundTrip : {12, 24, 40})
            for (const int each : {300, 1000, 2000, 5000})
                QTest::addRow("%d ms, a step each %d ms", roundTrip, each) << roundTrip << each;
    }

    /// In steps that each look like a little unrest.
    void yieldsOnALongPathThatNarrowsStepByStep()
    {
        QFETCH(int, roundTripMs);
        QFETCH(int, eachMs);
        Path path(gigabit / 10, std::chrono::milliseconds(roundTripMs));
        path.run(10s);
        for (const double share : {0.8, 0.68, 0.55, 0.45}) {
            path.capacity = gigabit / 10 * share;
            path.run(std::chrono::milliseconds(eachMs));
        }
        path.forget();
        path.tooLong = 4ms;
        path.run(10s);
        const auto figures = millisecondsOf(path.late, "ms of 10 s, ") + millisecondsOf(path.longestWait, "ms at the longest");
        QVERIFY2(path.late < 500ms, figures.constData());
    }

    /// Each round trip carries twice as much as the one before, and what is under way is more than what the last one delivered.
    void takesNoSlowStartOnALongPathForAQueue()
    {
        Path path(gigabit / 10, 40ms);
        path.mostUnrest = 4ms;
        path.lateTogether = 20;
        path.startSlowly();
        path.run(1s);
        QVERIFY2(path.rate.rate() > 0.5 * path.capacity, qPrintable(QString::number(path.rate.rate() / path.capacity)));
    }

    void smallFramesOnAnUnquietLongPathDoNotCostItsRate_data()
    {
        QTest::addColumn<double>("bytes");
        QTest::addColumn<int>("unrestMs");
        for (const double bytes : {8e3, 20e3, 60e3})
            for (const int unrest : {2, 4})
                QTest::addRow("%.0f bytes, %d ms", bytes, unrest) << bytes << unrest;
    }

    /// They are over within less time than they may be late: how long they took says nothing of the path. The lowest rate of ten seconds,
    /// in the mean of sixteen such paths.
    void smallFramesOnAnUnquietLongPathDoNotCostItsRate()
    {
        QFETCH(double, bytes);
        QFETCH(int, unrestMs);
        constexpr unsigned paths = 16;
        double lowest = 0;
        for (unsigned path = 1; path <= paths; ++path)
            lowest += lowestRate(bytes, std::chrono::milliseconds(unrestMs), path) / paths;
        QVERIFY2(lowest > 0.33, qPrintable(QString::number(lowest)));
    }

    /// What was learnt of the unrest does not hide a path that became narrow.
    void yieldsOnAnUnquietPathThatCollapsesToATenth()
    {
        Path path(gigabit / 10, 40ms);
        path.mostUnrest = 4ms;
        path.lateTogether = 20;
        path.run(10s);
        path.capacity = gigabit / 100;
        path.run(2s);
        path.forget();
        path.run(10s);
        QVERIFY2(path.rate.rate() < 1.15 * path.capacity, qPrintable(QString::number(path.rate.rate() / path.capacity)));
        QVERIFY2(path.longestWait < 60ms, millisecondsOf(path.longestWait, "ms").constData());
        QVERIFY2(path.sent() > 0.7 * path.capacity * 10, qPrintable(QString::number(path.sent() / path.capacity / 10)));
    }
};

QTEST_GUILESS_MAIN(PathRateLongWayTest)
#include "path_rate_long_way_test.moc"
