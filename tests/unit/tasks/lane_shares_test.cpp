// What each bulk lane may send of what all together may, and what they know of the path together.
#include "tasks/lane_shares.hpp"

#include <QTest>

using namespace liena::tasks;

namespace {

using Shares = std::vector<std::optional<double>>;
using Instant = PathRate::Instant;
using namespace std::chrono_literals;

/// Of lanes that are all in use.
Shares shares(std::optional<double> limit, const std::vector<double>& steadyRates)
{
    std::vector<LaneRate> lanes;
    for (const double rate : steadyRates)
        lanes.push_back({rate, std::nullopt, true});
    return sharesOf(limit, lanes);
}

LaneRate knowing(double bytesPerSecond, bool inUse, std::chrono::seconds shown = 1s)
{
    return {bytesPerSecond, KnownRate{bytesPerSecond, Instant(shown)}, inUse};
}

std::optional<KnownRate> together(const std::vector<LaneRate>& lanes) { return togetherOf(lanes); }

} // namespace

class LaneSharesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void lanesShareAsTheyWouldSend() { QCOMPARE(shares(4e6, {30e6, 10e6}), (Shares{3e6, 1e6})); }

    /// It would tell its streams that they can count on nothing, and then leave unpaced.
    void laneThatIsNotUpIsNotLimitedToNothing()
    {
        QCOMPARE(shares(4e6, {30e6, 0}), (Shares{4e6, std::nullopt}));
        QCOMPARE(shares(4e6, {0, 0}), (Shares{std::nullopt, std::nullopt}));
    }

    void withoutALimitNobodyIsLimited()
    {
        QCOMPARE(shares(std::nullopt, {30e6, 0}), (Shares{std::nullopt, std::nullopt}));
        QVERIFY(shares(4e6, {}).empty());
    }

    /// Two streams began together and one has ended: the other's source would be told of half of what the way carries.
    void laneThatNobodyUsesTakesNothingFromTheOthers()
    {
        const std::vector<LaneRate> lanes{{30e6, std::nullopt, false}, {10e6, std::nullopt, true}};
        QCOMPARE(sharesOf(4e6, lanes), (Shares{3e6, 4e6})); // what it may begin with until the shares are reckoned anew
        const std::vector<LaneRate> allIdle{{30e6, std::nullopt, false}, {10e6, std::nullopt, false}};
        QCOMPARE(sharesOf(4e6, allIdle), (Shares{4e6, 4e6}));
        const std::vector<LaneRate> idleAndDown{{0, std::nullopt, false}, {10e6, std::nullopt, true}};
        QCOMPARE(sharesOf(4e6, idleAndDown), (Shares{std::nullopt, 4e6}));
    }

    void lanesInUseAreCarriedAtTheirSum()
    {
        const auto sum = together({knowing(3e6, true, 5s), knowing(1e6, true, 2s), {7e6, std::nullopt, true}});
        QVERIFY(sum);
        QCOMPARE(sum->bytesPerSecond, 4e6);
        QCOMPARE(sum->shown, Instant(2s)); // the one that was filled longest ago
        QVERIFY(!together({{7e6, std::nullopt, true}}));
        QVERIFY(!together({}));
    }

    /// It learnt the same path before: both together would be twice of it.
    void laneThatNobodyUsesIsNoPartOfWhatIsKnown()
    {
        const auto one = together({knowing(9e6, false), knowing(10e6, true)});
        QVERIFY(one);
        QCOMPARE(one->bytesPerSecond, 10e6);
        const auto fastest = together({knowing(5e6, false), knowing(10e6, false)});
        QVERIFY(fastest);
        QCOMPARE(fastest->bytesPerSecond, 10e6);
        const auto before = together({knowing(10e6, false), {7e6, std::nullopt, true}}); // which has not filled the path yet
        QVERIFY(before);
        QCOMPARE(before->bytesPerSecond, 10e6);
    }

    /// 100 Mbit/s into a line of 20 that another lane has filled already.
    void anotherLaneBeginsWithItsPartOfWhatIsKnown()
    {
        QCOMPARE(beginningBeside(KnownRate{2.5e6, Instant(1s)}, 1), 1.25e6);
        QCOMPARE(beginningBeside(KnownRate{3e6, Instant(1s)}, 2), 1e6);
        QCOMPARE(beginningBeside(KnownRate{125e6, Instant(1s)}, 1), PathRate::first);
        QCOMPARE(beginningBeside(std::nullopt, 1), PathRate::first);
    }

    void rateBeginsWhereItIsTold()
    {
        PathRate rate;
        QCOMPARE(rate.rate(), PathRate::first);
        rate.beginAt(1.25e6);
        QCOMPARE(rate.rate(), 1.25e6);
        rate.beginAt(1);
        QCOMPARE(rate.rate(), PathRate::least);
        QVERIFY(!rate.known());
    }
};

QTEST_APPLESS_MAIN(LaneSharesTest)
#include "lane_shares_test.moc"
