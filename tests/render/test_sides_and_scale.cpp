// Tests of the two marks that a picture is read by: which side of the patient is where, and how many pixels its millimetres are.
#include "gui/shown_texts.hpp"
#include "imaging/c_arm_pose.hpp"
#include "imaging/picture_overlay.hpp"
#include "imaging/reference_image_view.hpp"
#include "live_pane.hpp"

#include <algorithm>
#include <array>
#include <cmath>

using namespace console;
using console::test::ShownText;
using console::test::textsPaintedBy;
using console::test::wordsPaintedBy;
using samples::frameSize;
using samples::LivePane;

namespace {

QFont bodyFont()
{
    QFont font;
    font.setPixelSize(16);
    return font;
}

/// 0.4 mm a pixel in the isocentre's plane: 256 mm x 208 mm.
DisplayPicture pictureOf(PictureRole role, double primaryAngle = 0)
{
    DisplayPicture picture;
    picture.about = *samples::frame(1, frameSize, 8, PixelEncoding::Raw);
    picture.about.imagerPixelSpacing = 0.6;
    picture.about.geometry.sourceObjectDistance = 800;
    picture.about.geometry.sourceDetectorDistance = 1200;
    picture.about.geometry.primaryAngle = primaryAngle;
    picture.role = role;
    picture.window = {128, 256};
    picture.image = QImage(frameSize, QImage::Format_RGB32);
    picture.image.fill(qRgb(40, 40, 40));
    return picture;
}

/// One of each kind; the picture stands from (12, 12) to (651, 531), pixel for pixel.
struct Panes {
    explicit Panes(double primaryAngle = 0)
    {
        DisplayPicture newest = pictureOf(PictureRole::Live, primaryAngle);
        newest.about.arrival = live.now;
        live.view.showPicture(newest);
        reference.resize(frameSize + QSize(2 * hatchWidth, 2 * hatchWidth));
        reference.showPicture(pictureOf(PictureRole::Hold, primaryAngle));
    }

    LivePane live;
    ReferenceImageView reference;
    std::array<PictureCanvas*, 2> all{&live.view, &reference};
};

/// Where that and nothing else is written; far away when it is not.
QPointF placeOf(PictureCanvas& canvas, const QString& letter)
{
    for (const ShownText& shown : textsPaintedBy(canvas))
        if (shown.text == letter)
            return shown.ink.center();
    return {-1000, -1000};
}

/// In pixels: the longest unbroken row of the ink's colour in the lower half. No letter has one like it.
int barPaintedBy(PictureCanvas& canvas)
{
    const QImage image = canvas.grab().toImage().convertToFormat(QImage::Format_RGB32);
    int longest = 0;
    for (int y = image.height() / 2; y < image.height(); ++y)
        for (int x = 0, run = 0; x < image.width(); ++x) {
            run = image.pixel(x, y) == pane_colours::text.rgb() ? run + 1 : 0;
            longest = std::max(longest, run);
        }
    return longest;
}

} // namespace

class TestSidesAndScale : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void eachSideIsAtItsEdge_data();
    void eachSideIsAtItsEdge();
    void panesPaintEachSideAtItsEdge_data();
    void panesPaintEachSideAtItsEdge();
    void barIsAsLongAsItsLabelSays_data();
    void barIsAsLongAsItsLabelSays();
    void barFollowsTheZoomOfItsPane_data();
    void barFollowsTheZoomOfItsPane();
};

void TestSidesAndScale::eachSideIsAtItsEdge_data()
{
    QTest::addColumn<double>("primary");
    QTest::addColumn<double>("secondary");
    QTest::addColumn<QString>("left");
    QTest::addColumn<QString>("right");
    QTest::newRow("from the front, as one faces the patient") << 0.0 << 0.0 << "R"
                                                              << "L";
    QTest::newRow("LAO 30") << 30.0 << 0.0 << "R"
                            << "L";
    QTest::newRow("RAO 30") << -30.0 << 0.0 << "R"
                            << "L";
    QTest::newRow("CRA 30") << 0.0 << 30.0 << "R"
                            << "L";
    QTest::newRow("CAU 30") << 0.0 << -30.0 << "R"
                            << "L";
    QTest::newRow("LAO 60: more from the side than from the front") << 60.0 << 0.0 << "A"
                                                                    << "P";
    QTest::newRow("LAO 90: from the patient's left, who faces the picture's left") << 90.0 << 0.0 << "A"
                                                                                   << "P";
    QTest::newRow("RAO 90: from the patient's right") << -90.0 << 0.0 << "P"
                                                      << "A";
    QTest::newRow("from behind") << 180.0 << 0.0 << "L"
                                 << "R";
}

void TestSidesAndScale::eachSideIsAtItsEdge()
{
    QFETCH(double, primary);
    QFETCH(double, secondary);
    QFETCH(QString, left);
    QFETCH(QString, right);
    DisplayPicture picture = pictureOf(PictureRole::Live, primary);
    picture.about.geometry.secondaryAngle = secondary;
    TextPlates plates(bodyFont());
    placeSides(plates, QRect(100, 50, 640, 520), picture);
    QCOMPARE(plates.plates().size(), std::size_t(2));
    const bool inOrder = plates.plates().front().rect.left() < plates.plates().back().rect.left();
    const OverlayPlate& atLeft = inOrder ? plates.plates().front() : plates.plates().back();
    const OverlayPlate& atRight = inOrder ? plates.plates().back() : plates.plates().front();
    QCOMPARE(atLeft.text, left);
    QCOMPARE(atRight.text, right);
    // Half a letter of text from the edges, which are at 100 and 739, and half-way down from 50 to 569.
    QCOMPARE(atLeft.rect.left(), 108);
    QCOMPARE(atRight.rect.right(), 731);
    QVERIFY(std::abs(atLeft.rect.center().y() - 309) <= 1);
    QVERIFY(std::abs(atRight.rect.center().y() - 309) <= 1);
    // At the top is the head, at the bottom are the feet, which nobody writes there.
    QCOMPARE(sideLetter(axesOf(primary, secondary).up), QChar(u'H'));
    QCOMPARE(sideLetter(-axesOf(primary, secondary).up), QChar(u'F'));
}

void TestSidesAndScale::panesPaintEachSideAtItsEdge_data()
{
    QTest::addColumn<double>("primary");
    QTest::addColumn<QString>("left");
    QTest::addColumn<QString>("right");
    QTest::newRow("from the front") << 0.0 << "R"
                                    << "L";
    QTest::newRow("from the side") << 90.0 << "A"
                                   << "P";
}

void TestSidesAndScale::panesPaintEachSideAtItsEdge()
{
    QFETCH(double, primary);
    QFETCH(QString, left);
    QFETCH(QString, right);
    Panes panes(primary);
    for (PictureCanvas* canvas : panes.all) {
        const QPointF atLeft = placeOf(*canvas, left);
        const QPointF atRight = placeOf(*canvas, right);
        QVERIFY2(atLeft.x() > 12 && atLeft.x() < 72, qPrintable(canvas->accessibleName()));
        QVERIFY2(atRight.x() > 592 && atRight.x() < 652, qPrintable(canvas->accessibleName()));
        QVERIFY2(std::abs(atLeft.y() - 272) < 15 && std::abs(atRight.y() - 272) < 15, qPrintable(canvas->accessibleName()));
    }
}

void TestSidesAndScale::barIsAsLongAsItsLabelSays_data()
{
    QTest::addColumn<double>("spacing"); // mm at the detector
    QTest::addColumn<double>("sourceObject");
    QTest::addColumn<double>("sourceDetector");
    QTest::addColumn<int>("columns");
    QTest::addColumn<int>("onScreen"); // pixels
    QTest::addColumn<double>("shown"); // of the picture's width
    QTest::addColumn<QString>("millimetres");
    QTest::addColumn<int>("bar"); // pixels on the screen
    QTest::newRow("0.4 mm a pixel") << 0.6 << 800.0 << 1200.0 << 640 << 640 << 1.0 << "50" << 125;
    QTest::newRow("half of it is shown: 0.2 mm") << 0.6 << 800.0 << 1200.0 << 640 << 640 << 0.5 << "20" << 100;
    QTest::newRow("an eighth of it: 0.05 mm") << 0.6 << 800.0 << 1200.0 << 640 << 640 << 0.125 << "5" << 100;
    QTest::newRow("twice as large on the screen") << 0.6 << 800.0 << 1200.0 << 640 << 1280 << 1.0 << "50" << 250;
    QTest::newRow("a small pane") << 0.6 << 800.0 << 1200.0 << 640 << 256 << 1.0 << "50" << 50;
    QTest::newRow("half of it in a small pane") << 0.6 << 800.0 << 1200.0 << 640 << 256 << 0.5 << "20" << 40;
    QTest::newRow("nearer to the source: 0.3 mm") << 0.6 << 600.0 << 1200.0 << 640 << 640 << 1.0 << "20" << 67;
    QTest::newRow("smaller pixels: 0.2 mm") << 0.3 << 800.0 << 1200.0 << 640 << 640 << 1.0 << "20" << 100;
    QTest::newRow("fewer of them") << 0.6 << 800.0 << 1200.0 << 320 << 640 << 1.0 << "20" << 100;
    QTest::newRow("as most pictures: 0.2045 mm") << 0.3 << 750.0 << 1100.0 << 640 << 640 << 1.0 << "20" << 98;
}

void TestSidesAndScale::barIsAsLongAsItsLabelSays()
{
    QFETCH(double, spacing);
    QFETCH(double, sourceObject);
    QFETCH(double, sourceDetector);
    QFETCH(int, columns);
    QFETCH(int, onScreen);
    QFETCH(double, shown);
    QFETCH(QString, millimetres);
    QFETCH(int, bar);
    DisplayPicture picture = pictureOf(PictureRole::Live);
    picture.about.imagerPixelSpacing = spacing;
    picture.about.geometry.sourceObjectDistance = sourceObject;
    picture.about.geometry.sourceDetectorDistance = sourceDetector;
    picture.about.columns = columns;
    TextPlates plates(bodyFont());
    const QRect where(100, 50, onScreen, 520);
    const QRect placed = placeScale(plates, where, picture, shown);
    QCOMPARE(plates.plates().size(), std::size_t(1));
    const OverlayPlate& label = plates.plates().front();
    QVERIFY2(label.text.startsWith(millimetres + QStringLiteral(" mm @ isocentre")), qPrintable(label.text));
    QCOMPARE(placed.width(), bar);
    // Above its label in the lower right corner.
    QCOMPARE(label.rect.bottomRight(), QPoint(100 + onScreen - 1 - 8, 569 - 8));
    QCOMPARE(placed.right(), label.rect.right());
    QVERIFY(placed.bottom() < label.rect.top());
    QVERIFY(where.contains(placed));
}

void TestSidesAndScale::barFollowsTheZoomOfItsPane_data()
{
    QTest::addColumn<double>("zoom");
    QTest::addColumn<QString>("millimetres");
    QTest::addColumn<int>("bar"); // pixels
    QTest::newRow("whole: 0.4 mm a pixel") << 1.0 << "50" << 125;
    QTest::newRow("1.6: 0.25 mm") << 1.6 << "20" << 80;
    QTest::newRow("2: 0.2 mm") << 2.0 << "20" << 100;
    QTest::newRow("4: 0.1 mm") << 4.0 << "10" << 100;
    QTest::newRow("8: 0.05 mm") << 8.0 << "5" << 100;
}

void TestSidesAndScale::barFollowsTheZoomOfItsPane()
{
    QFETCH(double, zoom);
    QFETCH(QString, millimetres);
    QFETCH(int, bar);
    Panes panes;
    const QString zoomed = QStringLiteral("ZOOM %1\u00D7").arg(zoom, 0, 'f', 1);
    for (PictureCanvas* canvas : panes.all) {
        canvas->zoomBy(zoom);
        QCOMPARE(barPaintedBy(*canvas), bar);
        const QString words = wordsPaintedBy(*canvas);
        QVERIFY2(words.contains(millimetres + QStringLiteral(" mm @ isocentre plane (geometry)")), qPrintable(words));
        QVERIFY2(words.contains(QStringLiteral("ZOOM")) == (zoom > 1), qPrintable(words));
        QVERIFY2(words.contains(zoomed) == (zoom > 1), qPrintable(words));
    }
}

QTEST_MAIN(TestSidesAndScale)
#include "test_sides_and_scale.moc"
