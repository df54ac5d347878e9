// What the measuring programs ask of their figures: a limit is kept where that was measured, and nowhere else.
#include "limits.hpp"

#include <QTest>

#include <numeric>

namespace {

std::vector<double> upTo(int count)
{
    std::vector<double> values(static_cast<std::size_t>(count));
    std::iota(values.begin(), values.end(), 1);
    return values;
}

} // namespace

class LimitsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aLimitIsKeptUpToItsValue()
    {
        const Limit most{"age", Bound::AtMost, 200, "ms", "a hundred"};
        QVERIFY(judge(most, 200));
        QVERIFY(!judge(most, 200.1));
        const Limit least{"pictures", Bound::AtLeast, 30, "a second", "a second"};
        QVERIFY(judge(least, 30));
        QVERIFY(!judge(least, 29.9));
    }

    void whatCannotBeToldIsNotKept()
    {
        QVERIFY(!judge({"age", Bound::AtMost, 200, "ms", "a hundred"}, std::nullopt));
        QVERIFY(!judge({"pictures", Bound::AtLeast, 0, "a second", "a second"}, std::nullopt));
    }

    void ninetyNineInAHundredTakeAHundred()
    {
        QVERIFY(!p99Of({}));
        QVERIFY(!p99Of(upTo(99)));
        QCOMPARE(p99Of(upTo(100)).value(), 99.0);
        QCOMPARE(p99Of(upTo(200)).value(), 198.0);
    }

    void growthIsFromTheFirstThatCounts()
    {
        const std::vector<double> memory{100, 400, 500, 501, 503};
        QCOMPARE(growthSince(memory, 2, 4).value(), 3.0);
        QCOMPARE(growthSince({500, 501, 498}, 0, 3).value(), -2.0);
        QVERIFY(!growthSince(memory, 2, 6));
        QVERIFY(!growthSince(memory, 5, 4));
        QVERIFY(!growthSince({}, 0, 0));
    }
};

QTEST_APPLESS_MAIN(LimitsTest)
#include "limits_test.moc"
