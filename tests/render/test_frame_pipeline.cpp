// Tests of the way from the network thread to the GUI thread: the newest picture only, nothing lost from the books.
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
    void choosesWindowWhenFrameHasNone();
    void letsGoOfTheEncodedBytes();
    void endsWithFramesInFlight();
    void ignoresNoFrame();
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
    QVERIFY(picture.decodeTime > Duration::zero());
    QVERIFY(picture.windowTime > Duration::zero());
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
    QVERIFY(refusals.first().at(1).toString().contains(QStringLiteral("64 x 48 pixels take 3072 bytes, and it has 10")));
    QVERIFY(pictures.empty());
    pipeline.showFrame(good);
    QTRY_COMPARE(pictures.size(), std::size_t(1));
    QCOMPARE(pipeline.counts().refused, quint64(1));
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

QTEST_GUILESS_MAIN(TestFramePipeline)
#include "test_frame_pipeline.moc"
