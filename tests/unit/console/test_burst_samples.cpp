// The sound of a burst, measured in its samples.
#include "sound/burst_samples.hpp"

#include <QTest>

#include <cmath>
#include <cstring>

using namespace console;

namespace {

std::vector<std::int16_t> samplesOf(AlarmPriority priority)
{
    const auto bytes = burstSamples(priority);
    std::vector<std::int16_t> samples(std::size_t(bytes.size()) / 2);
    std::memcpy(samples.data(), bytes.constData(), std::size_t(bytes.size()));
    return samples;
}

/// Where it sounds and where it is silent, over windows of 10 ms.
int pulsesIn(const std::vector<std::int16_t>& samples)
{
    constexpr std::size_t window = sampleRate / 100;
    int pulses = 0;
    bool sounding = false;
    for (std::size_t at = 0; at + window <= samples.size(); at += window) {
        const bool loud = std::any_of(samples.begin() + std::ptrdiff_t(at), samples.begin() + std::ptrdiff_t(at + window),
                                      [](std::int16_t sample) { return std::abs(sample) > 2000; });
        pulses += loud && !sounding ? 1 : 0;
        sounding = loud;
    }
    return pulses;
}

} // namespace

class TestBurstSamples : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void hasTheNumberOfPulses_data()
    {
        QTest::addColumn<int>("priority");
        QTest::addColumn<int>("pulses");
        QTest::newRow("high") << int(AlarmPriority::High) << 10;
        QTest::newRow("medium") << int(AlarmPriority::Medium) << 3;
        QTest::newRow("low") << int(AlarmPriority::Low) << 2;
    }

    void hasTheNumberOfPulses()
    {
        QFETCH(int, priority);
        QFETCH(int, pulses);
        QCOMPARE(pulsesIn(samplesOf(AlarmPriority(priority))), pulses);
    }

    void isLoudAndNeverClipsOrClicks()
    {
        for (const auto priority : {AlarmPriority::High, AlarmPriority::Medium, AlarmPriority::Low}) {
            const auto samples = samplesOf(priority);
            int most = 0;
            for (const auto sample : samples)
                most = std::max(most, std::abs(int(sample)));
            QVERIFY2(most > 8000 && most < 32767, qPrintable(QString::number(most)));
            QVERIFY(std::abs(samples.front()) < 200 && std::abs(samples.back()) < 200);
        }
    }
};

QTEST_GUILESS_MAIN(TestBurstSamples)
#include "test_burst_samples.moc"
