// What each bulk lane may send of what all together may.
#include "tasks/lane_shares.hpp"

#include <QTest>

using namespace liena::tasks;

namespace {

using Shares = std::vector<std::optional<double>>;

Shares shares(std::optional<double> limit, const std::vector<double>& steadyRates) { return sharesOf(limit, steadyRates); }

} // namespace

class LaneSharesTest : public QObject {
    Q_OBJECT

private slots:
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
};

QTEST_APPLESS_MAIN(LaneSharesTest)
#include "lane_shares_test.moc"
