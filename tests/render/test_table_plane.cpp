// Tests of lengths in a plane above the table: DICOM's model with numbers by hand, and when there is no length at all.
#include "imaging/measurement.hpp"
#include "sample_frames.hpp"

#include <QtTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

const Instant start = Instant() + 1h;

/// SID 1100, SOD 750, 0.3 mm at the detector.
std::shared_ptr<XrayFrame> frameFrom(double primary, double secondary)
{
    auto frame = samples::frame(1, {640, 520}, 12, PixelEncoding::Raw);
    frame->geometry.primaryAngle = primary;
    frame->geometry.secondaryAngle = secondary;
    return frame;
}

bool near(double a, double b) { return std::abs(a - b) < 1e-6; }

/// 50 px in the plane 10 cm above a table whose top is 17 cm below the isocentre at height 0; it is at height 20 mm.
struct Measured {
    Measured()
    {
        frame->ageAtArrival = 5ms;
        measurement.setMode(MeasureMode::Distance);
        measurement.setPlane({100, 170});
        report(20);
        follow();
        measure();
    }

    void report(double height)
    {
        now += 100ms;
        table.note({5, 6, height}, now);
    }

    /// Another picture, this long after the last report.
    void follow(Duration late = 10ms)
    {
        ++frame->frame;
        frame->arrival = now + late;
        again();
    }

    void again() { measurement.follow(*frame, table); }

    void measure()
    {
        measurement.clear();
        measurement.add({100, 100});
        measurement.add({150, 100});
    }

    TablePlaneFault fault() const { return measurement.calibration().fault; }

    Instant now = start;
    TableRest table;
    std::shared_ptr<XrayFrame> frame = frameFrom(0, 0);
    Measurement measurement;
};

const QString none = QStringLiteral("50 px (uncalibrated: no table plane)");
const QString heightUnknown = QStringLiteral("the table's height in this picture is unknown");

} // namespace

class TestTablePlane : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void followsTheModel_data();
    void followsTheModel();
    void refusesWhatTheModelDoesNotCover_data();
    void refusesWhatTheModelDoesNotCover();
    void isocentrePlaneHasNoLimitOfAngle();
    void goesThroughTheHeightsAndBack();
    void saysThePlaneItWasComputedFor();
    void followsTableAndCArm();
    void saysWhyThereIsNoPlane();
    void needsTheTablesHeightInThePicture();
    void catheterGoesBefore();
};

void TestTablePlane::followsTheModel_data()
{
    QTest::addColumn<double>("primary");
    QTest::addColumn<double>("secondary");
    QTest::addColumn<double>("tableTop");
    QTest::addColumn<double>("object");
    QTest::addColumn<double>("distance");
    QTest::newRow("upright") << 0.0 << 0.0 << 150.0 << 100.0 << 700.0;
    QTest::newRow("object in the isocentre") << 0.0 << 0.0 << 100.0 << 100.0 << 750.0;
    QTest::newRow("above it") << 0.0 << 0.0 << 70.0 << 100.0 << 780.0;
    QTest::newRow("table above it") << 0.0 << 0.0 << -20.0 << 50.0 << 820.0;
    QTest::newRow("LAO 30") << 30.0 << 0.0 << 150.0 << 100.0 << 692.264973; // 750 - 50 / 0.866025
    QTest::newRow("RAO 30") << -30.0 << 0.0 << 150.0 << 100.0 << 692.264973;
    QTest::newRow("CAU 20") << 0.0 << -20.0 << 150.0 << 100.0 << 696.791111;        // 750 - 50 / 0.939693
    QTest::newRow("LAO 30 CRA 20") << 30.0 << 20.0 << 150.0 << 100.0 << 688.559668; // 750 - 50 / 0.813798
    QTest::newRow("LAO 60, the limit") << 60.0 << 0.0 << 150.0 << 100.0 << 650.0;   // 750 - 50 / 0.5
    QTest::newRow("RAO 60") << -60.0 << 0.0 << 150.0 << 100.0 << 650.0;
    QTest::newRow("45 and 45 are 60") << 45.0 << 45.0 << 150.0 << 100.0 << 650.0;
    QTest::newRow("just before the source") << 0.0 << 0.0 << 849.0 << 100.0 << 1.0;
    QTest::newRow("just before the detector") << 0.0 << 0.0 << -249.0 << 100.0 << 1099.0;
}

void TestTablePlane::followsTheModel()
{
    QFETCH(double, primary);
    QFETCH(double, secondary);
    QFETCH(double, tableTop);
    QFETCH(double, object);
    QFETCH(double, distance);
    const TablePlane plane = tablePlaneOf(*frameFrom(primary, secondary), tableTop, object);
    QCOMPARE(plane.fault, TablePlaneFault::None);
    QVERIFY2(near(plane.distance, distance), qPrintable(QString::number(plane.distance, 'f', 6)));
    QVERIFY(near(plane.pixelSize, 0.3 * distance / 1100));
}

void TestTablePlane::refusesWhatTheModelDoesNotCover_data()
{
    QTest::addColumn<double>("primary");
    QTest::addColumn<double>("secondary");
    QTest::addColumn<double>("sid");
    QTest::addColumn<double>("tableTop");
    QTest::addColumn<double>("object");
    QTest::addColumn<TablePlaneFault>("fault");
    using enum TablePlaneFault;
    QTest::newRow("LAO 60.1") << 60.1 << 0.0 << 1100.0 << 150.0 << 100.0 << TooOblique;
    QTest::newRow("RAO 60.1") << -60.1 << 0.0 << 1100.0 << 150.0 << 100.0 << TooOblique;
    QTest::newRow("CRA 75") << 0.0 << 75.0 << 1100.0 << 150.0 << 100.0 << TooOblique;
    QTest::newRow("45 and 46") << 45.0 << 46.0 << 1100.0 << 150.0 << 100.0 << TooOblique;
    QTest::newRow("from the side") << 90.0 << 0.0 << 1100.0 << 150.0 << 100.0 << TooOblique;
    QTest::newRow("from above") << 180.0 << 0.0 << 1100.0 << 150.0 << 100.0 << SourceAbove;
    QTest::newRow("obliquely from above") << -150.0 << 10.0 << 1100.0 << 150.0 << 100.0 << SourceAbove;
    QTest::newRow("in the source") << 0.0 << 0.0 << 1100.0 << 850.0 << 100.0 << OutsideBeam;
    QTest::newRow("behind the source") << 0.0 << 0.0 << 1100.0 << 900.0 << 100.0 << OutsideBeam;
    QTest::newRow("in the detector") << 0.0 << 0.0 << 1100.0 << -250.0 << 100.0 << OutsideBeam;
    QTest::newRow("no table top") << 0.0 << 0.0 << 1100.0 << qQNaN() << 100.0 << HeightUnknown;
    QTest::newRow("table top nowhere") << 0.0 << 0.0 << 1100.0 << qInf() << 100.0 << HeightUnknown;
    QTest::newRow("no object") << 0.0 << 0.0 << 1100.0 << 150.0 << qQNaN() << HeightUnknown;
    QTest::newRow("no SID") << 0.0 << 0.0 << 0.0 << 150.0 << 100.0 << GeometryUnknown;
    QTest::newRow("SID is no number") << 0.0 << 0.0 << qQNaN() << 150.0 << 100.0 << GeometryUnknown;
    QTest::newRow("angle is no number") << qQNaN() << 0.0 << 1100.0 << 150.0 << 100.0 << GeometryUnknown;
}

void TestTablePlane::refusesWhatTheModelDoesNotCover()
{
    QFETCH(double, primary);
    QFETCH(double, secondary);
    QFETCH(double, sid);
    QFETCH(double, tableTop);
    QFETCH(double, object);
    QFETCH(TablePlaneFault, fault);
    const auto frame = frameFrom(primary, secondary);
    frame->geometry.sourceDetectorDistance = sid;
    const TablePlane plane = tablePlaneOf(*frame, tableTop, object);
    QCOMPARE(plane.fault, fault);
    QCOMPARE(plane.pixelSize, 0.0);
    QCOMPARE(plane.distance, 0.0);
}

void TestTablePlane::isocentrePlaneHasNoLimitOfAngle()
{
    for (const double primary : {0.0, 60.1, 90.0, 180.0})
        QVERIFY(near(pixelSizeAtIsocentre(*frameFrom(primary, 0)).value_or(0), 0.3 * 750 / 1100));
}

void TestTablePlane::goesThroughTheHeightsAndBack()
{
    DisplayState display;
    QVERIFY(!display.plane().object);
    for (const std::optional<int> height : {std::optional(100), std::optional(125), std::optional(150), std::optional(50),
                                            std::optional(75), std::optional<int>(), std::optional(100)}) {
        display.nextPlane();
        QCOMPARE(display.plane().object, height);
    }
    display.nextPlane();
    display.setTable(170, 100); // as it was usual before: a person's choice stays
    QCOMPARE(display.plane(), (MeasurePlane{125, 170}));
    display.setTable(170, 150);
    QCOMPARE(display.plane(), (MeasurePlane{150, 170}));
    display.setTable({}, 75);
    QCOMPARE(display.plane(), (MeasurePlane{75, {}}));
}

void TestTablePlane::saysThePlaneItWasComputedFor()
{
    Measured on;
    QCOMPARE(on.measurement.text(), QStringLiteral("9.5 mm @ table plane + 10.0 cm (geometry)")); // 50 x 0.3 x 700 / 1100
    QCOMPARE(on.measurement.depthText(), QStringLiteral("object 5 cm nearer or farther: \u2248 7 % off"));
    on.measurement.setPlane({125, 170});
    QCOMPARE(on.measurement.text(), QStringLiteral("9.9 mm @ table plane + 12.5 cm (geometry)")); // SOD 725
    on.measurement.setPlane({{}, 170});
    QCOMPARE(on.measurement.text(), QStringLiteral("10.2 mm @ isocentre plane (geometry)")); // 50 x 0.3 x 750 / 1100
    QCOMPARE(planeText({75, 170}), QStringLiteral("lengths by geometry: table plane + 7.5 cm"));
    QCOMPARE(planeText({}), QStringLiteral("lengths by geometry: isocentre plane"));
}

void TestTablePlane::followsTableAndCArm()
{
    Measured on;
    on.report(20.6); // less than clears the points
    on.follow();
    QVERIFY(near(on.measurement.calibration().distance, 700.6));
    QVERIFY(!on.measurement.text().isEmpty());
    on.report(100);
    on.follow();
    QVERIFY(on.measurement.points().empty());
    on.measure();
    QCOMPARE(on.measurement.text(), QStringLiteral("10.6 mm @ table plane + 10.0 cm (geometry)")); // SOD 780
    on.report(20);
    on.frame->geometry.primaryAngle = 30;
    on.follow();
    QVERIFY(on.measurement.points().empty());
    on.measure();
    QCOMPARE(on.measurement.text(), QStringLiteral("9.4 mm @ table plane + 10.0 cm (geometry)")); // SOD 692.26
    on.frame->geometry.primaryAngle = 75;
    on.follow();
    on.measure();
    QCOMPARE(on.measurement.text(), none);
    QCOMPARE(on.measurement.depthText(), QStringLiteral("the beam is more than 60\u00B0 from upright"));
}

void TestTablePlane::saysWhyThereIsNoPlane()
{
    Measured on;
    on.measurement.setPlane({100, {}});
    QCOMPARE(on.measurement.text(), none);
    QCOMPARE(on.measurement.depthText(), QStringLiteral("the table's top is not set up in the preferences"));
    on.measurement.setPlane({100, 950});
    QCOMPARE(on.measurement.text(), none);
    QCOMPARE(on.measurement.depthText(), QStringLiteral("the plane is not between source and detector"));
    on.measurement.setPlane({100, 170});
    on.frame->geometry.primaryAngle = 180;
    on.follow();
    on.measure();
    QCOMPARE(on.measurement.text(), none);
    QCOMPARE(on.measurement.depthText(), QStringLiteral("the X-ray source is above the table"));
    on.frame->geometry = {};
    on.follow();
    on.measure();
    QCOMPARE(on.measurement.text(), none);
    QCOMPARE(on.measurement.depthText(), QStringLiteral("the picture's geometry is unknown"));
    on.measurement.setPlane({});
    QCOMPARE(on.measurement.text(), QStringLiteral("50 px (uncalibrated)"));
    QCOMPARE(on.measurement.depthText(), QString());
}

/// Not of before, not of later, not on its way, and not what is reported beside a recorded run.
void TestTablePlane::needsTheTablesHeightInThePicture()
{
    Measured on;
    on.follow(501ms); // reports stay away
    QCOMPARE(on.measurement.text(), none);
    QCOMPARE(on.measurement.depthText(), heightUnknown);
    on.now += 1s;
    on.report(20);
    on.again(); // it may have gone and come back
    QCOMPARE(on.fault(), TablePlaneFault::HeightUnknown);

    on.follow();
    QCOMPARE(on.fault(), TablePlaneFault::None);
    on.report(25);
    on.again(); // perhaps it was taken while the table went
    QCOMPARE(on.measurement.text(), none);
    on.follow();
    QCOMPARE(on.fault(), TablePlaneFault::None);

    on.report(qQNaN());
    on.follow();
    QCOMPARE(on.fault(), TablePlaneFault::HeightUnknown);

    Measured recorded;
    recorded.frame->source = PictureSource::Recorded;
    recorded.follow();
    QCOMPARE(recorded.measurement.text(), none);
    QCOMPARE(recorded.measurement.depthText(), heightUnknown);

    Measured before;
    before.table = {};
    before.follow();
    QCOMPARE(before.fault(), TablePlaneFault::HeightUnknown);
    before.now += 10s; // that long after the picture, nobody knows where it was
    before.report(20);
    before.again();
    QCOMPARE(before.fault(), TablePlaneFault::HeightUnknown);
}

void TestTablePlane::catheterGoesBefore()
{
    Measured on;
    on.measurement.nextCatheter();
    QCOMPARE(on.measurement.calibration(), calibrationBy(4, 50));
    QCOMPARE(on.measurement.text(), QStringLiteral("1.3 mm (4 F catheter)"));
}

QTEST_APPLESS_MAIN(TestTablePlane)
#include "test_table_plane.moc"
