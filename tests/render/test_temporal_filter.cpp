// Tests of the temporal recursive filter against its own arithmetic: noise, delay, motion, reset.
#include "imaging/temporal_filter.hpp"
#include "noisy_picture.hpp"

#include <QtTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

constexpr double sigma2 = 100;

/// Where K has stood for long.
Duration settledDelay(double k, Duration period)
{
    Duration delay{};
    for (int frame = 0; frame < 100; ++frame)
        delay = filterDelay(k, delay, period);
    return delay;
}

cv::Mat flat(unsigned seed)
{
    return samples::noisyPicture(
        128, seed, [](int, int) { return 1000.0; }, [](double) { return sigma2; });
}

} // namespace

class TestTemporalFilter : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void reducesNoiseAsTheFormulaSays_data();
    void reducesNoiseAsTheFormulaSays();
    void letsMovementThroughAtOnce();
    void followsSlowRampWithTheDelayThatIsReported();
    void followsSlowRampWithTheDelayThatIsReportedWhileKChanges();
    void startsAnewAfterReset();
    void startsAnewForAnotherSize();
    void changesNothingAtK1();
    void tellsDelays_data();
    void tellsDelays();
    void keepsDelayWithinRoom();
};

void TestTemporalFilter::reducesNoiseAsTheFormulaSays_data()
{
    QTest::addColumn<double>("k");
    QTest::newRow("0.5") << 0.5;
    QTest::newRow("0.25") << 0.25;
}

void TestTemporalFilter::reducesNoiseAsTheFormulaSays()
{
    QFETCH(double, k);
    TemporalFilter filter;
    cv::Mat picture;
    for (unsigned frame = 0; frame < 30; ++frame) {
        picture = flat(frame + 1);
        filter.apply(picture, k, {0, 1e9}); // so noisy that nothing counts as moving: the plain recursive filter
    }
    const double share = samples::varianceOf(picture, 0, picture.cols) / sigma2;
    QVERIFY2(std::abs(share / varianceShare(k) - 1) < 0.1, qPrintable(QString::number(share)));

    // With the true noise, a little of it is taken for movement.
    filter.reset();
    for (unsigned frame = 0; frame < 30; ++frame) {
        picture = flat(frame + 1);
        filter.apply(picture, k, {0, sigma2});
    }
    const double adaptive = samples::varianceOf(picture, 0, picture.cols) / sigma2;
    QVERIFY2(adaptive < 2 * varianceShare(k), qPrintable(QString::number(adaptive)));
}

void TestTemporalFilter::letsMovementThroughAtOnce()
{
    TemporalFilter filter;
    const NoiseModel noise{0, sigma2};
    for (unsigned frame = 0; frame < 5; ++frame) {
        cv::Mat picture = flat(frame + 1);
        filter.apply(picture, 0.25, noise);
    }
    cv::Mat picture = flat(9);
    picture.col(64) -= 300; // a wire, 30 σ deep
    const cv::Mat sent = picture.clone();
    filter.apply(picture, 0.25, noise);
    for (int y = 0; y < picture.rows; ++y)
        QVERIFY(std::abs(picture.at<float>(y, 64) - sent.at<float>(y, 64)) < 1);
    // And where it was before, nothing stays of it.
    cv::Mat gone = flat(10);
    filter.apply(gone, 0.25, noise);
    for (int y = 0; y < gone.rows; ++y)
        QVERIFY(gone.at<float>(y, 64) > 900);
}

void TestTemporalFilter::followsSlowRampWithTheDelayThatIsReported()
{
    // A brightness that rises by 1 a frame, far below the noise: it comes (1 − K)/K frames late, which is what PROC tells.
    TemporalFilter filter;
    constexpr double k = 0.25;
    cv::Mat picture;
    for (int frame = 0; frame < 60; ++frame) {
        picture = cv::Mat(4, 4, CV_32FC1, cv::Scalar(frame));
        filter.apply(picture, k, {0, 1e9});
    }
    const double lag = 59 - static_cast<double>(picture.at<float>(2, 2));
    QVERIFY(std::abs(lag - 3) < 0.01);
    QVERIFY(std::abs(milliseconds(settledDelay(k, 100ms)) - 300) < 0.001);
}

/// A K that rises rids the picture at once of a part of what is late only.
void TestTemporalFilter::followsSlowRampWithTheDelayThatIsReportedWhileKChanges()
{
    TemporalFilter filter;
    Duration delay{};
    cv::Mat picture;
    for (int frame = 0; frame < 40; ++frame) {
        const double k = frame < 20 ? 0.25 : frame < 30 ? 0.7 : 0.4;
        picture = cv::Mat(4, 4, CV_32FC1, cv::Scalar(frame));
        filter.apply(picture, k, {0, 1e9});
        delay = frame > 0 ? filterDelay(k, delay, 100ms) : Duration::zero();
        const double lag = frame - static_cast<double>(picture.at<float>(2, 2));
        QVERIFY2(std::abs(milliseconds(delay) - 100 * lag) < 0.5, qPrintable(QString::number(frame)));
    }
}

void TestTemporalFilter::startsAnewAfterReset()
{
    TemporalFilter filter;
    cv::Mat first(8, 8, CV_32FC1, cv::Scalar(100));
    filter.apply(first, 0.25, {0, 1e9});
    QVERIFY(filter.remembers({8, 8}));
    filter.reset();
    QVERIFY(!filter.remembers({8, 8}));
    cv::Mat second(8, 8, CV_32FC1, cv::Scalar(500));
    filter.apply(second, 0.25, {0, 1e9});
    QCOMPARE(second.at<float>(3, 3), 500.0F);
}

void TestTemporalFilter::startsAnewForAnotherSize()
{
    TemporalFilter filter;
    cv::Mat first(8, 8, CV_32FC1, cv::Scalar(100));
    filter.apply(first, 0.25, {0, 1e9});
    cv::Mat second(9, 8, CV_32FC1, cv::Scalar(500));
    filter.apply(second, 0.25, {0, 1e9});
    QCOMPARE(second.at<float>(3, 3), 500.0F);
}

void TestTemporalFilter::changesNothingAtK1()
{
    TemporalFilter filter;
    cv::Mat first(8, 8, CV_32FC1, cv::Scalar(100));
    filter.apply(first, 1, {0, 1e9});
    cv::Mat second(8, 8, CV_32FC1, cv::Scalar(500));
    filter.apply(second, 1, {0, 1e9});
    QCOMPARE(second.at<float>(3, 3), 500.0F);
}

void TestTemporalFilter::tellsDelays_data()
{
    QTest::addColumn<double>("k");
    QTest::addColumn<int>("atFifteen");
    QTest::addColumn<int>("atSevenAndAHalf");
    QTest::newRow("0.7") << 0.7 << 29 << 57;
    QTest::newRow("0.5") << 0.5 << 67 << 133;
    QTest::newRow("0.35") << 0.35 << 124 << 248;
    QTest::newRow("0.25") << 0.25 << 200 << 400;
    QTest::newRow("off") << 1.0 << 0 << 0;
}

void TestTemporalFilter::tellsDelays()
{
    QFETCH(double, k);
    QFETCH(int, atFifteen);
    QFETCH(int, atSevenAndAHalf);
    QCOMPARE(static_cast<int>(std::lround(milliseconds(settledDelay(k, fromMilliseconds(1000.0 / 15))))), atFifteen);
    QCOMPARE(static_cast<int>(std::lround(milliseconds(settledDelay(k, fromMilliseconds(1000.0 / 7.5))))), atSevenAndAHalf);
}

void TestTemporalFilter::keepsDelayWithinRoom()
{
    for (const auto before : {0ms, 200ms})
        for (const auto room : {10ms, 50ms, 65ms}) {
            const double k = leastK(room, before, 66ms);
            QVERIFY(k > 0 && k < 1);
            QVERIFY(std::abs(milliseconds(filterDelay(k, before, 66ms)) - milliseconds(room)) < 0.01);
        }
    QCOMPARE(leastK(300ms, 200ms, 66ms), 0.0); // there is room for more than can be
    QCOMPARE(leastK(0ms, 10ms, 66ms), 1.0);
    QCOMPARE(leastK(-5ms, 10ms, 66ms), 1.0);
    QCOMPARE(leastK(50ms, 10ms, 0ms), 1.0);
    QCOMPARE(kOfStrength(0), 1.0);
    QCOMPARE(kOfStrength(100), 0.25);
    QCOMPARE(kOfStrength(1000), 0.25);
}

QTEST_APPLESS_MAIN(TestTemporalFilter)
#include "test_temporal_filter.moc"
