// Growing and shrinking in virtual time.
#include "tasks/load_balancer.hpp"

#include <QTest>

#include <algorithm>
#include <functional>
#include <set>
#include <vector>

using namespace liena::tasks;
using namespace std::chrono_literals;

namespace {

using Instant = LoadBalancer::Instant;
constexpr auto period = 100ms;

/// A device on which `demand` processors' worth of bulk is to be done: what workers do not do, the network thread does.
struct Device {
    explicit Device(std::size_t most) : balancer(most) {}

    LoadBalancer balancer;
    Instant now{1h};
    std::vector<std::size_t> counts;

    void run(std::chrono::nanoseconds time, std::size_t lanes, const std::function<double(std::chrono::nanoseconds)>& demand)
    {
        for (std::chrono::nanoseconds at{}; at < time; at += period) {
            now += period;
            const auto threads = static_cast<double>(std::min(balancer.workers(), lanes));
            LoadBalancer::Sample sample;
            sample.lanes = lanes;
            if (balancer.workers() > 0)
                sample.workers = std::min(demand(at), threads);
            else
                sample.network = std::min(demand(at), 1.0);
            counts.push_back(balancer.judge(sample, now));
        }
    }
    void run(std::chrono::nanoseconds time, std::size_t lanes, double demand)
    {
        run(time, lanes, [=](std::chrono::nanoseconds) { return demand; });
    }

    std::size_t changes() const
    {
        std::size_t count = 0;
        for (std::size_t i = 1; i < counts.size(); ++i)
            count += counts[i] != counts[i - 1] ? 1 : 0;
        return count;
    }
};

} // namespace

class LoadBalancerTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void idleDeviceHasNoWorker();
    void littleBulkStaysOnTheNetworkThread();
    void growsAtOnceAndOneByOne();
    void neverBeyondItsBounds_data();
    void neverBeyondItsBounds();
    void oneLaneCannotUseTwo();
    void shrinksAfterAQuietWhile();
    void lanesThatEndTakeTheirWorkersAlong();
    void loadThatComesAndGoesDoesNotFlap_data();
    void loadThatComesAndGoesDoesNotFlap();
    void steadyLoadNearABoundDoesNotFlap_data();
    void steadyLoadNearABoundDoesNotFlap();
    void countKeepsWithinBounds();
    void countShrinksByOneAfterEachQuietWhile();
    void lanesFollowTheStreams();
};

void LoadBalancerTest::idleDeviceHasNoWorker()
{
    Device device(8);
    device.run(60s, 0, 0.0);
    QVERIFY(std::all_of(device.counts.begin(), device.counts.end(), [](std::size_t count) { return count == 0; }));
}

void LoadBalancerTest::littleBulkStaysOnTheNetworkThread()
{
    Device device(8);
    device.run(60s, 2, 0.2);
    QCOMPARE(device.balancer.workers(), std::size_t{0});
}

void LoadBalancerTest::growsAtOnceAndOneByOne()
{
    Device device(8);
    device.run(400ms, 4, 8.0);
    QVERIFY((device.counts == std::vector<std::size_t>{1, 2, 3, 4}));
}

void LoadBalancerTest::neverBeyondItsBounds_data()
{
    QTest::addColumn<quint64>("allowed");
    QTest::addColumn<quint64>("most");
    QTest::newRow("none") << quint64{0} << quint64{0};
    QTest::newRow("one") << quint64{1} << quint64{1};
    QTest::newRow("three") << quint64{3} << quint64{3};
    QTest::newRow("many") << quint64{64} << quint64{4};
}

void LoadBalancerTest::neverBeyondItsBounds()
{
    QFETCH(quint64, allowed);
    QFETCH(quint64, most);
    Device device(allowed);
    device.run(30s, 16, 100.0);
    QCOMPARE(*std::max_element(device.counts.begin(), device.counts.end()), std::size_t{most});
    QCOMPARE(device.balancer.workers(), std::size_t{most});
}

void LoadBalancerTest::oneLaneCannotUseTwo()
{
    Device device(8);
    device.run(30s, 1, 5.0);
    QCOMPARE(*std::max_element(device.counts.begin(), device.counts.end()), std::size_t{1});
}

void LoadBalancerTest::shrinksAfterAQuietWhile()
{
    Device device(8);
    device.run(2s, 4, 8.0);
    QCOMPARE(device.balancer.workers(), std::size_t{4});
    device.counts.clear();
    device.run(20s, 0, 0.0);
    QVERIFY((std::set<std::size_t>(device.counts.begin(), device.counts.end()) == std::set<std::size_t>{0, 1, 2, 3, 4}));
    QCOMPARE(device.counts[18], std::size_t{4}); // not within two seconds
    QCOMPARE(device.counts[20], std::size_t{3});
    QVERIFY(std::is_sorted(device.counts.rbegin(), device.counts.rend()));
    QCOMPARE(device.balancer.workers(), std::size_t{0});
}

void LoadBalancerTest::lanesThatEndTakeTheirWorkersAlong()
{
    Device device(8);
    device.run(2s, 4, 8.0);
    device.run(20s, 2, 8.0);
    QCOMPARE(device.balancer.workers(), std::size_t{2});
}

void LoadBalancerTest::loadThatComesAndGoesDoesNotFlap_data()
{
    QTest::addColumn<int>("every");
    for (const int milliseconds : {200, 600, 1000, 2000})
        QTest::addRow("every %d ms", milliseconds) << milliseconds;
}

void LoadBalancerTest::loadThatComesAndGoesDoesNotFlap()
{
    QFETCH(int, every);
    Device device(8);
    device.run(120s, 4, [&](std::chrono::nanoseconds at) { return at / std::chrono::milliseconds(every) % 2 == 0 ? 3.9 : 0.0; });
    QCOMPARE(device.balancer.workers(), std::size_t{4});
    QVERIFY2(device.changes() <= 4, qPrintable(QString::number(device.changes())));
}

void LoadBalancerTest::steadyLoadNearABoundDoesNotFlap_data()
{
    QTest::addColumn<double>("demand");
    for (int i = 0; i <= 45; ++i)
        QTest::addRow("%.2f", i / 10.0) << i / 10.0;
}

void LoadBalancerTest::steadyLoadNearABoundDoesNotFlap()
{
    QFETCH(double, demand);
    Device device(8);
    device.run(10s, 4, demand);
    device.counts.clear();
    device.run(120s, 4, demand);
    QCOMPARE(device.changes(), std::size_t{0});
}

void LoadBalancerTest::countKeepsWithinBounds()
{
    ElasticCount count({1, 3, 5s});
    QCOMPARE(count.count(), std::size_t{1});
    QCOMPARE(count.want(0, Instant(1h)), std::size_t{1});
    QCOMPARE(count.want(9, Instant(1h)), std::size_t{3});
}

void LoadBalancerTest::countShrinksByOneAfterEachQuietWhile()
{
    ElasticCount count({0, 4, 5s});
    const Instant begin(1h);
    QCOMPARE(count.want(3, begin), std::size_t{3});
    QCOMPARE(count.want(1, begin + 1s), std::size_t{3});
    QCOMPARE(count.want(1, begin + 6s - 1ns), std::size_t{3});
    QCOMPARE(count.want(1, begin + 6s), std::size_t{2});
    QCOMPARE(count.want(2, begin + 10s), std::size_t{2}); // the quiet begins anew
    QCOMPARE(count.want(1, begin + 11s), std::size_t{2});
    QCOMPARE(count.want(1, begin + 15s), std::size_t{2});
    QCOMPARE(count.want(1, begin + 16s), std::size_t{1});
    QCOMPARE(count.want(1, begin + 60s), std::size_t{1});
}

void LoadBalancerTest::lanesFollowTheStreams()
{
    auto lanes = laneCount();
    const Instant begin(1h);
    QCOMPARE(lanes.want(0, begin), std::size_t{1});
    QCOMPARE(lanes.want(2, begin), std::size_t{2});
    QCOMPARE(lanes.want(7, begin), std::size_t{4});
    QCOMPARE(lanes.want(0, begin + 1s), std::size_t{4});
    QCOMPARE(lanes.want(0, begin + 3s), std::size_t{4});
    QCOMPARE(lanes.want(0, begin + 4s), std::size_t{3});
}

QTEST_APPLESS_MAIN(LoadBalancerTest)
#include "load_balancer_test.moc"
