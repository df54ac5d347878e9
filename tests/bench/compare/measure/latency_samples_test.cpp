// Quantiles of the comparison's latencies: values that were measured, by nearest rank.
#include "measure/latency_samples.hpp"

#include <QTest>

using namespace liena::compare;

class LatencySamplesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void quantilesAreMeasuredValuesInAnyOrder()
    {
        LatencySamples samples;
        for (int i = 0; i < 1000; ++i)
            samples.record(1 + (i * 7) % 1000); // 1 to 1000, each once
        QCOMPARE(samples.count(), std::uint64_t(1000));
        QCOMPARE(samples.quantile(0.5), std::uint64_t(500));
        QCOMPARE(samples.quantile(0.99), std::uint64_t(990));
        QCOMPARE(samples.quantile(0.999), std::uint64_t(999));
        QCOMPARE(samples.max(), std::uint64_t(1000));
    }

    void fewAndNoneAndNegative()
    {
        LatencySamples samples;
        QCOMPARE(samples.quantile(0.5), std::uint64_t(0));
        samples.record(-5);
        QCOMPARE(samples.quantile(0.99), std::uint64_t(0));
        samples.record(20'447'001);
        QCOMPARE(samples.quantile(0.5), std::uint64_t(0));
        QCOMPARE(samples.quantile(0.999), std::uint64_t(20'447'001)); // to the nanosecond
    }
};

QTEST_APPLESS_MAIN(LatencySamplesTest)
#include "latency_samples_test.moc"
