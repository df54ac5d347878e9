// Tests of the part of a picture that is painted: zoomed and panned, what is seen is where the mouse and the measurement take it to be.
#include "imaging/picture_overlay.hpp"
#include "imaging/reference_image_view.hpp"
#include "live_pane.hpp"

#include <QLineF>
#include <QPainter>
#include <QWheelEvent>

using namespace console;
using samples::frameSize;
using samples::LivePane;

namespace {

constexpr QSize paneSize(664, 544);           // the picture stands from (12, 12) to (651, 531)
constexpr QRect green(400, 200, 10, 10);      // in a picture of 640 x 520; in a coarser one it stands at the same place
constexpr QRect greenWhole(412, 212, 10, 10); // in the pane that shows the whole picture
constexpr QRect greenAtTwo(493, 153, 20, 20); // and at zoom 2 about the pane's middle pixel, (331, 271), which is (319, 259) of the picture

/// The square is the only thing with a colour.
QImage withSquare(QSize size, QImage::Format format, const QColor& ground)
{
    QImage image(size, format);
    image.fill(ground);
    const int coarser = frameSize.width() / size.width();
    QPainter painter(&image);
    painter.fillRect(QRect(green.topLeft() / coarser, green.size() / coarser), QColor(0, 255, 0));
    return image;
}

DisplayPicture pictureOf(QSize size, PictureRole role)
{
    DisplayPicture picture;
    picture.about = *samples::frame(1, size, 8, PixelEncoding::Raw);
    picture.role = role;
    picture.window = {128, 256};
    picture.image = withSquare(size, QImage::Format_RGB32, QColor(40, 40, 40));
    return picture;
}

/// What is green by more than half: where an edge is softened, it counts where it is.
QRect greenIn(PictureCanvas& canvas)
{
    const QImage image = canvas.grab().toImage().convertToFormat(QImage::Format_RGB32);
    QRect seen;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (qGreen(image.pixel(x, y)) - qRed(image.pixel(x, y)) > 127)
                seen |= QRect(x, y, 1, 1);
    return seen;
}

/// Where it is instead; empty where it is as expected, to a pixel at each edge.
QString misplaced(const QRect& seen, const QRect& expected)
{
    if (expected.adjusted(-1, -1, 1, 1).contains(seen) && seen.contains(expected.adjusted(1, 1, -1, -1)))
        return {};
    return QStringLiteral("%1,%2 %3x%4").arg(seen.x()).arg(seen.y()).arg(seen.width()).arg(seen.height());
}

/// The live or the reference pane with such a picture.
struct Pane {
    Pane(bool isLive, QSize size)
    {
        DisplayPicture picture = pictureOf(size, isLive ? PictureRole::Live : PictureRole::Hold);
        picture.about.arrival = live.now;
        if (isLive) {
            live.view.showPicture(picture);
        } else {
            reference.resize(paneSize);
            reference.show();
            reference.showPicture(picture);
            canvas = &reference;
        }
        canvas->setDisplay(&display);
    }

    QString misplacedFrom(const QRect& expected) const { return misplaced(greenIn(*canvas), expected); }

    void wheel(int notches, QPoint at) const
    {
        QWheelEvent event(at, canvas->mapToGlobal(at), {}, {0, 120 * notches}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(canvas, &event);
    }

    void drag(Qt::MouseButton button, Qt::KeyboardModifiers modifiers, QPoint by) const
    {
        const QPoint from(300, 250);
        QTest::mousePress(canvas, button, modifiers, from);
        QTest::mouseMove(canvas, from + by);
        QTest::mouseRelease(canvas, button, modifiers, from + by);
    }

    DisplayState display;
    LivePane live;
    ReferenceImageView reference;
    PictureCanvas* canvas = &live.view;
};

void addPanes()
{
    QTest::addColumn<bool>("isLive");
    QTest::addColumn<QSize>("size");
    QTest::newRow("live, pixel for pixel") << true << frameSize;
    QTest::newRow("live, coarser than the pane") << true << frameSize / 2;
    QTest::newRow("reference, pixel for pixel") << false << frameSize;
    QTest::newRow("reference, coarser than the pane") << false << frameSize / 2;
}

} // namespace

class TestShownPart : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void growsAboutTheMiddle_data() { addPanes(); }
    void growsAboutTheMiddle();
    void staysUnderTheMouseThatZooms_data() { addPanes(); }
    void staysUnderTheMouseThatZooms();
    void goesWithTheMouseThatPans_data() { addPanes(); }
    void goesWithTheMouseThatPans();
    void goesAgainstTheKeysThatPan_data() { addPanes(); }
    void goesAgainstTheKeysThatPan();
    void isMeasuredWhereItIsSeen_data() { addPanes(); }
    void isMeasuredWhereItIsSeen();
    void vesselsStayOnTheirPicture();
};

void TestShownPart::growsAboutTheMiddle()
{
    QFETCH(bool, isLive);
    QFETCH(QSize, size);
    const Pane pane(isLive, size);
    QCOMPARE(pane.misplacedFrom(greenWhole), QString());
    pane.canvas->zoomBy(2);
    QCOMPARE(pane.misplacedFrom(greenAtTwo), QString());
    pane.canvas->resetView();
    QCOMPARE(pane.misplacedFrom(greenWhole), QString());
}

void TestShownPart::staysUnderTheMouseThatZooms()
{
    QFETCH(bool, isLive);
    QFETCH(QSize, size);
    const Pane pane(isLive, size);
    pane.wheel(3, {417, 217}); // the square's middle; 1.25³ times as large it is 19.5 pixels wide
    QCOMPARE(pane.misplacedFrom(QRect(407, 207, 20, 20)), QString());
}

void TestShownPart::goesWithTheMouseThatPans()
{
    QFETCH(bool, isLive);
    QFETCH(QSize, size);
    const Pane pane(isLive, size);
    pane.canvas->zoomBy(2);
    pane.drag(Qt::MiddleButton, {}, {-60, 40});
    QCOMPARE(pane.misplacedFrom(QRect(433, 193, 20, 20)), QString());
    pane.drag(Qt::LeftButton, Qt::ShiftModifier, {40, -20});
    QCOMPARE(pane.misplacedFrom(QRect(473, 173, 20, 20)), QString());
    pane.drag(Qt::LeftButton, {}, {40, -20}); // the window's
    QCOMPARE(pane.misplacedFrom(QRect(473, 173, 20, 20)), QString());
}

/// They move the part that is shown: a key to the right shows what is farther to the right.
void TestShownPart::goesAgainstTheKeysThatPan()
{
    QFETCH(bool, isLive);
    QFETCH(QSize, size);
    const Pane pane(isLive, size);
    pane.canvas->zoomBy(2);
    QTest::keyClick(pane.canvas, Qt::Key_6);
    QCOMPARE(pane.misplacedFrom(QRect(453, 153, 20, 20)), QString());
    QTest::keyClick(pane.canvas, Qt::Key_2);
    QCOMPARE(pane.misplacedFrom(QRect(453, 113, 20, 20)), QString());
    QTest::keyClick(pane.canvas, Qt::Key_4);
    QTest::keyClick(pane.canvas, Qt::Key_8);
    QCOMPARE(pane.misplacedFrom(greenAtTwo), QString());
}

void TestShownPart::isMeasuredWhereItIsSeen()
{
    QFETCH(bool, isLive);
    QFETCH(QSize, size);
    Pane pane(isLive, size);
    pane.canvas->zoomBy(2);
    pane.drag(Qt::MiddleButton, {}, {-60, 40});
    const QRect seen = greenIn(*pane.canvas);
    QVERIFY(!seen.isEmpty());
    pane.display.nextMeasureMode();
    QCOMPARE(pane.canvas->measurement().mode(), MeasureMode::Distance);
    QTest::mouseClick(pane.canvas, Qt::LeftButton, {}, seen.topLeft());
    QTest::mouseClick(pane.canvas, Qt::LeftButton, {}, seen.topLeft() + QPoint(seen.width(), 0));
    const std::vector<QPointF>& points = pane.canvas->measurement().points();
    QCOMPARE(points.size(), std::size_t(2));
    const int coarser = frameSize.width() / size.width();
    QVERIFY(QLineF(points[0] * coarser, QPointF(400, 200)).length() < 1);
    QVERIFY(QLineF(points[1] * coarser, QPointF(410, 200)).length() < 1);
}

/// A layer of half as many pixels, over pictures of as many and of twice as many.
void TestShownPart::vesselsStayOnTheirPicture()
{
    for (const QSize size : {frameSize, frameSize / 2}) {
        ReferenceImageView view;
        view.resize(paneSize);
        DisplayPicture picture = pictureOf(size, PictureRole::Roadmap);
        picture.image.fill(qRgb(40, 40, 40));
        view.showPicture(picture);
        view.setVessels(withSquare(frameSize / 2, QImage::Format_ARGB32_Premultiplied, Qt::transparent));
        view.setOpacity(1);
        QCOMPARE(misplaced(greenIn(view), greenWhole), QString());
        view.zoomBy(2);
        QCOMPARE(misplaced(greenIn(view), greenAtTwo), QString());
    }
}

QTEST_MAIN(TestShownPart)
#include "test_shown_part.moc"
