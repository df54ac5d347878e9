// The histogram of latencies: what it counts, and how exactly.
#include "liena/latency_histogram.hpp"

#include <QTest>

using namespace liena;

class LatencyHistogramTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void saysNothingWithoutRecords()
    {
        const LatencyHistogram histogram;
        QCOMPARE(histogram.count(), std::uint64_t{0});
        QCOMPARE(histogram.quantile(0.99), std::uint64_t{0});
    }

    void tellsAQuantileFromTheGreatestByCount()
    {
        LatencyHistogram histogram;
        QVERIFY(!histogram.tells(0.5));
        histogram.record(5, 99);
        QVERIFY(histogram.tells(0.9) && !histogram.tells(0.99));
        histogram.record(5);
        QVERIFY(histogram.tells(0.99) && !histogram.tells(0.999));
        histogram.record(5, 9900);
        QVERIFY(histogram.tells(0.9999) && !histogram.tells(1));
    }

    void isExactBelow64()
    {
        LatencyHistogram histogram;
        for (int value = 1; value <= 60; ++value)
            histogram.record(value);
        QCOMPARE(histogram.quantile(0.5), std::uint64_t{30});
        QCOMPARE(histogram.quantile(1.0 / 60), std::uint64_t{1});
        QCOMPARE(histogram.quantile(1), std::uint64_t{60});
    }

    void isAtMostOneSixtyFourthAbove_data()
    {
        QTest::addColumn<qint64>("value");
        for (const qint64 value : {63, 64, 65, 127, 128, 129, 1000, 65535, 65536, 123'456'789})
            QTest::addRow("%lld", value) << value;
        QTest::addRow("the highest") << static_cast<qint64>(LatencyHistogram::highest);
    }
    void isAtMostOneSixtyFourthAbove()
    {
        QFETCH(qint64, value);
        LatencyHistogram histogram;
        histogram.record(value);
        histogram.record(static_cast<std::int64_t>(LatencyHistogram::highest)); // lest the maximum bound what is said
        const auto said = static_cast<qint64>(histogram.quantile(0.5));
        QVERIFY2(said >= value && said <= value + value / 64, qPrintable(QString::number(said)));
    }

    void findsTheTailOfAThousand()
    {
        LatencyHistogram histogram;
        for (int i = 0; i < 999; ++i)
            histogram.record(10);
        histogram.record(50'000);
        QCOMPARE(histogram.quantile(0.999), std::uint64_t{10});
        QCOMPARE(histogram.quantile(0.9991), std::uint64_t{50'000});
        QCOMPARE(histogram.max(), std::uint64_t{50'000});
    }

    void countsWhatIsOutOfRangeAtItsEnds()
    {
        LatencyHistogram histogram;
        histogram.record(-5);
        QCOMPARE(histogram.quantile(1), std::uint64_t{0});
        histogram.record(std::numeric_limits<std::int64_t>::max());
        QCOMPARE(histogram.max(), LatencyHistogram::highest);
        QCOMPARE(histogram.count(), std::uint64_t{2});
    }

    void isTheSameWhenItsBucketsAreRecordedAgain()
    {
        LatencyHistogram histogram;
        for (int i = 1; i < 5000; ++i)
            histogram.record(i * 977LL);
        LatencyHistogram again;
        std::uint64_t told = 0;
        histogram.forEach([&](std::uint64_t value, std::uint64_t count) {
            again.record(static_cast<std::int64_t>(value), count);
            told += count;
        });
        QCOMPARE(told, histogram.count());
        QCOMPARE(again.max(), histogram.max());
        for (const double fraction : {0.001, 0.5, 0.9, 0.99, 0.999, 0.9999, 1.0})
            QCOMPARE(again.quantile(fraction), histogram.quantile(fraction));
        QCOMPARE(histogram.least(), std::uint64_t{977});
    }
};

QTEST_APPLESS_MAIN(LatencyHistogramTest)
#include "latency_histogram_test.moc"
