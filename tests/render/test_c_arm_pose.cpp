// Tests of the C-arm's place in space, of the sides of a picture, and of the camera.
#include "imaging/c_arm_pose.hpp"
#include "imaging/display_picture.hpp"
#include "imaging/orbit_camera.hpp"
#include "imaging/picture_overlay.hpp"

#include <QtTest>

#include <limits>

using namespace console;

class TestCArmPose : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void mirrorsThePatientFrame();
    void namesSidesByAngle_data();
    void namesSidesByAngle();
    void putsSourceIsocentreAndDetectorOnOneLine();
    void tableMovesTheCArmTheOtherWay();
    void refusesGeometryThatMakesNoSense_data();
    void refusesGeometryThatMakesNoSense();
    void scalesPixelsToTheIsocentre();
    void choosesRoundScaleBars_data();
    void choosesRoundScaleBars();
    void cameraLooksFromTheFront();
    void cameraStaysUpright();
    void cameraProjectsFocusToTheMiddle();
};

namespace {

bool near(const QVector3D& a, const QVector3D& b) { return (a - b).length() < 1e-3F; }

} // namespace

void TestCArmPose::mirrorsThePatientFrame()
{
    // The patient's right is x of the patient frame; in the scene, as in DICOM, x grows to the left.
    QCOMPARE(sideLetter(toScene({1, 0, 0})), QChar(u'R'));
    QCOMPARE(sideLetter(toScene({0, 1, 0})), QChar(u'P'));
    QCOMPARE(sideLetter(toScene({0, 0, 1})), QChar(u'H'));
}

void TestCArmPose::namesSidesByAngle_data()
{
    QTest::addColumn<double>("primary");
    QTest::addColumn<double>("secondary");
    QTest::addColumn<QString>("letters"); // right edge, top, detector
    QTest::newRow("from the front: the patient's left on the picture's right") << 0.0 << 0.0 << "LHA";
    QTest::newRow("LAO 30") << 30.0 << 0.0 << "LHA";
    QTest::newRow("LAO 90: detector at the left, back on the picture's right") << 90.0 << 0.0 << "PHL";
    QTest::newRow("RAO 90: detector at the right") << -90.0 << 0.0 << "AHR";
    QTest::newRow("from behind") << 180.0 << 0.0 << "RHP";
    QTest::newRow("CRA 30") << 0.0 << 30.0 << "LHA";
    QTest::newRow("CRA 80: detector at the head") << 0.0 << 80.0 << "LPH";
    QTest::newRow("CAU 80: detector at the feet") << 0.0 << -80.0 << "LAF";
}

void TestCArmPose::namesSidesByAngle()
{
    QFETCH(double, primary);
    QFETCH(double, secondary);
    QFETCH(QString, letters);
    const PictureAxes axes = axesOf(primary, secondary);
    QCOMPARE(QString(sideLetter(axes.right)) + sideLetter(axes.up) + sideLetter(axes.beam), letters);
    QVERIFY(near(QVector3D::crossProduct(axes.right, axes.up), axes.beam));
}

void TestCArmPose::putsSourceIsocentreAndDetectorOnOneLine()
{
    const auto pose = poseOf({25, -15, 1100, 750, {300, 200}, {}});
    QVERIFY(pose);
    QCOMPARE(pose->source.length(), 750.0F);
    QCOMPARE(pose->detector.length(), 350.0F);
    QVERIFY(near(pose->source.normalized(), -pose->detector.normalized()));
    QVERIFY(near(pose->corner(1, 0) - pose->corner(-1, 0), pose->axes.right * 300));
    QVERIFY(near(pose->corner(0, 1) - pose->corner(0, -1), pose->axes.up * 200));
}

void TestCArmPose::tableMovesTheCArmTheOtherWay()
{
    const auto still = poseOf({0, 0, 1100, 750, {300, 300}, {}});
    // 10 mm to the patient's right, 20 mm towards the head, 30 mm up, which is to the front of a patient who lies on the back.
    const auto moved = poseOf({0, 0, 1100, 750, {300, 300}, {10, 20, 30}});
    QVERIFY(still && moved);
    QVERIFY(near(moved->source - still->source, -toScene({10, -30, 20})));
    QVERIFY(near(moved->detector - still->detector, -toScene({10, -30, 20})));
}

void TestCArmPose::refusesGeometryThatMakesNoSense_data()
{
    QTest::addColumn<double>("primary");
    QTest::addColumn<double>("sid");
    QTest::addColumn<double>("sod");
    QTest::addColumn<double>("edge");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    QTest::newRow("unknown distances") << 0.0 << 0.0 << 0.0 << 300.0;
    QTest::newRow("object behind the detector") << 0.0 << 900.0 << 950.0 << 300.0;
    QTest::newRow("unknown spacing") << 0.0 << 1100.0 << 750.0 << 0.0;
    QTest::newRow("angle not a number") << nan << 1100.0 << 750.0 << 300.0;
    QTest::newRow("distance not a number") << 0.0 << nan << 750.0 << 300.0;
    QTest::newRow("edge not a number") << 0.0 << 1100.0 << 750.0 << nan;
}

void TestCArmPose::refusesGeometryThatMakesNoSense()
{
    QFETCH(double, primary);
    QFETCH(double, sid);
    QFETCH(double, sod);
    QFETCH(double, edge);
    QVERIFY(poseOf({0, 0, 1100, 750, {300, 300}, {}}));
    QVERIFY(!poseOf({primary, 0, sid, sod, {edge, edge}, {}}));
}

void TestCArmPose::scalesPixelsToTheIsocentre()
{
    XrayFrame frame;
    frame.imagerPixelSpacing = 0.278875;
    frame.geometry.sourceDetectorDistance = 1108;
    frame.geometry.sourceObjectDistance = 811.94;
    const auto size = pixelSizeAtIsocentre(frame);
    QVERIFY(size);
    QVERIFY(std::abs(*size - 0.278875 / (1108 / 811.94)) < 1e-9);
    frame.geometry.sourceObjectDistance = 0;
    QVERIFY(!pixelSizeAtIsocentre(frame));
    frame.geometry.sourceObjectDistance = 811.94;
    frame.imagerPixelSpacing = 0;
    QVERIFY(!pixelSizeAtIsocentre(frame));
}

void TestCArmPose::choosesRoundScaleBars_data()
{
    QTest::addColumn<double>("width");
    QTest::addColumn<double>("length");
    QTest::newRow("a head") << 205.0 << 20.0;
    QTest::newRow("small") << 27.0 << 5.0;
    QTest::newRow("large") << 520.0 << 100.0;
    QTest::newRow("tiny") << 3.0 << 0.5;
    QTest::newRow("nothing") << 0.0 << 0.0;
}

void TestCArmPose::choosesRoundScaleBars()
{
    QFETCH(double, width);
    QFETCH(double, length);
    QCOMPARE(scaleBarLength(width), length);
}

void TestCArmPose::cameraLooksFromTheFront()
{
    OrbitCamera camera;
    camera.rotate(-camera.azimuth(), -camera.elevation());
    QCOMPARE(sideLetter(camera.offset()), QChar(u'A'));
    QCOMPARE(sideLetter(camera.right()), QChar(u'L'));
    QCOMPARE(sideLetter(camera.up()), QChar(u'H'));
    camera.rotate(90, 0);
    QCOMPARE(sideLetter(camera.offset()), QChar(u'L'));
}

void TestCArmPose::cameraStaysUpright()
{
    OrbitCamera camera;
    camera.rotate(1000, 1000);
    QVERIFY(camera.elevation() <= 89);
    QVERIFY(std::abs(camera.azimuth()) <= 180);
    camera.zoom(1e9);
    QVERIFY(camera.distance() >= 60);
    camera.zoom(0);
    camera.zoom(std::numeric_limits<double>::quiet_NaN());
    QVERIFY(camera.distance() >= 60);
    camera.zoom(1e-9);
    QVERIFY(camera.distance() <= 5000);
}

void TestCArmPose::cameraProjectsFocusToTheMiddle()
{
    const OrbitCamera camera;
    QCOMPARE(camera.project({}, {400, 300}), std::optional(QPointF(200, 150)));
    const auto right = camera.project(camera.right() * 50, {400, 300});
    QVERIFY(right && right->x() > 210 && std::abs(right->y() - 150) < 1e-3);
    QVERIFY(!camera.project(camera.offset() * 2, {400, 300}));
    OrbitCamera fitted;
    fitted.fit(80);
    const auto top = fitted.project(fitted.up() * 80, {400, 300});
    QVERIFY(top && top->y() > 0 && top->y() < 20);
}

QTEST_APPLESS_MAIN(TestCArmPose)
#include "test_c_arm_pose.moc"
