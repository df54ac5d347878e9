// The rate of bulk in virtual time where a connection begins: the first one, and one more.
#include "tasks/path_rate.hpp"

#include "support/milliseconds_of.hpp"
#include "support/virtual_path.hpp"

#include <QTest>

#include <algorithm>

using namespace liena::tasks;
using namespace std::chrono_literals;
using liena::test::millisecondsOf;
using Nanoseconds = std::chrono::nanoseconds;
using Path = liena::test::VirtualPath;

namespace {

constexpr double gigabit = 125e6; // bytes per second

/// Three fifths of what the path carries.
void sendFrames(Path& path, int seconds)
{
    for (int i = 0; i < seconds * 30; ++i)
        path.frame(0.6 * path.capacity / 30, Nanoseconds(1s) / 30);
}

} // namespace

class PathRateConnectionsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void takesANewConnectionsFirstFactsAsABeginning()
    {
        Path path(gigabit, 200us);
        path.run(4s);
        const double before = path.rate.rate();
        path.rate.restart();
        path.rate.observe({200us, 200us, 20, 10, {}, 0}, PathRate::Instant{2h});
        QCOMPARE(path.rate.rate(), before);
    }

    /// The handshake's computing is in a new connection's round trip, and the first bytes leave one by one.
    void doesNotTakeAHandshakeForAQueue()
    {
        PathRate rate;
        rate.restart();
        auto now = PathRate::Instant{1h};
        for (std::uint64_t sent = 1000; sent < 60'000; sent += 3000, now += 5ms)
            rate.observe({44ms, 40ms, sent, sent / 2, {}, 0}, now);
        QCOMPARE(rate.rate(), PathRate::first);
        QVERIFY(!rate.known());
    }

    void knowsOfANewConnectionsPathWhatItKnewBefore_data()
    {
        QTest::addColumn<double>("megabits");
        QTest::addColumn<int>("roundTripMs");
        for (const double megabits : {20.0, 100.0, 1000.0})
            for (const int roundTrip : {1, 40})
                QTest::addRow("%g Mbit/s, %d ms", megabits, roundTrip) << megabits << roundTrip;
    }

    /// Its bytes are counted from the beginning, and what was sent before is not waited for: a fall is met as soon as by the old one.
    void knowsOfANewConnectionsPathWhatItKnewBefore()
    {
        QFETCH(double, megabits);
        QFETCH(int, roundTripMs);
        Path path(megabits * 125'000, std::chrono::milliseconds(roundTripMs));
        path.run(8s);
        path.reconnect(std::chrono::milliseconds(roundTripMs));
        path.forget();
        path.run(2s);
        QVERIFY2(path.sent() > 0.85 * path.capacity * 2, qPrintable(QString::number(path.sent() / path.capacity / 2)));
        QVERIFY2(path.longestWait < 4ms, millisecondsOf(path.longestWait, "ms").constData());
        path.capacity /= 4;
        path.run(1s);
        path.forget();
        path.run(2s);
        QVERIFY2(path.longestWait < 12ms, millisecondsOf(path.longestWait, "ms after a fall").constData());
    }

    void whatAWayVariedByIsNotBorneOnTheNext_data()
    {
        QTest::addColumn<double>("megabits");
        QTest::addColumn<int>("roundTripUs");
        QTest::addColumn<bool>("reconnects");
        for (const double megabits : {100.0, 400.0, 1000.0}) {
            QTest::addRow("%g Mbit/s, 200 us", megabits) << megabits << 200 << false;
            QTest::addRow("%g Mbit/s, 200 us, a new connection", megabits) << megabits << 200 << true;
            QTest::addRow("%g Mbit/s, 40 ms, a new connection", megabits) << megabits << 40'000 << true;
        }
    }

    /// Long ways whose round trips vary by milliseconds, and then one on which so long a wait is a queue.
    void whatAWayVariedByIsNotBorneOnTheNext()
    {
        QFETCH(double, megabits);
        QFETCH(int, roundTripUs);
        QFETCH(bool, reconnects);
        Nanoseconds longest{};
        for (const auto before : {20ms, 40ms, 80ms})
            for (const auto unrest : {2ms, 4ms, 6ms}) {
                Path path(megabits * 125'000, before);
                path.mostUnrest = unrest;
                path.lateTogether = 20;
                sendFrames(path, 10);
                path.mostUnrest = {};
                if (reconnects)
                    path.reconnect(std::chrono::microseconds(roundTripUs));
                else
                    path.reroute(std::chrono::microseconds(roundTripUs));
                sendFrames(path, 1);
                path.forget();
                sendFrames(path, 4);
                longest = std::max(longest, path.longestWait);
            }
        QVERIFY2(longest < 1500us + std::chrono::microseconds(roundTripUs / 16), millisecondsOf(longest, "ms").constData());
    }
};

QTEST_GUILESS_MAIN(PathRateConnectionsTest)
#include "path_rate_connections_test.moc"
