// Tests of the noise that is read from one picture.
#include "imaging/noise_model.hpp"
#include "noisy_picture.hpp"

#include <QtTest>

using namespace console;

class TestNoiseModel : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void findsEvenNoise();
    void findsNoiseThatGrowsWithBrightness();
    void isNotMisledByEdges();
    void hasNoneForPicturesThatCannotTell();
    void isNeverNegative();
};

void TestNoiseModel::findsEvenNoise()
{
    const cv::Mat picture = samples::noisyPicture(
        256, 1, [](int, int) { return 1000.0; }, [](double) { return 25.0; });
    QVERIFY(std::abs(estimateNoise(picture).variance(1000) - 25) < 4);
}

void TestNoiseModel::findsNoiseThatGrowsWithBrightness()
{
    const cv::Mat picture = samples::noisyPicture(
        512, 2, [](int x, int) { return 200.0 + 6 * x; }, [](double value) { return 0.5 * value + 40; });
    const NoiseModel noise = estimateNoise(picture);
    for (const double value : {400.0, 1000.0, 2000.0, 3000.0}) {
        const double share = noise.variance(value) / (0.5 * value + 40);
        QVERIFY2(share > 0.8 && share < 1.2, qPrintable(QString::number(share)));
    }
}

void TestNoiseModel::isNotMisledByEdges()
{
    // Stripes 40 wide with steps of a thousand, and noise of variance 9.
    const cv::Mat picture = samples::noisyPicture(
        512, 3, [](int x, int) { return (x / 40) % 2 == 0 ? 500.0 : 1500.0; }, [](double) { return 9.0; });
    QVERIFY(std::abs(estimateNoise(picture).variance(500) - 9) < 2);
    QVERIFY(std::abs(estimateNoise(picture).variance(1500) - 9) < 2);
}

void TestNoiseModel::hasNoneForPicturesThatCannotTell()
{
    QCOMPARE(estimateNoise(cv::Mat()).variance(100), 0.0);
    QCOMPARE(estimateNoise(cv::Mat(4, 2, CV_32FC1, cv::Scalar(7))).variance(7), 0.0);
    QCOMPARE(estimateNoise(cv::Mat(64, 64, CV_32FC1, cv::Scalar(7))).variance(7), 0.0);
    QCOMPARE(estimateNoise(cv::Mat(64, 64, CV_16UC1, cv::Scalar(7))).variance(7), 0.0);
}

void TestNoiseModel::isNeverNegative()
{
    const NoiseModel noise{-1, 10};
    QCOMPARE(noise.variance(4), 6.0);
    QCOMPARE(noise.variance(400), 0.0);
    QCOMPARE(noise.scaled(0.5).variance(4), 3.0);
}

QTEST_APPLESS_MAIN(TestNoiseModel)
#include "test_noise_model.moc"
