// Tests of the vessels that a run filled: what is found, what is not, and whether the patient moved.
#include "contrast_run.hpp"
#include "imaging/opacification.hpp"
#include "imaging/pane_colours.hpp"
#include "imaging/roadmap_maker.hpp"

#include <QtTest>

#include <opencv2/imgproc.hpp>

using namespace console;
using namespace console::test;

namespace {

double meanOf(const cv::Mat& vessels, const cv::Rect& part) { return cv::mean(vessels(part))[0]; }

} // namespace

class TestRoadmap : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void findsWhatContrastFilled_data();
    void findsWhatContrastFilled();
    void findsContrastHoweverLateInARunItComes();
    void noiseIsNoVessel();
    void anExposureThatSettlesIsNoContrast_data();
    void anExposureThatSettlesIsNoContrast();
    void nothingIsSeenBehindABlade();
    void aRunThatIsTooShortIsNone();
    void anotherProjectionBeginsAnew();
    void runsThatShareOnlyTheirNumberAreTwo();
    void anotherSourceBeginsAnew();
    void thePatientsMovementIsMeasured();
    void aPatientWhoLiesStillHasNotMovedHoweverOftenOneLooks();
    void noiseHasNotMoved();
    void aPictureOfFewRowsTellsNoMovement();
    void theLastRunWithContrastCounts();
    void whatIsForgottenServesNoMore();
    void comparesOnlyWhatIsWatched();
    void paintsInItsOwnColour();
};

void TestRoadmap::findsWhatContrastFilled_data()
{
    QTest::addColumn<int>("photometric");
    QTest::addColumn<int>("intensity");
    QTest::newRow("linear") << int(Photometric::Monochrome2) << int(IntensityRelationship::Linear);
    QTest::newRow("logarithmic") << int(Photometric::Monochrome2) << int(IntensityRelationship::Logarithmic);
    QTest::newRow("logarithmic, low is white") << int(Photometric::Monochrome1) << int(IntensityRelationship::Logarithmic);
}

void TestRoadmap::findsWhatContrastFilled()
{
    QFETCH(int, photometric);
    QFETCH(int, intensity);
    Scene scene;
    scene.photometric = static_cast<Photometric>(photometric);
    scene.intensity = static_cast<IntensityRelationship>(intensity);
    Opacification run;
    takeRun(run, scene, 1);
    const auto roadmap = run.roadmap();
    QVERIFY(roadmap);
    QCOMPARE(roadmap->pictures, 20);
    QCOMPARE(roadmap->vessels.size(), cv::Size(edge, edge));
    const double dark = meanOf(roadmap->vessels, {8, 122, edge / 2 - 16, 4});
    const double bright = meanOf(roadmap->vessels, {edge / 2 + 8, 122, edge / 2 - 16, 4});
    QVERIFY2(dark > 150 && bright > 150, qPrintable(QStringLiteral("%1 %2").arg(dark).arg(bright)));
    QVERIFY2(std::abs(dark - bright) < 0.25 * dark, qPrintable(QStringLiteral("%1 %2").arg(dark).arg(bright))); // whatever lies behind
    const cv::Mat outside = roadmap->vessels.rowRange(0, 110);
    QVERIFY(cv::countNonZero(outside > 60) < outside.rows * outside.cols / 200);
}

/// Noise darkens a pixel the more the longer one looks, and one behind bone the most.
void TestRoadmap::findsContrastHoweverLateInARunItComes()
{
    Scene scene;
    scene.dense = true;
    for (const quint32 before : {6U, 60U, 600U}) {
        Opacification run;
        takeRun(run, scene, 1, 1, before + 20, before);
        const auto roadmap = run.roadmap();
        QVERIFY2(roadmap, qPrintable(QString::number(before)));
        const double vessel = meanOf(roadmap->vessels, {edge / 2 + 8, 122, edge / 2 - 16, 4});
        QVERIFY2(vessel > 150, qPrintable(QStringLiteral("%1: %2").arg(before).arg(vessel)));
        const cv::Mat outside = roadmap->vessels.rowRange(0, 110);
        QVERIFY2(cv::countNonZero(outside > 60) < outside.rows * outside.cols / 200, qPrintable(QString::number(before)));
    }
}

void TestRoadmap::noiseIsNoVessel()
{
    Scene dense;
    dense.dense = true;
    for (const Scene& scene : {Scene{}, dense}) {
        Opacification run;
        takeRun(run, scene, 0, 1, 100);
        QVERIFY(!run.roadmap());
    }
}

void TestRoadmap::anExposureThatSettlesIsNoContrast_data()
{
    QTest::addColumn<bool>("dense");
    QTest::addColumn<double>("level"); // at the end
    QTest::addColumn<bool>("logarithmic");
    for (const bool dense : {false, true})
        for (const double level : {0.9, 0.95, 1.05, 1.1})
            for (const bool logarithmic : {false, true})
                QTest::addRow("%s, %s, to %g", dense ? "dense" : "plain", logarithmic ? "logarithmic" : "linear", level)
                    << dense << level << logarithmic;
}

/// Neither while there is none, nor so that what there is would not be found.
void TestRoadmap::anExposureThatSettlesIsNoContrast()
{
    QFETCH(bool, dense);
    QFETCH(double, level);
    QFETCH(bool, logarithmic);
    for (const double contrast : {0.0, 1.0}) {
        Opacification run;
        for (quint32 number = 1; number <= 40; ++number) {
            Scene scene;
            scene.dense = dense;
            scene.intensity = logarithmic ? IntensityRelationship::Logarithmic : IntensityRelationship::Linear;
            scene.level = 1 + (level - 1) * std::clamp((number - 3.0) / 9.0, 0.0, 1.0);
            scene.contrast = number > 16 && number < 30 ? contrast : 0;
            run.take(picture(number, scene), frame(number, scene));
        }
        const auto roadmap = run.roadmap();
        QCOMPARE(roadmap.has_value(), contrast > 0);
        if (!roadmap)
            continue;
        const double vessel = meanOf(roadmap->vessels, {edge / 2 + 8, 122, edge / 2 - 16, 4});
        QVERIFY2(vessel > 150, qPrintable(QString::number(vessel)));
        const cv::Mat outside = roadmap->vessels.rowRange(0, 110);
        QVERIFY(cv::countNonZero(outside > 60) < outside.rows * outside.cols / 200);
    }
}

/// A few quanta leak through the lead: in the logarithm their noise is larger than any vessel.
void TestRoadmap::nothingIsSeenBehindABlade()
{
    Opacification run;
    std::mt19937 random(3);
    for (quint32 number = 1; number <= 20; ++number) {
        Scene scene;
        scene.contrast = number > 6 && number < 16 ? 1 : 0;
        cv::Mat stored = picture(number, scene);
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < edge; ++x)
                stored.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(2 + random() % 12);
        run.take(stored, frame(number, scene));
    }
    const auto roadmap = run.roadmap();
    QVERIFY(roadmap);
    QCOMPARE(cv::countNonZero(roadmap->vessels.rowRange(0, 12)), 0);
    QVERIFY(meanOf(roadmap->vessels, {8, 122, edge / 2 - 16, 4}) > 150);
}

void TestRoadmap::aRunThatIsTooShortIsNone()
{
    Opacification run;
    QVERIFY(!run.roadmap());
    takeRun(run, {}, 1, 1, Opacification::leastPictures - 1);
    QVERIFY(!run.roadmap());
}

void TestRoadmap::anotherProjectionBeginsAnew()
{
    Opacification run;
    takeRun(run, {}, 1);
    auto turned = frame(200, {});
    turned.geometry.primaryAngle = 30;
    QVERIFY(run.endsWith(turned));
    run.take(picture(5, {}), turned);
    QVERIFY(!run.roadmap());
}

/// The X-ray system was started anew between them, and counts from the first again. What stands elsewhere since is no vessel.
void TestRoadmap::runsThatShareOnlyTheirNumberAreTwo()
{
    RoadmapMaker maker;
    takeRun(maker, {}, 0);
    Scene wire;
    wire.contrast = 1; // from the first picture on: nothing becomes darker in this run
    for (quint32 number = 1; number <= 20; ++number) {
        auto later = frame(100 + number, wire);
        later.captureNs += 60'000'000'000ULL;
        maker.take(picture(5000 + number, wire), later);
    }
    QVERIFY(!maker.make());
}

void TestRoadmap::anotherSourceBeginsAnew()
{
    Opacification run;
    takeRun(run, {}, 1);
    auto recorded = frame(200, {});
    QVERIFY(!run.endsWith(recorded));
    recorded.source = PictureSource::Live;
    QVERIFY(run.endsWith(recorded));
}

void TestRoadmap::thePatientsMovementIsMeasured()
{
    Opacification before;
    takeRun(before, {}, 1);
    const auto roadmap = before.roadmap();
    QVERIFY(roadmap);
    for (const cv::Point2d by : {cv::Point2d(0, 0), cv::Point2d(7, -4)}) {
        Opacification now;
        Scene scene;
        scene.patient = by;
        now.take(picture(77, scene), frame(500, scene, 2));
        const auto displacement = now.displacement(*roadmap);
        QVERIFY(displacement);
        QVERIFY2(std::hypot(displacement->x() - by.x, displacement->y() - by.y) < 1,
                 qPrintable(QStringLiteral("%1 %2").arg(displacement->x()).arg(displacement->y())));
    }
}

/// Twice a second for a minute: looking changes nothing of what is looked at.
void TestRoadmap::aPatientWhoLiesStillHasNotMovedHoweverOftenOneLooks()
{
    Opacification before;
    takeRun(before, {}, 1);
    const auto roadmap = before.roadmap();
    QVERIFY(roadmap);
    Opacification now;
    now.take(picture(77, {}), frame(500, {}, 2));
    const auto first = now.displacement(*roadmap);
    QVERIFY(first);
    for (int look = 0; look < 120; ++look)
        QCOMPARE(now.displacement(*roadmap), first);
}

void TestRoadmap::noiseHasNotMoved()
{
    Opacification before;
    takeRun(before, {}, 1);
    const cv::Mat noise = samples::noisyPicture(
        edge, 9, [](int, int) { return 2000; }, [](double) { return 10000; });
    cv::Mat stored;
    noise.convertTo(stored, CV_16U);
    Opacification now;
    now.take(stored, frame(500, {}, 2));
    QVERIFY(!now.displacement(before.roadmap().value()));
}

/// Made coarser, nothing is left of it but one row.
void TestRoadmap::aPictureOfFewRowsTellsNoMovement()
{
    const cv::Mat strip = cv::repeat(picture(77, {}).rowRange(0, 8), 1, 16);
    Opacification run;
    for (quint32 number = 1; number <= 20; ++number) {
        auto about = frame(number, {});
        about.rows = strip.rows;
        about.columns = strip.cols;
        cv::Mat stored = strip.clone();
        if (number > 6)
            stored.colRange(800, 1200) *= 0.8;
        run.take(stored, about);
    }
    const auto roadmap = run.roadmap();
    QVERIFY(roadmap);
    QCOMPARE(roadmap->background.rows, 1);
    QVERIFY(!run.displacement(*roadmap));
}

void TestRoadmap::theLastRunWithContrastCounts()
{
    RoadmapMaker maker;
    QVERIFY(!maker.make());
    takeRun(maker, {}, 1, 1);
    QVERIFY(maker.make());
    takeRun(maker, {}, 0, 2);
    const auto made = maker.make();
    QVERIFY(made);
    QCOMPARE(made->about.acquisition, 1U);
    takeRun(maker, {}, 1, 3);
    QCOMPARE(maker.make()->about.acquisition, 3U);
}

/// Something moved: neither the run that goes on nor one of before may be used again.
void TestRoadmap::whatIsForgottenServesNoMore()
{
    RoadmapMaker maker;
    takeRun(maker, {}, 1, 1);
    takeRun(maker, {}, 1, 2);
    maker.forget();
    QVERIFY(!maker.make());
    for (quint32 number = 1; number <= 20; ++number)
        maker.take(picture(3000 + number, {}), frame(300 + number, {}, 2)); // the same run goes on
    QVERIFY(!maker.make());
    takeRun(maker, {}, 1, 3);
    QVERIFY(maker.make());
}

void TestRoadmap::comparesOnlyWhatIsWatched()
{
    RoadmapMaker maker;
    takeRun(maker, {}, 1, 1);
    takeRun(maker, {}, 0, 2);
    QVERIFY(!maker.displacement());
    maker.watch(maker.make());
    QVERIFY(!maker.displacement());
    Scene moved;
    moved.patient = {6, 0};
    takeRun(maker, moved, 0, 3);
    QVERIFY(maker.displacement());
    QVERIFY(std::abs(maker.displacement()->pixels.x() - 6) < 1);
    QVERIFY(maker.displacement()->frame > 300);
    maker.watch(nullptr);
    QVERIFY(!maker.displacement());
}

void TestRoadmap::paintsInItsOwnColour()
{
    Roadmap roadmap;
    roadmap.vessels = cv::Mat::zeros(4, 6, CV_8UC1);
    roadmap.vessels.at<std::uint8_t>(2, 3) = 255;
    const QImage layer = vesselLayer(roadmap);
    QCOMPARE(layer.size(), QSize(6, 4));
    QCOMPARE(layer.pixelColor(3, 2), pane_colours::roadmap);
    QCOMPARE(qAlpha(layer.pixel(0, 0)), 0);
}

QTEST_APPLESS_MAIN(TestRoadmap)
#include "test_roadmap.moc"
