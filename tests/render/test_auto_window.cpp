// Tests of the automatic window from picture to picture: which one it follows, and when it begins anew.
#include "chain_run.hpp"

#include <QtTest>

using namespace console;
using samples::flatFrame;
using samples::rampFrame;
using Run = samples::ChainRun;

namespace {

DisplaySettings automatic()
{
    DisplaySettings settings;
    settings.window = WindowChoice::Automatic;
    return settings;
}

} // namespace

class TestAutoWindow : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void showsTheSameInFewerBitsAtOnce_data();
    void showsTheSameInFewerBitsAtOnce();
    void beginsAnew_data();
    void beginsAnew();
};

void TestAutoWindow::showsTheSameInFewerBitsAtOnce_data()
{
    QTest::addColumn<int>("before");
    QTest::addColumn<int>("after");
    QTest::newRow("down the ladder") << 12 << 8;
    QTest::newRow("up again") << 8 << 12;
}

/// Edges that walked there would leave the picture black or white for seconds.
void TestAutoWindow::showsTheSameInFewerBitsAtOnce()
{
    QFETCH(int, before);
    QFETCH(int, after);
    Run run;
    const QImage was = run.show(*rampFrame(1, before), automatic()).image;
    const QImage is = run.show(*rampFrame(2, after), automatic()).image;
    for (int column = 0; column < was.width(); ++column) {
        const int difference = qGray(was.pixel(column, 3)) - qGray(is.pixel(column, 3));
        QVERIFY2(std::abs(difference) <= 4, qPrintable(QString::number(difference)));
    }
    QVERIFY(qGray(is.pixel(56, 3)) - qGray(is.pixel(4, 3)) > 200);
}

void TestAutoWindow::beginsAnew_data()
{
    QTest::addColumn<QString>("what");
    for (const char* what : {"nothing", "acquisition", "source", "photometry", "intensity"})
        QTest::newRow(what) << QString::fromLatin1(what);
}

void TestAutoWindow::beginsAnew()
{
    QFETCH(QString, what);
    Run run;
    (void)run.show(*flatFrame(1, 1000), automatic());
    const auto frame = flatFrame(2, 1200);
    if (what == QStringLiteral("acquisition"))
        frame->acquisition = 2;
    else if (what == QStringLiteral("source"))
        frame->source = PictureSource::Recorded;
    else if (what == QStringLiteral("photometry"))
        frame->photometric = Photometric::Monochrome1;
    else if (what == QStringLiteral("intensity"))
        frame->intensity = IntensityRelationship::Logarithmic;
    const DisplayPicture picture = run.show(*frame, automatic());
    QVERIFY(picture.windowIsAutomatic);
    QCOMPARE(picture.window == percentileWindow(run.chain.stored()), what != QStringLiteral("nothing"));
}

QTEST_APPLESS_MAIN(TestAutoWindow)
#include "test_auto_window.moc"
