// Tests of the VOI LUT functions against DICOM PS3.3 C.11.2.1.2 and C.11.2.1.3.
#include "imaging/voi.hpp"
#include "imaging/window_level.hpp"

#include <QtTest>

#include <cmath>

using namespace console;

class TestVoi : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void followsTheFormulas_data();
    void followsTheFormulas();
    void sigmoidNeverEnds();
    void risesEverywhere();
    void keepsFractionsOfFilteredValues();
    void boundsSettings();
    void movesWindow();
};

void TestVoi::followsTheFormulas_data()
{
    QTest::addColumn<int>("function");
    QTest::addColumn<double>("stored");
    QTest::addColumn<double>("centre");
    QTest::addColumn<double>("width");
    QTest::addColumn<double>("expected");
    const auto linear = static_cast<int>(VoiFunction::Linear);
    const auto exact = static_cast<int>(VoiFunction::LinearExact);
    const auto sigmoid = static_cast<int>(VoiFunction::Sigmoid);
    // LINEAR: (x − (c − 0.5))/(w − 1) + 0.5.
    QTest::newRow("linear, lowest") << linear << 0.0 << 2048.0 << 4096.0 << 0.0;
    QTest::newRow("linear, highest") << linear << 4095.0 << 2048.0 << 4096.0 << 1.0;
    QTest::newRow("linear, c − 0.5 is the middle") << linear << 2047.5 << 2048.0 << 4096.0 << 0.5;
    QTest::newRow("linear, a quarter") << linear << 99.5 - 25.25 << 100.0 << 102.0 << 0.25;
    // LINEAR_EXACT: (x − c)/w + 0.5, clipped at c ± w/2.
    QTest::newRow("exact, lowest") << exact << 0.0 << 2048.0 << 4096.0 << 0.0;
    QTest::newRow("exact, c is the middle") << exact << 2048.0 << 2048.0 << 4096.0 << 0.5;
    QTest::newRow("exact, highest") << exact << 4096.0 << 2048.0 << 4096.0 << 1.0;
    QTest::newRow("exact, below") << exact << -10.0 << 2048.0 << 4096.0 << 0.0;
    QTest::newRow("exact, above") << exact << 4097.0 << 2048.0 << 4096.0 << 1.0;
    QTest::newRow("exact, width below 1") << exact << 10.1 << 10.0 << 0.4 << 0.75;
    // SIGMOID: 1/(1 + exp(−4 (x − c)/w)).
    QTest::newRow("sigmoid, middle") << sigmoid << 2048.0 << 2048.0 << 4096.0 << 0.5;
    QTest::newRow("sigmoid, a half width above") << sigmoid << 150.0 << 100.0 << 100.0 << 1 / (1 + std::exp(-2.0));
    QTest::newRow("sigmoid, a width below") << sigmoid << 0.0 << 100.0 << 100.0 << 1 / (1 + std::exp(4.0));
}

void TestVoi::followsTheFormulas()
{
    QFETCH(int, function);
    QFETCH(double, stored);
    QFETCH(double, centre);
    QFETCH(double, width);
    QFETCH(double, expected);
    const double value = voiValue(stored, {centre, width}, static_cast<VoiFunction>(function), 255);
    QVERIFY2(std::abs(value - 255 * expected) < 1e-9, qPrintable(QString::number(value, 'g', 12)));
}

void TestVoi::sigmoidNeverEnds()
{
    const GreyWindow window{2048, 1000};
    QVERIFY(voiValue(0, window, VoiFunction::Sigmoid, 1) > 0);
    QVERIFY(voiValue(4095, window, VoiFunction::Sigmoid, 1) < 1);
}

void TestVoi::risesEverywhere()
{
    for (const VoiFunction function : {VoiFunction::Linear, VoiFunction::LinearExact, VoiFunction::Sigmoid})
        for (int stored = 1; stored < 4096; ++stored)
            QVERIFY(voiValue(stored, {1000, 700}, function, 255) >= voiValue(stored - 1, {1000, 700}, function, 255));
}

void TestVoi::keepsFractionsOfFilteredValues()
{
    // A window of two stored values: what a filter puts between them is still seen.
    WindowLevelTable table;
    table.prepare({{101, 2}, VoiFunction::LinearExact}, 4);
    cv::Mat sixteenths(1, 3, CV_16UC1);
    sixteenths.at<std::uint16_t>(0, 0) = 100 * 16 + 8;
    sixteenths.at<std::uint16_t>(0, 1) = 101 * 16;
    sixteenths.at<std::uint16_t>(0, 2) = 101 * 16 + 8;
    const QImage image = table.apply(sixteenths);
    QCOMPARE(qGray(image.pixel(0, 0)), 64);
    QCOMPARE(qGray(image.pixel(1, 0)), 128);
    QCOMPARE(qGray(image.pixel(2, 0)), 191);
}

void TestVoi::boundsSettings()
{
    DisplaySettings settings;
    settings.edge = 400;
    settings.noiseReduction = -3;
    settings.window = WindowChoice::Fixed;
    const DisplaySettings bounded = withinBounds(settings);
    QCOMPARE(bounded.edge, 100);
    QCOMPARE(bounded.noiseReduction, 0);
    QCOMPARE(bounded.window, WindowChoice::AsSent);
    settings.fixed = {100, 50};
    QCOMPARE(withinBounds(settings).window, WindowChoice::Fixed);
}

void TestVoi::movesWindow()
{
    QCOMPARE(moved({1000, 400}, 0.5, 0), (GreyWindow{1200, 400}));
    QCOMPARE(moved({1000, 400}, 0, -0.5), (GreyWindow{1000, 200}));
    QCOMPARE(moved({1000, 3}, 0, -0.9).width, 2.0);
    QCOMPARE(moved({1000, 400}, 1e9, 1e9), (GreyWindow{131072, 131072}));
    QCOMPARE(moved({0, 0}, 1, 1), (GreyWindow{0, 0}));
    QCOMPARE(moved({1000, 400}, std::nan(""), 0), (GreyWindow{1000, 400}));
}

QTEST_APPLESS_MAIN(TestVoi)
#include "test_voi.moc"
