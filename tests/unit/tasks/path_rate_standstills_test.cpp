// The rate of bulk on a short way in virtual time: what stands still for a moment, and a path that falls.
#include "tasks/path_rate.hpp"

#include "support/standstills.hpp"
#include "support/virtual_path.hpp"

#include <QTest>

#include <cstdint>
#include <initializer_list>
#include <utility>

using namespace std::chrono_literals;
using Nanoseconds = std::chrono::nanoseconds;
using Path = liena::test::VirtualPath;

namespace {

enum class Who : std::uint8_t { Sender, Network, Receiver };

void standStill(Path& path, Who who, Nanoseconds time)
{
    switch (who) {
    case Who::Sender:
        return path.standStill(time);
    case Who::Receiver:
        return path.deafen(time);
    case Who::Network:
        path.stalled = true;
        path.run(time);
        path.stalled = false;
    }
}

/// Something stands still so often a second, for 0.5 ms to `longest`, while bulk is sent without a pause.
class Restless {
public:
    Restless(Path& path, Who who, unsigned seed, double perSecond = 6, std::chrono::milliseconds longest = 4ms)
        : m_path(path), m_who(who), m_standstills(perSecond, longest, seed)
    {}

    void run(Nanoseconds time)
    {
        while (time > m_untilNext) {
            time -= m_untilNext;
            m_path.run(m_untilNext);
            standStill(m_path, m_who, m_standstills.length());
            m_untilNext = m_standstills.untilNext();
        }
        m_untilNext -= time;
        m_path.run(time);
    }

private:
    Path& m_path;
    Who m_who;
    liena::test::Standstills m_standstills;
    Nanoseconds m_untilNext = m_standstills.untilNext();
};

} // namespace

class PathRateStandstillsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void standstillsCostAShortWayLittle_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("roundTripUs");
        QTest::addColumn<Who>("who");
        QTest::addColumn<double>("least");
        const std::initializer_list<std::pair<const char*, Who>> all{
            {"the sender", Who::Sender}, {"the network", Who::Network}, {"the receiver", Who::Receiver}};
        for (const double megabits : {20.0, 100.0, 200.0, 400.0, 1000.0})
            for (const int roundTrip : {200, 2000})
                for (const auto& [name, who] : all)
                    QTest::addRow("%.0f Mbit/s, %d us, %s", megabits, roundTrip, name)
                        << megabits * 125'000 << roundTrip << who << (megabits < 50 && who == Who::Network ? 0.68 : 0.86);
    }

    /// Themselves they take 1 % of the time. On a slow path a piece is late by as much as a standstill is long.
    void standstillsCostAShortWayLittle()
    {
        QFETCH(double, capacity);
        QFETCH(int, roundTripUs);
        QFETCH(Who, who);
        QFETCH(double, least);
        double sent = 0;
        for (const unsigned seed : {1, 2, 3}) {
            Path path(capacity, std::chrono::microseconds(roundTripUs));
            Restless restless(path, who, seed);
            restless.run(3s);
            path.forget();
            restless.run(10s);
            sent += path.sent();
        }
        const double carried = sent / capacity / 30;
        QVERIFY2(carried > least, qPrintable(QString::number(carried)));
    }

    void manyStandstillsLeaveMostOfAPath_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("roundTripUs");
        QTest::addColumn<double>("least");
        // 0.77, 0.68, 0.79 and 0.75 where what falls again soon after a standstill is believed at once.
        QTest::newRow("100 Mbit/s, 200 us") << 12.5e6 << 200 << 0.81;
        QTest::newRow("100 Mbit/s, 2000 us") << 12.5e6 << 2000 << 0.76;
        QTest::newRow("400 Mbit/s, 200 us") << 50e6 << 200 << 0.82;
        QTest::newRow("400 Mbit/s, 2000 us") << 50e6 << 2000 << 0.80;
    }

    /// Twenty times a second the network stands still, which takes 6 % of the time.
    void manyStandstillsLeaveMostOfAPath()
    {
        QFETCH(double, capacity);
        QFETCH(int, roundTripUs);
        QFETCH(double, least);
        double sent = 0;
        for (const unsigned seed : {1, 2, 3}) {
            Path path(capacity, std::chrono::microseconds(roundTripUs));
            Restless restless(path, Who::Network, seed, 20, 10ms);
            restless.run(3s);
            path.forget();
            restless.run(20s);
            sent += path.sent();
        }
        const double carried = sent / capacity / 60;
        QVERIFY2(carried > least, qPrintable(QString::number(carried)));
    }

    void aFallIsNoStandstill_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("roundTripUs");
        QTest::addColumn<double>("left");
        for (const double megabits : {100.0, 400.0, 1000.0})
            for (const int roundTrip : {200, 2000})
                for (const double left : {0.1, 0.5, 0.8})
                    QTest::addRow("%.0f Mbit/s, %d us, to %.1f", megabits, roundTrip, left) << megabits * 125'000 << roundTrip << left;
    }

    /// What a path carries less all at once is seen within some hundredths of a second, although it may have been a standstill.
    void aFallIsNoStandstill()
    {
        QFETCH(double, capacity);
        QFETCH(int, roundTripUs);
        QFETCH(double, left);
        Path path(capacity, std::chrono::microseconds(roundTripUs));
        path.run(4s);
        path.forget();
        path.capacity = capacity * left;
        path.tooLong = 2ms + path.carrying(static_cast<double>(path.rate.segment()));
        path.run(1s);
        QVERIFY2(path.late < 60ms + path.carrying(24 * 2896),
                 qPrintable(QString::number(static_cast<double>(path.late.count()) / 1e6) + " ms late"));
    }

    void aStandstillBeforeAFallIsNotLookedForAfterIt_data()
    {
        QTest::addColumn<double>("narrow");
        QTest::addColumn<int>("roundTripUs");
        QTest::addColumn<int>("mostMs");
        // 230, 236 and 147 where one is looked for.
        QTest::newRow("to 5 Mbit/s, 200 us") << 0.625e6 << 200 << 150;
        QTest::newRow("to 5 Mbit/s, 2000 us") << 0.625e6 << 2000 << 170;
        QTest::newRow("to 20 Mbit/s, 100 us") << 2.5e6 << 100 << 100;
    }

    /// The network stands still, and soon afterwards falls to a tenth, behind a token bucket, so that at first it seems to carry somewhat
    /// more than it does. The queue of that rate is no standstill's.
    void aStandstillBeforeAFallIsNotLookedForAfterIt()
    {
        QFETCH(double, narrow);
        QFETCH(int, roundTripUs);
        QFETCH(int, mostMs);
        Nanoseconds late{};
        for (const auto before : {100ms, 300ms, 600ms})
            for (const auto standstill : {4ms, 8ms}) {
                Path path(narrow * 10, std::chrono::microseconds(roundTripUs));
                path.bucket = 16'000;
                path.run(4s);
                standStill(path, Who::Network, standstill);
                path.run(before);
                path.capacity = narrow;
                path.forget();
                path.tooLong = path.carrying(static_cast<double>(path.rate.segment())) + 1500us;
                path.run(2s);
                late += path.late / 6;
            }
        QVERIFY2(late < std::chrono::milliseconds(mostMs), qPrintable(QString("%1 ms of 2 s late").arg(late / 1ms)));
    }

    void aSlowPathIsNotFilledAnewAfterAStandstill_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<double>("bucket");
        QTest::addColumn<int>("roundTripUs");
        QTest::newRow("8 Mbit/s, 1000 us, token bucket") << 1e6 << 4e3 << 1000;
        QTest::newRow("10 Mbit/s, 1000 us") << 1.25e6 << 0.0 << 1000;
        QTest::newRow("10 Mbit/s, 2000 us") << 1.25e6 << 0.0 << 2000;
        QTest::newRow("13 Mbit/s, 2000 us") << 1.625e6 << 0.0 << 2000;
    }

    /// One of 20 to 80 ms, so that it seems to carry next to nothing. What it carried before is remembered when that turns out to be wrong:
    /// a step too far would show only when others had followed it.
    void aSlowPathIsNotFilledAnewAfterAStandstill()
    {
        QFETCH(double, capacity);
        QFETCH(double, bucket);
        QFETCH(int, roundTripUs);
        for (const auto who : {Who::Sender, Who::Network, Who::Receiver})
            for (const auto standstill : {20ms, 40ms, 80ms}) {
                Path path(capacity, std::chrono::microseconds(roundTripUs));
                path.bucket = bucket;
                path.run(8s);
                standStill(path, who, standstill);
                path.run(standstill + 100ms);
                path.forget();
                path.tooLong = path.carrying(2 * static_cast<double>(path.rate.segment())) + 1500us;
                path.run(3s);
                QVERIFY2(path.late == 0ms, qPrintable(QString("%1 ms: %2 ms late, at most by %3 ms")
                                                          .arg(standstill / 1ms)
                                                          .arg(path.late / 1ms)
                                                          .arg(path.longestWait / 1ms)));
            }
    }

    void aFallIsSeenBetweenPauses_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("roundTripUs");
        QTest::addColumn<double>("left");
        for (const double megabits : {40.0, 100.0, 400.0, 1000.0})
            for (const int roundTrip : {200, 2000, 5000, 9000})
                for (const double left : {0.5, 0.6, 0.7})
                    QTest::addRow("%.0f Mbit/s, %d us, to %.1f", megabits, roundTrip, left) << megabits * 125'000 << roundTrip << left;
    }

    /// Its queue drains so fast that it may have been left by a standstill, but another one stands soon after: in the same frame, or in the
    /// next. Frames of less than the path carries, and of more.
    void aFallIsSeenBetweenPauses()
    {
        QFETCH(double, capacity);
        QFETCH(int, roundTripUs);
        QFETCH(double, left);
        for (const double part : {0.7, 0.9, 1.2})
            for (const int perSecond : {15, 30}) {
                Path path(capacity, std::chrono::microseconds(roundTripUs));
                const auto sendFor = [&](int seconds) {
                    for (int i = 0; i < seconds * perSecond; ++i)
                        path.frame(part * left * capacity / perSecond, Nanoseconds(1s) / perSecond);
                };
                sendFor(4);
                path.capacity = capacity * left;
                path.forget();
                path.tooLong = path.carrying(static_cast<double>(path.rate.segment())) + 1500us;
                sendFor(4);
                QVERIFY2(path.late < 500ms, qPrintable(QString("%1 frames/s of %2: %3 ms of 4 s late, at most by %4 ms")
                                                           .arg(perSecond)
                                                           .arg(part)
                                                           .arg(path.late / 1ms)
                                                           .arg(path.longestWait / 1ms)));
            }
    }

    void whatDrainsInEachPauseIsNoStandstill_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("roundTripUs");
        for (const double megabits : {4.0, 10.0, 20.0, 40.0, 100.0})
            for (const int roundTrip : {200, 2000, 9000})
                QTest::addRow("%.0f Mbit/s, %d us", megabits, roundTrip) << megabits * 125'000 << roundTrip;
    }

    /// A path falls to a tenth and becomes half as wide again, so that higher rates are tried, and frames take nine tenths of it. At a rate
    /// that is too high each of them leaves a queue at its end, which is gone when the next one begins.
    void whatDrainsInEachPauseIsNoStandstill()
    {
        QFETCH(double, capacity);
        QFETCH(int, roundTripUs);
        Path path(capacity * 10, std::chrono::microseconds(roundTripUs));
        const auto send = [&path](int seconds, double part) {
            for (int i = 0; i < seconds * 15; ++i)
                path.frame(part * path.capacity / 15, 66'667us);
        };
        send(4, 0.6);
        path.capacity = capacity;
        send(4, 0.6);
        path.capacity = capacity * 1.5;
        path.forget();
        path.tooLong = path.carrying(static_cast<double>(path.rate.segment())) + 500us;
        send(8, 0.9);
        QVERIFY2(path.late < 1'100ms && path.longestWait < 25ms,
                 qPrintable(QString("%1 ms of 8 s late, at most by %2 ms").arg(path.late / 1ms).arg(path.longestWait / 1ms)));
    }
};

QTEST_APPLESS_MAIN(PathRateStandstillsTest)
#include "path_rate_standstills_test.moc"
