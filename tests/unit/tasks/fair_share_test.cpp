// Bulk lanes beside each other in virtual time: before one bottleneck, or each before its own.
#include "tasks/fair_share.hpp"

#include "tasks/interface_shares.hpp"
#include "tasks/path_rate.hpp"

#include "support/standstills.hpp"

#include <QTest>

#include <algorithm>
#include <deque>
#include <map>
#include <memory>
#include <utility>
#include <vector>

using namespace liena::tasks;
using namespace std::chrono_literals;
using Nanoseconds = std::chrono::nanoseconds;

namespace {

constexpr double gigabit = 125e6; // bytes per second
constexpr Nanoseconds step = 250us;

/// What one lane has before the bottleneck, and the kernel's smoothed view of its round trip.
struct Flow {
    PathRate rate;
    bool sending = false;
    double queue = 0;
    double entered = 0;
    double delivered = 0;
    double offered = 0;
    Nanoseconds smoothed{};
    struct News {
        PathRate::Instant known;
        Nanoseconds waiting{};
        double bytes = 0;
    };
    std::deque<News> onItsWay{};
};

/// A first-in-first-out queue that several flows share, each of another session.
class Bottleneck {
public:
    Bottleneck(double bytesPerSecond, Nanoseconds idleRoundTrip, std::size_t count, const std::shared_ptr<FairShare>& share,
               std::uint32_t firstSession = 1)
        : m_capacity(bytesPerSecond), m_idle(idleRoundTrip)
    {
        for (std::size_t i = 0; i < count; ++i) {
            flows.push_back(std::make_unique<Flow>());
            flows.back()->smoothed = idleRoundTrip;
            flows.back()->rate.shareWith(share, liena::DeviceId(firstSession + static_cast<std::uint32_t>(i)));
        }
    }

    void tick(PathRate::Instant now)
    {
        const double seconds = std::chrono::duration<double>(step).count();
        double waiting = 0;
        for (auto& flow : flows) {
            const double offered = flow->sending ? flow->rate.rate() * seconds : 0;
            const double room = std::max(512e3, m_capacity * 0.005) / static_cast<double>(flows.size());
            const double taken = std::clamp(room - flow->queue, 0.0, offered);
            flow->queue += taken;
            flow->entered += taken;
            waiting += flow->queue;
        }
        const double carried = stalled ? 0 : std::min(waiting, m_capacity * seconds);
        const auto wait = std::chrono::duration_cast<Nanoseconds>(std::chrono::duration<double>(waiting / m_capacity));
        longestWait = std::max(longestWait, wait);
        for (auto& flow : flows) {
            const double part = waiting > 0 ? carried * flow->queue / waiting : 0;
            flow->queue -= part;
            flow->onItsWay.push_back({now + m_idle, wait, part});
            hear(*flow, now);
        }
    }

    /// Of all that was delivered since the last call.
    std::vector<double> parts()
    {
        double sum = 0;
        for (const auto& flow : flows)
            sum += flow->delivered;
        std::vector<double> result;
        for (const auto& flow : flows)
            result.push_back(std::exchange(flow->delivered, 0) / sum);
        return result;
    }

    std::vector<std::unique_ptr<Flow>> flows;
    bool stalled = false;
    Nanoseconds longestWait{};

private:
    void hear(Flow& flow, PathRate::Instant now)
    {
        for (; !flow.onItsWay.empty() && flow.onItsWay.front().known <= now; flow.onItsWay.pop_front()) {
            const auto& news = flow.onItsWay.front();
            if (news.bytes <= 0)
                continue;
            flow.delivered += news.bytes;
            m_acknowledged[&flow] += news.bytes;
            flow.smoothed += ((m_idle + news.waiting) - flow.smoothed) / 4;
        }
        if (flow.sending)
            flow.rate.observe({flow.smoothed,
                               m_idle,
                               static_cast<std::uint64_t>(flow.entered),
                               static_cast<std::uint64_t>(m_acknowledged[&flow]),
                               0,
                               {},
                               0},
                              now);
    }

    double m_capacity;
    Nanoseconds m_idle;
    std::map<const Flow*, double> m_acknowledged;
};

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

/// One flow after the other begins, each finding what the earlier ones left.
std::vector<double> partsOf(Bottleneck& bottleneck, std::chrono::milliseconds between = 3s)
{
    PathRate::Instant now{1h};
    for (auto& flow : bottleneck.flows) {
        flow->sending = true;
        for (const auto end = now + between; now < end; now += step)
            bottleneck.tick(now);
    }
    (void)bottleneck.parts();
    bottleneck.longestWait = {};
    for (const auto end = now + 10s; now < end; now += step)
        bottleneck.tick(now);
    return bottleneck.parts();
}

double fairnessOf(Bottleneck& bottleneck) { return fairness(partsOf(bottleneck)); }

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

    void lanesBeforeOneQueueComeToEvenRates()
    {
        QFETCH(const int, lanes);
        QFETCH(const int, microseconds);
        Bottleneck bottleneck(gigabit, std::chrono::microseconds(microseconds), static_cast<std::size_t>(lanes),
                              std::make_shared<FairShare>());
        const double index = fairnessOf(bottleneck);
        QVERIFY2(index > 0.85, qPrintable(QString::number(index)));
        QVERIFY2(bottleneck.longestWait < 8ms, qPrintable(QString::number(bottleneck.longestWait.count())));
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
        for (const auto between : {2500ms, 2800ms, 3000ms, 3300ms}) {
            const auto share = std::make_shared<FairShare>();
            Bottleneck bottleneck(gigabit, 1ms, sessions.size(), share);
            for (std::size_t i = 0; i < sessions.size(); ++i)
                bottleneck.flows[i]->rate.shareWith(share, liena::DeviceId(sessions[i]));
            const auto parts = partsOf(bottleneck, between);
            std::map<unsigned, double> ofSession;
            for (std::size_t i = 0; i < sessions.size(); ++i)
                ofSession[sessions[i]] += parts[i];
            std::vector<double> shares;
            for (const auto& [session, part] : ofSession)
                shares.push_back(part);
            const double index = fairness(shares); // lanes at even rates: 0.8 and 0.89
            QVERIFY2(index > 0.9, qPrintable(QString::number(index)));
            sum += index;
            QVERIFY2(bottleneck.longestWait < 8ms, qPrintable(QString::number(bottleneck.longestWait.count())));
        }
        QVERIFY2(sum / 4 > 0.93, qPrintable(QString::number(sum / 4))); // where in its breathing a lane meets the next one is chance
    }

    /// The same lanes without a share: what the last one finds is what it keeps.
    void lanesThatDoNotKnowOfEachOtherKeepWhatTheyFound()
    {
        Bottleneck bottleneck(gigabit, 9ms, 3, nullptr);
        const double index = fairnessOf(bottleneck);
        QVERIFY2(index < 0.85, qPrintable(QString::number(index)));
    }

    void standstillsCostSessionsBeforeOneQueueLittle_data()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("sessions");
        for (const double megabits : {100.0, 400.0, 1000.0})
            for (const int sessions : {2, 3})
                QTest::addRow("%.0f Mbit/s, %d", megabits, sessions) << megabits * 125'000 << sessions;
    }

    /// Six times a second, for 0.5 to 4 ms, the network stands still before all of them.
    void standstillsCostSessionsBeforeOneQueueLittle()
    {
        QFETCH(const double, capacity);
        QFETCH(const int, sessions);
        constexpr auto counted = 20s;
        Bottleneck bottleneck(capacity, 200us, static_cast<std::size_t>(sessions), std::make_shared<FairShare>());
        for (auto& flow : bottleneck.flows)
            flow->sending = true;
        liena::test::Standstills standstills(6, 4ms, 1);
        PathRate::Instant now{1h};
        const auto run = [&](Nanoseconds time) {
            for (const auto end = now + time; now < end; now += step)
                bottleneck.tick(now);
        };
        const auto runRestlessly = [&](Nanoseconds time) {
            for (const auto end = now + time; now < end;) {
                run(std::min(standstills.untilNext(), end - now));
                bottleneck.stalled = true;
                run(standstills.length());
                bottleneck.stalled = false;
            }
        };
        runRestlessly(3s);
        for (auto& flow : bottleneck.flows)
            flow->delivered = 0;
        runRestlessly(counted);
        double carried = 0;
        for (const auto& flow : bottleneck.flows)
            carried += flow->delivered / capacity / std::chrono::duration<double>(counted).count();
        QVERIFY2(carried > 0.87, qPrintable(QString::number(carried)));
        const double index = fairness(bottleneck.parts());
        QVERIFY2(index > 0.85, qPrintable(QString::number(index)));
    }

    void laneWithANarrowPathDoesNotHoldUpAWideOne()
    {
        const auto share = std::make_shared<FairShare>();
        Bottleneck wide(gigabit, 200us, 1, share);
        Bottleneck narrow(gigabit / 100, 5ms, 1, share, 2);
        wide.flows.front()->sending = narrow.flows.front()->sending = true;
        PathRate::Instant now{1h};
        const auto run = [&](Nanoseconds time) {
            for (const auto end = now + time; now < end; now += step) {
                wide.tick(now);
                narrow.tick(now);
            }
        };
        run(2s);
        wide.flows.front()->delivered = narrow.flows.front()->delivered = 0;
        run(10s);
        QVERIFY2(wide.flows.front()->delivered > 0.8 * gigabit * 10,
                 qPrintable(QString::number(wide.flows.front()->delivered / gigabit / 10)));
        QVERIFY(narrow.flows.front()->delivered > 0.8 * gigabit / 100 * 10);
    }

    /// A fast session waits in a queue of its own, far away; the others come to even rates before theirs all the same.
    void sessionWithAnotherBottleneckKeepsNobodyFromEvenRates()
    {
        const auto share = std::make_shared<FairShare>();
        Bottleneck far(4 * gigabit, 60ms, 4, share);
        for (auto& flow : far.flows) {
            flow->rate.shareWith(share, liena::DeviceId(9));
            flow->sending = true;
        }
        Bottleneck near(gigabit, 9ms, 3, share);
        for (std::size_t i = 0; i < near.flows.size(); ++i)
            near.flows[i]->rate.shareWith(share, liena::DeviceId(static_cast<std::uint32_t>(i + 1)));
        PathRate::Instant now{1h};
        const auto run = [&](Nanoseconds time) {
            for (const auto end = now + time; now < end; now += step) {
                far.tick(now);
                near.tick(now);
            }
        };
        for (auto& flow : near.flows) {
            flow->sending = true;
            run(3s);
        }
        (void)near.parts();
        (void)far.parts();
        run(10s);
        const double index = fairness(near.parts());
        QVERIFY2(index > 0.93, qPrintable(QString::number(index)));
    }

    void laneThatPausedOrEndedTakesNoShare()
    {
        const auto share = std::make_shared<FairShare>();
        Bottleneck bottleneck(gigabit, 200us, 3, share);
        (void)fairnessOf(bottleneck);
        bottleneck.flows.at(0)->sending = false;
        bottleneck.flows.at(0)->rate.pause(PathRate::Instant{2h});
        bottleneck.flows.erase(bottleneck.flows.begin() + 1); // its destructor leaves the share
        PathRate::Instant now{3h};
        for (const auto end = now + 3s; now < end; now += step)
            bottleneck.tick(now);
        QVERIFY(bottleneck.flows.back()->rate.rate() > 0.8 * gigabit);
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
