// Tests of what the live picture is: what is not live cannot look live, and its age and its source are told.
#include "imaging/picture_overlay.hpp"
#include "live_pane.hpp"

#include <QSignalSpy>

using namespace console;
using samples::differingPixels;
using samples::forEachPicturePixel;
using samples::frameSize;
using samples::LivePane;

class TestLiveCondition : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void tellsPaintedFrameAndAgeOnce();
    void movesLivenessMarkOnlyForNewFrame();
    void looksFrozenWhenPicturesStop();
    void becomesFrozenWithoutAnyEvent();
    void countsFrozenSeconds();
    void tellsLastImageHoldFromFrozen();
    void saysWhenAgeIsUnknown();
    void showsSourceOfEveryPicture();
    void tellsDelayOfFilterAsProcessing();
    void saysLiveOnlyOfWhatIsLive();
};

void TestLiveCondition::tellsPaintedFrameAndAgeOnce()
{
    LivePane pane;
    std::vector<std::optional<double>> ages;
    QObject::connect(&pane.view, &LiveImageView::picturePainted, &pane.view,
                     [&ages](quint32, std::optional<double> age) { ages.push_back(age); });
    const auto frame = samples::frame(5, frameSize, 12, PixelEncoding::Raw);
    frame->arrival = pane.now;
    pane.now += std::chrono::milliseconds(64); // before it is delivered: the window may paint it at once
    pane.pipeline.showFrame(frame);
    QTRY_COMPARE(pane.pipeline.counts().shown, quint64(1));
    pane.grab();
    pane.grab();
    QCOMPARE(ages.size(), std::size_t(1));
    QCOMPARE(ages.front(), std::optional(84.0)); // 20 ms on the way and 64 ms here
    QCOMPARE(pane.state.paintedCount(), quint64(1));
    QCOMPARE(pane.state.newest()->frame, 5U);
}

void TestLiveCondition::movesLivenessMarkOnlyForNewFrame()
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

void TestLiveCondition::looksFrozenWhenPicturesStop()
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

void TestLiveCondition::becomesFrozenWithoutAnyEvent()
{
    LivePane pane;
    QVERIFY(pane.send(1));
    pane.grab();
    QVERIFY(pane.view.accessibleDescription().contains(QStringLiteral("live")));
    pane.now += std::chrono::seconds(1);
    QTRY_VERIFY(pane.view.accessibleDescription().contains(QStringLiteral("frozen")));
}

void TestLiveCondition::countsFrozenSeconds()
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

void TestLiveCondition::tellsLastImageHoldFromFrozen()
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

void TestLiveCondition::saysWhenAgeIsUnknown()
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

void TestLiveCondition::showsSourceOfEveryPicture()
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

void TestLiveCondition::tellsDelayOfFilterAsProcessing()
{
    LivePane pane;
    DisplaySettings settings;
    settings.noiseReduction = 100;
    pane.pipeline.setSettings(settings);
    pane.pipeline.setFilterRoom(std::chrono::milliseconds(166)); // with the period for which a picture stands
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

void TestLiveCondition::saysLiveOnlyOfWhatIsLive()
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

QTEST_MAIN(TestLiveCondition)
#include "test_live_condition.moc"
