// Bulk lanes beside each other in virtual time: before one bottleneck, or each before its own.
#include "tasks/fair_share.hpp"

#include "tasks/interface_shares.hpp"

#include "support/standstills.hpp"
#include "support/virtual_lanes.hpp"

#include <QTest>

#include <map>
#include <memory>
#include <numeric>
#include <vector>

using namespace liena::tasks;
using namespace std::chrono_literals;
using Nanoseconds = std::chrono::nanoseconds;
using Lanes = liena::test::VirtualLanes;
using Stream = liena::test::VirtualLane::Stream;

namespace {

constexpr double gigabit = 125e6; // bytes per second
constexpr auto between = 3s;

/// Each always has more to send, and begins so much later than the one before.
std::vector<Stream> endless(const std::vector<unsigned>& sessions, std::chrono::milliseconds apart = 0ms)
{
    std::vector<Stream> streams;
    for (const auto session : sessions)
        streams.push_back({1e12, 1h, apart * static_cast<int>(streams.size()), session});
    return streams;
}

/// One to `count`, a lane each.
std::vector<unsigned> sessions(int count)
{
    std::vector<unsigned> all(static_cast<std::size_t>(count));
    std::iota(all.begin(), all.end(), 1U);
    return all;
}

double delivered(Lanes& path)
{
    double sum = 0;
    for (std::size_t i = 0; i < path.count(); ++i)
        sum += path.lane(i).delivered;
    return sum;
}

/// Of all that was delivered.
std::vector<double> parts(Lanes& path)
{
    std::vector<double> result;
    for (std::size_t i = 0; i < path.count(); ++i)
        result.push_back(path.lane(i).delivered / delivered(path));
    return result;
}

/// Jain's index: 1 when all are equal, 1/n when one has everything (Jain, Chiu and Hawe, DEC-TR-301, 1984).
double fairness(const std::vector<double>& parts)
{
    double sum = 0;
    double squares = 0;
    for (const auto part : parts) {
        sum += part;
        squares += part * part;
    }
    return sum * sum / (static_cast<double>(parts.size()) * squares);
}

/// In step, since they share an interface.
void runTogether(Lanes& one, Lanes& other, Nanoseconds time)
{
    for (; time > 0s; time -= Lanes::step) {
        one.run(Lanes::step);
        other.run(Lanes::step);
    }
}

QByteArray milliseconds(Nanoseconds time) { return QByteArray::number(static_cast<double>(time.count()) / 1e6) + " ms"; }

QByteArray number(double value) { return QByteArray::number(value); }

} // namespace

class FairShareTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void lanesBeforeOneQueueComeToEvenRates_data()
    {
        QTest::addColumn<int>("lanes");
        QTest::addColumn<int>("microseconds");
        QTest::newRow("two in a room") << 2 << 200;
        QTest::newRow("eight in a house") << 8 << 1000;
        QTest::newRow("four in a city") << 4 << 5000;
        QTest::newRow("three in a country") << 3 << 20'000;
        QTest::newRow("two across one") << 2 << 40'000;
    }

    /// One after the other begins, each finding what the earlier ones left.
    void lanesBeforeOneQueueComeToEvenRates()
    {
        QFETCH(const int, lanes);
        QFETCH(const int, microseconds);
        Lanes path(gigabit, std::chrono::microseconds(microseconds), endless(sessions(lanes), between));
        path.run(between * lanes);
        path.forget();
        path.run(10s);
        const double index = fairness(parts(path));
        QVERIFY2(index > 0.85, number(index).constData());
        QVERIFY2(path.waitedFor(1) < 8ms, milliseconds(path.waitedFor(1)).constData());
    }

    void sessionsBeforeOneQueueComeToEvenRatesWhateverTheirLanes_data()
    {
        QTest::addColumn<std::vector<unsigned>>("sessions"); // of the lanes, in the order in which they begin
        QTest::newRow("one lane after three") << std::vector{1U, 1U, 1U, 2U};
        QTest::newRow("one lane before three") << std::vector{2U, 1U, 1U, 1U};
        QTest::newRow("two of one beside one each of two") << std::vector{1U, 2U, 3U, 1U};
    }

    void sessionsBeforeOneQueueComeToEvenRatesWhateverTheirLanes()
    {
        QFETCH(const std::vector<unsigned>, sessions);
        double sum = 0;
        for (const auto time : {2500ms, 2800ms, 3000ms, 3300ms}) {
            Lanes path(gigabit, 1ms, endless(sessions, time));
            path.run(time * static_cast<int>(sessions.size()));
            path.forget();
            path.run(10s);
            std::map<unsigned, double> ofSession;
            for (std::size_t i = 0; i < sessions.size(); ++i)
                ofSession[sessions[i]] += path.lane(i).delivered;
            std::vector<double> shares;
            for (const auto& [session, part] : ofSession)
                shares.push_back(part);
            const double index = fairness(shares); // lanes at even rates: 0.8 and 0.89
            QVERIFY2(index > 0.9, number(index).constData());
            sum += index;
            QVERIFY2(path.waitedFor(1) < 8ms, milliseconds(path.waitedFor(1)).constData());
        }
        QVERIFY2(sum / 4 > 0.93, number(sum / 4).constData()); // where in its breathing a lane meets the next one is chance
    }

    /// The same lanes without a share: what the last one finds is what it keeps.
    void lanesThatDoNotKnowOfEachOtherKeepWhatTheyFound()
    {
        Lanes path(gigabit, 9ms, endless(sessions(3), between), nullptr);
        path.run(between * 3);
        path.forget();
        path.run(10s);
        const double index = fairness(parts(path));
        QVERIFY2(index < 0.85, number(index).constData());
    }

    void standstillsCostSessionsBeforeOneQueueLittle_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("count");
        for (const double megabits : {100.0, 400.0, 1000.0})
            for (const int count : {2, 3})
                QTest::addRow("%.0f Mbit/s, %d", megabits, count) << megabits * 125'000 << count;
    }

    /// Six times a second, for 0.5 to 4 ms, the network stands still before all of them.
    void standstillsCostSessionsBeforeOneQueueLittle()
    {
        QFETCH(const double, capacity);
        QFETCH(const int, count);
        constexpr auto counted = 20s;
        Lanes path(capacity, 200us, endless(sessions(count)));
        liena::test::Standstills standstills(6, 4ms, 1);
        const auto run = [&](Nanoseconds time) {
            while (time > 0s) {
                const auto calm = std::min(standstills.untilNext(), time);
                path.run(calm);
                const auto still = standstills.length();
                path.stalled = true;
                path.run(still);
                path.stalled = false;
                time -= calm + still;
            }
        };
        run(3s);
        path.forget();
        run(counted);
        const double carried = delivered(path) / capacity / std::chrono::duration<double>(counted).count();
        QVERIFY2(carried > 0.87, number(carried).constData());
        const double index = fairness(parts(path));
        QVERIFY2(index > 0.85, number(index).constData());
    }

    void laneWithANarrowPathDoesNotHoldUpAWideOne()
    {
        const auto share = std::make_shared<FairShare>();
        Lanes wide(gigabit, 200us, endless({1}), share);
        Lanes narrow(gigabit / 100, 5ms, endless({2}), share);
        runTogether(wide, narrow, 2s);
        wide.forget();
        narrow.forget();
        runTogether(wide, narrow, 10s);
        QVERIFY2(delivered(wide) > 0.8 * gigabit * 10, number(delivered(wide) / gigabit / 10).constData());
        QVERIFY(delivered(narrow) > 0.8 * gigabit / 100 * 10);
    }

    /// A fast session waits in a queue of its own, far away; the others come to even rates before theirs all the same.
    void sessionWithAnotherBottleneckKeepsNobodyFromEvenRates()
    {
        const auto share = std::make_shared<FairShare>();
        Lanes far(4 * gigabit, 60ms, endless({9, 9, 9, 9}), share);
        Lanes near(gigabit, 9ms, endless(sessions(3), between), share);
        runTogether(far, near, between * 3);
        near.forget();
        runTogether(far, near, 10s);
        const double index = fairness(parts(near));
        QVERIFY2(index > 0.93, number(index).constData());
    }

    void laneThatPausedOrEndedTakesNoShare()
    {
        Lanes path(gigabit, 200us, endless(sessions(3), between));
        path.run(between * 3);
        path.stop(0);
        path.close(1); // it leaves the share
        path.run(3s);
        QVERIFY2(path.lane(1).rate.rate() > 0.8 * gigabit, number(path.lane(1).rate.rate() / gigabit).constData());
    }

    void interfacesHaveSharesOfTheirOwn()
    {
        InterfaceShares shares;
        const auto one = boost::asio::ip::make_address("192.0.2.1");
        QCOMPARE(shares.of(one), shares.of(one));
        QVERIFY(shares.of(one) != shares.of(boost::asio::ip::make_address("192.0.2.2")));
    }
};

QTEST_GUILESS_MAIN(FairShareTest)
#include "fair_share_test.moc"
