// Tests of the grey scale against values of DICOM PS3.14 and against displays made up for it.
#include "imaging/grey_scale.hpp"
#include "imaging/window_level.hpp"

#include <QTemporaryDir>
#include <QtTest>

#include <cmath>

using namespace console;

class TestGreyScale : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void givesTheStandardsLuminances();
    void findsIndexOfLuminance();
    void isTheIdentityWithoutMeasurement();
    void makesEqualStepsLookEqual();
    void countsTheLightOfTheRoom();
    void tellsTheTableOfAMeasuredDisplay();
    void readsMeasurement();
    void refusesBadMeasurement_data();
    void refusesBadMeasurement();
};

namespace {

// A display of gamma 2.2 between 0.5 and 400 cd/m².
DisplayMeasurement gammaDisplay(double ambient)
{
    DisplayMeasurement measured;
    measured.ambient = ambient;
    for (int level = 0; level <= 255; level += 5)
        measured.greys.push_back({level, 0.5 + 399.5 * std::pow(level / 255.0, 2.2)});
    return measured;
}

double lightOf(double level, double ambient) { return ambient + 0.5 + 399.5 * std::pow(level / 255.0, 2.2); }

} // namespace

void TestGreyScale::givesTheStandardsLuminances()
{
    // PS3.14 table B-1, first and last, and two between.
    QVERIFY(std::abs(gsdfLuminance(1) - 0.05) < 0.0001);
    QVERIFY(std::abs(gsdfLuminance(2) - 0.0547) < 0.0001);
    QVERIFY(std::abs(gsdfLuminance(1023) / 3993.4 - 1) < 0.0001);
    for (int index = 2; index <= 1023; ++index)
        QVERIFY(gsdfLuminance(index) > gsdfLuminance(index - 1));
}

void TestGreyScale::findsIndexOfLuminance()
{
    for (const double index : {1.5, 50.0, 333.25, 700.0, 1000.0})
        QVERIFY(std::abs(gsdfIndex(gsdfLuminance(index)) - index) < 1e-6);
    QVERIFY(gsdfIndex(0) < 1.001);
    QVERIFY(gsdfIndex(1e6) > 1022.999);
}

void TestGreyScale::isTheIdentityWithoutMeasurement()
{
    const GreyScale none;
    QVERIFY(!none.isCalibrated());
    QCOMPARE(none.level(0), 0.0);
    QCOMPARE(none.level(1), 255.0);
    QCOMPARE(none.level(0.5), 127.5);
    QCOMPARE(none.level(7), 255.0);
}

void TestGreyScale::makesEqualStepsLookEqual()
{
    const GreyScale scale(gammaDisplay(0));
    QVERIFY(scale.isCalibrated());
    const double first = gsdfIndex(lightOf(0, 0));
    const double last = gsdfIndex(lightOf(255, 0));
    for (int step = 0; step <= 10; ++step) {
        const double level = scale.level(step / 10.0);
        const double seen = gsdfIndex(lightOf(level, 0));
        QVERIFY2(std::abs(seen - (first + (last - first) * step / 10)) < 3, qPrintable(QStringLiteral("%1: %2").arg(step).arg(seen)));
    }
}

void TestGreyScale::countsTheLightOfTheRoom()
{
    const GreyScale dark(gammaDisplay(0));
    const GreyScale bright(gammaDisplay(5));
    QVERIFY(bright.level(0.1) > dark.level(0.1));
    QVERIFY(std::abs(bright.level(1) - 255) < 1e-6);
    QVERIFY(std::abs(bright.level(0)) < 1e-6);
}

void TestGreyScale::tellsTheTableOfAMeasuredDisplay()
{
    WindowLevelTable table;
    QVERIFY(!table.isCalibrated());
    table.prepare({{128, 256}});
    cv::Mat stored(1, 256, CV_8UC1);
    for (int value = 0; value < 256; ++value)
        stored.at<std::uint8_t>(0, value) = static_cast<std::uint8_t>(value);
    QVERIFY(table.presentation(stored).isNull());
    const GreyScale scale(gammaDisplay(0.3));
    table.setGreyScale(scale);
    QVERIFY(table.isCalibrated());
    const QImage shown = table.apply(stored);
    for (int value = 0; value < 256; ++value)
        QVERIFY(std::abs(qGray(shown.pixel(value, 0)) - scale.level(value / 255.0)) <= 0.5 + 1e-9);
    const QImage values = table.presentation(stored);
    QCOMPARE(values.format(), QImage::Format_Grayscale8);
    for (int value = 0; value < 256; ++value)
        QCOMPARE(qGray(values.pixel(value, 0)), value); // whatever the display is
    // INVERSE turns the P-values round, before the display: not the levels.
    table.prepare({{128, 256}, VoiFunction::Linear, Polarity::LowIsWhite});
    const QImage inverse = table.apply(stored);
    for (int value = 0; value < 256; ++value)
        QCOMPARE(inverse.pixel(255 - value, 0), shown.pixel(value, 0));
    QCOMPARE(qGray(table.presentation(stored).pixel(255, 0)), 0);
}

void TestGreyScale::readsMeasurement()
{
    const QTemporaryDir folder;
    QFile file(folder.filePath(QStringLiteral("display.txt")));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("# photometer 12, room at 20 lx\nambient 0.4\n0 0.5\n\n128 90 # middle\n255 400\n");
    file.close();
    const DisplayMeasurementResult read = readDisplayMeasurement(file.fileName());
    QVERIFY2(read.measurement, qPrintable(read.error));
    QCOMPARE(read.measurement->ambient, 0.4);
    QCOMPARE(read.measurement->greys.size(), std::size_t(3));
    QCOMPARE(read.measurement->greys[1].level, 128);
    QCOMPARE(read.measurement->greys[1].luminance, 90.0);
    QVERIFY(readDisplayMeasurement(folder.filePath(QStringLiteral("none.txt"))).error.contains(QStringLiteral("none.txt cannot be read")));
}

void TestGreyScale::refusesBadMeasurement_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("place");
    QTest::newRow("falls") << QByteArray("0 5\n100 4\n255 400\n") << QStringLiteral(":2:");
    QTest::newRow("level twice") << QByteArray("0 5\n0 6\n255 400\n") << QStringLiteral(":2:");
    QTest::newRow("no white") << QByteArray("0 5\n100 40\n") << QStringLiteral("0 and 255");
    QTest::newRow("no black") << QByteArray("5 5\n255 40\n") << QStringLiteral("0 and 255");
    QTest::newRow("empty") << QByteArray() << QStringLiteral("0 and 255");
    QTest::newRow("no number") << QByteArray("0 nan\n255 40\n") << QStringLiteral(":1:");
    QTest::newRow("level beyond") << QByteArray("0 1\n256 40\n") << QStringLiteral(":2:");
    QTest::newRow("three words") << QByteArray("0 1 2\n") << QStringLiteral(":1:");
    QTest::newRow("negative light") << QByteArray("0 -1\n") << QStringLiteral(":1:");
    QTest::newRow("too long") << QByteArray(70000, '#') << QStringLiteral("64 KiB");
}

void TestGreyScale::refusesBadMeasurement()
{
    QFETCH(QByteArray, text);
    QFETCH(QString, place);
    const QTemporaryDir folder;
    QFile file(folder.filePath(QStringLiteral("display.txt")));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(text);
    file.close();
    const DisplayMeasurementResult read = readDisplayMeasurement(file.fileName());
    QVERIFY(!read.measurement);
    QVERIFY2(read.error.contains(place), qPrintable(read.error));
}

QTEST_GUILESS_MAIN(TestGreyScale)
#include "test_grey_scale.moc"
