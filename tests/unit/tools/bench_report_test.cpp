// What a bench run shows: text, JSON that can be read again, the plot, and files that are there whole or not at all.
#include "bench_report.hpp"
#include "invented_measurement.hpp"
#include "json_value.hpp"
#include "latency_plot.hpp"
#include "report_file.hpp"

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <QXmlStreamReader>

#include <csignal>

#include <sys/resource.h>

using namespace liena;
using namespace liena::test;
using namespace liena::tools;

namespace {

const BenchSubject subject{"t", "cock<pit", "robot", "inside its session"};

std::string textOf(const Measurement& measurement)
{
    return benchText(subject, strictProfile(), judge(measurement, strictProfile()), measurement);
}

} // namespace

class BenchReportTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void theVerdictComesFirst()
    {
        const auto good = textOf(goodLine());
        QVERIFY2(good.starts_with("GO: the line from cock<pit to robot"), good.c_str());
        auto measurement = goodLine();
        measurement.phases[0].packets.echoed = 2400;
        const auto bad = textOf(measurement);
        QVERIFY2(bad.starts_with("NO-GO: "), bad.c_str());
        QVERIFY2(bad.find("-> 2 % is more than 1 %") != std::string::npos, bad.c_str());
        QVERIFY2(bad.find("2500 sent, 2500 heard there, 2400 echoes heard here") != std::string::npos, bad.c_str());
    }

    void theTextSaysWhatWasCarried()
    {
        const auto text = textOf(goodLine());
        for (const char* part :
             {"commands, paced", "2.0", "commands at most", "20000 a second", "images at most", "52.4 MB/s", "105 of 105 that were due"})
            QVERIFY2(text.find(part) != std::string::npos, (std::string(part) + "\n" + text).c_str());
    }

    void theBudgetsRateIsNoThroughput()
    {
        auto measurement = goodLine();
        measurement.phases[2].prompt.limited = true;
        const auto text = textOf(measurement);
        QVERIFY2(text.find("commands at most") == std::string::npos, text.c_str());
        const auto json = JsonValue::parse(benchJson(subject, strictProfile(), judge(measurement, strictProfile()), measurement));
        QVERIFY(json && (*json)["throughput"]["commands_per_second"].isNull());
        QVERIFY(!(*json)["throughput"]["images_mb_per_second"].isNull());
    }

    /// What many under way bring back on a line that is long and not full is no more than their number allows.
    void whatTheWindowAllowsIsNotWhatTheLineCarries_data()
    {
        QTest::addColumn<int>("idle"); // ms
        QTest::addColumn<int>("full");
        QTest::addColumn<int>("echoes"); // in 5 s
        QTest::addColumn<bool>("byWindow");
        QTest::newRow("a long line") << 200 << 205 << 24976 << true;
        QTest::newRow("a long line, somewhat busy") << 200 << 380 << 13474 << true;
        QTest::newRow("a queue stands") << 200 << 410 << 12488 << false;
        QTest::newRow("a short line is full") << 2 << 51 << 100'000 << false;
        QTest::newRow("fewer were under way") << 200 << 205 << 18'000 << false;
        QTest::newRow("the idle line was not measured") << 0 << 205 << 24976 << false;
    }
    void whatTheWindowAllowsIsNotWhatTheLineCarries()
    {
        QFETCH(int, idle);
        QFETCH(int, full);
        QFETCH(int, echoes);
        QFETCH(bool, byWindow);
        auto measurement = goodLine();
        measurement.phases[0].prompt = figures({500}, idle > 0 ? 2500 : 0, idle * 1'000'000LL);
        measurement.phases[2].prompt = figures({0, 1024}, static_cast<std::uint64_t>(echoes), full * 1'000'000LL);
        const auto text = textOf(measurement);
        const auto row = QString::fromStdString(text.substr(text.find(byWindow ? "  commands, at least" : "  commands at most")))
                             .section(QLatin1Char('\n'), 0, 0)
                             .simplified();
        const auto rate = QString::number(echoes / 5.0, 'f', 0);
        QCOMPARE(row, byWindow ? QStringLiteral("commands, at least %1 a second, there and back; limited by 1024 under way").arg(rate)
                               : QStringLiteral("commands at most %1 a second, there and back").arg(rate));
        const auto json = JsonValue::parse(benchJson(subject, strictProfile(), judge(measurement, strictProfile()), measurement));
        QVERIFY(json);
        QCOMPARE((*json)["throughput"]["commands_limited_by_window"].truth(), byWindow);
    }

    void aPercentileOfTooFewIsNone()
    {
        auto measurement = goodLine();
        measurement.phases[0].prompt = figures({100}, 500, 2'000'000);
        const auto text = textOf(measurement);
        const auto row = text.substr(text.find("  commands, paced"));
        QCOMPARE(QString::fromStdString(row.substr(0, row.find('\n'))).simplified(),
                 QStringLiteral("commands, paced 2.00 ms 2.00 ms 2.00 ms - - 2.00 ms 500"));
        const auto json = JsonValue::parse(toJson(measurement));
        QVERIFY(json);
        const auto roundTrip = (*json)["phases"].items().front()["prompt"]["round_trip_us"];
        QCOMPARE(roundTrip["p99"].numberOr(0), 2000.0);
        QVERIFY(roundTrip["p99_9"].isNull() && roundTrip["p99_99"].isNull());
        QCOMPARE(roundTrip["max"].numberOr(0), 2000.0);
        measurement.phases[3].images = figures({15, 0, 524'288}, 10, 20'000'000);
        const auto svg = latencyPlot(subject, strictProfile(), judge(measurement, strictProfile()), measurement);
        QVERIFY2(svg.find("images, until heard: most 20 ms") != std::string::npos, svg.c_str());
        QVERIFY2(svg.find("commands, idle: 99 % within 2 ms, most 2 ms") != std::string::npos, svg.c_str());
    }

    void noNumberHasAnExponent()
    {
        auto measurement = goodLine();
        measurement.phases[3].images = figures({15, 0, 524'288}, 200, 1'240'000'000);
        const auto text = textOf(measurement);
        QVERIFY2(text.find("1240 ms is more than 100 ms") != std::string::npos, text.c_str());
        const auto svg = latencyPlot(subject, strictProfile(), judge(measurement, strictProfile()), measurement);
        QVERIFY2(svg.find("images, until heard: 99 % within 1240 ms, most 1240 ms") != std::string::npos, svg.c_str());
        for (const auto& shown : {text, svg})
            QVERIFY2(shown.find("e+") == std::string::npos, shown.c_str());
    }

    void theBudgetIsSaid()
    {
        auto measurement = goodLine();
        measurement.inUse = true;
        measurement.limits = {200, 4'000'000, std::chrono::seconds(60)};
        const auto text = textOf(measurement);
        QVERIFY2(text.find("budget: 200 probes a second, 4.0 MB/s of images; a device is in use") != std::string::npos, text.c_str());
    }

    void theJsonIsReadAgain()
    {
        auto measurement = goodLine();
        measurement.phases[0].prompt.roundTrip.record(123'456'789);
        measurement.phases[3].images.limited = true;
        measurement.phases[3].images.withheld = 3;
        measurement.bulkRate = 12.5e6;
        measurement.bulkRateAge = std::chrono::milliseconds(1500);
        const auto text = benchJson(subject, strictProfile(), judge(measurement, strictProfile()), measurement);
        QVERIFY(text.find('\n') == std::string::npos);
        const auto json = JsonValue::parse(text);
        QVERIFY(json);
        QCOMPARE((*json)["verdict"].text(), std::string("CAUTION"));
        QCOMPARE((*json)["from"].text(), std::string("cock<pit"));
        QCOMPARE((*json)["figures"].items().size(), figureKinds.size());
        QCOMPARE((*json)["throughput"]["commands_per_second"].numberOr(0), 20'000.0);
        QCOMPARE((*json)["throughput"]["images_mb_per_second"].numberOr(0), 52.429); // 500 of 512 KiB in 5 s
        const auto again = measurementFrom((*json)["measurement"]);
        QVERIFY(again);
        QCOMPARE(again->phases.size(), measurement.phases.size());
        const auto& prompt = again->phases[0].prompt;
        QCOMPARE(prompt.sent, measurement.phases[0].prompt.sent);
        QCOMPARE(prompt.roundTrip.count(), std::uint64_t{2501});
        for (const double fraction : {0.5, 0.99, 0.9999, 1.0})
            QCOMPARE(prompt.roundTrip.quantile(fraction), measurement.phases[0].prompt.roundTrip.quantile(fraction));
        QVERIFY(again->phases[3].images.limited && again->phases[3].images.withheld == 3);
        QVERIFY(!again->phases[1].images.asked.isUsed());
        QVERIFY(again->bulkRate == measurement.bulkRate && again->bulkRateAge == measurement.bulkRateAge);
        QCOMPARE(textOf(*again), textOf(measurement));
    }

    void whatIsNoMeasurementIsNone()
    {
        for (const char* text : {"{}", "[]", "3", "null", R"({"phases":null})"})
            QVERIFY2(!measurementFrom(*JsonValue::parse(text)), text);
        const auto odd =
            measurementFrom(*JsonValue::parse(R"({"phases":[{"prompt":{"sent":-5,"buckets_ns":[[1],[2,3,4],"x",[9,1e99]]}}]})"));
        QVERIFY(odd && odd->phases[0].prompt.sent == 0 && odd->phases[0].prompt.roundTrip.count() == 0);
    }

    void thePlotIsXmlWithACurveForEach()
    {
        const auto svg = latencyPlot(subject, strictProfile(), judge(goodLine(), strictProfile()), goodLine());
        QXmlStreamReader reader(QByteArray::fromStdString(svg));
        int curves = 0;
        int dashes = 0;
        QString texts;
        while (!reader.atEnd()) {
            reader.readNext();
            curves += reader.isStartElement() && reader.name() == QLatin1String("polyline") ? 1 : 0;
            dashes += reader.isStartElement() && reader.attributes().hasAttribute(QLatin1String("stroke-dasharray")) ? 1 : 0;
            texts += reader.isCharacters() ? reader.text().toString() : QString();
        }
        QVERIFY2(!reader.hasError(), qPrintable(reader.errorString()));
        QCOMPARE(curves, 5);
        QCOMPARE(dashes, 4); // the limits for 99 and for 99.9 %
        for (const char* limit :
             {"go: 99 % within 10 ms", "caution: 99 % within 20 ms", "go: 99.9 % within 20 ms", "caution: 99.9 % within 40 ms"})
            QVERIFY2(texts.contains(QLatin1String(limit)), qPrintable(texts));
        QVERIFY2(texts.contains(QStringLiteral("GO: the line from cock<pit to robot")), qPrintable(texts));
        QVERIFY(!QXmlStreamReader(QByteArray::fromStdString(latencyPlot(subject, strictProfile(), {}, Measurement()))).hasError());
    }

    void aReportIsWholeOrNotThere()
    {
        const QTemporaryDir folder;
        const auto file = folder.path().toStdString() + "/line.svg";
        QVERIFY(writeReport(file, "old"));
        QVERIFY(writeReport(file, "new"));
        QFile read(QString::fromStdString(file));
        QVERIFY(read.open(QIODevice::ReadOnly));
        QCOMPARE(read.readAll(), QByteArray("new"));
        QCOMPARE(QDir(folder.path()).entryList(QDir::Files).size(), 1);
        QVERIFY(tryReport(file));
        QCOMPARE(QDir(folder.path()).entryList(QDir::Files).size(), 1);
        for (const auto& place : {folder.path().toStdString() + "/no/line.svg", folder.path().toStdString()})
            QVERIFY(!tryReport(place));
        const auto nowhere = writeReport(folder.path().toStdString() + "/no/line.svg", "new");
        QVERIFY(!nowhere && nowhere.error().what.find("No such file") != std::string::npos);
    }

    void aFullDiskIsSaid()
    {
        const auto full = writeReport("/dev/full", "much");
        QVERIFY(!full);
        QVERIFY2(full.error().what.find("make room") != std::string::npos, full.error().what.c_str());
        QVERIFY(QFile::exists(QStringLiteral("/dev/full")));
    }

    /// No disk is filled for it: the kernel ends a file at a limit of the process, in the midst of writing as a full disk does.
    void whatDoesNotFitLeavesTheOldReport()
    {
        const QTemporaryDir folder;
        const auto file = folder.path().toStdString() + "/line.svg";
        QVERIFY(writeReport(file, "old"));
        rlimit before{};
        QVERIFY(::getrlimit(RLIMIT_FSIZE, &before) == 0);
        const auto signal = std::signal(SIGXFSZ, SIG_IGN);
        const rlimit narrow{4096, before.rlim_max};
        QVERIFY(::setrlimit(RLIMIT_FSIZE, &narrow) == 0);
        const auto written = writeReport(file, std::string(10'000, 'x'));
        ::setrlimit(RLIMIT_FSIZE, &before);
        std::signal(SIGXFSZ, signal);
        QVERIFY(!written);
        QVERIFY2(written.error().what.find("File too large") != std::string::npos, written.error().what.c_str());
        QFile read(QString::fromStdString(file));
        QVERIFY(read.open(QIODevice::ReadOnly));
        QCOMPARE(read.readAll(), QByteArray("old"));
        QCOMPARE(QDir(folder.path()).entryList(QDir::Files).size(), 1);
    }
};

QTEST_APPLESS_MAIN(BenchReportTest)
#include "bench_report_test.moc"
