// The rate of bulk in virtual time on a way that becomes longer: another route, a line that failed.
#include "tasks/path_rate.hpp"

#include "support/milliseconds_of.hpp"
#include "support/virtual_frames.hpp"
#include "support/virtual_path.hpp"

#include <QTest>

#include <algorithm>
#include <tuple>
#include <utility>

using namespace std::chrono_literals;
using liena::test::millisecondsOf;
using Nanoseconds = std::chrono::nanoseconds;
using Frames = liena::test::VirtualFrames;
using Path = liena::test::VirtualPath;

namespace {

constexpr int seconds = 4; // before and after
constexpr int framesPerSecond = 30;

/// Of what the path carries, in frames; all of it: without a pause.
void send(Path& path, double part)
{
    if (part >= 1)
        return path.run(std::chrono::seconds(seconds));
    for (int i = 0; i < seconds * framesPerSecond; ++i)
        path.frame(part * path.capacity / framesPerSecond, Nanoseconds(1s) / framesPerSecond);
}

struct Cost {
    double sent = 0; ///< of what the path carries
    Nanoseconds late{};
};

/// The mean of paths of 10 Mbit/s to 1 Gbit/s that become longer by 20 to 60 ms, in the seconds after that.
Cost costOfALongerWay(std::chrono::microseconds before, double part)
{
    Cost sum;
    int paths = 0;
    for (const double megabits : {10.0, 20.0, 40.0, 100.0, 400.0, 1000.0})
        for (const auto longer : {20ms, 40ms, 60ms}) {
            Path path(megabits * 125'000, before);
            send(path, part);
            path.reroute(before + longer);
            path.forget();
            send(path, part);
            sum.sent += path.sent() / path.capacity / seconds;
            sum.late += path.late;
            ++paths;
        }
    return {sum.sent / paths, sum.late / paths};
}

} // namespace

class PathRateLongerWayTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// The kernel remembers the shortest round trip for five minutes; what a longer route adds is no queue of ours for so long.
    void usesAPathThatHasBecomeLonger_data()
    {
        QTest::addColumn<double>("megabits");
        QTest::addColumn<int>("beforeUs");
        QTest::addColumn<int>("afterUs");
        for (const double megabits : {100.0, 400.0, 1000.0})
            for (const auto& [before, after] :
                 {std::pair{200, 1500}, {1000, 6000}, {2000, 8000}, {10000, 14000}, {10000, 30000}, {40000, 60000}})
                QTest::addRow("%g Mbit/s, %d to %d us", megabits, before, after) << megabits << before << after;
    }

    void usesAPathThatHasBecomeLonger()
    {
        QFETCH(double, megabits);
        QFETCH(int, beforeUs);
        QFETCH(int, afterUs);
        const double capacity = megabits * 125'000;
        Path path(capacity, std::chrono::microseconds(beforeUs));
        path.run(8s);
        path.reroute(std::chrono::microseconds(afterUs));
        path.run(12s);
        path.forget();
        path.run(4s);
        QVERIFY2(path.sent() > 0.85 * capacity * 4, qPrintable(QString::number(path.sent() / capacity / 4)));
        path.reroute(std::chrono::microseconds(beforeUs)); // and back: a queue is told as early as before
        path.run(4s);
        path.forget();
        path.run(4s);
        QVERIFY2(path.longestWait < 10ms, qPrintable(QString::number(path.longestWait.count())));
    }

    void aPauseForgetsNoLongerWay_data()
    {
        QTest::addColumn<double>("megabits");
        QTest::addColumn<int>("beforeUs");
        QTest::addColumn<int>("afterUs");
        QTest::addColumn<double>("part");
        for (const double part : {1.0, 0.6})
            for (const auto& [megabits, before, after] :
                 {std::tuple(10.0, 200, 4200), {10.0, 2000, 42000}, {20.0, 2000, 4000}, {20.0, 200, 40200}, {100.0, 2000, 12000}})
                QTest::addRow("%g Mbit/s, %d to %d us, %g", megabits, before, after, part) << megabits << before << after << part;
    }

    /// Nobody looks at pictures for a while, and then again: all leaves as before, though the kernel remembers the shorter way.
    void aPauseForgetsNoLongerWay()
    {
        QFETCH(double, megabits);
        QFETCH(int, beforeUs);
        QFETCH(int, afterUs);
        QFETCH(double, part);
        Path path(megabits * 125'000, std::chrono::microseconds(beforeUs));
        send(path, part);
        send(path, part);
        path.reroute(std::chrono::microseconds(afterUs));
        for (int i = 0; i < 3; ++i)
            send(path, part);
        path.run(20s, false);
        path.forget();
        send(path, part);
        QVERIFY2(path.sent() > 0.92 * part * path.capacity * seconds, qPrintable(QString::number(path.sent() / path.capacity / seconds)));
    }

    void usesAWayThatHasBecomeMuchLonger_data()
    {
        QTest::addColumn<double>("megabits");
        QTest::addColumn<int>("framesPerSecond");
        QTest::addColumn<int>("beforeMs");
        QTest::addColumn<int>("afterMs");
        for (const double megabits : {100.0, 400.0, 1000.0})
            for (const int frames : {15, 30})
                for (const auto& [before, after] : {std::pair{10, 30}, {40, 60}, {20, 80}})
                    QTest::addRow("%g Mbit/s, %d frames/s, %d to %d ms", megabits, frames, before, after)
                        << megabits << frames << before << after;
    }

    /// As when a line fails and a network takes another one: what is late by so much looks like a long queue. No frame takes half a second,
    /// and two seconds later all leave as fast as before.
    void usesAWayThatHasBecomeMuchLonger()
    {
        QFETCH(double, megabits);
        QFETCH(int, framesPerSecond);
        QFETCH(int, beforeMs);
        QFETCH(int, afterMs);
        Path path(megabits * 125'000, std::chrono::milliseconds(beforeMs));
        Frames frames(path, framesPerSecond);
        for (int i = 0; i < 8 * framesPerSecond; ++i)
            frames.send();
        path.reroute(std::chrono::milliseconds(afterMs));
        Nanoseconds slowest{};
        for (int i = 0; i < 2 * framesPerSecond; ++i)
            slowest = std::max(slowest, frames.send());
        QVERIFY2(slowest < 500ms, millisecondsOf(slowest, "ms").constData());
        path.forget();
        Nanoseconds slowestThen{};
        for (int i = 0; i < 3 * framesPerSecond; ++i)
            slowestThen = std::max(slowestThen, frames.send());
        QVERIFY2(slowestThen < 22ms, millisecondsOf(slowestThen, "ms, of at least 17").constData());
        QVERIFY2(path.longestWait < 5ms, millisecondsOf(path.longestWait, "ms").constData());
    }

    void littleIsLostUntilALongerWayIsKnown_data()
    {
        QTest::addColumn<int>("beforeUs");
        QTest::addColumn<double>("part");
        QTest::addColumn<double>("least");
        // 0.25, 0.45, 0.38 and 0.68 where the rate goes on falling while what waits may be the way's.
        QTest::newRow("200 us, without a pause") << 200 << 1.0 << 0.28;
        QTest::newRow("200 us, frames") << 200 << 0.9 << 0.48;
        QTest::newRow("2 ms, without a pause") << 2000 << 1.0 << 0.41;
        QTest::newRow("2 ms, frames") << 2000 << 0.9 << 0.72;
    }

    void littleIsLostUntilALongerWayIsKnown()
    {
        QFETCH(int, beforeUs);
        QFETCH(double, part);
        QFETCH(double, least);
        const auto cost = costOfALongerWay(std::chrono::microseconds(beforeUs), part);
        QVERIFY2(cost.sent > least, qPrintable(QString::number(cost.sent)));
    }

    void commandsWaitLittleUntilALongerWayIsKnown_data()
    {
        QTest::addColumn<int>("beforeMs");
        QTest::addColumn<int>("mostMs");
        // 314, 395 and 602 where a rate in doubt takes its next step before a round trip has passed.
        QTest::newRow("20 ms") << 20 << 270;
        QTest::newRow("40 ms") << 40 << 350;
        QTest::newRow("80 ms") << 80 << 550;
    }

    void commandsWaitLittleUntilALongerWayIsKnown()
    {
        QFETCH(int, beforeMs);
        QFETCH(int, mostMs);
        const auto cost = costOfALongerWay(std::chrono::milliseconds(beforeMs), 0.9);
        QVERIFY2(cost.late < std::chrono::milliseconds(mostMs), millisecondsOf(cost.late, "ms of 4 s late").constData());
    }
};

QTEST_APPLESS_MAIN(PathRateLongerWayTest)
#include "path_rate_longer_way_test.moc"
