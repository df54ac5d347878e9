// Tests of the way from the network thread to the GUI thread: the newest picture only, nothing lost from the books.
#include "imaging/cine_ring.hpp"
#include "imaging/frame_pipeline.hpp"
#include "sample_frames.hpp"

#include <QSignalSpy>
#include <QtTest>

using namespace console;

class TestFramePipeline : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void deliversPictureWithItsFacts();
    void keepsOnlyTheNewestOfABurst();
    void reportsRefusalAndGoesOn();
    void pictureThatComesAgainAsANewOneIsRefused();
    void aRecordingMayHoldAPictureTwice();
    void reviewShowsAPictureAsOftenAsItIsAsked();
    void choosesWindowWhenFrameHasNone();
    void letsGoOfTheEncodedBytes();
    void endsWithFramesInFlight();
    void ignoresNoFrame();
    void redrawsWithNewSettings();
    void countsPictureOnceThatIsRedrawnBeforeItIsShown();
    void givesEveryPictureItsRole();
    void writesFramesIntoRing();
    void keepsNoQueueWithAllFilters();
};

namespace {

constexpr QSize size(64, 48);

void collect(FramePipeline& pipeline, QObject& context, std::vector<DisplayPicture>& pictures)
{
    QObject::connect(&pipeline, &FramePipeline::pictureReady, &context,
                     [&pictures](const DisplayPicture& picture) { pictures.push_back(picture); });
}

} // namespace

void TestFramePipeline::deliversPictureWithItsFacts()
{
    std::vector<DisplayPicture> pictures;
    FramePipeline pipeline;
    collect(pipeline, *this, pictures);
    const auto frame = samples::frame(7, size, 12, PixelEncoding::JpegLs);
    pipeline.showFrame(frame);
    QTRY_COMPARE(pictures.size(), std::size_t(1));
    const DisplayPicture& picture = pictures.front();
    QCOMPARE(picture.about.frame, 7U);
    QCOMPARE(picture.about.captureNs, frame->captureNs);
    QCOMPARE(picture.image.size(), size);
    QCOMPARE(picture.image.format(), QImage::Format_RGB32);
    QVERIFY(!picture.windowIsAutomatic);
    QVERIFY(picture.times.decode > Duration::zero());
    QVERIFY(picture.times.window > Duration::zero());
}

void TestFramePipeline::keepsOnlyTheNewestOfABurst()
{
    std::vector<DisplayPicture> pictures;
    FramePipeline pipeline;
    collect(pipeline, *this, pictures);
    constexpr quint32 burst = 200;
    // The GUI thread is in here and delivers nothing meanwhile.
    for (quint32 number = 1; number <= burst; ++number)
        pipeline.showFrame(samples::frame(number, size, 8, PixelEncoding::Raw));
    QTRY_VERIFY(!pictures.empty() && pictures.back().about.frame == burst);
    QVERIFY(pictures.size() <= 3);
    const FrameCounts counts = pipeline.counts();
    QCOMPARE(counts.received, quint64(burst));
    QCOMPARE(counts.shown, quint64(pictures.size()));
    QCOMPARE(counts.replacedBeforeDecoding + counts.replacedBeforeShowing + counts.refused + counts.shown, quint64(burst));
    for (std::size_t i = 1; i < pictures.size(); ++i)
        QVERIFY(pictures[i - 1].about.frame < pictures[i].about.frame);
}

void TestFramePipeline::reportsRefusalAndGoesOn()
{
    std::vector<DisplayPicture> pictures;
    FramePipeline pipeline;
    collect(pipeline, *this, pictures);
    QSignalSpy refusals(&pipeline, &FramePipeline::pictureRefused);
    const auto good = samples::frame(1, size, 8, PixelEncoding::Raw);
    pipeline.showFrame(samples::withBytes(*good, std::vector<std::byte>(10)));
    QTRY_COMPARE(refusals.count(), 1);
    QCOMPARE(refusals.first().first().toUInt(), 1U);
    const QString reason = refusals.first().at(1).toString();
    QVERIFY(reason.contains(QStringLiteral("64 x 48 pixels take 3072 bytes, and it has 10")));
    QVERIFY2(!reason.contains(QStringLiteral("refused")), qPrintable(reason)); // that is said by whoever tells it
    QVERIFY(pictures.empty());
    pipeline.showFrame(good);
    QTRY_COMPARE(pictures.size(), std::size_t(1));
    QCOMPARE(pipeline.counts().refused, quint64(1));
}

/// A sender that hangs with its clock running: number and time are new each time, and the picture is not.
void TestFramePipeline::pictureThatComesAgainAsANewOneIsRefused()
{
    std::vector<DisplayPicture> pictures;
    FramePipeline pipeline;
    collect(pipeline, *this, pictures);
    QSignalSpy refusals(&pipeline, &FramePipeline::pictureRefused);
    const auto first = samples::frame(1, size, 12, PixelEncoding::Raw);
    const auto again = [&first](quint32 number) {
        auto copy = samples::withBytes(*first, {first->pixels.begin(), first->pixels.end()});
        copy->frame = number;
        copy->captureNs += number * 66'000'000ULL;
        copy->arrival = std::chrono::steady_clock::now();
        return copy;
    };
    pipeline.showFrame(first);
    QTRY_COMPARE(pictures.size(), std::size_t(1));
    for (quint32 number = 2; number < 5; ++number) {
        pipeline.showFrame(again(number));
        QTRY_COMPARE(refusals.count(), int(number) - 1);
        QVERIFY(refusals.last().at(1).toString().contains(QStringLiteral("the same as the one before")));
    }
    QCOMPARE(pictures.size(), std::size_t(1));
    pipeline.showFrame(samples::frame(5, size, 12, PixelEncoding::Raw));
    QTRY_COMPARE(pictures.size(), std::size_t(2));
    pipeline.showFrame(again(6)); // as an earlier one is nothing against it: the one before was another
    QTRY_COMPARE(pictures.size(), std::size_t(3));
}

/// Cines stand still at times; nobody may move by one.
void TestFramePipeline::aRecordingMayHoldAPictureTwice()
{
    std::vector<DisplayPicture> pictures;
    FramePipeline pipeline;
    collect(pipeline, *this, pictures);
    const auto first = samples::frame(1, size, 12, PixelEncoding::Raw);
    for (quint32 number = 1; number < 4; ++number) {
        auto copy = samples::withBytes(*first, {first->pixels.begin(), first->pixels.end()});
        copy->frame = number;
        copy->source = PictureSource::Recorded;
        pipeline.showFrame(copy);
        QTRY_COMPARE(pictures.size(), std::size_t(number));
    }
    QCOMPARE(pipeline.counts().refused, quint64(0));
}

void TestFramePipeline::reviewShowsAPictureAsOftenAsItIsAsked()
{
    std::vector<DisplayPicture> pictures;
    FramePipeline review(nullptr, PictureRole::Review);
    collect(review, *this, pictures);
    const auto one = samples::frame(1, size, 12, PixelEncoding::Raw);
    for (std::size_t shown = 1; shown < 4; ++shown) {
        review.showFrame(one);
        QTRY_COMPARE(pictures.size(), shown);
    }
}

void TestFramePipeline::choosesWindowWhenFrameHasNone()
{
    std::vector<DisplayPicture> pictures;
    FramePipeline pipeline;
    collect(pipeline, *this, pictures);
    const auto frame = samples::frame(1, size, 16, PixelEncoding::Raw);
    frame->windowWidth = 0;
    pipeline.showFrame(frame);
    QTRY_COMPARE(pictures.size(), std::size_t(1));
    QVERIFY(pictures.front().windowIsAutomatic);
    QVERIFY(pictures.front().window.width > 50000);
}

void TestFramePipeline::letsGoOfTheEncodedBytes()
{
    std::vector<DisplayPicture> pictures;
    FramePipeline pipeline;
    collect(pipeline, *this, pictures);
    auto frame = samples::frame(1, size, 8, PixelEncoding::Raw);
    const std::weak_ptr<const void> bytes = frame->owner;
    pipeline.showFrame(std::move(frame));
    QTRY_COMPARE(pictures.size(), std::size_t(1));
    QTRY_VERIFY(bytes.expired());
}

void TestFramePipeline::endsWithFramesInFlight()
{
    for (int round = 0; round < 20; ++round) {
        const auto pipeline = std::make_unique<FramePipeline>();
        for (quint32 number = 0; number < 5; ++number)
            pipeline->showFrame(samples::frame(number, {256, 256}, 16, PixelEncoding::JpegLs));
    }
    QCoreApplication::processEvents();
}

void TestFramePipeline::ignoresNoFrame()
{
    FramePipeline pipeline;
    pipeline.showFrame(nullptr);
    QCOMPARE(pipeline.counts().received, quint64(0));
}

void TestFramePipeline::redrawsWithNewSettings()
{
    std::vector<DisplayPicture> pictures;
    FramePipeline pipeline;
    collect(pipeline, *this, pictures);
    DisplaySettings settings;
    settings.inverted = true;
    pipeline.setSettings(settings); // before the first picture there is nothing to redraw
    pipeline.showFrame(samples::frame(1, size, 8, PixelEncoding::Raw));
    QTRY_COMPARE(pictures.size(), std::size_t(1));
    QVERIFY(pictures.front().settings.inverted);
    settings.inverted = false;
    pipeline.setSettings(settings);
    QTRY_COMPARE(pictures.size(), std::size_t(2));
    QVERIFY(pictures[1].isSameFrameAs(pictures[0]));
    QVERIFY(pictures[1].image != pictures[0].image);
    pipeline.setSettings(settings); // nothing new
    settings.edge = 1000;
    pipeline.setSettings(settings);
    QTRY_COMPARE(pictures.size(), std::size_t(3));
    QCOMPARE(pictures[2].settings.edge, 100);
    QCOMPARE(pipeline.counts().received, quint64(1));
    QCOMPARE(pipeline.counts().shown, quint64(1));
}

void TestFramePipeline::countsPictureOnceThatIsRedrawnBeforeItIsShown()
{
    std::vector<DisplayPicture> pictures;
    FramePipeline pipeline;
    collect(pipeline, *this, pictures);
    constexpr quint32 last = 60;
    DisplaySettings settings;
    for (quint32 number = 1; number <= last; ++number) {
        settings.edge = static_cast<int>(number);
        pipeline.showFrame(samples::frame(number, size, 8, PixelEncoding::Raw));
        pipeline.setSettings(settings);
    }
    QTRY_VERIFY(!pictures.empty() && pictures.back().about.frame == last && pictures.back().settings == settings);
    const FrameCounts counts = pipeline.counts();
    QCOMPARE(counts.received, quint64(last));
    QCOMPARE(counts.replacedBeforeDecoding + counts.replacedBeforeShowing + counts.refused + counts.shown, quint64(last));
}

void TestFramePipeline::givesEveryPictureItsRole()
{
    std::vector<DisplayPicture> pictures;
    FramePipeline review(nullptr, PictureRole::Review);
    collect(review, *this, pictures);
    review.showFrame(samples::frame(1, size, 8, PixelEncoding::Raw));
    QTRY_COMPARE(pictures.size(), std::size_t(1));
    DisplaySettings settings;
    settings.inverted = true;
    review.setSettings(settings);
    QTRY_COMPARE(pictures.size(), std::size_t(2));
    QCOMPARE(pictures[0].role, PictureRole::Review);
    QCOMPARE(pictures[1].role, PictureRole::Review);
}

void TestFramePipeline::writesFramesIntoRing()
{
    CineRing ring;
    std::vector<DisplayPicture> pictures;
    FramePipeline pipeline;
    pipeline.recordInto(ring);
    collect(pipeline, *this, pictures);
    const auto good = samples::frame(3, size, 8, PixelEncoding::Raw);
    pipeline.showFrame(good);
    QTRY_COMPARE(ring.range().end, quint64(1));
    QCOMPARE(ring.at(0)->frame, 3U);
    QSignalSpy refusals(&pipeline, &FramePipeline::pictureRefused);
    pipeline.showFrame(samples::withBytes(*good, std::vector<std::byte>(10)));
    QTRY_COMPARE(refusals.count(), 1);
    QCOMPARE(ring.range().end, quint64(1)); // what cannot be shown is not kept
}

void TestFramePipeline::keepsNoQueueWithAllFilters()
{
    // Frames far faster than the chain: what is not the newest is dropped, and the newest is shown.
    std::vector<quint32> shown;
    FramePipeline pipeline;
    DisplaySettings settings;
    settings.noiseReduction = 70;
    settings.edge = 50;
    settings.window = WindowChoice::Automatic;
    pipeline.setSettings(settings);
    pipeline.setFilterRoom(std::chrono::seconds(1));
    QObject::connect(&pipeline, &FramePipeline::pictureReady, this,
                     [&shown](const DisplayPicture& picture) { shown.push_back(picture.about.frame); });
    constexpr quint32 last = 40;
    for (quint32 number = 1; number <= last; ++number)
        pipeline.showFrame(samples::frame(number, {256, 256}, 16, PixelEncoding::Raw));
    QTRY_VERIFY(!shown.empty() && shown.back() == last);
    const FrameCounts counts = pipeline.counts();
    QCOMPARE(counts.replacedBeforeDecoding + counts.replacedBeforeShowing + counts.refused + counts.shown, quint64(last));
}

QTEST_GUILESS_MAIN(TestFramePipeline)
#include "test_frame_pipeline.moc"
