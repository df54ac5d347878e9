// Computed fluoroscopy: what it shows, where it shows it, and how its noise behaves.
#include "fluoroscopy_generator.hpp"

#include <QTest>

#include <numeric>

using namespace liena::devices;
using namespace std::chrono_literals;

namespace {

constexpr int size = 256;

Exposure exposureAt(std::chrono::milliseconds time, const InstrumentView& view = {}, AcquisitionMode mode = AcquisitionMode::Fluoroscopy)
{
    Exposure exposure;
    exposure.time = time;
    exposure.mode = mode;
    exposure.acquisition = 1;
    exposure.instruments = view;
    return exposure;
}

FluoroscopyGenerator generator(std::uint64_t seed = 1) { return {VesselTree::cerebral(), size, seed}; }

Picture take(FluoroscopyGenerator& source, const Exposure& exposure)
{
    Picture picture;
    if (!source.next(exposure, picture))
        qFatal("no picture");
    return picture;
}

// Mean of the pixels within `reach` of a point of the patient.
double meanAround(const Picture& picture, const CArmProjection& projection, Vector point, int reach)
{
    const auto spot = projection.project(point);
    double sum = 0;
    int count = 0;
    for (int row = static_cast<int>(spot.row + 0.5) - reach; row <= static_cast<int>(spot.row + 0.5) + reach; ++row)
        for (int column = static_cast<int>(spot.column + 0.5) - reach; column <= static_cast<int>(spot.column + 0.5) + reach; ++column) {
            sum += picture.pixels.at(static_cast<std::size_t>(row) * size + static_cast<std::size_t>(column));
            ++count;
        }
    return sum / count;
}

// Of the difference of two pictures of the same scene, in the middle.
double noiseVariance(const Picture& a, const Picture& b)
{
    double sum = 0;
    int count = 0;
    for (int row = size * 3 / 8; row < size * 5 / 8; ++row)
        for (int column = size * 3 / 8; column < size * 5 / 8; ++column) {
            const std::size_t pixel = static_cast<std::size_t>(row) * size + static_cast<std::size_t>(column);
            const double difference = double{static_cast<double>(a.pixels[pixel])} - b.pixels[pixel];
            sum += difference * difference;
            ++count;
        }
    return sum / count / 2;
}

} // namespace

class FluoroscopyGeneratorTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void describesItsPictures()
    {
        auto source = generator();
        const Picture picture = take(source, exposureAt(0ms));
        QCOMPARE(picture.pixels.size(), std::size_t{size * size});
        QCOMPARE(picture.format.bitsStored, std::uint8_t{12});
        QCOMPARE(picture.format.source, PictureSource::Simulated);
        QCOMPARE(picture.format.relationship, IntensityRelationship::Linear);
        QCOMPARE(picture.format.imagerPixelSpacing, 300.0 / size);
        QVERIFY(picture.format.windowWidth > 100);
        QVERIFY(*std::max_element(picture.pixels.begin(), picture.pixels.end()) <= 4095);
    }

    void sameSeedGivesTheSamePicture()
    {
        auto first = generator(3);
        auto second = generator(3);
        auto other = generator(4);
        const Picture picture = take(first, exposureAt(0ms));
        QVERIFY(picture.pixels == take(second, exposureAt(0ms)).pixels);
        QVERIFY(picture.pixels != take(other, exposureAt(0ms)).pixels);
        QVERIFY(picture.pixels != take(first, exposureAt(100ms)).pixels);
    }

    void wireIsDarkAtTheReportedTip()
    {
        const VesselWay way(VesselTree::cerebral());
        const CArmProjection projection({}, {}, size);
        for (const double arc : {420.0, 470.0, 520.0}) {
            auto without = generator();
            auto with = generator();
            const InstrumentView view{true, arc, 0, 0, 0};
            const Exposure empty = exposureAt(0ms, {}, AcquisitionMode::Acquisition);
            const Exposure wired = exposureAt(0ms, view, AcquisitionMode::Acquisition);
            const Picture before = take(without, empty);
            const Picture after = take(with, wired);
            const Vector tip = way.at(arc - 2).position;
            QVERIFY(meanAround(after, projection, tip, 1) < 0.92 * meanAround(before, projection, tip, 1));
            // Nothing 12 mm ahead of it.
            const Vector ahead = way.at(arc + 12).position;
            QVERIFY(std::abs(meanAround(after, projection, ahead, 1) / meanAround(before, projection, ahead, 1) - 1) < 0.08);
        }
    }

    void contrastFillsTheVesselsDownstreamOnly()
    {
        const VesselWay way(VesselTree::cerebral());
        const CArmProjection projection({}, {}, size);
        const double catheter = 440;
        auto source = generator();
        const Picture mask = take(source, exposureAt(0ms, {true, 0, 0, catheter, 0}, AcquisitionMode::Acquisition));
        QVERIFY(mask.format.mask);
        Picture filled;
        for (int frame = 1; frame <= 20; ++frame)
            filled = take(source, exposureAt(frame * 66ms, {true, 0, 0, catheter, 4}, AcquisitionMode::Acquisition));
        QVERIFY(!filled.format.mask);
        const Vector downstream = way.at(480).position;
        QVERIFY(meanAround(filled, projection, downstream, 1) < 0.85 * meanAround(mask, projection, downstream, 1));
        const Vector otherSide{-way.at(470).position.x - 3, 40, 20}; // brain of the other side, away from the way
        QVERIFY(std::abs(meanAround(filled, projection, otherSide, 4) / meanAround(mask, projection, otherSide, 4) - 1) < 0.05);
        // And it washes out.
        Picture washed;
        for (int frame = 21; frame <= 150; ++frame)
            washed = take(source, exposureAt(frame * 66ms, {true, 0, 0, catheter, 0}, AcquisitionMode::Acquisition));
        QVERIFY(meanAround(washed, projection, downstream, 1) > 0.95 * meanAround(mask, projection, downstream, 1));
    }

    // Nobody looks from 2 s to 60 s, and the injection ends meanwhile.
    void contrastThatStoppedUnseenIsNotInTheNextRun()
    {
        const VesselWay way(VesselTree::cerebral());
        const CArmProjection projection({}, {}, size);
        const double catheter = 440;
        auto source = generator();
        for (int frame = 0; frame <= 30; ++frame)
            take(source, exposureAt(frame * 66ms, {true, 0, 0, catheter, 2}));
        Exposure next = exposureAt(60s, {true, 0, 0, catheter, 0}, AcquisitionMode::Acquisition);
        next.acquisition = 2;
        const Picture first = take(source, next);
        QVERIFY(first.format.mask);
        auto fresh = generator();
        const Picture clean = take(fresh, next);
        const Vector downstream = way.at(480).position;
        QVERIFY(std::abs(meanAround(first, projection, downstream, 1) / meanAround(clean, projection, downstream, 1) - 1) < 0.05);
    }

    void contrastFlowsOnWhileThePedalIsPressedAnew()
    {
        const VesselWay way(VesselTree::cerebral());
        const CArmProjection projection({}, {}, size);
        const double catheter = 440;
        auto source = generator();
        Exposure exposure = exposureAt(0ms, {true, 0, 0, catheter, 0}, AcquisitionMode::Acquisition);
        const Picture mask = take(source, exposure);
        for (int frame = 1; frame <= 20; ++frame)
            take(source, exposureAt(frame * 66ms, {true, 0, 0, catheter, 4}, AcquisitionMode::Acquisition));
        exposure = exposureAt(4s, {true, 0, 0, catheter, 4}, AcquisitionMode::Acquisition);
        exposure.acquisition = 2;
        const Picture filled = take(source, exposure);
        QVERIFY(!filled.format.mask);
        const Vector downstream = way.at(480).position;
        QVERIFY(meanAround(filled, projection, downstream, 1) < 0.85 * meanAround(mask, projection, downstream, 1));
    }

    void noiseVarianceFollowsTheDose()
    {
        auto source = generator();
        const double low = noiseVariance(take(source, exposureAt(0ms)), take(source, exposureAt(66ms)));
        const double high = noiseVariance(take(source, exposureAt(132ms, {}, AcquisitionMode::Acquisition)),
                                          take(source, exposureAt(198ms, {}, AcquisitionMode::Acquisition)));
        QVERIFY2(std::abs(low / high - 10) < 1.5, qPrintable(QString("%1 / %2").arg(low).arg(high))); // ten times the quanta
    }

    void brightnessDoesNotFollowTheDose()
    {
        auto source = generator();
        const auto mean = [](const Picture& picture) {
            return std::accumulate(picture.pixels.begin(), picture.pixels.end(), 0.0) / (size * size);
        };
        const double low = mean(take(source, exposureAt(0ms)));
        const double high = mean(take(source, exposureAt(66ms, {}, AcquisitionMode::Acquisition)));
        QVERIFY(std::abs(low / high - 1) < 0.02);
    }

    void projectionFollowsTheAngles_data()
    {
        QTest::addColumn<double>("primary");
        QTest::addColumn<double>("secondary");
        QTest::addColumn<double>("x");
        QTest::addColumn<double>("y");
        QTest::addColumn<double>("z");
        QTest::addColumn<int>("right");
        QTest::addColumn<int>("down");
        QTest::newRow("the patient's left is at the right") << 0.0 << 0.0 << -30.0 << 0.0 << 0.0 << 1 << 0;
        QTest::newRow("the head is up") << 0.0 << 0.0 << 0.0 << 0.0 << 30.0 << 0 << -1;
        QTest::newRow("from the left, the face is at the left") << 90.0 << 0.0 << 0.0 << -30.0 << 0.0 << -1 << 0;
        QTest::newRow("cranial, what is in front sinks") << 0.0 << 40.0 << 0.0 << -30.0 << 0.0 << 0 << 1;
    }

    void projectionFollowsTheAngles()
    {
        QFETCH(double, primary);
        QFETCH(double, secondary);
        QFETCH(double, x);
        QFETCH(double, y);
        QFETCH(double, z);
        QFETCH(int, right);
        QFETCH(int, down);
        CArmGeometry geometry;
        geometry.primaryAngle = primary;
        geometry.secondaryAngle = secondary;
        const CArmProjection projection(geometry, {}, size);
        const auto spot = projection.project({x, y, z});
        const double middle = (size - 1) / 2.0;
        const auto sign = [](double value) { return value > 3 ? 1 : value < -3 ? -1 : 0; };
        QCOMPARE(sign(spot.column - middle), right);
        QCOMPARE(sign(spot.row - middle), down);
    }

    void magnificationIsThatOfTheGeometry()
    {
        const CArmGeometry geometry;
        const CArmProjection projection(geometry, {}, size);
        const auto a = projection.project({0, 0, 0});
        const auto b = projection.project({-10, 0, 0});
        const double expected = 10 * geometry.sourceDetectorDistance / geometry.sourceObjectDistance / (geometry.fieldOfView / size);
        QVERIFY(std::abs(b.column - a.column - expected) < 1e-9);
    }

    void tableCarriesThePatient()
    {
        CArmGeometry geometry;
        geometry.table = {20, 0, 0}; // to the patient's right
        const CArmProjection moved(geometry, {}, size);
        const CArmProjection still({}, {}, size);
        QVERIFY(moved.project({0, 0, 0}).column < still.project({0, 0, 0}).column);
    }

    void foreignTreeIsBroughtIntoTheMiddle()
    {
        VesselTree tree = VesselTree::cerebral();
        for (auto& point : tree.points)
            point.position = point.position + Vector{1000, 0, 0};
        const FluoroscopyGenerator source(tree, size, 1);
        QVERIFY(std::abs(source.isocentre().x - 1000) < 30);
        QCOMPARE(generator().isocentre(), Vector{});
    }
};

QTEST_GUILESS_MAIN(FluoroscopyGeneratorTest)
#include "fluoroscopy_generator_test.moc"
