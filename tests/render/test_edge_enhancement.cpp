// Tests of the edge enhancement: its transfer, and that noise is left alone.
#include "imaging/edge_enhancement.hpp"
#include "noisy_picture.hpp"

#include <QtTest>

#include <numbers>

using namespace console;

namespace {

constexpr int edge = 256;

// A wave along the rows and its amplitude in the middle of the picture.
cv::Mat wave(double frequency, double amplitude)
{
    return samples::noisyPicture(
        edge, 1, [=](int x, int) { return 1000 + amplitude * std::cos(2 * std::numbers::pi * frequency * x); }, [](double) { return 0.0; });
}

double amplitudeOf(const cv::Mat& picture, double frequency)
{
    double sum = 0;
    int count = 0;
    for (int x = 64; x < 192; ++x, ++count)
        sum += (picture.at<float>(edge / 2, x) - 1000) * std::cos(2 * std::numbers::pi * frequency * x);
    return 2 * sum / count;
}

} // namespace

class TestEdgeEnhancement : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void hasTheTransferOfAnUnsharpMask_data();
    void hasTheTransferOfAnUnsharpMask();
    void doesNothingAtZero();
    void leavesFlatPicturesAlone();
    void doesNotRaiseNoise();
    void raisesEdgesAboveNoise();
};

void TestEdgeEnhancement::hasTheTransferOfAnUnsharpMask_data()
{
    QTest::addColumn<double>("frequency");
    QTest::addColumn<int>("percent");
    QTest::newRow("slow, full") << 1.0 / 64 << 100;
    QTest::newRow("middle, full") << 1.0 / 16 << 100;
    QTest::newRow("fast, full") << 1.0 / 4 << 100;
    QTest::newRow("middle, half") << 1.0 / 16 << 50;
    QTest::newRow("fast, a quarter") << 1.0 / 4 << 25;
}

void TestEdgeEnhancement::hasTheTransferOfAnUnsharpMask()
{
    QFETCH(double, frequency);
    QFETCH(int, percent);
    cv::Mat picture = wave(frequency, 100);
    EdgeEnhancement().apply(picture, percent, {});
    const double gain = EdgeEnhancement::strongest * percent / 100;
    const double exponent = 2 * std::pow(std::numbers::pi * EdgeEnhancement::sigma * frequency, 2);
    const double expected = 1 + gain * (1 - std::exp(-exponent));
    const double measured = amplitudeOf(picture, frequency) / 100;
    QVERIFY2(std::abs(measured / expected - 1) < 0.01, qPrintable(QStringLiteral("%1 for %2").arg(measured).arg(expected)));
}

void TestEdgeEnhancement::doesNothingAtZero()
{
    cv::Mat picture = wave(0.1, 50);
    const cv::Mat before = picture.clone();
    EdgeEnhancement().apply(picture, 0, {});
    QCOMPARE(cv::countNonZero(picture != before), 0);
}

void TestEdgeEnhancement::leavesFlatPicturesAlone()
{
    cv::Mat picture(32, 32, CV_32FC1, cv::Scalar(700));
    EdgeEnhancement().apply(picture, 100, {});
    for (int x = 0; x < 32; ++x)
        QVERIFY(std::abs(picture.at<float>(0, x) - 700) < 1e-3);
}

void TestEdgeEnhancement::doesNotRaiseNoise()
{
    const auto flat = [] {
        return samples::noisyPicture(
            edge, 5, [](int, int) { return 1000.0; }, [](double) { return 100.0; });
    };
    cv::Mat limited = flat();
    EdgeEnhancement().apply(limited, 100, {0, 100});
    cv::Mat unlimited = flat();
    EdgeEnhancement().apply(unlimited, 100, {});
    QVERIFY(samples::varianceOf(limited, 0, edge) < 125);
    QVERIFY(samples::varianceOf(unlimited, 0, edge) > 500);
}

void TestEdgeEnhancement::raisesEdgesAboveNoise()
{
    cv::Mat picture(64, 64, CV_32FC1, cv::Scalar(1000));
    picture.col(32) -= 200; // a wire
    EdgeEnhancement().apply(picture, 50, {0, 100});
    QVERIFY(picture.at<float>(30, 32) < 700);
}

QTEST_APPLESS_MAIN(TestEdgeEnhancement)
#include "test_edge_enhancement.moc"
