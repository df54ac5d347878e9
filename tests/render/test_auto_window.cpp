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
    void isThatOfAPictureThatStands();
    void goesOnFromAPictureThatWasRedrawn();
    void staysInsideTheShutterOfAPictureThatStands();
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
    for (const char* what : {"nothing", "acquisition", "source", "photometry", "intensity", "gap", "time runs back", "shutter"})
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
    else if (what == QStringLiteral("gap"))
        frame->captureNs += 5'000'000'000ULL;
    else if (what == QStringLiteral("time runs back")) // through a review
        frame->captureNs -= 5'000'000'000ULL;
    DisplaySettings settings = automatic();
    if (what == QStringLiteral("shutter"))
        settings.shutter = ShutterShape::Circle;
    const DisplayPicture picture = run.show(*frame, settings);
    QVERIFY(picture.windowIsAutomatic);
    QCOMPARE(picture.window == percentileWindow(run.chain.stored()), what != QStringLiteral("nothing"));
}

/// What was right for another picture, many before it, is nothing to go on from: this one gets no second step.
void TestAutoWindow::isThatOfAPictureThatStands()
{
    Run run;
    (void)run.show(*flatFrame(1, 500), automatic());
    for (quint32 number = 2; number <= 20; ++number)
        (void)run.show(*flatFrame(number, 3000), {});
    DisplayPicture picture;
    QVERIFY(run.chain.redraw(automatic(), picture));
    QVERIFY(picture.windowIsAutomatic);
    QCOMPARE(picture.window, percentileWindow(run.chain.stored()));
}

void TestAutoWindow::goesOnFromAPictureThatWasRedrawn()
{
    Run run;
    DisplayPicture before;
    (void)run.show(*flatFrame(1, 1000), {});
    QVERIFY(run.chain.redraw(automatic(), before));
    const DisplayPicture after = run.show(*flatFrame(2, 1200), automatic());
    QVERIFY(after.window != before.window);
    QVERIFY(std::abs(after.window.centre - before.window.centre) < 1); // as it does from one picture to the next
}

void TestAutoWindow::staysInsideTheShutterOfAPictureThatStands()
{
    Run run;
    const QSize size = samples::chainSize;
    std::vector<std::uint16_t> values(static_cast<std::size_t>(size.width() * size.height()), 4000); // a collimator's blaze
    const Shutter round(ShutterShape::Circle, size);
    for (int row = 0; row < size.height(); ++row) {
        const Shutter::Opening opening = round.opening(row);
        for (int column = opening.first; column < opening.end; ++column)
            values[static_cast<std::size_t>(row * size.width() + column)] = static_cast<std::uint16_t>(500 + column);
    }
    const auto frame = samples::frame(1, size, 12, PixelEncoding::Raw);
    const auto open = run.show(*samples::withBytes(*frame, samples::encode(values, size, 12, PixelEncoding::Raw, 0)), automatic()).window;
    QVERIFY(open.width > 3000);
    DisplaySettings settings = automatic();
    settings.shutter = ShutterShape::Circle;
    DisplayPicture picture;
    QVERIFY(run.chain.redraw(settings, picture));
    QVERIFY(picture.window.width < 100);
    settings.inverted = true;
    const GreyWindow inside = picture.window;
    QVERIFY(run.chain.redraw(settings, picture));
    QCOMPARE(picture.window, inside); // no other setting moves it
    QVERIFY(run.chain.redraw(automatic(), picture));
    QCOMPARE(picture.window, open);
}

QTEST_APPLESS_MAIN(TestAutoWindow)
#include "test_auto_window.moc"
