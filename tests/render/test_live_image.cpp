// Tests of the live picture, pixel by pixel: what was sent is what is shown, and what is not live cannot look live.
#include "imaging/picture_overlay.hpp"
#include "live_pane.hpp"

#include <turbojpeg.h>

#include <QSignalSpy>

using namespace console;
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

// Calls `check` with each pixel of the picture that no mark covers; returns how many there are.
template <typename Check>
int forEachPicturePixel(const LivePane& pane, Check check)
{
    const QRect area = pane.view.pictureRect();
    const QRegion picture = QRegion(area) - pane.view.overlayRegion();
    int count = 0;
    for (const QRect& part : picture)
        for (int y = part.top(); y <= part.bottom(); ++y)
            for (int x = part.left(); x <= part.right(); ++x, ++count)
                check(x, y, x - area.left(), y - area.top());
    return count;
}

int differingPixels(const QImage& a, const QImage& b, const QRect& area)
{
    int differing = 0;
    for (int y = area.top(); y <= area.bottom(); ++y)
        for (int x = area.left(); x <= area.right(); ++x)
            differing += a.pixel(x, y) != b.pixel(x, y) ? 1 : 0;
    return differing;
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
    void tellsPaintedFrameAndAgeOnce();
    void movesLivenessMarkOnlyForNewFrame();
    void looksFrozenWhenPicturesStop();
    void becomesFrozenWithoutAnyEvent();
    void countsFrozenSeconds();
    void tellsLastImageHoldFromFrozen();
    void saysWhenAgeIsUnknown();
    void showsSourceOfEveryPicture();
    void showsNoScaleAndNoSidesWithoutGeometry();
    void showsHonestTextWithoutPicture();
    void showsRefusalUntilNextPicture();
    void tellsDelayOfFilterAsProcessing();
    void saysLiveOnlyOfWhatIsLive();
    void saysWhatAReducedPictureLost_data();
    void saysWhatAReducedPictureLost();
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

void TestLiveImage::tellsPaintedFrameAndAgeOnce()
{
    LivePane pane;
    std::vector<std::optional<double>> ages;
    QObject::connect(&pane.view, &LiveImageView::picturePainted, &pane.view,
                     [&ages](quint32, std::optional<double> age) { ages.push_back(age); });
    QVERIFY(pane.send(5));
    pane.now += std::chrono::milliseconds(64);
    pane.grab();
    pane.grab();
    QCOMPARE(ages.size(), std::size_t(1));
    QCOMPARE(ages.front(), std::optional(84.0)); // 20 ms on the way and 64 ms here
    QCOMPARE(pane.state.paintedCount(), quint64(1));
    QCOMPARE(pane.state.newest()->frame, 5U);
}

void TestLiveImage::movesLivenessMarkOnlyForNewFrame()
{
    LivePane pane;
    QVERIFY(pane.send(1));
    const QImage first = pane.grab();
    const QRect mark = pane.view.livenessRect();
    QVERIFY(!mark.isEmpty());
    QCOMPARE(differingPixels(first, pane.grab(), mark), 0);
    QSignalSpy refusals(&pane.pipeline, &FramePipeline::pictureRefused);
    pane.pipeline.showFrame(samples::frame(1, frameSize, 12, PixelEncoding::Raw)); // the same once more
    QTRY_COMPARE(refusals.count(), 1);
    QCOMPARE(differingPixels(first, pane.grab(), mark), 0);
    pane.now += std::chrono::seconds(2); // time alone moves nothing
    QCOMPARE(differingPixels(first, pane.grab(), mark), 0);
    QVERIFY(pane.send(2));
    QVERIFY(differingPixels(first, pane.grab(), mark) > 0);
    QCOMPARE(pane.state.paintedCount(), quint64(2));
}

void TestLiveImage::looksFrozenWhenPicturesStop()
{
    LivePane pane;
    QVERIFY(pane.send(1));
    const QImage live = pane.grab();
    const QRegion liveMarks = pane.view.overlayRegion();
    QCOMPARE(pane.state.reading(pane.now).condition, PictureCondition::Live);
    pane.now += std::chrono::seconds(1);
    const QImage frozen = pane.grab();
    QCOMPARE(pane.state.reading(pane.now).condition, PictureCondition::Frozen);

    // 60 % of the picture, 40 % of the grey of stale things.
    int wrong = 0;
    const QColor veil = pane_colours::stale;
    const auto mixed = [](int picture, int grey) { return 0.6 * picture + 0.4 * grey; };
    forEachPicturePixel(pane, [&](int x, int y, int, int) {
        if (liveMarks.contains(QPoint(x, y)))
            return;
        const QRgb was = live.pixel(x, y);
        const QRgb is = frozen.pixel(x, y);
        if (std::abs(qRed(is) - mixed(qRed(was), veil.red())) > 1.5 || std::abs(qGreen(is) - mixed(qGreen(was), veil.green())) > 1.5 ||
            std::abs(qBlue(is) - mixed(qBlue(was), veil.blue())) > 1.5)
            ++wrong;
    });
    QCOMPARE(wrong, 0);

    // The frame, twelve pixels wide, is hatched: along it light and dark alternate, every twelve pixels, on every row of its width.
    for (const int y : {0, hatchWidth / 2, hatchWidth - 1}) {
        int light = 0;
        int dark = 0;
        for (int x = 0; x < pane.view.width(); ++x) {
            const int grey = qGray(frozen.pixel(x, y));
            light += grey > 150 ? 1 : 0;
            dark += grey < 60 ? 1 : 0;
        }
        QVERIFY(light > pane.view.width() / 4);
        QVERIFY(dark > pane.view.width() / 4);
    }
    // FROZEN and its time stand where nothing stood before.
    QVERIFY(!(pane.view.overlayRegion() - liveMarks).isEmpty());
}

void TestLiveImage::becomesFrozenWithoutAnyEvent()
{
    LivePane pane;
    QVERIFY(pane.send(1));
    pane.grab();
    QVERIFY(pane.view.accessibleDescription().contains(QStringLiteral("live")));
    pane.now += std::chrono::seconds(1);
    QTRY_VERIFY(pane.view.accessibleDescription().contains(QStringLiteral("frozen")));
}

void TestLiveImage::countsFrozenSeconds()
{
    LivePane pane;
    QVERIFY(pane.send(1));
    pane.grab();
    pane.now += std::chrono::seconds(1);
    const QImage one = pane.grab();
    const QRegion marks = pane.view.overlayRegion();
    pane.now += std::chrono::seconds(3);
    const QImage four = pane.grab();
    int changed = 0;
    for (const QRect& part : marks)
        changed += differingPixels(one, four, part);
    QVERIFY(changed > 0);
}

void TestLiveImage::tellsLastImageHoldFromFrozen()
{
    LivePane pane;
    QVERIFY(pane.send(1));
    const QImage live = pane.grab();
    pane.now += std::chrono::seconds(1);
    const QImage frozen = pane.grab();
    pane.state.expect(0, pane.now); // the pedal is up
    const QImage held = pane.grab();
    QCOMPARE(pane.state.reading(pane.now).condition, PictureCondition::Held);
    const QRect ring(0, 0, pane.view.width(), hatchWidth);
    QCOMPARE(differingPixels(live, held, ring), 0);
    QVERIFY(differingPixels(frozen, held, ring) > 0);
    QVERIFY(differingPixels(live, held, pane.view.pictureRect()) > 0); // the words
    QVERIFY(differingPixels(frozen, held, pane.view.pictureRect()) > 0);
    QVERIFY(pane.view.accessibleDescription().startsWith(QStringLiteral("Last image hold")));
}

void TestLiveImage::saysWhenAgeIsUnknown()
{
    LivePane pane;
    const auto frame = samples::frame(1, frameSize, 12, PixelEncoding::Raw);
    frame->ageAtArrival.reset();
    std::vector<std::optional<double>> ages;
    QObject::connect(&pane.view, &LiveImageView::picturePainted, &pane.view,
                     [&ages](quint32, std::optional<double> age) { ages.push_back(age); });
    QVERIFY(pane.send(frame));
    pane.grab();
    QCOMPARE(ages, std::vector<std::optional<double>>{std::nullopt});
    QVERIFY(pane.view.accessibleDescription().contains(QStringLiteral("age is unknown")));
}

void TestLiveImage::showsSourceOfEveryPicture()
{
    LivePane pane;
    std::vector<QImage> shown;
    quint32 number = 1;
    for (const PictureSource source : {PictureSource::Live, PictureSource::Simulated, PictureSource::Recorded}) {
        const auto frame = samples::frame(number++, frameSize, 12, PixelEncoding::Raw);
        frame->source = source;
        QVERIFY(pane.send(frame));
        shown.push_back(pane.grab().copy(QRect(pane.view.pictureRect().topLeft(), QSize(220, 40))));
    }
    QVERIFY(shown[0] != shown[1]);
    QVERIFY(shown[1] != shown[2]);
    QVERIFY(shown[0] != shown[2]);
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

void TestLiveImage::tellsDelayOfFilterAsProcessing()
{
    LivePane pane;
    DisplaySettings settings;
    settings.noiseReduction = 100;
    pane.pipeline.setSettings(settings);
    pane.pipeline.setFilterRoom(std::chrono::milliseconds(100));
    for (quint32 number = 1; number <= 12; ++number)
        QVERIFY(pane.send(number));
    pane.grab();
    const PictureReading reading = pane.state.reading(pane.now);
    const Duration delay = pane.view.picture()->treatment.filterDelay;
    QVERIFY(delay > std::chrono::milliseconds(50));
    QVERIFY(delay <= std::chrono::milliseconds(100) + std::chrono::microseconds(1));
    QCOMPARE(reading.processing, delay);                                     // painted at the moment it arrived
    QCOMPARE(*reading.age, Duration(std::chrono::milliseconds(20)) + delay); // and the age counts it
}

void TestLiveImage::saysLiveOnlyOfWhatIsLive()
{
    LivePane pane;
    const auto frame = samples::frame(1, frameSize, 12, PixelEncoding::Raw);
    frame->source = PictureSource::Live;
    QVERIFY(pane.send(frame));
    const QRect corner(pane.view.pictureRect().topLeft(), QSize(200, 40));
    const QImage live = pane.grab().copy(corner);
    pane.state.expect(0, pane.now);
    const QImage held = pane.grab().copy(corner);
    QVERIFY(live != held);
    pane.state.expect(15, pane.now);
    pane.now += std::chrono::seconds(2);
    const QImage frozen = pane.grab().copy(corner);
    QVERIFY(frozen != held);
    QVERIFY(frozen != live);
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

QTEST_MAIN(TestLiveImage)
#include "test_live_image.moc"
