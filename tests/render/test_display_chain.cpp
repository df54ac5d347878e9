// Tests of the display chain as a whole: order, exactness without filters, when the filter begins anew, and how late it may be.
#include "chain_run.hpp"
#include "imaging/picture_marks.hpp"

#include <QtTest>

using namespace console;
using namespace std::chrono_literals;
using samples::flatFrame;
using samples::rampFrame;
using Run = samples::ChainRun;

namespace {

constexpr QSize size = samples::chainSize;

DisplaySettings filtered(int strength)
{
    DisplaySettings settings;
    settings.noiseReduction = strength;
    return settings;
}

/// flatFrame() of 1000 in JPEG-LS with that largest error.
std::shared_ptr<XrayFrame> jpegLsFrame(quint32 number, int error)
{
    const std::vector<std::uint16_t> values(static_cast<std::size_t>(size.width() * size.height()), 1000);
    auto made = samples::withBytes(*flatFrame(number, 1000), samples::encode(values, size, 12, PixelEncoding::JpegLs, error));
    made->encoding = PixelEncoding::JpegLs;
    made->quality = error;
    return made;
}

} // namespace

class TestDisplayChain : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void showsWindowsAsChosen_data();
    void showsWindowsAsChosen();
    void keepsWindowByHandAmongThePicturesValues();
    void keepsWindowByHandWhenPicturesHaveFewerBits();
    void leavesRoomForTheTimeThatAPictureStands();
    void filtersThoughTheCArmTrembles();
    void invertsBothPhotometries();
    void losesNothingInTheFilters();
    void tellsDelayOfFilter();
    void keepsDelayWithinRoom();
    void tellsWholeDelayWhileFilterWeakens_data();
    void tellsWholeDelayWhileFilterWeakens();
    void weakensFilterAtOnceAndStrengthensItSlowly();
    void blamesTheLatencyOnlyWhereItBoundsTheFilter();
    void beginsFilterAnew_data();
    void beginsFilterAnew();
    void redrawsWithoutFilteringTwice();
    void takesFilterAwayAndNeverPretendsIt();
    void enhancesEdgesByTheMethodChosen();
    void neverShowsWhatWasRefused();
    void usesPicturesAgain();
    void leavesPicturesAloneThatAreHeld();
    void blackensOutsideOfShutter();
};

void TestDisplayChain::showsWindowsAsChosen_data()
{
    QTest::addColumn<int>("choice");
    QTest::addColumn<double>("centre");
    QTest::addColumn<double>("width");
    QTest::newRow("as sent") << static_cast<int>(WindowChoice::AsSent) << 2048.0 << 4000.0;
    QTest::newRow("half") << static_cast<int>(WindowChoice::Narrow) << 2048.0 << 2000.0;
    QTest::newRow("twice") << static_cast<int>(WindowChoice::Wide) << 2048.0 << 8000.0;
    QTest::newRow("full") << static_cast<int>(WindowChoice::FullRange) << 2048.0 << 4096.0;
    QTest::newRow("by hand") << static_cast<int>(WindowChoice::Fixed) << 700.0 << 300.0;
}

void TestDisplayChain::showsWindowsAsChosen()
{
    QFETCH(int, choice);
    QFETCH(double, centre);
    QFETCH(double, width);
    DisplaySettings settings;
    settings.window = static_cast<WindowChoice>(choice);
    settings.fixed = {700, 300};
    auto frame = samples::frame(1, size, 12, PixelEncoding::Raw);
    frame->windowWidth = 4000;
    Run run;
    const DisplayPicture picture = run.show(*frame, settings);
    QCOMPARE(picture.window, (GreyWindow{centre, width}));
    QVERIFY(!picture.windowIsAutomatic);
    const auto values = samples::storedValues(size, 12);
    for (int x = 0; x < size.width(); ++x)
        QCOMPARE(qGray(picture.image.pixel(x, 0)),
                 samples::linearGrey(values[static_cast<std::size_t>(x)], static_cast<int>(centre), static_cast<int>(width)));
    settings.window = WindowChoice::Automatic;
    QVERIFY(run.show(*frame, settings).windowIsAutomatic);
}

void TestDisplayChain::keepsWindowByHandAmongThePicturesValues()
{
    Run run;
    DisplaySettings settings;
    settings.window = WindowChoice::Fixed;
    for (const double centre : {-50000.0, 50000.0}) {
        settings.fixed = {centre, 100};
        const DisplayPicture picture = run.show(*samples::frame(1, size, 12, PixelEncoding::Raw), settings);
        QVERIFY(picture.window.centre >= 0 && picture.window.centre <= 4096);
        QCOMPARE(picture.window.width, 100.0);
        int black = 0;
        int white = 0;
        for (int y = 0; y < size.height(); ++y)
            for (int x = 0; x < size.width(); ++x) {
                black += qGray(picture.image.pixel(x, y)) == 0 ? 1 : 0;
                white += qGray(picture.image.pixel(x, y)) == 255 ? 1 : 0;
            }
        QVERIFY(black > 0 && white > 0); // something is still seen
    }
}

/// As the X-ray system's ladder does: the window that is sent becomes the whole of eight bits.
void TestDisplayChain::keepsWindowByHandWhenPicturesHaveFewerBits()
{
    DisplaySettings settings;
    settings.window = WindowChoice::Fixed;
    settings.fixed = {1900, 600};
    settings.fixedOn = {12, {2048, 2000}};
    Run run;
    const QImage was = run.show(*rampFrame(1, 12), settings).image;
    const QImage is = run.show(*rampFrame(2, 8), settings).image;
    for (int column = 0; column < size.width(); ++column) {
        const int difference = qGray(was.pixel(column, 3)) - qGray(is.pixel(column, 3));
        QVERIFY2(std::abs(difference) <= 4, qPrintable(QString::number(difference))); // a step of eight bits is 3.3 of the window
    }
    QVERIFY(qGray(is.pixel(40, 3)) - qGray(is.pixel(20, 3)) > 200);
    const WindowBasis twelve{12, {2048, 2000}};
    const WindowBasis eight{8, {128, 256}};
    const auto there = carriedOver({1900, 600}, twelve, eight);
    QVERIFY(std::abs(there.width - 76.8) < 1e-9);
    const auto back = carriedOver(there, eight, twelve);
    QVERIFY(std::abs(back.centre - 1900) < 1e-9 && std::abs(back.width - 600) < 1e-9);
    QCOMPARE(carriedOver({1900, 600}, twelve, {12, {1000, 500}}), (GreyWindow{1900, 600})); // the system's own window moves, ours does not
}

/// At the lower rate it will stand for twice as long before the next one comes.
void TestDisplayChain::leavesRoomForTheTimeThatAPictureStands()
{
    Run run;
    const auto first = flatFrame(1, 1000);
    (void)run.show(*first, filtered(100), 160ms);
    auto second = flatFrame(2, 1000);
    second->rate = 7.5;
    second->captureNs = first->captureNs + 133'333'333;
    const auto picture = run.show(*second, filtered(100), 160ms);
    QVERIFY(picture.treatment.filterDelay + 133ms <= 160ms + 1ms);
}

void TestDisplayChain::filtersThoughTheCArmTrembles()
{
    Run run;
    double k = 1;
    for (quint32 number = 1; number < 30; ++number) {
        auto frame = flatFrame(number, 1000);
        frame->geometry.primaryAngle = number % 2 == 0 ? 30.01 : 29.99;
        k = run.show(*frame, filtered(100)).treatment.k;
    }
    QVERIFY(k < 0.5);
    auto turned = flatFrame(30, 1000);
    turned->geometry.primaryAngle = 30.2;
    QCOMPARE(run.show(*turned, filtered(100)).treatment.k, 1.0);
}

void TestDisplayChain::invertsBothPhotometries()
{
    Run run;
    auto frame = samples::frame(1, size, 12, PixelEncoding::Raw);
    DisplaySettings inverted;
    inverted.inverted = true;
    const QImage plain = run.show(*frame, {}).image;
    const QImage inverse = run.show(*frame, inverted).image;
    frame->photometric = Photometric::Monochrome1;
    QCOMPARE(run.show(*frame, {}).image, inverse);
    QCOMPARE(run.show(*frame, inverted).image, plain);
    QVERIFY(plain != inverse);
}

void TestDisplayChain::losesNothingInTheFilters()
{
    // Through the floating-point way and back: a picture that nothing changes comes out as it went in.
    Run run;
    const auto frame = samples::frame(1, size, 12, PixelEncoding::Raw);
    QCOMPARE(run.show(*frame, filtered(100)).image, run.show(*frame, {}).image);
    QCOMPARE(run.refusal, QString());
}

void TestDisplayChain::tellsDelayOfFilter()
{
    Run run;
    QCOMPARE(run.show(*flatFrame(1, 1000), filtered(100)).treatment.filterDelay, Duration::zero()); // it shows itself alone
    Duration delay{};
    for (quint32 number = 2; number < 40; ++number)
        delay = run.show(*flatFrame(number, 1000), filtered(100)).treatment.filterDelay;
    // K = 0.25, pulses 66.7 ms apart as announced: three frames.
    QVERIFY(std::abs(milliseconds(delay) - 200) < 1);
    QCOMPARE(run.show(*flatFrame(40, 1000), {}).treatment.filterDelay, Duration::zero());
}

void TestDisplayChain::keepsDelayWithinRoom()
{
    Run run;
    for (quint32 number = 1; number < 60; ++number) {
        const DisplayPicture picture = run.show(*flatFrame(number, 1000), filtered(100), 90ms);
        QVERIFY(picture.treatment.filterDelay <= 90ms + 1us);
        if (number > 1)
            QVERIFY(picture.treatment.filterIsBounded);
    }
    QCOMPARE(run.show(*flatFrame(60, 1000), filtered(100), 0ms).treatment.k, 1.0);
    // Every second picture only: the same delay is half as many frames.
    for (quint32 number = 62; number < 120; number += 2)
        QVERIFY(run.show(*flatFrame(number, 1000), filtered(100), 90ms).treatment.filterDelay <= 90ms + 1us);
}

void TestDisplayChain::tellsWholeDelayWhileFilterWeakens_data()
{
    QTest::addColumn<int>("strength");
    QTest::addColumn<int>("roomMs");
    QTest::newRow("a person weakens it") << 40 << 10'000;
    QTest::newRow("the room shrinks") << 100 << 95;
}

/// The picture that is mixed in is as late as it was, whatever K is now.
void TestDisplayChain::tellsWholeDelayWhileFilterWeakens()
{
    QFETCH(int, strength);
    QFETCH(int, roomMs);
    const double period = 1000.0 / 15;
    Run run;
    double before = 0;
    for (quint32 number = 1; number <= 40; ++number)
        before = milliseconds(run.show(*flatFrame(number, 1000), filtered(100)).treatment.filterDelay);
    for (quint32 number = 41; number <= 44; ++number) {
        const auto treatment = run.show(*flatFrame(number, 1000), filtered(strength), std::chrono::milliseconds(roomMs)).treatment;
        const double delay = milliseconds(treatment.filterDelay);
        QVERIFY(treatment.k > 0.5 && treatment.k < 1);
        QVERIFY2(std::abs(delay - (1 - treatment.k) * (before + period)) < 1, qPrintable(QString::number(delay)));
        QVERIFY2(delay <= roomMs - period + 1, qPrintable(QString::number(delay)));
        before = delay;
    }
}

void TestDisplayChain::weakensFilterAtOnceAndStrengthensItSlowly()
{
    Run run;
    quint32 number = 1;
    double before = run.show(*flatFrame(number, 1000), filtered(100)).treatment.k;
    for (++number; number < 10; ++number) {
        const double k = run.show(*flatFrame(number, 1000), filtered(100)).treatment.k;
        QVERIFY(k < before && before - k <= 0.05 + 1e-9);
        before = k;
    }
    QCOMPARE(run.show(*flatFrame(number, 1000), filtered(0)).treatment.k, 1.0);
}

void TestDisplayChain::blamesTheLatencyOnlyWhereItBoundsTheFilter()
{
    Run run;
    for (quint32 number = 1; number < 10; ++number) { // a run begins, and the filter with it
        const auto treatment = run.show(*flatFrame(number, 1000), filtered(100)).treatment;
        QVERIFY(treatment.k > 0.5 && !treatment.filterIsBounded);
    }
    QVERIFY(run.show(*flatFrame(10, 1000), filtered(100), 90ms).treatment.filterIsBounded);
    QVERIFY(!run.show(*flatFrame(11, 1000), filtered(100)).treatment.filterIsBounded); // it comes back slowly
}

void TestDisplayChain::beginsFilterAnew_data()
{
    QTest::addColumn<QString>("what");
    QTest::addColumn<bool>("anew");
    for (const char* what :
         {"acquisition", "angle", "table side of the beam", "zoom", "gain", "gap", "time runs back", "source", "lossy", "other quality"})
        QTest::newRow(what) << QString::fromLatin1(what) << true;
    for (const char* what : {"nothing", "lossless encoding", "same quality"})
        QTest::newRow(what) << QString::fromLatin1(what) << false;
}

void TestDisplayChain::beginsFilterAnew()
{
    QFETCH(QString, what);
    QFETCH(bool, anew);
    Run run;
    const bool wasLossy = what.endsWith(QStringLiteral("quality"));
    for (quint32 number = 1; number < 20; ++number)
        run.show(wasLossy ? *jpegLsFrame(number, 2) : *flatFrame(number, 1000), filtered(100));
    // 50 more than before: little against the brightness, and a filter that went on would show less of it than the whole.
    auto frame = flatFrame(20, what == QStringLiteral("gain") ? 1200 : 1000);
    if (what == QStringLiteral("acquisition"))
        frame->acquisition = 2;
    else if (what == QStringLiteral("angle"))
        frame->geometry.primaryAngle = 3;
    else if (what == QStringLiteral("table side of the beam"))
        frame->geometry.sourceObjectDistance = 740;
    else if (what == QStringLiteral("zoom"))
        frame->imagerPixelSpacing = 0.2;
    else if (what == QStringLiteral("gap"))
        frame->captureNs += 5'000'000'000ULL;
    else if (what == QStringLiteral("time runs back"))
        frame->captureNs -= 5'000'000'000ULL;
    else if (what == QStringLiteral("source"))
        frame->source = PictureSource::Recorded;
    else if (what == QStringLiteral("lossless encoding"))
        frame = jpegLsFrame(20, 0);
    else if (what == QStringLiteral("lossy") || what == QStringLiteral("same quality"))
        frame = jpegLsFrame(20, 2);
    else if (what == QStringLiteral("other quality"))
        frame = jpegLsFrame(20, 1);
    const DisplayPicture picture = run.show(*frame, filtered(100));
    QCOMPARE(run.refusal, QString());
    QCOMPARE(picture.treatment.k == 1.0, anew);
}

void TestDisplayChain::redrawsWithoutFilteringTwice()
{
    Run run;
    DisplayPicture redrawn;
    QVERIFY(!run.chain.redraw({}, redrawn));
    for (quint32 number = 1; number < 6; ++number)
        run.show(*flatFrame(number, 1000), filtered(60));
    const DisplayPicture shown = run.show(*flatFrame(6, 1040), filtered(60));
    for (int round = 0; round < 5; ++round)
        QVERIFY(run.chain.redraw(filtered(60), redrawn));
    QCOMPARE(redrawn.image, shown.image);
    QVERIFY(redrawn.isSameFrameAs(shown));
    QCOMPARE(redrawn.treatment.filterDelay, shown.treatment.filterDelay);
    DisplaySettings inverted = filtered(60);
    inverted.inverted = true;
    QVERIFY(run.chain.redraw(inverted, redrawn));
    QVERIFY(redrawn.image != shown.image);
    QVERIFY(redrawn.isSameFrameAs(shown));
}

void TestDisplayChain::takesFilterAwayAndNeverPretendsIt()
{
    Run run;
    for (quint32 number = 1; number < 6; ++number)
        run.show(*flatFrame(number, 1000), filtered(60));
    const DisplayPicture shown = run.show(*flatFrame(6, 1040), filtered(60));
    QVERIFY(shown.treatment.k < 1);
    DisplayPicture redrawn;
    QVERIFY(run.chain.redraw({}, redrawn));
    QCOMPARE(redrawn.treatment.k, 1.0);
    QCOMPARE(qGray(redrawn.image.pixel(3, 3)), samples::linearGrey(1040, 2048, 4096));
    QVERIFY(run.chain.redraw(filtered(10), redrawn)); // it cannot be weakened any more
    QCOMPARE(redrawn.treatment.k, shown.treatment.k);
    const long strength = std::lround(strengthOfK(shown.treatment.k));
    QVERIFY(strength > 10);
    QVERIFY2(treatmentLine(redrawn).contains(QStringLiteral("noise %1 %").arg(strength)), qPrintable(treatmentLine(redrawn)));
    Run other;
    other.show(*flatFrame(1, 1000), {});
    QVERIFY(other.chain.redraw(filtered(60), redrawn));
    QCOMPARE(redrawn.treatment.k, 1.0);
}

void TestDisplayChain::enhancesEdgesByTheMethodChosen()
{
    Run run;
    const auto frame = samples::frame(1, size, 12, PixelEncoding::Raw);
    DisplaySettings settings;
    const QImage plain = run.show(*frame, settings).image;
    settings.edge = 100;
    const QImage unsharp = run.show(*frame, settings).image;
    settings.edgeMethod = EdgeMethod::MultiScale;
    const QImage multiScale = run.show(*frame, settings).image;
    QVERIFY(unsharp != plain && multiScale != plain && multiScale != unsharp);
    settings.edge = 0;
    QCOMPARE(run.show(*frame, settings).image, plain); // no method does anything at nothing
}

void TestDisplayChain::neverShowsWhatWasRefused()
{
    Run run;
    const DisplayPicture good = run.show(*samples::frame(1, size, 12, PixelEncoding::JpegLs), {});
    auto damaged = samples::frame(2, {128, 96}, 12, PixelEncoding::JpegLs);
    std::vector<std::byte> bytes(damaged->pixels.begin(),
                                 damaged->pixels.begin() + static_cast<std::ptrdiff_t>(damaged->pixels.size() / 2));
    run.show(*samples::withBytes(*damaged, bytes), {});
    QVERIFY(!run.refusal.isEmpty());
    DisplayPicture redrawn;
    QVERIFY(run.chain.redraw({}, redrawn));
    QVERIFY(redrawn.isSameFrameAs(good));
    QCOMPARE(redrawn.image, good.image);
}

void TestDisplayChain::usesPicturesAgain()
{
    Run run;
    const uchar* first = nullptr;
    {
        const DisplayPicture picture = run.show(*flatFrame(1, 1000), {});
        first = picture.image.constBits();
    }
    const DisplayPicture again = run.show(*flatFrame(2, 2000), {});
    QCOMPARE(again.image.constBits(), first);
}

void TestDisplayChain::leavesPicturesAloneThatAreHeld()
{
    Run run;
    std::vector<DisplayPicture> held;
    for (quint32 number = 1; number <= 12; ++number)
        held.push_back(run.show(*flatFrame(number, static_cast<std::uint16_t>(100 * number)), {}));
    for (quint32 number = 1; number <= 12; ++number)
        QCOMPARE(qGray(held[number - 1].image.pixel(5, 5)), samples::linearGrey(static_cast<int>(100 * number), 2048, 4096));
}

void TestDisplayChain::blackensOutsideOfShutter()
{
    Run run;
    DisplaySettings settings;
    settings.shutter = ShutterShape::Circle;
    settings.inverted = true;
    const QImage image = run.show(*flatFrame(1, 0), settings).image;
    QCOMPARE(qGray(image.pixel(0, 0)), 0);
    QCOMPARE(qGray(image.pixel(size.width() / 2, size.height() / 2)), 255);
}

QTEST_APPLESS_MAIN(TestDisplayChain)
#include "test_display_chain.moc"
