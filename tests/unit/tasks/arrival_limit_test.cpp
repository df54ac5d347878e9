// The rate of bulk by the peer's reports, on ways in virtual time whose queue our kernel cannot see.
#include "tasks/arrival_limit.hpp"

#include "tasks/path_rate.hpp"

#include <QTest>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <limits>

using namespace liena::tasks;
using namespace std::chrono_literals;
using Nanoseconds = std::chrono::nanoseconds;

namespace {

constexpr double megabyte = 1e6; // per second where it is a rate

/// Messages that enter a relay with room for everything, which hands them on at its own rate; whole ones are counted at both ends.
class Way {
public:
    explicit Way(double bytesPerSecond) : capacity(bytesPerSecond) {}

    void run(Nanoseconds time)
    {
        for (const auto end = m_now + time; m_now < end; m_now += step) {
            send(std::min(wanted, limit.bytesPerSecond().value_or(wanted)) * seconds(step));
            carry();
            if (m_now - m_reported >= 200ms)
                report();
        }
    }

    /// Time that what enters now will wait.
    double wait() const { return (m_entered - m_carried) / capacity; }
    double arrived() const { return m_arrived; }
    void forget() { m_arrived = longestWait = 0; }
    double rate() const { return std::min(wanted, limit.bytesPerSecond().value_or(wanted)); }

    ArrivalLimit limit;
    double capacity;
    double wanted = 0;       ///< bytes per second that the source would send
    double message = 200e3;  ///< bytes
    Nanoseconds delay = 1ms; ///< of the way besides
    bool ours = false;       ///< the queue stands in our own kernel
    Nanoseconds every{};     ///< whole messages at once, that often; zero: an even flow of `wanted`
    double longestWait = 0;  ///< seconds

private:
    static constexpr Nanoseconds step = 1ms;
    static double seconds(Nanoseconds time) { return std::chrono::duration<double>(time).count(); }

    void send(double bytes)
    {
        if (every > Nanoseconds::zero()) {
            bytes = m_now - m_burst >= every ? message : 0;
            m_burst = bytes > 0 ? m_now : m_burst;
        }
        m_entered += bytes;
        longestWait = std::max(longestWait, wait());
    }

    void carry()
    {
        m_carried = std::min(m_entered, m_carried + capacity * seconds(step));
        m_onItsWay.push_back({m_now + delay, m_carried});
        for (; !m_onItsWay.empty() && m_onItsWay.front().at <= m_now; m_onItsWay.pop_front()) {
            m_arrived += m_onItsWay.front().total - m_there;
            m_there = m_onItsWay.front().total;
        }
    }

    std::uint64_t whole(double bytes) const { return static_cast<std::uint64_t>(bytes / message) * static_cast<std::uint64_t>(message); }

    std::uint64_t held() const { return ours ? static_cast<std::uint64_t>(m_entered - m_there) : 0; }

    void report()
    {
        const auto received = whole(m_there);
        limit.reported({m_now - m_reported, received - m_told, whole(m_entered), 0, held(), static_cast<std::size_t>(message), delay});
        m_told = received;
        m_reported = m_now;
    }

    struct Total {
        Nanoseconds at{};
        double total = 0;
    };

    Nanoseconds m_now{};
    Nanoseconds m_reported{};
    Nanoseconds m_burst = -1h;
    double m_entered = 0;
    double m_carried = 0;
    double m_there = 0;
    double m_arrived = 0;
    std::uint64_t m_told = 0;
    std::deque<Total> m_onItsWay;
};

} // namespace

class ArrivalLimitTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aRelayThatCannotFollowIsNotFilled_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("delayMs");
        for (const double capacity : {0.5, 2.0, 12.5, 50.0})
            for (const int delay : {0, 20, 150})
                QTest::addRow("%.1f MB/s, %d ms", capacity, delay) << capacity * megabyte << delay;
    }

    void aRelayThatCannotFollowIsNotFilled()
    {
        QFETCH(double, capacity);
        QFETCH(int, delayMs);
        Way way(capacity);
        way.delay = std::chrono::milliseconds(delayMs);
        way.message = std::min(200e3, capacity / 10);
        way.wanted = capacity * 2;
        way.run(10s);
        way.forget();
        way.run(50s);
        const double bound =
            0.9 + 2.5e-3 * delayMs; // a message at either end, and what may still be on its way, which is known to a report's window
        QVERIFY2(way.longestWait < bound, qPrintable(QString::number(way.longestWait)));
        QVERIFY2(way.arrived() > 0.8 * capacity * 50, qPrintable(QString::number(way.arrived() / capacity / 50)));
    }

    /// Without the reports the relay would hold half a minute of pictures by then.
    void itYieldsSoon()
    {
        Way way(2 * megabyte);
        way.wanted = 4 * megabyte;
        way.run(30s);
        QVERIFY2(way.longestWait < 1.5, qPrintable(QString::number(way.longestWait)));
        QVERIFY(way.wait() < 0.5);
    }

    void aWayThatHealsIsUsedWithinTenSeconds()
    {
        Way way(1 * megabyte);
        way.wanted = 10 * megabyte;
        way.message = 100e3;
        way.run(20s);
        QVERIFY(way.rate() < 2 * megabyte);
        way.capacity = 20 * megabyte;
        way.run(10s);
        QCOMPARE(way.rate(), 10 * megabyte);
    }

    /// Frames of two megabytes fifteen times a second, on a way that carries them.
    void framesThatAreCarriedKnowNoLimit_data()
    {
        QTest::addColumn<int>("delayMs");
        for (const int delay : {0, 20, 300})
            QTest::addRow("%d ms", delay) << delay;
    }

    void framesThatAreCarriedKnowNoLimit()
    {
        QFETCH(int, delayMs);
        Way way(125 * megabyte);
        way.delay = std::chrono::milliseconds(delayMs);
        way.message = 2 * megabyte;
        way.run(5s); // before the first
        way.every = 66ms;
        for (int i = 0; i < 600; ++i) {
            way.run(100ms);
            QVERIFY(!way.limit.bytesPerSecond());
        }
    }

    void aMomentWithoutArrivalsIsNoQueue()
    {
        Way way(125 * megabyte);
        way.wanted = 30 * megabyte;
        way.run(5s);
        way.capacity = 1;
        way.run(250ms);
        way.capacity = 125 * megabyte;
        way.run(1s);
        QVERIFY(!way.limit.bytesPerSecond());
    }

    /// A link that falls to a tenth and heals: what stands before it stands in our own kernel, which `PathRate` watches.
    void whatOurKernelHoldsIsNoQueueOfTheWay()
    {
        Way way(12.5 * megabyte);
        way.ours = true;
        way.wanted = 6 * megabyte;
        way.run(5s);
        way.capacity = 1.25 * megabyte;
        way.run(5s);
        QVERIFY(way.wait() > 1);
        QVERIFY(!way.limit.bytesPerSecond());
        way.capacity = 12.5 * megabyte;
        way.run(5s);
        QVERIFY(!way.limit.bytesPerSecond());
    }

    /// Packets that are lost wait nowhere, however many they become.
    void lossIsNoQueue()
    {
        ArrivalLimit limit;
        for (std::uint64_t i = 1; i < 3000; ++i) {
            limit.reported({200ms, 209'500, i * 210'000, 0, 0, 20'000, 1ms});
            QVERIFY(!limit.bytesPerSecond());
        }
    }

    /// Commands by UDP, before the first picture: nothing larger has left, and what is lost is more than a tenth of a second of them.
    void lostPacketsAreNoQueue_data()
    {
        QTest::addColumn<double>("lost");
        QTest::addColumn<int>("roundTripMs");
        for (const double lost : {0.002, 0.02, 0.2})
            for (const int roundTrip : {1, 40})
                QTest::addRow("%.1f %%, %d ms", lost * 100, roundTrip) << lost << roundTrip;
    }

    void lostPacketsAreNoQueue()
    {
        QFETCH(double, lost);
        QFETCH(int, roundTripMs);
        ArrivalLimit limit;
        for (std::uint64_t i = 1; i < 1000; ++i) {
            const auto sent = i * 4100;
            const auto received = static_cast<std::uint64_t>(4100 * (1 - lost));
            limit.reported({200ms, received, sent, sent, 0, 0, std::chrono::milliseconds(roundTripMs)});
            QVERIFY2(!limit.bytesPerSecond(), QByteArray::number(static_cast<qulonglong>(i)));
        }
    }

    /// Pictures that queue are seen beside them, and what was sent by UDP before the reports began excuses nothing.
    void packetsHideNoQueue()
    {
        ArrivalLimit limit;
        std::uint64_t sent = 500'000'000;
        const std::uint64_t packets = 400'000'000;
        for (int i = 0; i < 10; ++i) {
            sent += 800'000;
            limit.reported({200ms, 400'000, sent, packets + static_cast<std::uint64_t>(i) * 4100, 0, 100'000, 1ms});
        }
        QVERIFY(limit.bytesPerSecond().has_value());
    }

    /// A lane ended with bytes on it: they are nowhere any more.
    void afterARestartOnlyWhatLeftSinceCounts()
    {
        ArrivalLimit limit;
        limit.reported({200ms, 1'000'000, 1'000'000, 0, 0, 1000, 1ms});
        limit.restart();
        for (std::uint64_t i = 1; i < 20; ++i)
            limit.reported({200ms, 1'000'000, 50'000'000 + i * 1'000'000, 0, 0, 1000, 1ms});
        QVERIFY(!limit.bytesPerSecond());
        QCOMPARE(limit.waiting(), std::uint64_t{0});
    }

    /// Six pictures in each window, all of which arrive: what one report would have counted is no queue.
    void aReportThatIsMissingIsNoQueue()
    {
        constexpr std::uint64_t picture = 262'144;
        ArrivalLimit limit;
        for (std::uint64_t i = 1; i < 300; ++i) {
            if (i % 50 == 30)
                limit.forgetWaiting();
            else
                limit.reported({200ms, 6 * picture, i * 6 * picture, 0, 0, picture, 1ms});
            QVERIFY(!limit.bytesPerSecond());
        }
        QCOMPARE(limit.waiting(), std::uint64_t{0});
    }

    void aQueueIsMetThoughAReportIsMissing()
    {
        Way way(2 * megabyte);
        way.wanted = 4 * megabyte;
        way.run(500ms);
        QVERIFY(!way.limit.bytesPerSecond());
        way.limit.forgetWaiting();
        way.run(3s);
        QVERIFY(way.limit.bytesPerSecond().has_value());
        QVERIFY2(way.longestWait < 2, qPrintable(QString::number(way.longestWait)));
    }

    /// A session that is interrupted again and again: the relay is not flooded anew each time. What waits there at that moment is not seen
    /// any more, so that the wait grows with each; without the known rate it grows to 2.7 s.
    void whatTheWayCarriesIsKnownAfterAMissingReport()
    {
        Way way(2 * megabyte);
        way.wanted = 4 * megabyte;
        way.run(10s);
        const auto known = way.limit.bytesPerSecond();
        QVERIFY(known.has_value());
        way.limit.forgetWaiting();
        QVERIFY(way.limit.bytesPerSecond() == known);
        way.forget();
        for (int i = 0; i < 6; ++i) {
            way.run(10s);
            way.limit.forgetWaiting();
        }
        QVERIFY2(way.longestWait < 2.3, qPrintable(QString::number(way.longestWait)));
    }

    void reportsWithoutSenseDoNoHarm()
    {
        constexpr auto most = std::numeric_limits<std::uint64_t>::max();
        ArrivalLimit limit;
        std::uint64_t sent = 0;
        for (int i = 0; i < 5000; ++i) {
            sent += 100'000;
            const std::uint64_t received[] = {0, most, 1, most / 2, 0};
            limit.reported({i % 7 == 0 ? Nanoseconds::zero() : std::chrono::microseconds(i % 3 + 1), received[i % 5], sent,
                            sent / 3 * static_cast<std::uint64_t>(i % 4), static_cast<std::uint64_t>(i % 3) * most / 2, 1000, 1ms});
            if (const auto rate = limit.bytesPerSecond()) {
                QVERIFY(*rate >= PathRate::least);
                QVERIFY(*rate <= PathRate::most);
            }
        }
    }

    /// A peer that never says that it received anything gets pictures slowly, and still gets them.
    void aPeerThatReceivesNothingIsSentLittle()
    {
        ArrivalLimit limit;
        double sent = 0;
        for (int i = 0; i < 1000; ++i) {
            sent += 0.2 * std::min(30 * megabyte, limit.bytesPerSecond().value_or(30 * megabyte));
            limit.reported({200ms, 0, static_cast<std::uint64_t>(sent), 0, 0, 200'000, 1ms});
        }
        QVERIFY(limit.bytesPerSecond().has_value());
        QCOMPARE(*limit.bytesPerSecond(), PathRate::least);
    }
};

QTEST_GUILESS_MAIN(ArrivalLimitTest)
#include "arrival_limit_test.moc"
