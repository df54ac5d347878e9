// What the drawings of an instrument say: directions, grippers, limits, what was asked for, force and what is left.
#include "shown_texts.hpp"
#include "widgets/axis_panel.hpp"
#include "widgets/contrast_bar.hpp"
#include "widgets/force_gauge.hpp"
#include "widgets/theme.hpp"

#include <QApplication>
#include <QFontMetricsF>
#include <QTest>
#include <QTransform>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;
namespace colour = console::theme::colour;

namespace {

AxisReading reading(double velocity = 0, double rotation = 0)
{
    AxisReading r;
    r.freshness = r.drives = Freshness::Fresh;
    r.travel = InstrumentTravel{{0, 630}, {-5, 635}};
    r.position = 315;
    r.velocity = velocity;
    r.rotation = rotation;
    return r;
}

struct Shown {
    QString words;
    QImage picture;
};

Shown shown(const AxisReading& r)
{
    AxisPanel panel(QStringLiteral("Guidewire"), icons::Icon::Guidewire);
    panel.resize(panel.sizeHint());
    panel.setReading(r);
    return {wordsPaintedBy(panel), panel.grab().toImage().convertToFormat(QImage::Format_RGB32)};
}

/// Of the columns in which two pictures differ.
std::vector<int> differingColumns(const QImage& one, const QImage& other)
{
    std::vector<int> columns;
    for (int x = 0; x < one.width(); ++x)
        for (int y = 0; y < one.height(); ++y)
            if (one.pixel(x, y) != other.pixel(x, y)) {
                columns.push_back(x);
                break;
            }
    return columns;
}

/// Rows from the first in which two pictures differ to the last.
int differingHeight(const QImage& one, const QImage& other)
{
    const QTransform onItsSide = QTransform().rotate(90);
    const auto rows = differingColumns(one.transformed(onItsSide), other.transformed(onItsSide));
    return rows.empty() ? 0 : rows.back() - rows.front() + 1;
}

} // namespace

class TestInstrumentPanels : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void directionsHaveASignAndAWord_data()
    {
        QTest::addColumn<double>("velocity");
        QTest::addColumn<double>("rotation");
        QTest::addColumn<QString>("line");
        QTest::addColumn<QString>("turn");
        QTest::newRow("forwards") << 3.9 << 12.0 << QStringLiteral("+3.9\u00A0mm/sadvance") << QStringLiteral("+12.0\u00B0/sclockwise");
        QTest::newRow("backwards") << -2.0 << -12.0 << QStringLiteral("\u22122.0\u00A0mm/sretract")
                                   << QStringLiteral("\u221212.0\u00B0/santiclockwise");
        QTest::newRow("still") << 0.0 << 0.0 << QStringLiteral("0.0\u00A0mm/sstill") << QStringLiteral("0.0\u00B0/sstill");
        QTest::newRow("nearly still") << -0.04 << 0.04 << QStringLiteral("0.0\u00A0mm/sstill") << QStringLiteral("0.0\u00B0/sstill");
    }

    void directionsHaveASignAndAWord()
    {
        QFETCH(double, velocity);
        QFETCH(double, rotation);
        QFETCH(QString, line);
        QFETCH(QString, turn);
        const QString words = shown(reading(velocity, rotation)).words;
        QVERIFY2(words.contains(line), qPrintable(words));
        QVERIFY2(words.contains(turn), qPrintable(words));
        if (std::abs(velocity) < 0.05)
            QVERIFY2(!words.contains(QLatin1Char('+')) && !words.contains(QChar(0x2212) + QStringLiteral("0.0")), qPrintable(words));
    }

    void speedsAreAsLargeAsPositionsWhereTheDriveKeepsItsLine_data()
    {
        QTest::addColumn<int>("height");
        QTest::addColumn<int>("role");
        QTest::addColumn<bool>("drive");
        QTest::newRow("as at the reference") << 136 << int(theme::TextRole::Value) << true;
        QTest::newRow("little room") << 120 << int(theme::TextRole::Strong) << true;
        QTest::newRow("hardly any") << 90 << int(theme::TextRole::Strong) << false;
    }

    void speedsAreAsLargeAsPositionsWhereTheDriveKeepsItsLine()
    {
        QFETCH(int, height);
        QFETCH(int, role);
        QFETCH(bool, drive);
        AxisPanel panel(QStringLiteral("Guidewire"), icons::Icon::Guidewire);
        panel.resize(686, height);
        const auto pictureAt = [&](double velocity) {
            auto r = reading(velocity);
            r.freshness = Freshness::Stale; // its bar is empty then: only figures differ
            panel.setReading(r);
            return panel.grab().toImage().convertToFormat(QImage::Format_RGB32);
        };
        const int painted = differingHeight(pictureAt(1.1), pictureAt(8.8));
        const double figure = QFontMetricsF(theme::font(theme::TextRole(role), 1)).tightBoundingRect(QStringLiteral("8")).height();
        QVERIFY2(std::abs(painted - figure) <= 1.5, qPrintable(QStringLiteral("%1 rows, a figure has %2").arg(painted).arg(figure)));
        QCOMPARE(wordsPaintedBy(panel).contains(QStringLiteral("\u00B0C")), drive);
    }

    void theEndsOfTheTravelStandApart()
    {
        AxisPanel panel(QStringLiteral("Guidewire"), icons::Icon::Guidewire);
        panel.setReading(reading());
        const auto wordsAt = [&](int width) {
            panel.resize(width, 120);
            return wordsPaintedBy(panel);
        };
        QVERIFY(wordsAt(686).contains(QStringLiteral("\u22125\u00A0mm")));
        const QString narrow = wordsAt(500);
        QVERIFY2(!narrow.contains(QStringLiteral("\u22125\u00A0mm")) && narrow.contains(QStringLiteral("\u22125")), qPrintable(narrow));
        QVERIFY2(narrow.contains(QStringLiteral("635\u00A0mm")), qPrintable(narrow));
    }

    void whatIsNotKnownHasNoDirection()
    {
        auto r = reading(3.9, 12);
        r.freshness = r.drives = Freshness::Unknown;
        const QString words = shown(r).words;
        QVERIFY2(words.contains(QStringLiteral("\u2014\u00A0mm/s")), qPrintable(words));
        QVERIFY2(!words.contains(QStringLiteral("advance")) && !words.contains(QStringLiteral("clockwise")), qPrintable(words));
        QVERIFY2(words.contains(QStringLiteral("gripper \u2014")), qPrintable(words));
    }

    void theGripperAndTheLimitsAreWords()
    {
        auto r = reading();
        QVERIFY(shown(r).words.contains(QStringLiteral("gripper open")));
        r.gripperClosed = true;
        QVERIFY(shown(r).words.contains(QStringLiteral("gripper closed")));
        QVERIFY(!shown(r).words.contains(QStringLiteral("LIMIT")));
        r.softHigh = true;
        QVERIFY2(shown(r).words.contains(QStringLiteral("SOFT LIMIT")), qPrintable(shown(r).words));
        r.softHigh = false;
        r.hardLow = true;
        QVERIFY2(shown(r).words.contains(QStringLiteral("HARD LIMIT")), qPrintable(shown(r).words));
    }

    /// Where the hand asks the instrument to go is drawn on its side of the middle, the further the more, and hollow.
    void whatWasAskedForIsAGhostOfItsOwn()
    {
        const QImage none = shown(reading()).picture;
        auto r = reading();
        r.askedVelocity = 0;
        const auto middle = differingColumns(none, shown(r).picture);
        QVERIFY(!middle.empty());
        r.askedVelocity = 20;
        const QImage forwards = shown(r).picture;
        const auto right = differingColumns(none, forwards);
        QVERIFY(!right.empty());
        r.askedVelocity = 40;
        const auto farRight = differingColumns(none, shown(r).picture);
        r.askedVelocity = -20;
        const auto left = differingColumns(none, shown(r).picture);
        QVERIFY(left.back() < middle.front());
        QVERIFY(middle.back() < right.front());
        QVERIFY(right.back() < farRight.front());
        int armed = 0;
        const int centre = (right.front() + right.back()) / 2;
        const auto isArmed = [&](int x, int y) {
            const QColor seen = forwards.pixelColor(x, y);
            return std::abs(seen.red() - colour::armed.red()) < 30 && std::abs(seen.blue() - colour::armed.blue()) < 30;
        };
        for (int y = 0; y < forwards.height(); ++y)
            armed += isArmed(right.front() + 1, y) ? 1 : 0;
        QVERIFY2(armed >= 4, qPrintable(QString::number(armed)));
        int within = 0;
        for (int y = 0; y < forwards.height(); ++y)
            within += isArmed(centre, y) ? 1 : 0;
        QVERIFY2(within < armed, qPrintable(QStringLiteral("%1 of %2").arg(within).arg(armed)));
    }

    void theForceHasItsMarksAndItsPeak()
    {
        const Instant now = std::chrono::steady_clock::now();
        const auto gauge = [now](double peak) {
            InstrumentState instrument;
            RobotStatus status;
            status.guidewireForce = peak;
            instrument.receiveRobot(status, now - 9s);
            status.guidewireForce = 0.4;
            for (Duration ago = 8s; ago >= 0ms; ago -= 50ms)
                instrument.receiveRobot(status, now - ago);
            ForceGauge drawn;
            drawn.resize(350, 350);
            drawn.setState(instrument, now);
            return Shown{wordsPaintedBy(drawn), drawn.grab().toImage().convertToFormat(QImage::Format_RGB32)};
        };
        const auto low = gauge(0.4);
        const auto high = gauge(1.5);
        for (const char* words : {"warn 1\u00A0N", "stop 2\u00A0N", "0.40\u00A0N", "resistance"})
            QVERIFY2(high.words.contains(QString::fromUtf8(words)), qPrintable(high.words));
        QVERIFY2(low.words.contains(QStringLiteral("peak 0.40\u00A0N")), qPrintable(low.words));
        QVERIFY2(high.words.contains(QStringLiteral("peak 1.50\u00A0N")), qPrintable(high.words));
        int moved = 0; // on the arc, above the words between its ends
        for (int y = 0; y < 110; ++y)
            for (int x = 0; x < high.picture.width(); ++x)
                moved += high.picture.pixel(x, y) != low.picture.pixel(x, y) ? 1 : 0;
        QVERIFY2(moved >= 20, qPrintable(QString::number(moved)));
    }

    void theContrastBarIsAsFullAsTheInjector_data()
    {
        QTest::addColumn<double>("left"); // below 0: not known
        QTest::newRow("full") << 100.0;
        QTest::newRow("half") << 50.0;
        QTest::newRow("one injection") << 5.0;
        QTest::newRow("empty") << 0.0;
        QTest::newRow("not known") << -1.0;
    }

    void theContrastBarIsAsFullAsTheInjector()
    {
        QFETCH(double, left);
        ContrastBar bar;
        bar.resize(200, 14);
        bar.setContrast(left < 0 ? std::nullopt : std::optional(left), 100);
        const QImage picture = bar.grab().toImage().convertToFormat(QImage::Format_RGB32);
        int filled = 0;
        int last = -1;
        for (int x = 0; x < picture.width(); ++x)
            if (picture.pixelColor(x, 7) == colour::secondary) {
                ++filled;
                last = x;
            }
        const double part = std::max(left, 0.0) / 100;
        QVERIFY2(std::abs(filled - part * 160) <= 2, qPrintable(QString::number(filled))); // 2 of each 10 px are a gap
        QVERIFY2(last < part * 200, qPrintable(QString::number(last)));
    }
};

QTEST_MAIN(TestInstrumentPanels)
#include "test_instrument_panels.moc"
