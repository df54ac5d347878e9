// Tests of the live picture, pixel by pixel: what was sent is what is shown, and where something lacks, that is what is said.
#include "imaging/picture_overlay.hpp"
#include "imaging/reference_image_view.hpp"
#include "live_pane.hpp"

#include <turbojpeg.h>

#include <QSignalSpy>

using namespace console;
using samples::differingPixels;
using samples::forEachPicturePixel;
using samples::frameSize;
using samples::LivePane;

namespace {

std::vector<std::uint16_t> decodedJpeg(const XrayFrame& frame)
{
    const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
    std::vector<unsigned char> grey(static_cast<std::size_t>(frame.rows) * static_cast<std::size_t>(frame.columns));
    if (tjDecompress2(decoder.get(), reinterpret_cast<const unsigned char*>(frame.pixels.data()),
                      static_cast<unsigned long>(frame.pixels.size()), grey.data(), frame.columns, frame.columns, frame.rows, TJPF_GRAY,
                      TJFLAG_ACCURATEDCT) != 0)
        return {};
    return {grey.begin(), grey.end()};
}

int pixelsOf(const QImage& image, const QColor& colour)
{
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            count += image.pixel(x, y) == colour.rgb() ? 1 : 0;
    return count;
}

} // namespace

class TestLiveImage : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void showsExactlyWhatWasSent_data();
    void showsExactlyWhatWasSent();
    void keepsTheShapeOfThePicture();
    void showsNoScaleAndNoSidesWithoutGeometry();
    void showsHonestTextWithoutPicture();
    void showsRefusalUntilNextPicture();
    void saysTheWholeOfARefusal();
    void saysWhatAReducedPictureLost_data();
    void saysWhatAReducedPictureLost();
    void saysBelowALengthWhatItIsWorth();
    void saysCalibratedOnTheMeasuredScreenOnly();
};

void TestLiveImage::showsExactlyWhatWasSent_data()
{
    QTest::addColumn<int>("bits");
    QTest::addColumn<int>("encoding");
    QTest::addColumn<int>("quality");
    QTest::addColumn<int>("centre");
    QTest::addColumn<int>("width");
    QTest::addColumn<bool>("inverted");
    const int raw = static_cast<int>(PixelEncoding::Raw);
    const int jpegLs = static_cast<int>(PixelEncoding::JpegLs);
    const int jpeg = static_cast<int>(PixelEncoding::Jpeg);
    QTest::newRow("8 bits, raw") << 8 << raw << 0 << 128 << 256 << false;
    QTest::newRow("8 bits, raw, narrow window") << 8 << raw << 0 << 90 << 41 << false;
    QTest::newRow("8 bits, jpeg-ls") << 8 << jpegLs << 0 << 128 << 200 << false;
    QTest::newRow("8 bits, jpeg") << 8 << jpeg << 90 << 128 << 200 << false;
    QTest::newRow("12 bits, raw") << 12 << raw << 0 << 2048 << 4096 << false;
    QTest::newRow("12 bits, jpeg-ls") << 12 << jpegLs << 0 << 1500 << 1001 << false;
    QTest::newRow("12 bits, jpeg-ls, MONOCHROME1") << 12 << jpegLs << 0 << 1500 << 1001 << true;
    QTest::newRow("16 bits, raw") << 16 << raw << 0 << 32768 << 65536 << false;
    QTest::newRow("16 bits, jpeg-ls") << 16 << jpegLs << 0 << 30000 << 12345 << false;
}

void TestLiveImage::showsExactlyWhatWasSent()
{
    QFETCH(int, bits);
    QFETCH(int, encoding);
    QFETCH(int, quality);
    QFETCH(int, centre);
    QFETCH(int, width);
    QFETCH(bool, inverted);
    LivePane pane;
    const auto frame = samples::frame(1, frameSize, bits, static_cast<PixelEncoding>(encoding), quality);
    frame->windowCentre = centre;
    frame->windowWidth = width;
    frame->photometric = inverted ? Photometric::Monochrome1 : Photometric::Monochrome2;
    QVERIFY(pane.send(frame));
    const QImage shown = pane.grab();
    QCOMPARE(pane.view.pictureRect().size(), frameSize);
    const auto values = frame->encoding == PixelEncoding::Jpeg ? decodedJpeg(*frame) : samples::storedValues(frameSize, bits);
    int wrong = 0;
    const int compared = forEachPicturePixel(pane, [&](int x, int y, int column, int row) {
        const int grey = samples::linearGrey(values[static_cast<std::size_t>(row * frameSize.width() + column)], centre, width);
        const int expected = inverted ? 255 - grey : grey;
        wrong += shown.pixel(x, y) != qRgb(expected, expected, expected) ? 1 : 0;
    });
    QCOMPARE(wrong, 0);
    QVERIFY(compared > frameSize.width() * frameSize.height() * 8 / 10);
}

void TestLiveImage::keepsTheShapeOfThePicture()
{
    LivePane pane;
    QVERIFY(pane.send(1));
    pane.view.resize(900, 500);
    const QRect area = pane.view.pictureRect();
    QVERIFY(pane.view.rect().adjusted(hatchWidth, hatchWidth, -hatchWidth, -hatchWidth).contains(area));
    const double shape = static_cast<double>(area.width()) / area.height();
    QVERIFY(std::abs(shape - 640.0 / 520.0) < 0.01);
    pane.view.resize(300, 900);
    QCOMPARE(pane.view.pictureRect().width(), 300 - 2 * hatchWidth);
}

void TestLiveImage::showsNoScaleAndNoSidesWithoutGeometry()
{
    LivePane pane;
    QVERIFY(pane.send(1));
    const QImage known = pane.grab();
    const auto frame = samples::frame(2, frameSize, 12, PixelEncoding::Raw);
    frame->geometry = {};
    QVERIFY(pane.send(frame));
    const QImage unknown = pane.grab();
    const QRect area = pane.view.pictureRect();
    const QRect rightEdge(area.right() - 40, area.center().y() - 20, 40, 40);
    QVERIFY(differingPixels(known, unknown, rightEdge) > 0);
    // Where the letter stood, there is the picture.
    const auto values = samples::storedValues(frameSize, 12);
    const QPoint inside = rightEdge.center() - area.topLeft();
    const int grey = samples::linearGrey(values[static_cast<std::size_t>(inside.y() * frameSize.width() + inside.x())], 2048, 4096);
    QCOMPARE(unknown.pixel(rightEdge.center()), qRgb(grey, grey, grey));
}

void TestLiveImage::showsHonestTextWithoutPicture()
{
    LivePane pane;
    const QImage empty = pane.grab();
    QCOMPARE(pane.view.accessibleName(), QStringLiteral("Live X-ray image"));
    QCOMPARE(pane.view.accessibleDescription(), QStringLiteral("No picture yet."));
    QVERIFY(pane.view.pictureRect().isEmpty());
    int textPixels = 0;
    for (int y = 100; y < empty.height() - 100; ++y)
        for (int x = 20; x < empty.width() - 20; ++x)
            textPixels += qGray(empty.pixel(x, y)) > 120 ? 1 : 0;
    QVERIFY(textPixels > 100);
}

void TestLiveImage::showsRefusalUntilNextPicture()
{
    LivePane pane;
    QVERIFY(pane.send(1));
    const QImage good = pane.grab();
    QSignalSpy refusals(&pane.pipeline, &FramePipeline::pictureRefused);
    pane.pipeline.showFrame(samples::withBytes(*samples::frame(2, frameSize, 12, PixelEncoding::Raw), std::vector<std::byte>(3)));
    QTRY_COMPARE(refusals.count(), 1);
    const QImage refused = pane.grab();
    QVERIFY(differingPixels(good, refused, pane.view.pictureRect()) > 0);
    QCOMPARE(pane.state.paintedCount(), quint64(1));
    const QRegion marks = pane.view.overlayRegion();
    QVERIFY(pane.send(3));
    pane.grab();
    QVERIFY(!(marks - pane.view.overlayRegion()).isEmpty());
}

/// In as many rows as it needs: none over what stands at the foot, and what is told of a button above them.
void TestLiveImage::saysTheWholeOfARefusal()
{
    LivePane pane;
    QVERIFY(pane.send(1));
    pane.grab();
    const QRegion usual = pane.view.overlayRegion();
    const auto added = [&] {
        pane.grab();
        return (pane.view.overlayRegion() - usual).boundingRect();
    };
    pane.view.showRefusal(2, QStringLiteral("short"));
    const QRect one = added();
    QVERIFY(!one.isEmpty() && !usual.intersects(one));
    pane.view.showRefusal(2, QStringLiteral("the reason is a long one ").repeated(6));
    const QRect many = added();
    QVERIFY(many.height() > 3 * one.height() / 2);
    QCOMPARE(many.bottom(), one.bottom());
    QVERIFY(pane.view.pictureRect().contains(many) && !usual.intersects(many));
    pane.view.tell(QStringLiteral("picture saved"));
    pane.grab();
    const QRegion told = pane.view.overlayRegion() - usual - many;
    QVERIFY(!told.isEmpty());
    QVERIFY(told.boundingRect().bottom() < many.top());
}

void TestLiveImage::saysWhatAReducedPictureLost_data()
{
    QTest::addColumn<int>("rung");
    QTest::addColumn<double>("rate");
    QTest::addColumn<int>("encoding");
    QTest::addColumn<bool>("said");
    QTest::addColumn<bool>("losing");
    const int raw = static_cast<int>(PixelEncoding::Raw);
    const int jpegLs = static_cast<int>(PixelEncoding::JpegLs);
    const int jpeg = static_cast<int>(PixelEncoding::Jpeg);
    QTest::newRow("as asked for") << 0 << 15.0 << raw << false << false;
    QTest::newRow("half the rate") << 1 << 7.5 << raw << true << true;
    QTest::newRow("lossless") << 2 << 15.0 << jpegLs << true << false;
    QTest::newRow("lossy") << 4 << 15.0 << jpeg << true << true;
}

void TestLiveImage::saysWhatAReducedPictureLost()
{
    QFETCH(int, rung);
    QFETCH(double, rate);
    QFETCH(int, encoding);
    QFETCH(bool, said);
    QFETCH(bool, losing);
    const int quality = static_cast<PixelEncoding>(encoding) == PixelEncoding::Jpeg ? 75 : 0;
    LivePane pane;
    QVERIFY(pane.send(samples::frame(1, frameSize, 12, PixelEncoding::Raw)));
    pane.grab();
    const QRegion without = pane.view.overlayRegion();
    const auto frame = samples::frame(2, frameSize, 8, static_cast<PixelEncoding>(encoding), quality);
    frame->rung = rung;
    frame->rate = rate;
    frame->askedRate = 15;
    pane.now += std::chrono::milliseconds(66);
    QVERIFY(pane.send(frame));
    QCOMPARE(pixelsOf(pane.grab(), pane_colours::caution) > 0, losing);
    const auto plates = [](const QRegion& region) { return std::distance(region.begin(), region.end()); };
    QCOMPARE(plates(pane.view.overlayRegion()) > plates(without), said);
    for (const int width : {1200, 480, 320}) { // whole on any pane
        pane.view.resize(width, 500);
        QCOMPARE(pixelsOf(pane.grab(), pane_colours::caution) > 0, losing);
        const QRegion outside = pane.view.overlayRegion() - QRegion(pane.view.pictureRect());
        QVERIFY2(!said || outside.isEmpty(), qPrintable(QStringLiteral("at a width of %1").arg(width)));
    }
}

void TestLiveImage::saysBelowALengthWhatItIsWorth()
{
    DisplayState display;
    LivePane pane;
    pane.view.setDisplay(&display);
    QVERIFY(pane.send(1));
    const QRect area = pane.view.pictureRect();
    const auto rowsCovered = [&] {
        pane.grab();
        int rows = 0;
        for (int y = area.top(); y <= area.bottom(); ++y)
            rows += pane.view.overlayRegion().contains(QPoint(area.center().x(), y)) ? 1 : 0;
        return rows;
    };
    QTest::keyClick(&pane.view, Qt::Key_M);
    const int request = rowsCovered(); // what to do, and the choice of plane
    for (const QPoint point : {QPoint(100, 100), QPoint(130, 140)})
        QTest::mouseClick(&pane.view, Qt::LeftButton, {}, area.topLeft() + point);
    const int byGeometry = rowsCovered(); // length, depth, and what the right button does
    QTest::keyClick(&pane.view, Qt::Key_B);
    const int byCatheter = rowsCovered(); // length and depth
    QCOMPARE(byCatheter, request);
    QVERIFY(byGeometry - byCatheter > 5);
    QVERIFY(byGeometry - byCatheter < byCatheter);
}

void TestLiveImage::saysCalibratedOnTheMeasuredScreenOnly()
{
    LivePane pane;
    pane.pipeline.setGreyScale(GreyScale(DisplayMeasurement{0.2, {{0, 0.4}, {128, 60}, {255, 350}}}));
    QVERIFY(pane.send(1));
    ReferenceImageView reference;
    reference.resize(pane.view.size());
    auto held = *pane.view.picture();
    held.role = PictureRole::Hold;
    reference.showPicture(held);
    for (PictureCanvas* view : {static_cast<PictureCanvas*>(&pane.view), static_cast<PictureCanvas*>(&reference)}) {
        view->grab(); // the first paint tells of the picture
        const QImage anywhere = view->grab().toImage();
        view->setMeasuredScreen(nullptr);
        QVERIFY(view->grab().toImage() != anywhere);
        QVERIFY(!view->asSeenHere(held).isCalibrated);
        view->setMeasuredScreen(view->screen());
        QCOMPARE(view->grab().toImage(), anywhere);
        QVERIFY(view->asSeenHere(held).isCalibrated);
    }
}

QTEST_MAIN(TestLiveImage)
#include "test_live_image.moc"
