// Tests of the mean of a run's last pictures: its values, and which pictures may go into it.
#include "chain_run.hpp"
#include "imaging/frame_decoder.hpp"
#include "imaging/mean_picture.hpp"

#include <QtTest>

#include <utility>
#include <vector>

using namespace console;
using namespace std::chrono_literals;

namespace {

const Instant start = std::chrono::steady_clock::now();

/// Fifteen a second.
std::shared_ptr<XrayFrame> frameOf(quint32 number, std::uint16_t value = 1000)
{
    auto frame = samples::flatFrame(number, value);
    frame->arrival = start + number * 66ms;
    return frame;
}

cv::Mat decoded(const XrayFrame& frame)
{
    cv::Mat stored;
    return decodeFrame(frame, stored).isEmpty() ? stored : cv::Mat();
}

bool isAll(const cv::Mat& stored, int value) { return !stored.empty() && cv::countNonZero(stored != value) == 0; }

std::vector<quint32> numbersOf(const SharedFrames& frames)
{
    std::vector<quint32> numbers;
    for (const auto& frame : frames)
        numbers.push_back(frame->frame);
    return numbers;
}

struct Difference {
    const char* name;
    void (*make)(XrayFrame&);
};

constexpr Difference differences[] = {
    {"run", [](XrayFrame& f) { f.acquisition = 7; }},
    {"source", [](XrayFrame& f) { f.source = PictureSource::Recorded; }},
    {"rows and columns", [](XrayFrame& f) { std::swap(f.rows, f.columns); }},
    {"bits", [](XrayFrame& f) { f.bitsStored = 11; }},
    {"photometric", [](XrayFrame& f) { f.photometric = Photometric::Monochrome1; }},
    {"intensity", [](XrayFrame& f) { f.intensity = IntensityRelationship::Logarithmic; }},
    {"imager spacing", [](XrayFrame& f) { f.imagerPixelSpacing = 0.15; }},
    {"primary angle", [](XrayFrame& f) { f.geometry.primaryAngle += 0.2; }},
    {"secondary angle", [](XrayFrame& f) { f.geometry.secondaryAngle -= 0.2; }},
    {"SID", [](XrayFrame& f) { f.geometry.sourceDetectorDistance += 1; }},
    {"SOD", [](XrayFrame& f) { f.geometry.sourceObjectDistance -= 1; }},
    {"step of the ladder", [](XrayFrame& f) { f.rung = 2; }},
    {"encoding", [](XrayFrame& f) { f.encoding = PixelEncoding::JpegLs; }},
    {"quality", [](XrayFrame& f) { f.quality = 3; }},
    {"mask", [](XrayFrame& f) { f.mask = true; }},
};

} // namespace

class TestMeanPicture : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void roundsToTheNearest_data()
    {
        QTest::addColumn<int>("type");
        QTest::addColumn<QList<int>>("values");
        QTest::addColumn<int>("mean");
        QTest::newRow("one") << CV_16UC1 << QList<int>{4711} << 4711;
        QTest::newRow("half") << CV_16UC1 << QList<int>{1, 2} << 2;
        QTest::newRow("below half") << CV_16UC1 << QList<int>{1, 1, 2} << 1;
        QTest::newRow("above half") << CV_16UC1 << QList<int>{1, 2, 2} << 2;
        QTest::newRow("far apart") << CV_16UC1 << QList<int>{0, 65535} << 32768;
        QTest::newRow("sixteen bits") << CV_16UC1 << QList<int>(8, 65535) << 65535;
        QTest::newRow("sixteen bits but one") << CV_16UC1 << QList<int>{65535, 65535, 65535, 65534} << 65535;
        QTest::newRow("eight bits") << CV_8UC1 << QList<int>(8, 255) << 255;
        QTest::newRow("eight bits, half") << CV_8UC1 << QList<int>{0, 255} << 128;
    }

    void roundsToTheNearest()
    {
        QFETCH(int, type);
        QFETCH(QList<int>, values);
        QFETCH(int, mean);
        PictureMean taken;
        for (const int value : values)
            taken.add(cv::Mat(3, 5, type, cv::Scalar(value)));
        QCOMPARE(taken.count(), int(values.size()));
        cv::Mat stored;
        taken.writeTo(stored);
        QCOMPARE(stored.type(), type);
        QCOMPARE(stored.size(), cv::Size(5, 3));
        QVERIFY2(isAll(stored, mean), qPrintable(QString::number(type == CV_8UC1 ? stored.at<uchar>(0) : stored.at<ushort>(0))));
    }

    void isOfEachPixelByItself()
    {
        cv::Mat first(2, 2, CV_16UC1);
        cv::Mat second(2, 2, CV_16UC1);
        for (int i = 0; i < 4; ++i) {
            first.at<std::uint16_t>(i / 2, i % 2) = std::uint16_t(1000 * i);
            second.at<std::uint16_t>(i / 2, i % 2) = std::uint16_t(1000 * i + 20);
        }
        PictureMean taken;
        taken.add(first);
        taken.add(second);
        cv::Mat mean;
        taken.writeTo(mean);
        for (int i = 0; i < 4; ++i)
            QCOMPARE(int(mean.at<std::uint16_t>(i / 2, i % 2)), 1000 * i + 10);
    }

    void takesAllThatGoTogether()
    {
        const auto newest = frameOf(4, 1004);
        cv::Mat stored = decoded(*newest);
        QCOMPARE(meanWith(*newest, SharedFrames{frameOf(3, 1003), frameOf(2, 1001), frameOf(1, 1000)}, stored), 4);
        QVERIFY(isAll(stored, 1002));
    }

    void aloneItStaysAsItWas()
    {
        const auto newest = frameOf(4, 1004);
        cv::Mat stored = decoded(*newest);
        QCOMPARE(meanWith(*newest, {}, stored), 1);
        QVERIFY(isAll(stored, 1004));
    }

    /// What comes before the difference does not count, however well it would go with the last.
    void endsAtEachDifference()
    {
        for (const Difference& difference : differences) {
            const auto newest = frameOf(4, 1004);
            const auto other = frameOf(2, 900);
            difference.make(*other);
            cv::Mat stored = decoded(*newest);
            QVERIFY2(meanWith(*newest, SharedFrames{frameOf(3, 1000), other, frameOf(1, 1000)}, stored) == 2, difference.name);
            QVERIFY2(isAll(stored, 1002), difference.name);
            CineRing ring;
            for (const auto& frame : {frameOf(1), other, frameOf(3), newest})
                ring.add(*frame);
            QVERIFY2(numbersOf(framesForMean(ring, *newest, 8, start)) == (std::vector<quint32>{4, 3}), difference.name);
        }
    }

    void endsWhereTheBrightnessShowsAnotherGain()
    {
        const auto newest = frameOf(4, 1000);
        for (const auto& [value, pictures] : {std::pair(1099, 3), std::pair(901, 3), std::pair(1101, 1), std::pair(899, 1)}) {
            cv::Mat stored = decoded(*newest);
            QCOMPARE(meanWith(*newest, SharedFrames{frameOf(3, std::uint16_t(value)), frameOf(2, 1000)}, stored), pictures);
            QCOMPARE(isAll(stored, 1000), pictures == 1);
        }
    }

    void endsAtWhatCannotBeDecoded()
    {
        const auto newest = frameOf(4, 1004);
        const auto broken = frameOf(2, 500);
        broken->pixels = broken->pixels.first(10);
        cv::Mat stored = decoded(*newest);
        QCOMPARE(meanWith(*newest, SharedFrames{frameOf(3, 1000), broken, frameOf(1, 500)}, stored), 2);
        QVERIFY(isAll(stored, 1002));
    }

    void takesTheRingsOwnFramesTheNewestFirst()
    {
        CineRing ring;
        for (quint32 number = 1; number <= 10; ++number)
            ring.add(*frameOf(number));
        const SharedFrames frames = framesForMean(ring, *frameOf(10), 4, start);
        QCOMPARE(numbersOf(frames), (std::vector<quint32>{10, 9, 8, 7}));
        for (std::size_t i = 0; i < frames.size(); ++i)
            QCOMPARE(frames[i], ring.at(9 - i));
        QCOMPARE(framesForMean(ring, *frameOf(10), 1, start).size(), std::size_t(1));
        QCOMPARE(framesForMean(ring, *frameOf(10), 64, start).size(), std::size_t(10)); // no more are there
    }

    void picturesThatAreMissingAreNoEnd()
    {
        CineRing ring;
        for (const quint32 number : {1U, 2U, 5U, 9U})
            ring.add(*frameOf(number));
        QCOMPARE(numbersOf(framesForMean(ring, *frameOf(9), 4, start)), (std::vector<quint32>{9, 5, 2, 1}));
    }

    void whatCameAfterTheRunIsNotOfIt()
    {
        CineRing ring;
        for (quint32 number = 1; number <= 6; ++number) {
            const auto frame = frameOf(number);
            frame->acquisition = number <= 4 ? 1 : 2;
            ring.add(*frame);
        }
        QCOMPARE(numbersOf(framesForMean(ring, *frameOf(4), 3, start)), (std::vector<quint32>{4, 3, 2}));
    }

    void anXraySystemThatBeganAnewHasAnotherRun()
    {
        CineRing ring;
        for (quint32 number = 1; number <= 5; ++number)
            ring.add(*frameOf(number));
        for (quint32 number = 1; number <= 2; ++number) {
            const auto frame = frameOf(number);
            frame->arrival += 10s;
            frame->captureNs += 10'000'000'000ULL;
            ring.add(*frame);
        }
        const auto last = ring.at(6);
        QCOMPARE(numbersOf(framesForMean(ring, *last, 8, start)), (std::vector<quint32>{2, 1}));
    }

    void isNoneWhileTheLastIsNotInTheRing()
    {
        CineRing ring;
        QVERIFY(framesForMean(ring, *frameOf(4), 4, start).empty());
        for (quint32 number = 1; number <= 3; ++number)
            ring.add(*frameOf(number));
        QVERIFY(framesForMean(ring, *frameOf(4), 4, start).empty());
    }

    /// By the earliest time at which a picture can have been taken.
    void endsWhereTheTableStoodElsewhere()
    {
        CineRing ring;
        for (quint32 number = 1; number <= 4; ++number)
            ring.add(*frameOf(number)); // 20 ms old at their arrival
        const Instant captured = frameOf(3)->arrival - 20ms;
        QCOMPARE(framesForMean(ring, *frameOf(4), 4, captured).size(), std::size_t(2));
        QCOMPARE(framesForMean(ring, *frameOf(4), 4, captured + 1ms).size(), std::size_t(1));
        QCOMPARE(framesForMean(ring, *frameOf(4), 4, Instant::max()).size(), std::size_t(1));
        CineRing unknown;
        for (quint32 number = 1; number <= 4; ++number) {
            const auto frame = frameOf(number);
            if (number < 3)
                frame->ageAtArrival.reset();
            if (number == 3)
                frame->ageUncertainty = 5ms;
            unknown.add(*frame);
        }
        QCOMPARE(framesForMean(unknown, *frameOf(4), 4, captured).size(), std::size_t(1));
        QCOMPARE(framesForMean(unknown, *frameOf(4), 4, captured - 5ms).size(), std::size_t(2));
        QCOMPARE(framesForMean(unknown, *frameOf(4), 4, frameOf(1)->arrival - 500ms).size(), std::size_t(4));
    }
};

QTEST_GUILESS_MAIN(TestMeanPicture)
#include "test_mean_picture.moc"
