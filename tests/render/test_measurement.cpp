// Tests of what is measured on a picture: what its millimetres are of, and when it is forgotten.
#include "imaging/measurement.hpp"
#include "sample_frames.hpp"

#include <QtTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

constexpr QSize frameSize(640, 520);
const Instant start = Instant() + 1h;

// A distance of 20 px on a picture; then the next picture, with the table elsewhere.
struct Measured {
    Measured()
    {
        frame->ageAtArrival = 5ms;
        report({5, 6, 7});
        measurement.setMode(MeasureMode::Distance);
        follow();
        measure();
    }

    void measure()
    {
        measurement.clear();
        measurement.add({100, 100});
        measurement.add({120, 100});
    }

    void report(const std::array<double, 3>& place)
    {
        now += 100ms;
        table.note(place, now);
    }

    void follow()
    {
        frame->arrival = now + 10ms;
        measurement.follow(*frame, table);
    }

    void moveTable(const std::array<double, 3>& place)
    {
        report(place);
        ++frame->frame;
        follow();
    }

    CalibrationKind kind() const { return measurement.calibration().kind; }

    Instant now = start;
    TableRest table;
    std::shared_ptr<XrayFrame> frame = samples::frame(1, frameSize, 12, PixelEncoding::Raw);
    Measurement measurement;
};

} // namespace

class TestMeasurement : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void forgetsInAnotherProjection();
    void forgetsPointsWhenTheTableMoves_data();
    void forgetsPointsWhenTheTableMoves();
    void forgetsCatheterWhenThePatientComesNearerToTheSource();
    void belongsToThePictureThatStands();
    void goesByWhereTheTableStoodInAnOlderPicture();
    void countsBothEndsOfAMovementForAPictureOnTheWay();
    void goesByWhenALatePictureWasTaken_data();
    void goesByWhenALatePictureWasTaken();
    void takesTheFirstReportForThePicturesBefore();
    void noticesATableThatCreeps();
    void calibratesByCatheter();
    void saysWhatALengthIsWorthOffItsPlane_data();
    void saysWhatALengthIsWorthOffItsPlane();
    void takesTheDistanceThatStandsForTheCatheter();
};

void TestMeasurement::forgetsInAnotherProjection()
{
    Measurement measurement;
    measurement.setMode(MeasureMode::Distance);
    const auto frame = samples::frame(1, frameSize, 12, PixelEncoding::Raw);
    measurement.follow(*frame);
    measurement.add({0, 0});
    measurement.add({30, 40});
    frame->frame = 2;
    measurement.follow(*frame);
    QCOMPARE(measurement.pixels(), std::optional(50.0));
    for (const double tremble : {0.01, -0.01, 0.2}) {
        frame->geometry.secondaryAngle = tremble;
        measurement.follow(*frame);
        QVERIFY(!measurement.points().empty());
    }
    frame->geometry.secondaryAngle = 0.6; // from where the points were set, however small each step was
    measurement.follow(*frame);
    QVERIFY(measurement.points().empty());
    measurement.add({0, 0});
    frame->geometry.secondaryAngle = 10;
    measurement.follow(*frame);
    QVERIFY(measurement.points().empty());
    frame->geometry = {};
    measurement.follow(*frame);
    measurement.add({0, 0});
    measurement.add({30, 40});
    QCOMPARE(measurement.text(), QStringLiteral("50 px (uncalibrated)"));
}

void TestMeasurement::forgetsPointsWhenTheTableMoves_data()
{
    QTest::addColumn<double>("lateral");
    QTest::addColumn<double>("longitudinal");
    QTest::addColumn<double>("height");
    QTest::addColumn<bool>("keeps");
    QTest::newRow("sideways") << 3.0 << 6.0 << 7.0 << false;
    QTest::newRow("lengthwise") << 5.0 << 8.0 << 7.0 << false;
    QTest::newRow("up") << 5.0 << 6.0 << 87.0 << false;
    QTest::newRow("no number") << qQNaN() << 6.0 << 7.0 << false;
    QTest::newRow("trembles") << 5.5 << 5.5 << 7.5 << true;
}

void TestMeasurement::forgetsPointsWhenTheTableMoves()
{
    QFETCH(double, lateral);
    QFETCH(double, longitudinal);
    QFETCH(double, height);
    QFETCH(bool, keeps);
    Measured on;
    on.moveTable({lateral, longitudinal, height});
    QCOMPARE(!on.measurement.points().empty(), keeps);
    on.measure();
    on.moveTable({lateral, longitudinal, height}); // what was set there stands there
    QCOMPARE(!on.measurement.points().empty(), !qIsNaN(lateral));
}

/// That is the height while the C-arm is upright, and the side while it is turned by a right angle.
void TestMeasurement::forgetsCatheterWhenThePatientComesNearerToTheSource()
{
    for (const bool turned : {false, true}) {
        Measured on;
        if (turned)
            on.frame->geometry.primaryAngle = 90;
        on.follow();
        on.measure();
        on.measurement.nextCatheter();
        QCOMPARE(on.measurement.calibration(), calibrationBy(4, 20));
        on.moveTable(turned ? std::array<double, 3>{5, 60, 87} : std::array<double, 3>{90, 60, 7.5});
        QVERIFY(on.measurement.points().empty());
        QCOMPARE(on.measurement.calibration(), calibrationBy(4, 20));
        on.measure();
        on.moveTable(turned ? std::array<double, 3>{6.5, 60, 87} : std::array<double, 3>{90, 60, 8.5});
        QCOMPARE(on.kind(), CalibrationKind::Geometry);
    }
}

/// It shows the patient where the table was; the next one does not, also when it was measured on meanwhile.
void TestMeasurement::belongsToThePictureThatStands()
{
    Measured on;
    on.report({5, 6, 87});
    on.measurement.follow(*on.frame, on.table); // drawn anew
    QCOMPARE(on.measurement.pixels(), std::optional(20.0));
    on.measure();
    on.measurement.nextCatheter();
    on.moveTable({5, 6, 87});
    QVERIFY(on.measurement.points().empty());
    QCOMPARE(on.kind(), CalibrationKind::Geometry);
}

/// The pane of the last image also shows pictures of a minute ago.
void TestMeasurement::goesByWhereTheTableStoodInAnOlderPicture()
{
    Measured on;
    const XrayFrame first = *on.frame;
    on.moveTable({5, 6, 7});
    const XrayFrame second = *on.frame;
    on.moveTable({5, 6, 7});
    on.moveTable({5, 6, 87});
    const XrayFrame raised = *on.frame;
    on.measure();
    on.measurement.nextCatheter();
    on.measurement.follow(first, on.table);
    QVERIFY(on.measurement.points().empty());
    QCOMPARE(on.kind(), CalibrationKind::Geometry);
    on.measure();
    on.measurement.nextCatheter();
    on.measurement.follow(second, on.table); // the same place, though the table stands elsewhere now
    QCOMPARE(on.measurement.pixels(), std::optional(20.0));
    QCOMPARE(on.kind(), CalibrationKind::Catheter);
    on.measurement.follow(raised, on.table);
    QVERIFY(on.measurement.points().empty());
    QCOMPARE(on.kind(), CalibrationKind::Geometry);
}

void TestMeasurement::countsBothEndsOfAMovementForAPictureOnTheWay()
{
    Measured on;
    const XrayFrame before = *on.frame;
    on.moveTable({5, 6, 7});
    const XrayFrame onTheWay = *on.frame;
    on.moveTable({5, 6, 87});
    const XrayFrame after = *on.frame;
    for (const XrayFrame& other : {before, after}) {
        on.measurement.follow(onTheWay, on.table);
        on.measure();
        on.measurement.nextCatheter();
        QCOMPARE(on.kind(), CalibrationKind::Catheter);
        on.measurement.follow(other, on.table);
        QVERIFY(on.measurement.points().empty());
        QCOMPARE(on.kind(), CalibrationKind::Geometry);
    }
}

void TestMeasurement::goesByWhenALatePictureWasTaken_data()
{
    QTest::addColumn<int>("ageMs"); // negative: the clocks do not tell
    QTest::addColumn<bool>("keeps");
    QTest::newRow("after the movement") << 5 << true;
    QTest::newRow("before it") << 150 << false;
    QTest::newRow("perhaps before it") << -1 << false;
}

/// It comes behind the report of a movement that it does not show.
void TestMeasurement::goesByWhenALatePictureWasTaken()
{
    QFETCH(int, ageMs);
    QFETCH(bool, keeps);
    Measured on;
    on.report({5, 6, 87});
    ++on.frame->frame;
    on.frame->ageAtArrival = ageMs < 0 ? std::nullopt : std::optional<Duration>(std::chrono::milliseconds(ageMs));
    on.follow();
    on.measure();
    on.measurement.nextCatheter();
    on.frame->ageAtArrival = 5ms;
    on.moveTable({5, 6, 87}); // where the reports had it when that picture came
    QCOMPARE(!on.measurement.points().empty(), keeps);
    QCOMPARE(on.kind(), keeps ? CalibrationKind::Catheter : CalibrationKind::Geometry);
}

void TestMeasurement::takesTheFirstReportForThePicturesBefore()
{
    for (const double height : {7.0, 87.0}) {
        Measured on;
        on.table = {};
        on.measurement = {};
        on.measurement.setMode(MeasureMode::Distance);
        on.follow();
        on.measure();
        on.report({5, 6, 7});
        on.moveTable({5, 6, height});
        QCOMPARE(on.measurement.points().empty(), height > 7);
    }
}

void TestMeasurement::noticesATableThatCreeps()
{
    Measured on;
    for (const double step : {0.5, 0.9}) {
        on.moveTable({5 + step, 6, 7});
        QVERIFY(!on.measurement.points().empty());
    }
    on.moveTable({6.2, 6, 7});
    QVERIFY(on.measurement.points().empty());
}

void TestMeasurement::calibratesByCatheter()
{
    Measurement measurement;
    measurement.setMode(MeasureMode::Distance);
    const auto frame = samples::frame(1, frameSize, 12, PixelEncoding::Raw);
    measurement.follow(*frame);
    measurement.nextCatheter(); // nothing was measured
    QCOMPARE(measurement.calibration().kind, CalibrationKind::Geometry);
    measurement.add({0, 0});
    measurement.add({8, 0});
    for (int french = 4; french <= 8; ++french) {
        measurement.nextCatheter();
        QCOMPARE(measurement.calibration(), calibrationBy(french, 8));
        QCOMPARE(measurement.text(), QStringLiteral("%1 mm (%2 F catheter)").arg(french / 3.0, 0, 'f', 1).arg(french));
    }
    measurement.add({0, 0});
    measurement.add({0, 30});
    QCOMPARE(measurement.text(), QStringLiteral("10.0 mm (8 F catheter)"));
    QVERIFY(!measurement.isCatheter());
    measurement.add({20, 0});
    measurement.add({28, 0});
    QVERIFY(measurement.isCatheter());
    measurement.nextCatheter(); // after the largest there is none
    QCOMPARE(measurement.calibration().kind, CalibrationKind::Geometry);
    QCOMPARE(calibrationBy(8, 0).kind, CalibrationKind::None);
    QCOMPARE(calibrationBy(0, 8).kind, CalibrationKind::None);
    QVERIFY(!angleAt({1, 1}, {1, 1}, {2, 2}));
}

void TestMeasurement::saysWhatALengthIsWorthOffItsPlane_data()
{
    QTest::addColumn<double>("distance"); // SOD, mm
    QTest::addColumn<QString>("said");
    QTest::newRow("usual") << 750.0 << QStringLiteral("object 5 cm nearer or farther: \u2248 7 % off");
    QTest::newRow("near to the source") << 500.0 << QStringLiteral("object 5 cm nearer or farther: \u2248 10 % off");
    QTest::newRow("unknown") << 0.0 << QString();
}

void TestMeasurement::saysWhatALengthIsWorthOffItsPlane()
{
    QFETCH(double, distance);
    QFETCH(QString, said);
    Measurement measurement;
    measurement.setMode(MeasureMode::Distance);
    const auto frame = samples::frame(1, frameSize, 12, PixelEncoding::Raw);
    frame->geometry.sourceObjectDistance = distance;
    measurement.follow(*frame);
    measurement.add({0, 0});
    QCOMPARE(measurement.depthText(), QString()); // of one point
    measurement.add({30, 40});
    QCOMPARE(measurement.depthText(), said);
    measurement.nextCatheter();
    QCOMPARE(measurement.depthText(), QStringLiteral("true in the catheter's plane only"));
    measurement.setMode(MeasureMode::Angle);
    for (const QPointF point : {QPointF(0, 0), QPointF(10, 0), QPointF(10, 10)})
        measurement.add(point);
    QVERIFY(measurement.isComplete());
    QCOMPARE(measurement.depthText(), QString());
}

/// Measured once more, and better; and never of a distance that is not on the screen.
void TestMeasurement::takesTheDistanceThatStandsForTheCatheter()
{
    Measured on;
    for (int french = 4; french <= 6; ++french)
        on.measurement.nextCatheter();
    QCOMPARE(on.measurement.calibration(), calibrationBy(6, 20));
    on.measurement.add({100, 100});
    on.measurement.nextCatheter(); // one point is no distance
    QCOMPARE(on.measurement.calibration(), calibrationBy(6, 20));
    on.measurement.add({124, 100});
    on.measurement.nextCatheter();
    QCOMPARE(on.measurement.calibration(), calibrationBy(4, 24));
    on.measurement.nextCatheter();
    QCOMPARE(on.measurement.calibration(), calibrationBy(5, 24));
    on.measurement.setMode(MeasureMode::Angle);
    on.measurement.add({0, 0});
    on.measurement.add({10, 0});
    on.measurement.add({10, 10});
    on.measurement.nextCatheter();
    QCOMPARE(on.measurement.calibration(), calibrationBy(5, 24));
}

QTEST_APPLESS_MAIN(TestMeasurement)
#include "test_measurement.moc"
