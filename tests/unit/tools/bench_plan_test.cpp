// What a measurement sends: enough to fill a line as long as a profile allows.
#include "bench_plan.hpp"
#include "line_verdict.hpp"
#include "support/probed_line.hpp"
#include "system/measure_order.hpp"

#include <QTest>

#include <algorithm>

using namespace liena;
using namespace liena::tools;
using namespace std::chrono_literals;

namespace {

LineProfile shipped(const std::string& name)
{
    return LineProfile::load(LIENA_SOURCE_DIR "/resources/profiles/" + name + ".profile").value();
}

const MeasurementPhase& phaseIn(const MeasurementPlan& plan, std::string_view name)
{
    return *std::find_if(plan.begin(), plan.end(), [&](const MeasurementPhase& phase) { return phase.name == name; });
}

ProbeStream imagesOf(const LineProfile& profile) { return phaseIn(benchPlan(profile, 5s, 64), phases::images).images; }

} // namespace

class BenchPlanTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void asManyAsGoFillTheLongestLineOfAProfile_data()
    {
        QTest::addColumn<QString>("name");
        for (const char* name : {"vascular-robot", "telesurgery", "observation"})
            QTest::newRow(name) << QString::fromLatin1(name);
    }
    void asManyAsGoFillTheLongestLineOfAProfile()
    {
        QFETCH(QString, name);
        const auto profile = shipped(name.toStdString());
        const auto images = imagesOf(profile);
        const double bytes = double(images.atOnce) * images.bytes;
        const double seconds = profile.limits.at(Figure::ImageDelivery).caution / 1e3;
        QVERIFY2(bytes / seconds >= profile.limits.at(Figure::ImageRate).go * 1e6, qPrintable(QString::number(bytes)));
    }

    void smallImagesAreMoreAndLargeOnesFew()
    {
        auto profile = shipped("observation");
        profile.imageBytes = 1;
        QCOMPARE(imagesOf(profile).atOnce, 1024U); // what a device takes
        profile.imageBytes = 8U << 20U;
        QCOMPARE(imagesOf(profile).atOnce, 3U);
        profile.imageBytes = 1U << 20U;
        profile.limits[Figure::ImageRate] = {100, 50};
        QCOMPARE(imagesOf(profile).atOnce, 96U); // 100 MB
    }

    void aRunLastsUntilEachLimitCanBeTold_data()
    {
        QTest::addColumn<bool>("inUse");
        QTest::addColumn<int>("seconds");
        QTest::newRow("vascular-robot") << false << 7; // 100 images at 15 a second
        QTest::newRow("telesurgery") << false << 7;
        QTest::newRow("observation") << false << 31; // 3000 packets in both phases at 50 a second
        QTest::newRow("vascular-robot, in use") << true << 16;
        QTest::newRow("observation, in use") << true << 31;
    }
    void aRunLastsUntilEachLimitCanBeTold()
    {
        QFETCH(bool, inUse);
        const auto name = QString::fromLatin1(QTest::currentDataTag()).section(QLatin1Char(','), 0, 0).toStdString();
        QTEST(static_cast<int>(enoughFor(shipped(name), inUse).count()), "seconds");
    }

    /// Those that a narrow line still has when their time is over would be before what is judged; and no heartbeat waits long behind them.
    void asManyCommandsAsGoComeLastAndAreFewEnough()
    {
        for (const std::uint32_t bytes : {0U, 64U, 200U, 1024U}) {
            const auto plan = benchPlan(shipped("vascular-robot"), 5s, bytes);
            QCOMPARE(plan.back().name, std::string(phases::messages));
            const double bytesOfEach = bytes + 110; // with headers of probe, TLS, TCP and IP
            QVERIFY2(plan.back().prompt.atOnce * bytesOfEach < 0.04 * 1.25e6, "much of the time until suspicion on 10 Mbit/s");
            QVERIFY(plan.back().prompt.atOnce >= 32);
        }
    }

    /// A rate that was rounded would be measured, and judged as the one that was asked for.
    void aRunningDeviceIsAskedForTheRatesOfTheProfile_data()
    {
        QTest::addColumn<double>("commands");
        QTest::addColumn<double>("frames");
        QTest::newRow("whole") << 500.0 << 15.0;
        QTest::newRow("halves") << 2.5 << 7.5;
        QTest::newRow("least") << 1.0 << 0.1;
        QTest::newRow("many digits") << 1234.5678 << 29.97003;
        QTest::newRow("most") << 10000.0 << 1000.0;
    }
    void aRunningDeviceIsAskedForTheRatesOfTheProfile()
    {
        QFETCH(double, commands);
        QFETCH(double, frames);
        auto profile = shipped("vascular-robot");
        profile.commandsPerSecond = commands;
        profile.framesPerSecond = frames;
        auto line = liveOrder(DeviceId(0x00008208U), profile, 20s, 64);
        QVERIFY(line.ends_with('\n'));
        line.pop_back();
        const auto order = system::MeasureOrder::parse(line);
        QVERIFY2(order, line.c_str());
        QVERIFY(order.value().peer == DeviceId(0x00008208U));
        QCOMPARE(order.value().seconds, 20U);
        QCOMPARE(order.value().commandsPerSecond, commands);
        QCOMPARE(order.value().commandBytes, 64U);
        QCOMPARE(order.value().imagesPerSecond, frames);
        QCOMPARE(order.value().imageBytes, profile.imageBytes);
    }

    void aLongFastLineIsGo()
    {
        const auto profile = shipped("observation");
        test::ProbedLine line(benchPlan(profile, 40s, 64));
        line.roundTrip = 200ms;
        line.imageTime = std::chrono::nanoseconds(profile.imageBytes * 8); // 1 Gbit/s
        QVERIFY(line.run());
        Measurement measurement;
        measurement.phases = line.probing.figures();
        const auto verdict = judge(measurement, profile);
        for (const auto& judged : verdict.figures)
            QVERIFY2(judged.verdict == Verdict::Go, judged.reason.c_str());
    }

    void aNarrowLineIsNoGo()
    {
        const auto profile = shipped("observation");
        test::ProbedLine line(benchPlan(profile, 10s, 64));
        line.roundTrip = 40ms;                                               // so that as many commands as go are no millions
        line.imageTime = std::chrono::nanoseconds(profile.imageBytes * 800); // 10 Mbit/s
        QVERIFY(line.run());
        Measurement measurement;
        measurement.phases = line.probing.figures();
        const auto verdict = judge(measurement, profile);
        for (const auto figure : {Figure::ImageRate, Figure::ImagesCarried, Figure::ImageDelivery})
            QVERIFY(verdict.figures.at(static_cast<std::size_t>(figure)).verdict == Verdict::NoGo);
    }
};

QTEST_APPLESS_MAIN(BenchPlanTest)
#include "bench_plan_test.moc"
