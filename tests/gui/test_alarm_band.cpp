// The alarm band: what flashes and how, measured in painted pixels; letters and contrast. That it flashes by itself is tried by
// gui.flash_clock, what a hand does at it by gui.alarm_band_controls.
#include "painted_band.hpp"
#include "shown_texts.hpp"
#include "unit/console/alarm_cases.hpp"

#include <QApplication>
#include <QPushButton>
#include <QTest>

#include <cmath>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

const QRect badgePoint(12, tall / 2, 1, 1); // left of the bars
const QRect badgeWord(20, 10, 100, 36);

struct Course {
    double rate = 0; ///< flashes a second
    double duty = 0; ///< part of the time in the first colour
    int colours = 0;
};

/// Ten seconds, a hundred looks a second.
Course courseOf(const Alarm& shown)
{
    Band room(shown.priority);
    room.band.setAlarms({shown});
    std::map<QRgb, int> seen;
    int changes = 0;
    const QRgb first = room.at(0ms, badgePoint).pixel(0, 0);
    QRgb last = first;
    constexpr int looks = 1000;
    for (int i = 0; i < looks; ++i) {
        const QRgb now = room.at(i * 10ms, badgePoint).pixel(0, 0);
        ++seen[now];
        changes += now != last ? 1 : 0;
        last = now;
    }
    return {changes == 0 ? 0.0 : (changes + 1) / 2.0 / 10.0, double(seen[first]) / looks, int(seen.size())};
}

Course courseOf(AlarmPriority priority, bool acknowledged = false) { return courseOf(alarm(priority, acknowledged)); }

QString paintedWords(AlarmBand& band)
{
    QStringList words;
    for (const ShownText& text : textsPaintedBy(band))
        words << text.text.trimmed();
    return words.join(QLatin1Char(' '));
}

const QPushButton* acknowledgeOf(const AlarmBand& band)
{
    const auto buttons = band.findChildren<QPushButton*>();
    const auto found = std::find_if(buttons.begin(), buttons.end(), [](const QPushButton* one) {
        return one->accessibleName() == QLatin1String("Acknowledge the alarm shown");
    });
    return found == buttons.end() ? nullptr : *found;
}

/// How many pixels of a row are in the band's ink: the long sides of a frame.
int inkIn(Band& room, int row)
{
    const QImage image = room.at(900ms, QRect(0, row, wide, 1));
    const QColor surface = room.band.surface();
    int inked = 0;
    for (int x = 0; x < 600; ++x)
        inked += theme::contrast(image.pixelColor(x, 0), surface) >= 4.5 ? 1 : 0;
    return inked;
}

} // namespace

class TestAlarmBand : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void flashesAtItsRateHalfOnAndHalfOff()
    {
        const auto high = courseOf(AlarmPriority::High);
        QCOMPARE(high.rate, 2.0);
        QVERIFY2(std::abs(high.duty - 0.5) < 0.02, qPrintable(QString::number(high.duty)));
        const auto medium = courseOf(AlarmPriority::Medium);
        QCOMPARE(medium.rate, 0.6);
        QVERIFY2(std::abs(medium.duty - 0.5) < 0.02, qPrintable(QString::number(medium.duty)));
        QCOMPARE(high.colours, 2);
    }

    void lowAndAcknowledgedAreSteady()
    {
        QCOMPARE(courseOf(AlarmPriority::Low).colours, 1);
        QCOMPARE(courseOf(AlarmPriority::High, true).colours, 1);
        QCOMPARE(courseOf(AlarmPriority::Medium, true).colours, 1);
    }

    // What has ended, and nobody has seen yet.

    void whatHasEndedFlashesUntilItIsSeen()
    {
        QCOMPARE(courseOf(ended(AlarmPriority::High)).rate, 2.0);
        QCOMPARE(courseOf(ended(AlarmPriority::Medium)).rate, 0.6);
        QCOMPARE(courseOf(ended(AlarmPriority::Low)).colours, 1);
    }

    void whatHasEndedSaysSoAndWhenAndAsksForNothingElse()
    {
        Band room(AlarmPriority::High);
        room.band.setAlarms({ended(AlarmPriority::High)});
        const auto* acknowledge = acknowledgeOf(room.band);
        QVERIFY(acknowledge);
        const QString what = alarm(AlarmPriority::High, false).text;
        for (const QString& said : {paintedWords(room.band), room.band.toolTip(), room.band.accessibleDescription()}) {
            QVERIFY2(said.contains(QStringLiteral("ENDED")) && said.contains(QStringLiteral("06:20:56")) && said.contains(what),
                     qPrintable(said));
            QVERIFY2(said.contains(QStringLiteral("It has ended; acknowledge that you saw it.")), qPrintable(said));
            QVERIFY2(!said.contains(alarm(AlarmPriority::High, false).remedy), qPrintable(said));
        }
        for (const QString& said : {acknowledge->toolTip(), acknowledge->accessibleDescription()})
            QVERIFY2(said.startsWith(QStringLiteral("ENDED")) && said.endsWith(what), qPrintable(said));
        room.band.setAlarms({alarm(AlarmPriority::High, false)});
        for (const QString& said : {paintedWords(room.band), room.band.toolTip(), room.band.accessibleDescription()})
            QVERIFY2(!said.contains(QStringLiteral("ENDED")) && said.contains(what), qPrintable(said));
    }

    /// Dark as one that was acknowledged, which has no frame; that it is to be seen yet says its mark.
    void whatHasEndedLooksLikeNothingThatIsThere()
    {
        constexpr int frame = 3;
        for (const auto priority : {AlarmPriority::High, AlarmPriority::Medium, AlarmPriority::Low}) {
            Band room(priority);
            const QColor there = room.band.surface();
            QCOMPARE(inkIn(room, frame), 0);
            room.band.setAlarms({alarm(priority, true)});
            QCOMPARE(inkIn(room, frame), 0);
            room.band.setAlarms({ended(priority)});
            QVERIFY(room.band.surface() != there);
            QVERIFY2(inkIn(room, frame) > 200, qPrintable(QString::number(inkIn(room, frame))));
        }
    }

    void whatHasEndedIsToldFromWhatIsThereAsAChipToo()
    {
        Band room(AlarmPriority::High);
        const auto behind = [&room](const Alarm& second) {
            room.band.setAlarms({alarm(AlarmPriority::High, true), second});
            const QImage lit = room.at(0ms);
            const QImage dim = room.at(900ms);
            int changed = 0;
            for (int x = 0; x < wide; ++x)
                changed += lit.pixel(x, tall / 4) != dim.pixel(x, tall / 4) ? 1 : 0;
            return changed;
        };
        const auto saidOnce = [&room] { return paintedWords(room.band).count(QStringLiteral("ENDED")) == 1; };
        QVERIFY(behind(alarm(AlarmPriority::Medium, false)) > 200); // the whole chip
        QVERIFY(!saidOnce());
        const int mark = behind(ended(AlarmPriority::Medium));
        QVERIFY2(mark > 15 && mark < 100, qPrintable(QString::number(mark)));
        QVERIFY(saidOnce());
        const auto* acknowledge = acknowledgeOf(room.band);
        QVERIFY(acknowledge && acknowledge->isVisible());
        QVERIFY2(acknowledge->text().startsWith(QStringLiteral("Acknowledge ended: Vascular robot")), qPrintable(acknowledge->text()));
    }

    /// Its mark has a ground of its own, at which the words do not begin.
    void theWordsOfAChipAreApartFromItsMark()
    {
        Band room(AlarmPriority::High);
        room.band.setAlarms({alarm(AlarmPriority::High, true), ended(AlarmPriority::Medium)});
        const auto texts = textsPaintedBy(room.band);
        const auto words =
            std::find_if(texts.begin(), texts.end(), [](const ShownText& one) { return one.text.startsWith(QStringLiteral("ENDED")); });
        QVERIFY(words != texts.end());
        const QImage image = room.at(0ms);
        const int row = int(words->ink.center().y());
        const int first = int(words->ink.left()) - 2;
        int edge = first;
        while (edge > 0 && image.pixel(edge, row) == image.pixel(first, row))
            --edge;
        QVERIFY2(words->ink.left() - edge >= 7, qPrintable(QString::number(words->ink.left() - edge)));
    }

    /// Behind an acknowledged one of higher priority: the band itself is steady then.
    void whatNobodyAcknowledgedFlashesAsAChipToo_data()
    {
        QTest::addColumn<int>("priority");
        QTest::addColumn<bool>("acknowledged");
        QTest::addColumn<bool>("flashes");
        QTest::newRow("high") << int(AlarmPriority::High) << false << true;
        QTest::newRow("medium") << int(AlarmPriority::Medium) << false << true;
        QTest::newRow("low") << int(AlarmPriority::Low) << false << false;
        QTest::newRow("medium, acknowledged") << int(AlarmPriority::Medium) << true << false;
    }

    void whatNobodyAcknowledgedFlashesAsAChipToo()
    {
        QFETCH(int, priority);
        QFETCH(bool, acknowledged);
        QFETCH(bool, flashes);
        Band room(AlarmPriority::High);
        room.band.setAlarms({alarm(AlarmPriority::High, true), alarm(AlarmPriority(priority), acknowledged)});
        const QImage lit = room.at(0ms);
        const QImage dim = room.at(900ms); // both clocks are off then
        QCOMPARE(room.at(900ms, badgeWord), room.at(0ms, badgeWord));
        int changed = 0;
        for (int x = 0; x < wide; ++x)
            changed += lit.pixel(x, tall / 4) != dim.pixel(x, tall / 4) ? 1 : 0;
        if (!flashes) {
            QCOMPARE(changed, 0);
            return;
        }
        QVERIFY2(changed > 200, qPrintable(QString::number(changed))); // the whole chip
        QCOMPARE(room.at(1700ms), lit);                                // and on again
    }

    void chipsGiveWayToTheHighestAlarmsText()
    {
        Band room(AlarmPriority::High);
        auto first = alarm(AlarmPriority::High, false);
        first.text = QStringLiteral("Vascular robot: its topology or message sets are others than ours, all three");
        const QFontMetricsF large(theme::font(theme::TextRole::Alarm, 1));
        QVERIFY(large.horizontalAdvance(first.text) > 1100); // of about 1650
        const auto textOf = [&](const std::vector<Alarm>& alarms) {
            room.band.setAlarms(alarms);
            return room.at(0ms, QRect(240, 0, 1000, tall)); // in smaller letters it would be another
        };
        const QImage alone = textOf({first});
        QCOMPARE(textOf({first, alarm(AlarmPriority::Medium, false), alarm(AlarmPriority::Low, false)}), alone);
    }

    void theTextNeverFlashes()
    {
        for (const auto priority : {AlarmPriority::High, AlarmPriority::Medium}) {
            Band room(priority);
            const QImage lit = room.at(0ms, alarmText);
            QCOMPARE(room.at(300ms, alarmText), lit);
            QCOMPARE(room.at(900ms, alarmText), lit);
            QVERIFY(room.at(0ms, badgeWord) != room.at(900ms, badgeWord));
        }
    }

    void everyAlarmTextIsReadable_data()
    {
        QTest::addColumn<int>("priority");
        QTest::addColumn<QString>("how");
        QTest::addColumn<int>("phaseMs");
        for (const auto priority : {AlarmPriority::High, AlarmPriority::Medium, AlarmPriority::Low})
            for (const char* how : {"there", "acknowledged", "ended"})
                for (const int phase : {0, 900})
                    QTest::addRow("%s, %s at %d ms", qPrintable(word(priority)), how, phase)
                        << int(priority) << QString::fromLatin1(how) << phase;
    }

    void everyAlarmTextIsReadable()
    {
        QFETCH(int, priority);
        QFETCH(QString, how);
        QFETCH(int, phaseMs);
        Band room(AlarmPriority(priority), how == QLatin1String("acknowledged"));
        if (how == QLatin1String("ended"))
            room.band.setAlarms({ended(AlarmPriority(priority))});
        const auto phase = std::chrono::milliseconds(phaseMs);
        for (const QRect& where : {alarmText, badgeWord}) {
            const double measured = paintedContrast(room.at(phase, where));
            QVERIFY2(measured >= 4.5, qPrintable(QString::number(measured)));
        }
    }

    /// With every button that may stand beside it: what is wrong can be read from where the surgeon stands.
    void everyAlarmsTextIsAsLargeAsAnAlarms()
    {
        Band room(AlarmPriority::High);
        room.band.setSound(true, 60s);
        const double wanted = QFontMetricsF(theme::font(theme::TextRole::Alarm, 1)).capHeight();
        for (const AlarmCase& one : alarmCases()) {
            AlarmReadings readings = calmReadings();
            readings.links[0].title = QStringLiteral("Vascular robot");
            readings.armed = readings.engaged = true;
            one.change(readings);
            Alarm shown = alarm(AlarmPriority::High, false);
            const auto reports = presentAlarms(readings);
            QVERIFY(!reports.empty());
            shown.text = reports.front().text;
            room.band.setAlarms({shown});
            QCoreApplication::processEvents();
            const auto texts = textsPaintedBy(room.band);
            const auto found = std::find_if(texts.begin(), texts.end(), [&](const ShownText& text) { return text.text == shown.text; });
            QVERIFY2(found != texts.end(), qPrintable(shown.text)); // in one line, and whole
            QVERIFY2(found->ink.height() > wanted - 0.5, qPrintable(shown.text));
        }
    }

    /// One whose reason comes from elsewhere, as long as it likes.
    void aLongerTextTakesASecondLineBeforeItsLettersGetSmall()
    {
        Band room(AlarmPriority::High);
        Alarm shown = alarm(AlarmPriority::High, false);
        shown.text = QStringLiteral("Recording: alarms-0x40018208.jsonl: No space left on device; the audit file of the sessions cannot be "
                                    "written: No space left on device; the pictures' folder is full; the event log is kept in memory alone "
                                    "until somebody makes room");
        room.band.setAlarms({shown});
        room.band.setSound(true, 60s);
        QCoreApplication::processEvents();
        const double wanted = QFontMetricsF(theme::font(theme::TextRole::Title, 1)).capHeight();
        QStringList lines;
        for (const ShownText& text : textsPaintedBy(room.band))
            if (shown.text.contains(text.text.trimmed()) && text.ink.height() > wanted - 0.5)
                lines << text.text.trimmed();
        QCOMPARE(lines.join(QLatin1Char(' ')), shown.text);
        QCOMPARE(lines.size(), 2);
        QCOMPARE(unreadableTexts(room.band), QStringList());
    }

    void everyPairOfAlarmColoursIsReadable()
    {
        for (const auto priority : {AlarmPriority::High, AlarmPriority::Medium, AlarmPriority::Low})
            for (const bool acknowledged : {false, true}) {
                const auto colours = alarmColours(priority, acknowledged);
                QVERIFY(theme::contrast(colours.ink, colours.surface) >= 4.5);
                QVERIFY(theme::contrast(colours.badgeInkLit, colours.badgeLit) >= 4.5);
                QVERIFY(theme::contrast(colours.badgeInkDim, colours.badgeDim) >= 4.5);
            }
    }
};

QTEST_MAIN(TestAlarmBand)
#include "test_alarm_band.moc"
