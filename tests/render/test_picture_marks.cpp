// Tests of what is written on the live picture: how it is reduced and treated, how old it is, and that nothing covers another.
#include "imaging/figure_cells.hpp"
#include "imaging/picture_overlay.hpp"
#include "live_pane.hpp"

#include <QPainter>

using namespace console;
using samples::frameSize;
using samples::LivePane;

namespace {

// A frame that the X-ray system has reduced; colours occur in the picture only where the reduction is told.
std::shared_ptr<XrayFrame> reducedFrame(quint32 number, double rate, PixelEncoding encoding, int quality)
{
    auto frame = samples::frame(number, frameSize, 8, encoding, quality);
    frame->rung = 5;
    frame->rate = rate;
    frame->askedRate = 15;
    return frame;
}

// The pixels in the colour of caution, softened edges of letters among them.
QRegion cautionPixels(const QImage& image)
{
    QRegion region;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            if (qBlue(image.pixel(x, y)) - qRed(image.pixel(x, y)) > 60)
                region += QRect(x, y, 1, 1);
    return region;
}

QFont bodyFont()
{
    QFont font;
    font.setPixelSize(16);
    return font;
}

QRect differenceOf(const QImage& a, const QImage& b)
{
    QRect different;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            if (a.pixel(x, y) != b.pixel(x, y))
                different |= QRect(x, y, 1, 1);
    return different;
}

int pixelCount(const QRegion& region)
{
    int count = 0;
    for (const QRect& part : region)
        count += part.width() * part.height();
    return count;
}

} // namespace

class TestPictureMarks : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void saysHowPictureIsReduced();
    void saysReductionWithoutAlarmsColourWhereNothingIsLost();
    void neverClipsNorCoversReduction_data();
    void neverClipsNorCoversReduction();
    void writesAgeLine_data();
    void writesAgeLine();
    void roundsUncertaintyUp();
    void noFigureMovesAnother_data();
    void noFigureMovesAnother();
    void frozenSecondsStandStill();
    void wordsThatTellAHoldAreLarge();
    void keepsFactsApart();
    void windowAndCalibrationStandWhateverTheRoom_data();
    void windowAndCalibrationStandWhateverTheRoom();
    void saysHowItWasTreated();
    void coversNoMarkWithAnother_data();
    void coversNoMarkWithAnother();
};

void TestPictureMarks::saysHowPictureIsReduced()
{
    LivePane pane;
    QVERIFY(pane.send(1));
    QVERIFY(cautionPixels(pane.grab()).isEmpty());
    QVERIFY(pane.send(reducedFrame(2, 7.5, PixelEncoding::Jpeg, 75)));
    const QRegion words = cautionPixels(pane.grab());
    QVERIFY(pixelCount(words) > 200);
    QVERIFY((words - pane.view.overlayRegion()).isEmpty());
    QVERIFY(pane.view.accessibleDescription().contains(QStringLiteral("REDUCED 7.5 of 15 /s, lossy 75")));
    pane.state.expect(0, pane.now); // last image hold: what the picture is, without the colour of an alarm that is not there
    QVERIFY(cautionPixels(pane.grab()).isEmpty());
    QVERIFY(pane.view.accessibleDescription().contains(QStringLiteral("REDUCED")));
    pane.state.expect(15, pane.now);
    QVERIFY(pane.send(3));
    QVERIFY(cautionPixels(pane.grab()).isEmpty());
    QVERIFY(!pane.view.accessibleDescription().contains(QStringLiteral("REDUCED")));
}

void TestPictureMarks::saysReductionWithoutAlarmsColourWhereNothingIsLost()
{
    LivePane pane;
    QVERIFY(pane.send(1));
    pane.grab();
    const QRegion marks = pane.view.overlayRegion();
    QVERIFY(pane.send(reducedFrame(2, 15, PixelEncoding::JpegLs, 0)));
    QVERIFY(cautionPixels(pane.grab()).isEmpty());
    QVERIFY(!(pane.view.overlayRegion() - marks).isEmpty());
    QVERIFY(pane.view.accessibleDescription().contains(QStringLiteral("RE-ENCODED 15 of 15 /s, lossless")));
}

void TestPictureMarks::neverClipsNorCoversReduction_data()
{
    QTest::addColumn<QSize>("area");
    QTest::addColumn<int>("pixelSize");
    QTest::newRow("large") << QSize(1136, 1136) << 20;
    QTest::newRow("half a screen") << QSize(562, 562) << 10;
    QTest::newRow("least pane") << QSize(216, 216) << 10;
    QTest::newRow("wide") << QSize(900, 300) << 12;
    QTest::newRow("narrow") << QSize(110, 216) << 10;
    QTest::newRow("large letters in little room") << QSize(216, 400) << 32;
}

void TestPictureMarks::neverClipsNorCoversReduction()
{
    QFETCH(QSize, area);
    QFETCH(int, pixelSize);
    DisplayPicture picture;
    picture.about = *reducedFrame(1, 7.5, PixelEncoding::Jpeg, 75);
    QFont font;
    font.setPixelSize(pixelSize);
    PictureReading reading;
    std::vector<QRegion> words;
    for (const PictureCondition condition : {PictureCondition::Live, PictureCondition::Frozen, PictureCondition::Unknown}) {
        reading.condition = condition;
        const QRect where(QPoint(200, 200), area);
        QImage image(where.adjusted(-200, -200, 200, 200).size(), QImage::Format_RGB32);
        image.fill(Qt::black);
        QPainter painter(&image);
        PictureOverlay(where, picture, reading, 1, font).paint(painter);
        painter.end();
        words.push_back(cautionPixels(image));
        QVERIFY(pixelCount(words.back()) > 50);
        QVERIFY(where.contains(words.back().boundingRect()));
    }
    QCOMPARE(words[1], words[0]); // FROZEN stands below it
    QCOMPARE(words[2], words[0]);
}

void TestPictureMarks::writesAgeLine_data()
{
    QTest::addColumn<int>("age");
    QTest::addColumn<int>("network");
    QTest::addColumn<int>("processing");
    QTest::addColumn<QString>("line");
    QTest::newRow("usual") << 98 << 31 << 67 << QStringLiteral("AGE 98 ms  NET 31  PROC 67  15 of 30 fps");
    QTest::newRow("unknown") << -1 << -1 << 67 << QStringLiteral("AGE unknown  NET unknown  PROC 67  15 of 30 fps");
    QTest::newRow("old") << 12340 << 31 << 67 << QStringLiteral("AGE 12.3 s  NET 31  PROC 67  15 of 30 fps");
}

void TestPictureMarks::writesAgeLine()
{
    QFETCH(int, age);
    QFETCH(int, network);
    QFETCH(int, processing);
    QFETCH(QString, line);
    PictureReading reading;
    if (age >= 0)
        reading.age = std::chrono::milliseconds(age);
    if (network >= 0)
        reading.network = std::chrono::milliseconds(network);
    reading.processing = std::chrono::milliseconds(processing);
    reading.shownPerSecond = 15;
    reading.expectedPerSecond = 30;
    QCOMPARE(ageLine(reading), line);
    reading.expectedPerSecond = 0; // nothing is expected
    QVERIFY(ageLine(reading).endsWith(QStringLiteral("  15 fps")));
}

void TestPictureMarks::roundsUncertaintyUp()
{
    PictureReading reading;
    reading.age = std::chrono::milliseconds(98);
    reading.network = std::chrono::milliseconds(31);
    reading.processing = std::chrono::milliseconds(67);
    reading.uncertainty = std::chrono::microseconds(2100);
    QCOMPARE(ageLine(reading), QStringLiteral("AGE 98 \u00B13 ms  NET 31  PROC 67  0 fps"));
    reading.age.reset();
    QVERIFY(!ageLine(reading).contains(QStringLiteral("\u00B1")));
}

void TestPictureMarks::noFigureMovesAnother_data()
{
    QTest::addColumn<QSize>("area");
    QTest::newRow("in the corner") << QSize(1100, 1100);
    QTest::newRow("below the source") << QSize(520, 520);
    QTest::newRow("in two rows") << QSize(300, 400);
}

// AGE gets another figure, and a narrower one: NET, PROC and the rate stay where they are, pixel by pixel.
void TestPictureMarks::noFigureMovesAnother()
{
    QFETCH(QSize, area);
    DisplayPicture picture;
    picture.about = *samples::frame(1, frameSize, 8, PixelEncoding::Raw);
    PictureReading reading;
    reading.condition = PictureCondition::Live;
    reading.network = std::chrono::milliseconds(31);
    reading.processing = std::chrono::milliseconds(67);
    std::vector<QImage> seen;
    QRegion region;
    for (const int age : {98, 1111, 111, 888}) {
        reading.age = std::chrono::milliseconds(age);
        QImage image(area, QImage::Format_RGB32);
        image.fill(Qt::black);
        QPainter painter(&image);
        const PictureOverlay overlay(image.rect(), picture, reading, 1, bodyFont());
        overlay.paint(painter);
        QVERIFY(region.isEmpty() || region == overlay.region());
        QVERIFY(QRect(QPoint(), area).contains(overlay.region().boundingRect()));
        region = overlay.region();
        seen.push_back(image);
    }
    const QRect changed = differenceOf(seen[0], seen[1]) | differenceOf(seen[0], seen[2]) | differenceOf(seen[0], seen[3]);
    QVERIFY(!changed.isEmpty());
    const double room = figuresWidth(bodyFont(), QStringLiteral("8888 ±88 ms"));
    QVERIFY2(changed.width() <= room, qPrintable(QStringLiteral("%1 of %2").arg(changed.width()).arg(room)));
}

void TestPictureMarks::frozenSecondsStandStill()
{
    DisplayPicture picture;
    picture.about = *samples::frame(1, frameSize, 8, PixelEncoding::Raw);
    PictureReading reading;
    reading.condition = PictureCondition::Frozen;
    QRegion region;
    for (const int tenths : {4, 11, 108, 1111}) {
        reading.frozenFor = std::chrono::milliseconds(100 * tenths);
        const PictureOverlay overlay(QRect(0, 0, 600, 600), picture, reading, 1, bodyFont());
        QVERIFY(region.isEmpty() || region == overlay.region());
        region = overlay.region();
    }
}

// 24 pixels where the text has 16; beside the plate below, which is narrower.
void TestPictureMarks::wordsThatTellAHoldAreLarge()
{
    QFont head = bodyFont();
    head.setPixelSize(24);
    const int plate = QFontMetrics(head).height() + bodyFont().pixelSize() / 2;
    for (const PictureCondition condition : {PictureCondition::Held, PictureCondition::Frozen}) {
        DisplayPicture picture;
        picture.about = *samples::frame(1, frameSize, 8, PixelEncoding::Raw);
        PictureReading reading;
        reading.condition = condition;
        const PictureOverlay overlay(QRect(0, 0, 520, 520), picture, reading, 1, bodyFont());
        int rows = 0;
        for (int y = 80; y < 200; ++y)
            rows += overlay.region().contains(QPoint(360, y)) ? 1 : 0;
        QVERIFY2(rows >= plate, qPrintable(QStringLiteral("%1: %2 of %3").arg(word(condition)).arg(rows).arg(plate)));
    }
}

void TestPictureMarks::keepsFactsApart()
{
    DisplayPicture picture;
    picture.about = *samples::frame(18, frameSize, 12, PixelEncoding::Raw);
    picture.window = {1062, 1825};
    for (int width = 200; width <= 1200; width += 7) {
        TextPlates plates(bodyFont());
        const QRect where(0, 0, width, 400);
        const QRect bar = placeScale(plates, where, picture, 1);
        const QRegion scale = plates.region();
        placeFacts(plates, where, bar, picture, 1);
        QVERIFY(where.contains(plates.region().boundingRect()));
        for (const QRect& part : plates.region() - scale)
            QVERIFY2(!scale.intersects(part.adjusted(-plates.gap(), 0, plates.gap(), 0)), qPrintable(QString::number(width)));
    }
}

void TestPictureMarks::windowAndCalibrationStandWhateverTheRoom_data()
{
    QTest::addColumn<int>("pixelSize");
    for (const int pixelSize : {10, 16, 32})
        QTest::addRow("letters of %d", pixelSize) << pixelSize;
}

// Whole, and as large as the room allows.
void TestPictureMarks::windowAndCalibrationStandWhateverTheRoom()
{
    QFETCH(int, pixelSize);
    DisplayPicture picture;
    picture.about = *samples::frame(123456, frameSize, 12, PixelEncoding::Raw);
    picture.window = {32768, 65536};
    picture.windowIsAutomatic = true;
    picture.settings.inverted = true;
    picture.settings.noiseReduction = 60;
    picture.settings.edge = 30;
    picture.settings.shutter = ShutterShape::Circle;
    QFont font;
    font.setPixelSize(pixelSize);
    bool withFrame = false;
    for (int width = 160; width <= 1600; width += 7) {
        TextPlates plates(font);
        const QRect where(0, 0, width, 400);
        placeFacts(plates, where, {}, picture, 2);
        const auto shows = [&](const QString& text) {
            return std::any_of(plates.plates().begin(), plates.plates().end(), [&](const OverlayPlate& plate) {
                return plate.text.contains(text) && figuresWidth(plate.font, plate.text) <= plate.rect.width() &&
                       where.contains(plate.rect);
            });
        };
        QVERIFY2(shows(windowLine(picture)) && windowLine(picture).endsWith(QStringLiteral("AUTO")), qPrintable(QString::number(width)));
        QVERIFY2(shows(QStringLiteral("display not calibrated")), qPrintable(QString::number(width)));
        const bool frame = shows(QStringLiteral("frame 123456  run "));
        QVERIFY2(frame || !withFrame, qPrintable(QString::number(width))); // more room never takes it away
        withFrame = frame;
        if (figuresWidth(font, windowLine(picture)) <= width - 4 * plates.gap())
            QCOMPARE(plates.plates().front().font.pixelSize(), pixelSize);
    }
    QVERIFY(withFrame);
}

void TestPictureMarks::saysHowItWasTreated()
{
    DisplayPicture picture;
    picture.window = {2048, 4096};
    QCOMPARE(windowLine(picture), QStringLiteral("C 2048  W 4096"));
    QCOMPARE(treatmentLine(picture), QStringLiteral("display not calibrated"));
    picture.isCalibrated = true;
    picture.windowIsAutomatic = true;
    picture.settings.function = VoiFunction::Sigmoid;
    picture.settings.inverted = true;
    picture.settings.noiseReduction = 60;
    picture.treatment.k = 0.55;
    picture.settings.edge = 30;
    picture.settings.shutter = ShutterShape::Circle;
    QCOMPARE(windowLine(picture), QStringLiteral("C 2048  W 4096  SIGMOID  AUTO"));
    QCOMPARE(treatmentLine(picture), QStringLiteral("display calibrated  INVERTED  noise 60 %  edge 30 %, unsharp mask  SHUTTER"));
    picture.settings.edgeMethod = EdgeMethod::MultiScale;
    QVERIFY(treatmentLine(picture).contains(QStringLiteral("edge 30 %, multi-scale  ")));
    picture.treatment.k = 0.7;
    QVERIFY(treatmentLine(picture).contains(QStringLiteral("noise 40 of 60 %  ")));
    picture.treatment.filterIsBounded = true;
    QVERIFY(treatmentLine(picture).contains(QStringLiteral("noise 40 of 60 %, for latency")));
}

void TestPictureMarks::coversNoMarkWithAnother_data()
{
    QTest::addColumn<QSize>("area");
    QTest::addColumn<int>("pixelSize");
    QTest::newRow("large") << QSize(1068, 1068) << 20;
    QTest::newRow("reference") << QSize(500, 500) << 10;
    QTest::newRow("small reference") << QSize(247, 247) << 10;
}

void TestPictureMarks::coversNoMarkWithAnother()
{
    QFETCH(QSize, area);
    QFETCH(int, pixelSize);
    DisplayPicture picture;
    picture.about = *samples::frame(123456, frameSize, 12, PixelEncoding::Raw);
    picture.window = {32768, 65536};
    picture.windowIsAutomatic = true;
    QFont font;
    font.setPixelSize(pixelSize);
    TextPlates plates(font);
    const QRect where(QPoint(0, 0), area);
    placeSides(plates, where, picture);
    const QRect bar = placeScale(plates, where, picture, 1);
    const QRegion before = plates.region() + bar;
    placeFacts(plates, where, bar, picture, 2);
    TextPlates facts(font);
    placeFacts(facts, where, {}, picture, 2);
    int covered = 0; // what the facts take is added to what was there, and nothing is lost
    for (const QRect& part : plates.region() + bar)
        covered += part.width() * part.height();
    int separate = 0;
    for (const QRegion& region : {before, facts.region()})
        for (const QRect& part : region)
            separate += part.width() * part.height();
    QCOMPARE(covered, separate);
    QVERIFY(plates.region().boundingRect().top() >= 0);
}

QTEST_MAIN(TestPictureMarks)
#include "test_picture_marks.moc"
