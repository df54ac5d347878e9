// The verdict: the worst figure decides, and each says why.
#include "invented_measurement.hpp"

#include <QTest>

#include <functional>

using namespace liena;
using namespace liena::test;
using namespace liena::tools;

namespace {

struct Spoiled {
    const char* name;
    std::function<void(Measurement&)> spoil;
    Figure figure;
    Verdict verdict;
    const char* reason;
};

PhaseFigures& of(Measurement& measurement, std::size_t place) { return measurement.phases.at(place); }

const std::vector<Spoiled>& spoiled()
{
    static const std::vector<Spoiled> all{
        {"slow", [](Measurement& m) { of(m, 0).prompt.roundTrip.record(15'000'000, 50); }, Figure::RoundTrip, Verdict::Caution,
         "ms is more than 10 ms"},
        {"very slow", [](Measurement& m) { of(m, 0).prompt.roundTrip.record(25'000'000, 50); }, Figure::RoundTrip, Verdict::NoGo,
         "ms is more than 20 ms"},
        {"a rare late one", [](Measurement& m) { of(m, 0).prompt.roundTrip.record(25'000'000, 20); }, Figure::RoundTrip, Verdict::Go, ""},
        {"late beside images", [](Measurement& m) { of(m, 3).prompt.roundTrip.record(90'000'000, 50); }, Figure::RoundTripBesideImages,
         Verdict::NoGo, "more than 20 ms"},
        {"late now and then beside images", [](Measurement& m) { of(m, 3).prompt.roundTrip.record(30'000'000, 13); },
         Figure::TailBesideImages, Verdict::Caution, "more than 20 ms"},
        {"very late now and then beside images", [](Measurement& m) { of(m, 3).prompt.roundTrip.record(400'000'000, 13); },
         Figure::TailBesideImages, Verdict::NoGo, "more than 40 ms"},
        {"that is not their 99 %", [](Measurement& m) { of(m, 3).prompt.roundTrip.record(400'000'000, 13); }, Figure::RoundTripBesideImages,
         Verdict::Go, ""},
        {"late on the idle line", [](Measurement& m) { of(m, 0).prompt.roundTrip.record(400'000'000, 13); }, Figure::TailBesideImages,
         Verdict::Go, ""},
        {"few commands for a tail", [](Measurement& m) { of(m, 3).prompt = figures({500}, 999, 2'000'000); }, Figure::TailBesideImages,
         Verdict::Caution, "99.9 % needs 1000 commands, not 999"},
        {"just enough commands for a tail", [](Measurement& m) { of(m, 3).prompt = figures({500}, 1000, 2'000'000); },
         Figure::TailBesideImages, Verdict::Go, ""},
        {"a tail beside fewer images", [](Measurement& m) { of(m, 3).images.limited = true; }, Figure::TailBesideImages, Verdict::Caution,
         "budget allows"},
        {"a tail beside none", [](Measurement& m) { of(m, 3).images = {}; }, Figure::TailBesideImages, Verdict::Caution,
         "images were not measured"},
        {"no command beside images", [](Measurement& m) { of(m, 3).prompt.echoed = 0; }, Figure::TailBesideImages, Verdict::Caution,
         "no echo came back"},
        {"jitter", [](Measurement& m) { of(m, 0).packets.roundTrip.record(8'000'000, 5); }, Figure::Jitter, Verdict::Caution,
         "more than 5 ms"},
        {"jitter beside images", [](Measurement& m) { of(m, 3).packets.roundTrip.record(10'000'000, 5); }, Figure::JitterBesideImages,
         Verdict::Caution, "more than 6 ms"},
        {"much jitter beside images", [](Measurement& m) { of(m, 3).packets.roundTrip.record(20'000'000, 5); }, Figure::JitterBesideImages,
         Verdict::NoGo, "more than 12 ms"},
        {"that is not the idle line's", [](Measurement& m) { of(m, 3).packets.roundTrip.record(20'000'000, 5); }, Figure::Jitter,
         Verdict::Go, ""},
        {"nor the other way round", [](Measurement& m) { of(m, 0).packets.roundTrip.record(20'000'000, 5); }, Figure::JitterBesideImages,
         Verdict::Go, ""},
        {"few packets for jitter beside images", [](Measurement& m) { of(m, 3).packets = figures({500}, 999, 1'900'000); },
         Figure::JitterBesideImages, Verdict::Caution, "99.9 % needs 1000 packets, not 999"},
        {"jitter beside fewer images", [](Measurement& m) { of(m, 3).images.limited = true; }, Figure::JitterBesideImages, Verdict::Caution,
         "budget allows"},
        {"jitter beside no images", [](Measurement& m) { of(m, 3).images = {}; }, Figure::JitterBesideImages, Verdict::Caution,
         "images were not measured"},
        {"no UDP beside images either", [](Measurement& m) { of(m, 0).packets.echoed = of(m, 3).packets.echoed = 0; },
         Figure::JitterBesideImages, Verdict::Caution, "UDP does not pass"},
        {"packets that images hold up for good", [](Measurement& m) { of(m, 3).packets.echoed = 0; }, Figure::JitterBesideImages,
         Verdict::Caution, "no packet came back"},
        {"packets on the idle line only", [](Measurement& m) { of(m, 3).packets = {}; }, Figure::JitterBesideImages, Verdict::Caution,
         "packets were not measured"},
        {"packets beside images only", [](Measurement& m) { of(m, 0).packets.echoed = 0; }, Figure::Jitter, Verdict::Caution,
         "no packet came back"},
        {"loss", [](Measurement& m) { of(m, 0).packets.echoed = 2475; }, Figure::Loss, Verdict::Caution, "0.5 % is more than 0.1 %"},
        {"more loss", [](Measurement& m) { of(m, 3).packets.echoed = 2400; }, Figure::Loss, Verdict::NoGo, "2 % is more than 1 %"},
        {"few packets", [](Measurement& m) { of(m, 0).packets = of(m, 3).packets = figures({100}, 500, 1'900'000); }, Figure::Loss,
         Verdict::Caution, "1000 packets are too few to tell 0.1 % from none"},
        {"no UDP", [](Measurement& m) { of(m, 0).packets.echoed = of(m, 3).packets.echoed = 0; }, Figure::Loss, Verdict::Caution,
         "UDP does not pass"},
        {"no UDP, no jitter", [](Measurement& m) { of(m, 0).packets.echoed = of(m, 3).packets.echoed = 0; }, Figure::Jitter,
         Verdict::Caution, "UDP does not pass"},
        {"commands withheld", [](Measurement& m) { of(m, 0).prompt.withheld = 125; }, Figure::CommandsCarried, Verdict::Caution,
         "95.2 % is less than 99 %"},
        {"commands withheld beside images", [](Measurement& m) { of(m, 3).prompt.withheld = 2500; }, Figure::CommandsCarried, Verdict::NoGo,
         "50 % is less than 90 %"},
        {"just below", [](Measurement& m) { of(m, 0).prompt.echoed = 2474; }, Figure::CommandsCarried, Verdict::Caution,
         "98.96 % is less than 99 %"},
        {"no commands", [](Measurement& m) { of(m, 0).prompt = of(m, 3).prompt = {}; }, Figure::CommandsCarried, Verdict::Caution,
         "not measured"},
        {"thin", [](Measurement& m) { of(m, 4).images.echoed = 150; }, Figure::ImageRate, Verdict::Caution, "less than 20 MB/s"},
        {"too thin", [](Measurement& m) { of(m, 4).images.echoed = 0; }, Figure::ImageRate, Verdict::NoGo, "no image arrived"},
        {"limited", [](Measurement& m) { of(m, 4).images.limited = true; }, Figure::ImageRate, Verdict::Caution, "budget"},
        {"left out", [](Measurement& m) { m.phases.pop_back(); }, Figure::ImageRate, Verdict::Caution, "fills the line"},
        {"withheld", [](Measurement& m) { of(m, 3).images.withheld = 35; }, Figure::ImagesCarried, Verdict::NoGo, "75 % is less than 90 %"},
        {"old images", [](Measurement& m) { of(m, 3).images.roundTrip.record(70'000'000, 5); }, Figure::ImageDelivery, Verdict::Caution,
         "more than 50 ms"},
        {"fewer images", [](Measurement& m) { of(m, 3).images.limited = true; }, Figure::ImageDelivery, Verdict::Caution, "budget allows"},
        {"few images",
         [](Measurement& m) {
             of(m, 3).images = figures({15, 0, 524'288}, 75, 20'000'000);
         },
         Figure::ImageDelivery, Verdict::Caution, "99 % needs 100 images, not 75"},
        {"few images due",
         [](Measurement& m) {
             of(m, 3).images = figures({15, 0, 524'288}, 1, 20'000'000);
         },
         Figure::ImagesCarried, Verdict::Caution, "99 % needs 100 images, not 1:"},
        {"few images, and slow",
         [](Measurement& m) {
             of(m, 3).images = figures({15, 0, 524'288}, 10, 200'000'000);
         },
         Figure::ImageDelivery, Verdict::NoGo, "200 ms is more than 100 ms; 99 % needs 100 images, not 10"},
        {"few commands", [](Measurement& m) { of(m, 0).prompt = figures({500}, 99, 2'000'000); }, Figure::RoundTrip, Verdict::Caution,
         "99 % needs 100 commands, not 99"},
        {"just enough commands", [](Measurement& m) { of(m, 0).prompt = figures({500}, 100, 2'000'000); }, Figure::RoundTrip, Verdict::Go,
         ""},
        {"few commands beside images", [](Measurement& m) { of(m, 3).prompt = figures({500}, 50, 2'000'000); },
         Figure::RoundTripBesideImages, Verdict::Caution, "99 % needs 100 commands, not 50"},
        {"few commands due", [](Measurement& m) { of(m, 3).prompt = figures({500}, 50, 2'000'000); }, Figure::CommandsCarried,
         Verdict::Caution, "99 % needs 100 commands, not 50"},
        {"few packets for jitter", [](Measurement& m) { of(m, 0).packets = figures({500}, 999, 1'900'000); }, Figure::Jitter,
         Verdict::Caution, "99.9 % needs 1000 packets, not 999"},
        {"just enough packets for jitter", [](Measurement& m) { of(m, 0).packets = figures({500}, 1000, 1'900'000); }, Figure::Jitter,
         Verdict::Go, ""},
        {"fewer commands",
         [](Measurement& m) {
             of(m, 0).prompt.limited = true;
             of(m, 0).prompt.perSecond = 100;
         },
         Figure::CommandsCarried, Verdict::Caution, "measured with 100 commands a second, which is what the budget allows, not 500"},
        {"fewer commands beside images", [](Measurement& m) { of(m, 3).prompt.limited = true; }, Figure::CommandsCarried, Verdict::Caution,
         "budget allows"},
        {"the round trip of fewer commands", [](Measurement& m) { of(m, 0).prompt.limited = true; }, Figure::RoundTrip, Verdict::Go, ""},
        {"nothing back", [](Measurement& m) { of(m, 0).prompt.echoed = 0; }, Figure::RoundTrip, Verdict::Caution, "no echo"},
    };
    return all;
}

} // namespace

class LineVerdictTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aGoodLineIsGo()
    {
        const auto verdict = judge(goodLine(), strictProfile());
        QCOMPARE(verdict.figures.size(), figureKinds.size());
        for (const auto& judged : verdict.figures)
            QVERIFY2(judged.verdict == Verdict::Go && judged.reason.empty(), kindOf(judged.figure).name.data());
        QVERIFY(verdict.verdict == Verdict::Go);
    }

    void eachFigureIsJudgedByItself_data()
    {
        QTest::addColumn<int>("place");
        for (std::size_t place = 0; place < spoiled().size(); ++place)
            QTest::newRow(spoiled()[place].name) << static_cast<int>(place);
    }
    void eachFigureIsJudgedByItself()
    {
        QFETCH(int, place);
        const auto& row = spoiled()[static_cast<std::size_t>(place)];
        auto measurement = goodLine();
        row.spoil(measurement);
        const auto verdict = judge(measurement, strictProfile());
        const auto& judged = verdict.figures.at(static_cast<std::size_t>(row.figure));
        QCOMPARE(wordOf(judged.verdict).data(), wordOf(row.verdict).data());
        QVERIFY2(judged.reason.find(row.reason) != std::string::npos, judged.reason.c_str());
        QVERIFY(verdict.verdict >= judged.verdict);
    }

    /// 99 % are as they should be, and one in two hundred is no command any more.
    void rareLateCommandsBesideImagesAreNotGo_data()
    {
        QTest::addColumn<QString>("name");
        for (const char* name : {"vascular-robot", "telesurgery"})
            QTest::newRow(name) << QString::fromLatin1(name);
    }
    void rareLateCommandsBesideImagesAreNotGo()
    {
        QFETCH(QString, name);
        const auto profile = LineProfile::load(LIENA_SOURCE_DIR "/resources/profiles/" + name.toStdString() + ".profile").value();
        auto measurement = goodLine();
        QVERIFY(judge(measurement, profile).verdict == Verdict::Go);
        auto& roundTrip = of(measurement, 3).prompt.roundTrip;
        roundTrip = {};
        roundTrip.record(3'000'000, 2487);
        roundTrip.record(400'000'000, 13);
        const auto verdict = judge(measurement, profile);
        QVERIFY(verdict.verdict == Verdict::NoGo);
        for (const auto& judged : verdict.figures)
            QVERIFY2((judged.verdict == Verdict::Go) == (judged.figure != Figure::TailBesideImages), kindOf(judged.figure).name.data());
    }

    void aNumberIsToldFromItsLimitAndHasNoExponent()
    {
        QCOMPARE(numberText(99.88, 99.9), std::string("99.88"));
        QCOMPARE(numberText(10.04, 10), std::string("10.04"));
        QCOMPARE(numberText(1.4321, 10), std::string("1.43"));
        QCOMPARE(numberText(1240, 200), std::string("1240"));
        QCOMPARE(numberText(1000.4, 1000), std::string("1000.4"));
        QCOMPARE(numberText(999.7), std::string("999.7"));
        QCOMPARE(numberText(100, 100), std::string("100"));
        QCOMPARE(numberText(0.1, 0.1), std::string("0.1"));
    }

    void whatHasNoLimitDecidesNothing()
    {
        auto profile = strictProfile();
        profile.limits.erase(Figure::Loss);
        auto measurement = goodLine();
        of(measurement, 0).packets.echoed = of(measurement, 3).packets.echoed = 1250;
        const auto verdict = judge(measurement, profile);
        QVERIFY(verdict.verdict == Verdict::Go);
        QVERIFY(verdict.figures.at(static_cast<std::size_t>(Figure::Loss)).value == 50.0); // and is shown
    }

    /// Inside a session the line is not filled, but its images may have shown what it carries.
    void imagesOfTheSessionShowWhatTheLineCarries()
    {
        auto measurement = goodLine();
        measurement.phases.pop_back();
        for (const auto& [bytesPerSecond, expected] :
             {std::pair(25e6, Verdict::Go), std::pair(15e6, Verdict::Caution), std::pair(5e6, Verdict::NoGo)}) {
            measurement.bulkRate = bytesPerSecond;
            QVERIFY(judge(measurement, strictProfile()).verdict == expected);
        }
    }

    void whatImagesShowedLongAgoIsNotGo()
    {
        auto measurement = goodLine();
        measurement.phases.pop_back();
        measurement.bulkRate = 25e6;
        measurement.bulkRateAge = std::chrono::seconds(59);
        QVERIFY(judge(measurement, strictProfile()).verdict == Verdict::Go);
        measurement.bulkRateAge = std::chrono::hours(3);
        const auto verdict = judge(measurement, strictProfile());
        QVERIFY(verdict.verdict == Verdict::Caution);
        const auto& reason = verdict.figures.at(static_cast<std::size_t>(Figure::ImageRate)).reason;
        QVERIFY2(reason.starts_with("images showed it 180 min ago"), reason.c_str());
    }

    /// What measures waits behind them, and is late by that.
    void imagesBesideTheSessionsOwnTellNothingOfTheirDelivery()
    {
        auto measurement = goodLine();
        measurement.imagesFlowed = true;
        measurement.phases[3].images = figures({15, 0, 524'288}, 105, 300'000'000); // no go by itself
        const auto delivery = [&] { return judge(measurement, strictProfile()).figures.back(); };
        QVERIFY(!delivery().value && delivery().verdict == Verdict::Caution);
        QVERIFY2(delivery().reason.find("the session's own images flowed") == 0, delivery().reason.c_str());
        std::string why;
        QVERIFY(valueOf(Figure::ImagesCarried, measurement, why) == 100.0 && why.empty());
        measurement.phases[3].images.withheld = 50;
        QVERIFY(!valueOf(Figure::ImagesCarried, measurement, why) && !why.empty());
        measurement.imagesFlowed = false;
        QVERIFY(delivery().verdict == Verdict::NoGo);
        QVERIFY(valueOf(Figure::ImagesCarried, measurement, why) < 90.0);
    }

    void anEmptyMeasurementIsNeverGo() { QVERIFY(judge(Measurement(), strictProfile()).verdict == Verdict::Caution); }
};

QTEST_APPLESS_MAIN(LineVerdictTest)
#include "line_verdict_test.moc"
