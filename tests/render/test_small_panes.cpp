// Tests of the words on pictures that are small, and in a language that takes more room: whole, or left out as a whole.
#include "gui/pseudo_language.hpp"
#include "gui/shown_texts.hpp"
#include "imaging/figure_cells.hpp"
#include "imaging/live_image_view.hpp"
#include "imaging/picture_overlay.hpp"
#include "imaging/reference_image_view.hpp"
#include "imaging/text_plates.hpp"
#include "model/roadmap_state.hpp"
#include "sample_frames.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QRegularExpression>
#include <QtTest>

#include <algorithm>

using namespace console;
using namespace std::chrono_literals;
using console::test::PseudoLanguage;
using console::test::ShownText;
using console::test::textsPaintedBy;
using console::test::wordsPaintedBy;

namespace {

constexpr QSize frameSize(512, 512);

QFont bodyFont(int pixels = 12)
{
    QFont font = theme::font(theme::TextRole::Caption, 1);
    font.setPixelSize(pixels);
    return font;
}

DisplayPicture pictureOf(PictureRole role)
{
    DisplayPicture picture;
    picture.about = *samples::frame(18, frameSize, 12, PixelEncoding::Raw);
    picture.about.source = PictureSource::Live;
    picture.about.arrival = std::chrono::steady_clock::now();
    picture.about.ageAtArrival = 5ms;
    picture.role = role;
    picture.window = {32768, 65536};
    picture.image = QImage(frameSize, QImage::Format_RGB32);
    picture.image.fill(qRgb(40, 40, 40));
    return picture;
}

QString describe(const ShownText& shown)
{
    return QStringLiteral("\"%1\" at %2,%3 %4 wide")
        .arg(shown.text)
        .arg(int(shown.ink.left()))
        .arg(int(shown.ink.top()))
        .arg(int(shown.ink.width()));
}

/// What is cut by the picture's edge or by the painter, and what lies on something else.
QStringList unreadable(PictureCanvas& pane)
{
    constexpr double slack = 1.5;
    const QRectF picture = QRectF(pane.pictureRect()).adjusted(-slack, -slack, slack, slack);
    const auto texts = textsPaintedBy(pane);
    QStringList wrong;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const ShownText& shown = texts[i];
        if (shown.text.trimmed().isEmpty())
            continue;
        if (!picture.contains(shown.ink) ||
            (!shown.room.isNull() && !shown.room.adjusted(-slack, -slack, slack, slack).contains(shown.ink)))
            wrong << QStringLiteral("cut: ") + describe(shown);
        for (std::size_t j = 0; j < i; ++j)
            if (const QRectF both = texts[j].ink & shown.ink;
                !texts[j].text.trimmed().isEmpty() && both.width() > 2 * slack && both.height() > slack)
                wrong << QStringLiteral("on each other: ") + describe(shown) + QStringLiteral(" / ") + describe(texts[j]);
    }
    return wrong;
}

/// Of what is painted of `words`: the rows that are smaller than the pane's letters, though there are spaces to break them at.
QStringList shrunk(PictureCanvas& pane, const QString& words)
{
    const double wanted = QFontMetricsF(pane.font()).capHeight();
    QStringList small;
    for (const ShownText& shown : textsPaintedBy(pane))
        if (const QString text = shown.text.trimmed(); text.size() > 3 && words.contains(text) && shown.ink.height() < wanted - 0.1)
            small << describe(shown);
    return small;
}

/// A pane of a side with a picture in it on which a distance can be measured.
template <typename Pane>
struct Measured {
    DisplayState display;
    Pane& pane;

    Measured(Pane& measured, int side, int letters) : pane(measured)
    {
        pane.setFont(bodyFont(letters));
        pane.setDisplay(&display);
        pane.resize(side, side);
    }

    void measure()
    {
        const QRect picture = pane.pictureRect();
        for (const QPoint& place : {picture.center(), picture.center() + QPoint(picture.width() / 3, picture.height() / 4)})
            QTest::mouseClick(&pane, Qt::LeftButton, {}, place);
    }
};

void addSizes()
{
    QTest::addColumn<int>("side");
    QTest::addColumn<int>("letters");
    QTest::addColumn<bool>("longer");
    // At 2560, 1920, 1366 and 1280 pixels of the window's width, and beside the live picture.
    for (const auto& [side, letters] : {std::pair(562, 16), std::pair(421, 12), std::pair(300, 11), std::pair(254, 11)})
        for (const bool longer : {false, true})
            QTest::addRow("%d pixels, letters of %d%s", side, letters, longer ? ", longer texts" : "") << side << letters << longer;
}

} // namespace

class TestSmallPanes : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }
    void cleanup() { QCoreApplication::removeTranslator(&m_pseudo); }

    void breaksNoFigureFromItsUnit_data();
    void breaksNoFigureFromItsUnit();
    void breaksNothingThatFits();
    void leavesOutWholeTextsAndNeverTheFirst();
    void referencePaneIsWhole_data() { addSizes(); }
    void referencePaneIsWhole();
    void livePaneIsWhole_data() { addSizes(); }
    void livePaneIsWhole();
    void lengthStandsHoweverSmallThePane();

private:
    PseudoLanguage m_pseudo;
};

void TestSmallPanes::breaksNoFigureFromItsUnit_data()
{
    QTest::addColumn<QString>("text");
    for (const char* text :
         {"12.4 mm @ table plane + 10.0 cm (geometry)", "12.4 mm @ isocentre plane (geometry)", "12.4 mm (8 F catheter)",
          "41 px (uncalibrated: no table plane)", "object 5 cm nearer or farther: \u2248 7 % off", "612 of 900, 19.2 s before the newest",
          "Catheter, right button or B: it is the width of a catheter of 4 F to 8 F", "Vessels of 12:03:41, run 14"})
        QTest::newRow(text) << QString::fromUtf8(text);
}

void TestSmallPanes::breaksNoFigureFromItsUnit()
{
    QFETCH(QString, text);
    static const QRegularExpression cut(QStringLiteral("[\\d+@\u2248]$"));
    static const QRegularExpression unit(QStringLiteral("^(mm|cm|px|F|s|%)\\b"));
    const QFont font = bodyFont();
    std::size_t broken = 0;
    for (int room = 40; room < 600; room += 3) {
        const QStringList rows = rowsOf(text, font, room);
        QCOMPARE(rows.join(QLatin1Char(' ')), text);
        broken = std::max(broken, std::size_t(rows.size()));
        for (qsizetype i = 0; i < rows.size(); ++i) {
            QVERIFY2(i + 1 == rows.size() || !cut.match(rows.at(i)).hasMatch(), qPrintable(rows.join(QLatin1Char('|'))));
            QVERIFY2(!unit.match(rows.at(i)).hasMatch(), qPrintable(rows.join(QLatin1Char('|'))));
            QVERIFY2(room < 120 || figuresWidth(font, rows.at(i)) <= room, qPrintable(rows.join(QLatin1Char('|'))));
        }
    }
    QVERIFY(broken > 1);
}

void TestSmallPanes::breaksNothingThatFits()
{
    const QString text = QStringLiteral("12.4 mm @ isocentre plane (geometry)");
    QCOMPARE(rowsOf(text, bodyFont(), 1000), QStringList{text});
    const QString chinese = QStringLiteral("\u8DDD\u7B49\u4E2D\u5FC3\u5E73\u9762 12.4 mm\u5904\u7684\u957F\u5EA6");
    QVERIFY(rowsOf(chinese, bodyFont(), 60).size() > 1); // where there are no spaces, too
    QCOMPARE(rowsOf(chinese, bodyFont(), 60).join(QString()).remove(QLatin1Char(' ')), QString(chinese).remove(QLatin1Char(' ')));
}

void TestSmallPanes::leavesOutWholeTextsAndNeverTheFirst()
{
    const QStringList texts{QStringLiteral("12.4 mm @ isocentre plane (geometry)"), QStringLiteral("object 5 cm nearer or farther"),
                            QStringLiteral("it is the width of a catheter of 4 F to 8 F")};
    const QFont font = bodyFont();
    std::size_t most = 0;
    bool someLeftOut = false;
    for (int height = 60; height <= 400; height += 10) {
        const QRect area(7, 11, 160, height);
        const QRegion taken =
            QRegion(area.left(), area.top(), area.width(), 20) + QRegion(area.left(), area.bottom() - 19, area.width(), 20);
        TextPlates plates(font);
        plates.addStack(texts, area, area.top() + height * 5 / 8, taken);
        QStringList shown;
        for (const OverlayPlate& plate : plates.plates()) {
            QVERIFY(area.contains(plate.rect));
            shown << plate.text;
        }
        const QString all = shown.join(QLatin1Char(' '));
        std::size_t whole = 0;
        for (qsizetype i = 0; i < texts.size(); ++i)
            if (all == QStringList(texts.mid(0, i + 1)).join(QLatin1Char(' ')))
                whole = std::size_t(i + 1);
        QVERIFY2(whole > 0, qPrintable(all)); // nothing but the first texts, each of them whole
        QVERIFY(whole >= most);
        most = whole;
        someLeftOut = someLeftOut || whole < 3;
        if (height >= 100)
            QVERIFY2(!plates.region().intersects(taken), qPrintable(QString::number(height)));
    }
    QCOMPARE(most, std::size_t(3));
    QVERIFY(someLeftOut);
}

void TestSmallPanes::referencePaneIsWhole()
{
    QFETCH(int, side);
    QFETCH(int, letters);
    QFETCH(bool, longer);
    if (longer)
        QCoreApplication::installTranslator(&m_pseudo);
    for (const PictureRole role : {PictureRole::Hold, PictureRole::Review, PictureRole::Roadmap}) {
        ReferenceImageView view;
        Measured<ReferenceImageView> measured(view, side, letters);
        DisplayPicture picture = pictureOf(role);
        picture.meanOf = role == PictureRole::Hold ? 4 : 1;
        view.showPicture(picture);
        QString place;
        if (role == PictureRole::Review)
            place = QCoreApplication::translate("console::CineReview", "%1 of %2, %3 s before the newest").arg(612).arg(900).arg(19.2);
        if (role == PictureRole::Roadmap)
            place = QCoreApplication::translate("console::RoadmapState", "ROADMAP REMOVED: %1")
                        .arg(QCoreApplication::translate("console::RoadmapState", "the distances of the C-arm changed"));
        view.setPlace(place);
        QCOMPARE(shrunk(view, place), QStringList());
        QStringList wrong = unreadable(view);
        QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join(QLatin1Char('\n'))));
        measured.display.nextMeasureMode();
        wrong = unreadable(view);
        QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join(QLatin1Char('\n'))));
        measured.measure();
        QVERIFY(view.measurement().pixels());
        wrong = unreadable(view);
        QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join(QLatin1Char('\n'))));
        QCOMPARE(shrunk(view, view.measurement().text() + view.measurement().depthText()), QStringList());
        measured.display.nextPlane();
        wrong = unreadable(view);
        QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join(QLatin1Char('\n'))));
    }
}

void TestSmallPanes::livePaneIsWhole()
{
    QFETCH(int, side);
    QFETCH(int, letters);
    QFETCH(bool, longer);
    if (longer)
        QCoreApplication::installTranslator(&m_pseudo);
    PictureState state;
    state.setLinkUp(true);
    const Instant now = std::chrono::steady_clock::now();
    state.expect(15, now);
    LiveImageView view(state);
    view.setClock([now] { return now; });
    Measured<LiveImageView> measured(view, side, letters);
    DisplayPicture picture = pictureOf(PictureRole::Live);
    picture.about.arrival = now;
    view.showPicture(picture);
    view.grab();
    measured.display.nextMeasureMode();
    QStringList wrong = unreadable(view);
    QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join(QLatin1Char('\n'))));
    measured.measure();
    QVERIFY(view.measurement().pixels());
    wrong = unreadable(view);
    QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join(QLatin1Char('\n'))));
}

// A figure without its unit, or half of it, is worse than none.
void TestSmallPanes::lengthStandsHoweverSmallThePane()
{
    for (int side = 160; side <= 600; side += 20) {
        ReferenceImageView view;
        Measured<ReferenceImageView> measured(view, side, 16);
        view.showPicture(pictureOf(PictureRole::Hold));
        measured.display.nextMeasureMode();
        measured.measure();
        QString painted = wordsPaintedBy(view).remove(QLatin1Char(' '));
        const QString result = view.measurement().text().remove(QLatin1Char(' '));
        QVERIFY2(painted.contains(result), qPrintable(QStringLiteral("%1: %2 in %3").arg(side).arg(result, painted)));
        for (const ShownText& shown : textsPaintedBy(view))
            if (result.contains(shown.text.trimmed().remove(QLatin1Char(' '))))
                QVERIFY2(view.pictureRect().contains(shown.ink.toRect()), qPrintable(describe(shown)));
    }
}

QTEST_MAIN(TestSmallPanes)
#include "test_small_panes.moc"
