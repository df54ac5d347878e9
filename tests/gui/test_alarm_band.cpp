// The alarm band: what flashes and how, measured in painted pixels; contrast; self-test and audio pause.
#include "cockpit_stage.hpp"
#include "shown_texts.hpp"
#include "unit/console/alarm_cases.hpp"
#include "widgets/alarm_band.hpp"
#include "widgets/flash_clock.hpp"
#include "widgets/self_test_block.hpp"

#include <QApplication>
#include <QImage>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include <map>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

constexpr int wide = 2560;
constexpr int tall = 56;
const QRect badgePoint(12, tall / 2, 1, 1); // left of the bars
const QRect badgeWord(20, 10, 100, 36);
const QRect alarmText(240, 0, 700, tall);

Alarm alarm(AlarmPriority priority, bool acknowledged)
{
    Alarm one;
    one.id = 1;
    one.priority = priority;
    one.acknowledged = acknowledged;
    one.text = QStringLiteral("Vascular robot: link lost, stand-by");
    one.remedy = QStringLiteral("Read the prompt.");
    return one;
}

struct Band {
    AlarmBand band;

    explicit Band(AlarmPriority priority, bool acknowledged = false)
    {
        band.resize(wide, tall);
        band.setAlarms({alarm(priority, acknowledged)});
        band.show();
    }

    QImage at(Duration phase, const QRect& where = QRect(0, 0, wide, tall))
    {
        band.flashClock().drive(phase);
        QImage image(where.size(), QImage::Format_RGB32);
        band.render(&image, QPoint(), QRegion(where), QWidget::DrawWindowBackground);
        return image;
    }
};

struct Course {
    double rate = 0; ///< flashes a second
    double duty = 0; ///< part of the time in the first colour
    int colours = 0;
};

/// Ten seconds, a hundred looks a second.
Course courseOf(AlarmPriority priority, bool acknowledged = false)
{
    Band room(priority, acknowledged);
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

/// Of the commonest colour of a text's room and the one that stands out most from it.
double paintedContrast(const QImage& image)
{
    std::map<QRgb, int> seen;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            ++seen[image.pixel(x, y)];
    const auto surface = std::max_element(seen.begin(), seen.end(), [](auto& a, auto& b) { return a.second < b.second; })->first;
    double most = 1;
    for (const auto& [colour, count] : seen)
        if (count >= 20) // strokes, not their blurred edges
            most = std::max(most, theme::contrast(QColor(colour), QColor(surface)));
    return most;
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

    void buttonsAreAsLargeAsAFinger_data()
    {
        QTest::addColumn<QSize>("screen");
        for (const QSize& screen : {QSize(2560, 1440), QSize(1920, 1080), QSize(1366, 768)})
            QTest::addRow("%d", screen.height()) << screen;
    }

    void buttonsAreAsLargeAsAFinger()
    {
        QFETCH(QSize, screen);
        CockpitStage stage(screen);
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.cockpit.loseRobot();
        stage.refresh();
        auto* band = stage.window.findChild<AlarmBand*>();
        band->setFoldedSheets({{1, QStringLiteral("Robot link lost, 0:12")}});
        QCoreApplication::processEvents();
        int looked = 0;
        for (const auto* button : band->findChildren<QPushButton*>()) {
            if (!button->isVisible())
                continue;
            ++looked;
            QVERIFY2(button->height() >= theme::touchSide(button), qPrintable(button->text()));
            QVERIFY2(band->rect().contains(QRect(button->mapTo(band, QPoint()), button->size())), qPrintable(button->text()));
        }
        QVERIFY(looked >= 3);
        QCOMPARE(band->geometry(), stage.window.regionGeometry(Region::Alarm));
        for (const char* name : {"Open all closed links, one after the other", "Show the topology"}) {
            const auto* button = stage.named<QPushButton>(QString::fromLatin1(name));
            QVERIFY(button != nullptr && button->height() >= theme::touchSide(button));
        }
    }

    /// Its time runs every second; a press that lasts longer, and the keys that were moved there, stay with it.
    void aFoldedSheetsChipStaysWhileItsTimeRuns()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        auto* band = stage.window.findChild<AlarmBand*>();
        QSignalSpy asked(band, &AlarmBand::sheetRequested);
        band->setFoldedSheets({{1, QStringLiteral("Robot link lost, 0:12")}});
        auto* chip = stage.named<QPushButton>(QStringLiteral("Show again: Robot link lost, 0:12"));
        QVERIFY(chip);
        QTest::mousePress(chip, Qt::LeftButton);
        band->setFoldedSheets({{1, QStringLiteral("Robot link lost, 0:13")}});
        QCOMPARE(stage.named<QPushButton>(QStringLiteral("Show again: Robot link lost, 0:13")), chip);
        QTest::mouseRelease(chip, Qt::LeftButton);
        QCOMPARE(asked.count(), 1);
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

    void twoBandsFlashTogether()
    {
        QVERIFY(FlashClock::litAt(AlarmPriority::High, 0ms) && FlashClock::litAt(AlarmPriority::Medium, 0ms));
        QVERIFY(!FlashClock::litAt(AlarmPriority::High, 250ms) && FlashClock::litAt(AlarmPriority::Medium, 833ms));
        QVERIFY(FlashClock::litAt(AlarmPriority::High, 500ms) && !FlashClock::litAt(AlarmPriority::Medium, 834ms));
    }

    void clockRunsByItself()
    {
        FlashClock clock;
        QSignalSpy ticked(&clock, &FlashClock::ticked);
        const bool before = clock.isLit(AlarmPriority::High);
        QTRY_VERIFY(clock.isLit(AlarmPriority::High) != before);
        QVERIFY(!ticked.isEmpty());
    }

    void everyAlarmTextIsReadable_data()
    {
        QTest::addColumn<int>("priority");
        QTest::addColumn<bool>("acknowledged");
        QTest::addColumn<int>("phaseMs");
        for (const auto priority : {AlarmPriority::High, AlarmPriority::Medium, AlarmPriority::Low})
            for (const bool acknowledged : {false, true})
                for (const int phase : {0, 900})
                    QTest::addRow("%s%s at %d ms", qPrintable(word(priority)), acknowledged ? ", acknowledged" : "", phase)
                        << int(priority) << acknowledged << phase;
    }

    void everyAlarmTextIsReadable()
    {
        QFETCH(int, priority);
        QFETCH(bool, acknowledged);
        QFETCH(int, phaseMs);
        Band room(AlarmPriority(priority), acknowledged);
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

    void selfTestShowsItsColoursAndAsks()
    {
        Band room(AlarmPriority::Low);
        room.band.setAlarms({});
        const auto colourOf = [&](AlarmSelfTest::Step step, std::optional<AlarmPriority> signal) {
            room.band.setSelfTest(step, signal);
            return room.band.surface();
        };
        QCOMPARE(colourOf(AlarmSelfTest::Step::High, AlarmPriority::High), QColor(theme::colour::highSurface));
        QCOMPARE(colourOf(AlarmSelfTest::Step::Medium, AlarmPriority::Medium), QColor(theme::colour::medium));
        QCOMPARE(colourOf(AlarmSelfTest::Step::Low, AlarmPriority::Low), QColor(theme::colour::low));
        QVERIFY(paintedContrast(room.at(0ms, alarmText)) >= 4.5);
        QCOMPARE(colourOf(AlarmSelfTest::Step::Asking, std::nullopt), QColor(theme::colour::panel));
    }

    void aPersonDoesTheSelfTest()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        auto& test = stage.cockpit.models.selfTest;
        auto now = std::chrono::steady_clock::now();
        connect(&stage.window, &CockpitWindow::alarmTestRequested, &test, [&] { test.begin(now); });
        connect(&stage.window, &CockpitWindow::alarmTestAnswered, &test, [&](bool right) { right ? test.confirm() : test.refuse(); });
        const auto button = [&](const char* name) { return stage.named<QPushButton>(QString::fromLatin1(name)); };
        const char* right = "All three alarm colours were seen, and the sounds heard";
        auto* begin = button("Begin the alarm self-test: three colours and three sounds");
        QVERIFY(begin && !button(right));
        QTest::mouseClick(begin, Qt::LeftButton);
        QVERIFY(test.running());
        for (int i = 0; i < 70; ++i) {
            QVERIFY(!test.signal() || !button(right)); // nobody confirms what is not yet shown
            test.update(false, now += 100ms);
        }
        QVERIFY(button(right));
        QTest::mouseClick(button(right), Qt::LeftButton);
        QVERIFY(test.passed());
        QVERIFY(!stage.window.findChild<SelfTestBlock*>()->isVisible());
        QVERIFY(stage.window.handHasKeys());
    }

    void selfTestIsBegunByItsKeyAndNotOfferedWhileArmed()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        auto& test = stage.cockpit.models.selfTest;
        QSignalSpy asked(&stage.window, &CockpitWindow::alarmTestRequested);
        QTest::keyClick(&stage.window, Qt::Key_F8);
        QCOMPARE(asked.count(), 1);
        QVERIFY(stage.window.findChild<SelfTestBlock*>()->isVisible());
        test.follow(PermitPhase::Armed, stage.cockpit.now);
        QVERIFY(!stage.window.findChild<SelfTestBlock*>()->isVisible());
        test.follow(PermitPhase::Hold, stage.cockpit.now);
        QVERIFY(stage.window.findChild<SelfTestBlock*>()->isVisible());
    }

    void noSelfTestIsOfferedBesideAHighAlarm()
    {
        Band room(AlarmPriority::Low);
        room.band.setSelfTest(AlarmSelfTest::Step::NotDone, std::nullopt);
        const auto* begin = room.band.findChild<SelfTestBlock*>()->findChild<QPushButton*>();
        room.band.setAlarms({alarm(AlarmPriority::High, false)});
        QVERIFY(!begin->isEnabled());
        room.band.setAlarms({alarm(AlarmPriority::High, true), alarm(AlarmPriority::Medium, false)});
        QVERIFY(begin->isEnabled());
    }

    void nobodyIsMadeToSayThatTheyHeardNothing()
    {
        Band room(AlarmPriority::Low);
        Alarm silent = alarm(AlarmPriority::Low, false);
        silent.condition = AlarmCondition::SoundFailed;
        room.band.setAlarms({silent});
        room.band.setSelfTest(AlarmSelfTest::Step::Asking, std::nullopt);
        QStringList words;
        for (const auto* one : room.band.findChildren<QPushButton*>())
            if (one->isVisible())
                words << one->text();
        QVERIFY2(words.contains(QStringLiteral("Test seen; no sound here")), qPrintable(words.join(QLatin1Char('|'))));
    }

    /// Always there, whatever stands: the moment does not wait.
    void anIncidentIsMarkedByItsButton()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        QSignalSpy asked(&stage.window, &CockpitWindow::incidentMarkRequested);
        auto* button = stage.named<QPushButton>(QStringLiteral("Mark this moment in both logs as an incident"));
        QVERIFY(button);
        QCOMPARE(button->text(), QStringLiteral("Incident"));
        QTest::mouseDClick(button, Qt::LeftButton);
        QTest::mouseClick(button, Qt::LeftButton);
        QCOMPARE(asked.count(), 1);          // a double click is one wish
        QVERIFY(stage.window.handHasKeys()); // and takes no keys
        const QRect place = button->geometry();
        stage.window.showIncidentMarked();
        QCOMPARE(button->text(), QStringLiteral("Marked"));
        stage.cockpit.freezePicture();
        stage.refresh();
        QCoreApplication::processEvents();
        QCOMPARE(button->geometry(), place); // nothing moves it
        QVERIFY(button->isVisible() && button->isEnabled());
        QTRY_COMPARE_WITH_TIMEOUT(button->text(), QStringLiteral("Incident"), 4000);
        button->setFocus(Qt::TabFocusReason);
        QTest::keyClick(button, Qt::Key_Space);
        QCOMPARE(asked.count(), 2);
        QVERIFY(stage.window.handHasKeys());
    }

    void soundIsPausedByButtonAndKeyAndCountsDown()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        auto& alarms = stage.cockpit.models.alarms;
        QSignalSpy asked(&stage.window, &CockpitWindow::audioPauseRequested);
        const QString name = QStringLiteral("Pause the alarm sound for a while, or end the pause");
        QVERIFY(!stage.named<QPushButton>(name));
        const auto now = std::chrono::steady_clock::now();
        alarms.update({{AlarmCondition::ForceWarn, 0, AlarmPriority::Medium, false, QStringLiteral("Force"), QStringLiteral("Stop."), 0}},
                      now, 0);
        auto* pause = stage.named<QPushButton>(name);
        QVERIFY(pause);
        QTest::mouseClick(pause, Qt::LeftButton);
        QTest::keyClick(&stage.window, Qt::Key_F9);
        QCOMPARE(asked.count(), 2);
        alarms.pauseAudio(now);
        stage.window.refresh(now + 18s);
        QCOMPARE(pause->text(), QStringLiteral("AUDIO PAUSED 42 s"));
        stage.window.refresh(now + 60s);
        QCOMPARE(pause->text(), QStringLiteral("Pause sound (F9)"));
    }
};

QTEST_MAIN(TestAlarmBand)
#include "test_alarm_band.moc"
