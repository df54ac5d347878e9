// Tests of the multi-scale enhancement: what it raises, and what it leaves alone.
#include "imaging/multi_scale_enhancement.hpp"
#include "noisy_picture.hpp"

#include <QtTest>

#include <numbers>

using namespace console;

namespace {

constexpr int edge = 256;
constexpr double ground = 1000;

// A wave along the rows around `ground`.
cv::Mat wave(double period, double amplitude)
{
    return samples::noisyPicture(
        edge, 1, [=](int x, int) { return ground + amplitude * std::cos(2 * std::numbers::pi * x / period); }, [](double) { return 0.0; });
}

double amplitudeOf(const cv::Mat& picture, double period)
{
    double sum = 0;
    for (int x = 64; x < 192; ++x)
        sum += (picture.at<float>(edge / 2, x) - ground) * std::cos(2 * std::numbers::pi * x / period);
    return sum / 64;
}

// How many times as high a wave of that amplitude becomes.
double raised(double period, double amplitude, int percent, const NoiseModel& noise = {})
{
    cv::Mat picture = wave(period, amplitude);
    MultiScaleEnhancement().apply(picture, percent, noise);
    return amplitudeOf(picture, period) / amplitude;
}

cv::Mat noisyGround(double variance)
{
    return samples::noisyPicture(
        edge, 5, [](int, int) { return ground; }, [variance](double) { return variance; });
}

} // namespace

class TestMultiScale : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void raisesWeakDetailOfEverySize_data();
    void raisesWeakDetailOfEverySize();
    void isStrongerWithThePercentage();
    void leavesStrongContrastAlone();
    void doesNothingAtZero();
    void leavesFlatAndSmallPicturesAlone();
    void doesNotRaiseNoise();
    void makesNoHaloBesideAStrongEdge();
};

void TestMultiScale::raisesWeakDetailOfEverySize_data()
{
    QTest::addColumn<double>("period");
    QTest::addColumn<double>("least");
    QTest::newRow("4 pixels") << 4.0 << 2.5;
    QTest::newRow("8 pixels") << 8.0 << 2.5;
    QTest::newRow("16 pixels") << 16.0 << 2.5;
    QTest::newRow("32 pixels") << 32.0 << 2.0;
}

void TestMultiScale::raisesWeakDetailOfEverySize()
{
    QFETCH(double, period);
    QFETCH(double, least);
    const double found = raised(period, 5, 100);
    QVERIFY2(found > least && found < 3.01, qPrintable(QString::number(found)));
}

void TestMultiScale::isStrongerWithThePercentage()
{
    double before = 1;
    for (const int percent : {25, 50, 75, 100}) {
        const double found = raised(8, 5, percent);
        QVERIFY2(found > before + 0.2, qPrintable(QStringLiteral("%1 %: %2").arg(percent).arg(found)));
        before = found;
    }
}

void TestMultiScale::leavesStrongContrastAlone()
{
    const double found = raised(8, 400, 100); // its tops are strong; its slopes are less, and are raised a little
    QVERIFY2(found < 1.25, qPrintable(QString::number(found)));
}

void TestMultiScale::doesNothingAtZero()
{
    cv::Mat picture = wave(10, 50);
    const cv::Mat before = picture.clone();
    MultiScaleEnhancement().apply(picture, 0, {});
    QCOMPARE(cv::countNonZero(picture != before), 0);
}

void TestMultiScale::leavesFlatAndSmallPicturesAlone()
{
    for (const cv::Size size : {cv::Size(64, 64), cv::Size(33, 47), cv::Size(20, 200), cv::Size(3, 3), cv::Size(1, 1)}) {
        cv::Mat picture(size, CV_32FC1, cv::Scalar(700));
        MultiScaleEnhancement().apply(picture, 100, {});
        QCOMPARE(picture.size(), size);
        QVERIFY(cv::norm(picture, cv::Mat(size, CV_32FC1, cv::Scalar(700)), cv::NORM_INF) < 1e-3);
    }
}

void TestMultiScale::doesNotRaiseNoise()
{
    cv::Mat limited = noisyGround(100);
    MultiScaleEnhancement().apply(limited, 100, {0, 100});
    cv::Mat unlimited = noisyGround(100);
    MultiScaleEnhancement().apply(unlimited, 100, {});
    QVERIFY2(samples::varianceOf(limited, 0, edge) < 125, qPrintable(QString::number(samples::varianceOf(limited, 0, edge))));
    QVERIFY(samples::varianceOf(unlimited, 0, edge) > 500);
}

void TestMultiScale::makesNoHaloBesideAStrongEdge()
{
    cv::Mat picture(64, 64, CV_32FC1, cv::Scalar(ground));
    picture.colRange(32, 64) = cv::Scalar(ground / 4); // bone
    MultiScaleEnhancement().apply(picture, 100, {});
    double least = 0;
    double most = 0;
    cv::minMaxLoc(picture.rowRange(16, 48).colRange(8, 56), &least, &most);
    QVERIFY2(most < ground * 1.3 && least > -ground * 0.05, qPrintable(QStringLiteral("%1 to %2").arg(least).arg(most)));
}

QTEST_APPLESS_MAIN(TestMultiScale)
#include "test_multi_scale.moc"
