// What bulk streams are told that they can count on.
#include "tasks/stream_rates.hpp"

#include <QTest>

using namespace liena;
using namespace liena::tasks;

namespace {

using Streams = std::vector<PlacedStream>;
using Lanes = std::vector<std::optional<double>>;
using Told = std::vector<std::pair<int, std::optional<double>>>;

Told told(const Streams& streams, const Lanes& lanes)
{
    Told result;
    for (const auto& stream : ratesOf(streams, lanes))
        result.emplace_back(stream.number, stream.rate);
    return result;
}

} // namespace

class StreamRatesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void streamHasItsLaneOnly() { QCOMPARE(told({{0x0202, 0}, {0x0203, 1}}, {4e6, 6e6}), (Told{{0x0202, 4e6}, {0x0203, 6e6}})); }

    void streamsOnOneLaneTakeTurns()
    {
        QCOMPARE(told({{0x0202, 0}, {0x0203, 1}, {0x0204, 0}}, {4e6, 6e6}), (Told{{0x0202, 2e6}, {0x0203, 6e6}, {0x0204, 2e6}}));
    }

    void saysNothingOfALaneThatIsNotKnown()
    {
        QCOMPARE(told({{0x0202, 0}, {0x0203, 1}}, {std::nullopt, 6e6}), (Told{{0x0202, std::nullopt}, {0x0203, 6e6}}));
        QVERIFY(told({}, {4e6}).empty()); // nobody uses it
    }
};

QTEST_APPLESS_MAIN(StreamRatesTest)
#include "stream_rates_test.moc"
