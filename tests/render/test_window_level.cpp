// Tests of window and level against DICOM PS3.3 C.11.2.1.2.
#include "imaging/window_level.hpp"
#include "sample_frames.hpp"

#include <QtTest>

#include <algorithm>
#include <limits>

using namespace console;

namespace {

/// Every value from `low` to `high`, as often as every other one.
cv::Mat ramp(int low, int high)
{
    cv::Mat stored(100, 100, CV_16UC1);
    for (int i = 0; i < 10000; ++i)
        stored.at<std::uint16_t>(i / 100, i % 100) = static_cast<std::uint16_t>(low + (high - low) * i / 9999);
    return stored;
}

} // namespace

class TestWindowLevel : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void showsValuesWorkedByHand_data();
    void showsValuesWorkedByHand();
    void tableEqualsFormulaForEverySixteenBitValue_data();
    void tableEqualsFormulaForEverySixteenBitValue();
    void invertsMonochrome1();
    void givesNoImageForOtherTypes();
    void knowsWhichWindowsMeanSomething();
    void findsPercentiles();
    void autoWindowMovesByAtMostFivePercentPerFrame();
    void autoWindowIsRightSoonAfterAnyFirstPicture_data();
    void autoWindowIsRightSoonAfterAnyFirstPicture();
    void onePictureThatFailedMovesAutoWindowLittle();
    void autoWindowSurvivesFlatPictures();
};

void TestWindowLevel::showsValuesWorkedByHand_data()
{
    QTest::addColumn<int>("stored");
    QTest::addColumn<double>("centre");
    QTest::addColumn<double>("width");
    QTest::addColumn<int>("shown");
    // Centre 2048, width 4096: 0 and below black, above 4095 white.
    QTest::newRow("lowest of 12 bits") << 0 << 2048.0 << 4096.0 << 0;
    QTest::newRow("first step") << 9 << 2048.0 << 4096.0 << 1;
    QTest::newRow("middle") << 2048 << 2048.0 << 4096.0 << 128;
    QTest::newRow("below the middle") << 2047 << 2048.0 << 4096.0 << 127;
    QTest::newRow("highest of 12 bits") << 4095 << 2048.0 << 4096.0 << 255;
    QTest::newRow("above") << 4096 << 2048.0 << 4096.0 << 255;
    // Width 1 is a threshold at centre − 0.5.
    QTest::newRow("threshold, below") << 99 << 100.0 << 1.0 << 0;
    QTest::newRow("threshold, at") << 100 << 100.0 << 1.0 << 255;
    // Width 2: centre − 1 is black, centre is white.
    QTest::newRow("width 2, black") << 99 << 100.0 << 2.0 << 0;
    QTest::newRow("width 2, white") << 100 << 100.0 << 2.0 << 255;
    QTest::newRow("8 bits unchanged") << 77 << 128.0 << 256.0 << 77;
    QTest::newRow("width below 1 is 1") << 100 << 100.0 << 0.25 << 255;
    QTest::newRow("negative centre") << 0 << -50.0 << 10.0 << 255;
}

void TestWindowLevel::showsValuesWorkedByHand()
{
    QFETCH(int, stored);
    QFETCH(double, centre);
    QFETCH(double, width);
    QFETCH(int, shown);
    QCOMPARE(static_cast<int>(displayValue(stored, {{centre, width}})), shown);
}

void TestWindowLevel::tableEqualsFormulaForEverySixteenBitValue_data()
{
    QTest::addColumn<int>("centre");
    QTest::addColumn<int>("width");
    QTest::newRow("all") << 32768 << 65536;
    QTest::newRow("12 bits") << 2048 << 4096;
    QTest::newRow("narrow") << 700 << 333;
    QTest::newRow("threshold") << 5000 << 1;
    QTest::newRow("two") << 5000 << 2;
    QTest::newRow("partly below zero") << 10 << 400;
    QTest::newRow("wider than the values") << 32768 << 131072;
}

void TestWindowLevel::tableEqualsFormulaForEverySixteenBitValue()
{
    QFETCH(int, centre);
    QFETCH(int, width);
    cv::Mat stored(256, 256, CV_16UC1);
    for (int value = 0; value < 65536; ++value)
        stored.at<std::uint16_t>(value / 256, value % 256) = static_cast<std::uint16_t>(value);
    WindowLevelTable table;
    table.prepare({{static_cast<double>(centre), static_cast<double>(width)}});
    const QImage image = table.apply(stored);
    QCOMPARE(image.format(), QImage::Format_RGB32);
    for (int value = 0; value < 65536; ++value) {
        const int grey = samples::linearGrey(value, centre, width);
        QCOMPARE(image.pixel(value % 256, value / 256), qRgb(grey, grey, grey));
    }
}

void TestWindowLevel::invertsMonochrome1()
{
    for (int value = 0; value < 4096; ++value)
        QCOMPARE(displayValue(value, {{2048, 4096}, VoiFunction::Linear, Polarity::LowIsWhite}) + displayValue(value, {{2048, 4096}}), 255);
    cv::Mat stored(1, 2, CV_8UC1);
    stored.at<std::uint8_t>(0, 0) = 0;
    stored.at<std::uint8_t>(0, 1) = 255;
    WindowLevelTable table;
    table.prepare({{128, 256}, VoiFunction::Linear, Polarity::LowIsWhite});
    QCOMPARE(table.apply(stored).pixel(0, 0), qRgb(255, 255, 255));
    table.prepare({{128, 256}});
    QCOMPARE(table.apply(stored).pixel(0, 0), qRgb(0, 0, 0));
}

void TestWindowLevel::givesNoImageForOtherTypes()
{
    const WindowLevelTable table;
    QVERIFY(table.apply(cv::Mat()).isNull());
    QVERIFY(table.apply(cv::Mat(2, 2, CV_8UC3)).isNull());
    QVERIFY(table.apply(cv::Mat(2, 2, CV_32FC1)).isNull());
    QVERIFY(!percentileWindow(cv::Mat()).isKnown());
}

void TestWindowLevel::knowsWhichWindowsMeanSomething()
{
    QVERIFY((GreyWindow{0, 1}).isKnown());
    QVERIFY(!(GreyWindow{100, 0}).isKnown());
    QVERIFY(!(GreyWindow{100, -5}).isKnown());
    QVERIFY(!(GreyWindow{std::numeric_limits<double>::quiet_NaN(), 10}).isKnown());
    QVERIFY(!(GreyWindow{10, std::numeric_limits<double>::infinity()}).isKnown());
}

void TestWindowLevel::findsPercentiles()
{
    // Each of 0 … 99 once: the 1st percentile is 0, the 99th is 98.
    cv::Mat stored(10, 10, CV_16UC1);
    for (int i = 0; i < 100; ++i)
        stored.at<std::uint16_t>(i / 10, i % 10) = static_cast<std::uint16_t>(i);
    const GreyWindow window = percentileWindow(stored);
    QCOMPARE(window.centre, 49.5);
    QCOMPARE(window.width, 99.0);
    QCOMPARE(static_cast<int>(displayValue(0, {window})), 0);
    QCOMPARE(static_cast<int>(displayValue(98, {window})), 255);
    QVERIFY(displayValue(97, {window}) < 255);
}

void TestWindowLevel::autoWindowMovesByAtMostFivePercentPerFrame()
{
    const cv::Mat dark = ramp(0, 1000);
    const cv::Mat bright = ramp(900, 2100); // something of it is seen in the window of the other
    AutoWindow window;
    GreyWindow before = window.next(dark);
    QCOMPARE(before, percentileWindow(dark));
    for (int frame = 0; frame < 15; ++frame) {
        const GreyWindow now = window.next(bright);
        const double step = 0.05 * std::max(before.width, percentileWindow(bright).width) + 1e-9;
        QVERIFY(std::abs((now.centre - now.width / 2) - (before.centre - before.width / 2)) <= step);
        QVERIFY(std::abs((now.centre + now.width / 2) - (before.centre + before.width / 2)) <= step);
        QVERIFY(now.centre > before.centre);
        before = now;
    }
    for (int frame = 0; frame < 500; ++frame)
        before = window.next(bright);
    QVERIFY(std::abs(before.centre - percentileWindow(bright).centre) < 1);
    window.reset();
    QCOMPARE(window.next(dark), percentileWindow(dark));
}

void TestWindowLevel::autoWindowIsRightSoonAfterAnyFirstPicture_data()
{
    QTest::addColumn<int>("firstLow");
    QTest::addColumn<int>("firstHigh");
    QTest::addColumn<int>("low");
    QTest::addColumn<int>("high");
    QTest::newRow("black") << 0 << 0 << 800 << 3000;
    QTest::newRow("dark") << 90 << 130 << 800 << 3000;
    QTest::newRow("dark, before a flat one") << 90 << 130 << 3000 << 3100;
    QTest::newRow("bright, before a flat one") << 4000 << 4095 << 100 << 140;
    QTest::newRow("flat, among the values that follow") << 1000 << 1000 << 800 << 3000;
    QTest::newRow("narrow, at the edge of what follows") << 700 << 900 << 800 << 3000;
    QTest::newRow("wide") << 0 << 4095 << 800 << 3000;
}

/// Until then it is white or black: 30 pictures are two seconds.
void TestWindowLevel::autoWindowIsRightSoonAfterAnyFirstPicture()
{
    QFETCH(int, firstLow);
    QFETCH(int, firstHigh);
    QFETCH(int, low);
    QFETCH(int, high);
    const cv::Mat first = ramp(firstLow, firstHigh);
    const cv::Mat settled = ramp(low, high);
    const GreyWindow wanted = percentileWindow(settled);
    AutoWindow window;
    QCOMPARE(window.next(first), percentileWindow(first));
    GreyWindow now;
    for (int frame = 0; frame < 30; ++frame)
        now = window.next(settled);
    QVERIFY2(std::abs(now.centre - wanted.centre) < 1 && std::abs(now.width - wanted.width) < 1,
             qPrintable(QStringLiteral("C %1  W %2").arg(now.centre).arg(now.width)));
}

void TestWindowLevel::onePictureThatFailedMovesAutoWindowLittle()
{
    const cv::Mat good = ramp(800, 3000);
    const GreyWindow usual = percentileWindow(good);
    AutoWindow window;
    (void)window.next(good);
    for (int round = 0; round < 3; ++round) {
        const GreyWindow failed = window.next(ramp(0, 20));
        QVERIFY(std::abs(failed.centre - usual.centre) <= 0.05 * usual.width + 1e-9);
        const GreyWindow next = window.next(good);
        QVERIFY(std::abs(next.centre - usual.centre) < 1 && std::abs(next.width - usual.width) < 1);
    }
}

void TestWindowLevel::autoWindowSurvivesFlatPictures()
{
    const cv::Mat flat(50, 50, CV_16UC1, cv::Scalar(1234));
    AutoWindow window;
    for (int frame = 0; frame < 10; ++frame)
        QVERIFY(window.next(flat).width >= 2);
}

QTEST_APPLESS_MAIN(TestWindowLevel)
#include "test_window_level.moc"
