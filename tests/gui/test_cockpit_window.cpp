// What a person asks of the cockpit and what reaches the hand.
#include "cockpit_stage.hpp"
#include "widgets/alarm_band.hpp"
#include "widgets/axis_panel.hpp"
#include "widgets/figures.hpp"
#include "widgets/force_gauge.hpp"
#include "widgets/link_card.hpp"
#include "widgets/permit_block.hpp"
#include "widgets/status_strip.hpp"
#include "widgets/trends_pane.hpp"
#include "widgets/waterfall.hpp"

#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>

using namespace console;
using namespace console::test;
namespace colour = console::theme::colour;

namespace {

int pixelsOf(const QImage& picture, const QColor& colour)
{
    int count = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            count += picture.pixelColor(x, y).rgb() == colour.rgb() ? 1 : 0;
    return count;
}

/// Of the plots' violet, however much of it a smoothed line has in a pixel: greys are bluer than green by less.
int violetPixels(const QImage& picture)
{
    int count = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const QColor seen = picture.pixelColor(x, y);
            count += seen.blue() - seen.green() > 30 && seen.red() > seen.green() ? 1 : 0;
        }
    return count;
}

QPushButton* cardButton(const CockpitStage& stage, quint32 peer)
{
    for (const LinkCard* card : stage.window.findChildren<LinkCard*>())
        if (card->peer() == peer)
            return card->findChild<QPushButton*>();
    return nullptr;
}

AlarmReport report(AlarmCondition condition, AlarmPriority priority, const QString& text)
{
    return {condition, robotId, priority, false, text, QStringLiteral("Do this.")};
}

} // namespace

class TestCockpitWindow : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

    void openAllAsks()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        QSignalSpy asked(&stage.window, &CockpitWindow::openAllRequested);
        QTest::mouseClick(stage.named<QPushButton>(QStringLiteral("Open all closed links, one after the other")), Qt::LeftButton);
        QCOMPARE(asked.count(), 1);
    }

    void cardOffersWhatTheStateAllows_data()
    {
        QTest::addColumn<int>("state");
        QTest::addColumn<QString>("offer");
        QTest::newRow("closed") << int(LinkState::Closed) << QStringLiteral("Open");
        QTest::newRow("open") << int(LinkState::Open) << QStringLiteral("Close");
        QTest::newRow("suspect") << int(LinkState::Suspect) << QStringLiteral("Close");
        QTest::newRow("stand-by") << int(LinkState::StandBy) << QStringLiteral("Re-open");
        QTest::newRow("opening") << int(LinkState::Opening) << QString();
        QTest::newRow("re-opening") << int(LinkState::Reopening) << QString();
    }

    void cardOffersWhatTheStateAllows()
    {
        QFETCH(int, state);
        QFETCH(QString, offer);
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.models.sessions.setLinkState(robotId, LinkState(state), stage.cockpit.now);
        stage.refresh();
        QSignalSpy opened(&stage.window, &CockpitWindow::openRequested);
        QSignalSpy closed(&stage.window, &CockpitWindow::closeRequested);
        QSignalSpy reopened(&stage.window, &CockpitWindow::reopenRequested);
        QPushButton* button = cardButton(stage, robotId);
        QTest::mouseClick(button, Qt::LeftButton);
        QCOMPARE(opened.count(), offer == QLatin1String("Open") ? 1 : 0);
        QCOMPARE(closed.count(), offer == QLatin1String("Close") ? 1 : 0);
        QCOMPARE(reopened.count(), offer == QLatin1String("Re-open") ? 1 : 0);
        QCOMPARE(button->isEnabled(), !offer.isEmpty());
    }

    void trendsShowAMinuteOrTen()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.refresh();
        auto* trends = stage.named<TrendsPane>(QStringLiteral("Trends"));
        auto* button = stage.named<QPushButton>(QStringLiteral("Span of the trends"));
        QVERIFY(trends != nullptr && button != nullptr);
        const QImage minute = trends->grab().toImage();
        QTest::mouseClick(button, Qt::LeftButton);
        QVERIFY(trends->span() == TrendSpan::TenMinutes);
        QCOMPARE(button->text(), QStringLiteral("10 min"));
        QVERIFY(trends->grab().toImage() != minute);
        QVERIFY2(trends->accessibleDescription().contains(QStringLiteral("Picture age")), qPrintable(trends->accessibleDescription()));
        QTest::mouseClick(button, Qt::LeftButton);
        QVERIFY(trends->span() == TrendSpan::Minute);
    }

    void trendIsDrawnInThePlotsHueAndNoAlarms()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.refresh();
        const QImage image = stage.named<TrendsPane>(QStringLiteral("Trends"))->grab().toImage();
        QVERIFY2(violetPixels(image) > 20, qPrintable(QString::number(violetPixels(image))));
        for (const QColor& alarm : {colour::high, colour::medium, colour::low})
            QCOMPARE(pixelsOf(image, alarm), 0);
    }

    void plotsTellWhereThePicturesAgeComesFrom()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        QTest::keyClick(&stage.window, Qt::Key_F3);
        QCOMPARE(stage.window.view(), View::Plots);
        auto* waterfall = stage.named<Waterfall>(QStringLiteral("Where the picture's age comes from"));
        QVERIFY(waterfall != nullptr);
        QVERIFY(waterfall->accessibleDescription().contains(QStringLiteral("No picture")));
        stage.cockpit.openAll();
        stage.window.findChild<PlotsView*>()->refresh(stage.cockpit.now);
        for (const char* words :
             {"before sending: median 21.0 ms", "way to here: median 37.0 ms", "to the screen: median 3.0 ms", "decoding: median 6.0 ms",
              "filter's delay: median 11.0 ms", "filter's delay: median 11.0 ms, 99th percentile 14.0 ms"})
            QVERIFY2(waterfall->accessibleDescription().replace(QChar::Nbsp, QLatin1Char(' ')).contains(QString::fromLatin1(words)),
                     qPrintable(waterfall->accessibleDescription()));
        auto* trip = stage.named<FigureLabel>(QStringLiteral("Round trip, 60 s, 99 %"));
        QVERIFY(trip != nullptr && trip->text().endsWith(QStringLiteral("ms")) && !trip->text().startsWith(QChar(0x2014)));
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_F3);
        QCOMPARE(stage.window.view(), View::Cockpit);
    }

    void handGetsKeysOnceAndNeverSpaceOrEnter()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.window.setFocus();
        QTRY_VERIFY(stage.window.handHasKeys());
        QSignalSpy pressed(&stage.window, &CockpitWindow::handKeyPressed);
        for (const Qt::Key key : {Qt::Key_Space, Qt::Key_Return, Qt::Key_Enter})
            QTest::keyClick(&stage.window, key);
        QCOMPARE(pressed.count(), 0);
        QTest::keyPress(&stage.window, Qt::Key_D);
        QKeyEvent repeat(QEvent::KeyPress, Qt::Key_D, Qt::NoModifier, QString(), true);
        QCoreApplication::sendEvent(&stage.window, &repeat);
        QCOMPARE(pressed.count(), 1);
        QCOMPARE(pressed.first().first().toInt(), int(Qt::Key_D));
    }

    void handLosesTheKeysTo_data()
    {
        QTest::addColumn<QString>("what");
        for (const char* what : {"the sheet", "the topology", "the plots", "the log", "a hidden window"})
            QTest::newRow(what) << QString::fromLatin1(what);
    }

    void handLosesTheKeysTo()
    {
        QFETCH(QString, what);
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        stage.window.setFocus();
        QTRY_VERIFY(stage.window.handHasKeys());
        QSignalSpy focus(&stage.window, &CockpitWindow::handFocusChanged);
        if (what == QLatin1String("the sheet"))
            stage.cockpit.loseRobot();
        else if (what == QLatin1String("the topology"))
            QTest::keyClick(&stage.window, Qt::Key_F2);
        else if (what == QLatin1String("the plots"))
            QTest::keyClick(&stage.window, Qt::Key_F3);
        else if (what == QLatin1String("the log"))
            QTest::keyClick(&stage.window, Qt::Key_F4);
        else
            stage.window.hide();
        QCOMPARE(focus.count(), 1);
        QCOMPARE(focus.first().first().toBool(), false);
        QSignalSpy pressed(&stage.window, &CockpitWindow::handKeyPressed);
        QWidget* target = QApplication::focusWidget() ? QApplication::focusWidget() : &stage.window;
        QTest::keyClick(target, Qt::Key_D);
        QCOMPARE(pressed.count(), 0);
    }

    void panicAndEmergencyKeysWorkEverywhere_data()
    {
        QTest::addColumn<bool>("inSheet");
        QTest::newRow("cockpit") << false;
        QTest::newRow("sheet") << true;
    }

    void panicAndEmergencyKeysWorkEverywhere()
    {
        QFETCH(bool, inSheet);
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        if (inSheet)
            stage.cockpit.loseRobot();
        QSignalSpy panic(&stage.window, &CockpitWindow::panicHoldRequested);
        QSignalSpy stop(&stage.window, &CockpitWindow::emergencyStopRequested);
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_F12);
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
        QCOMPARE(panic.count(), 1);
        QCOMPARE(stop.count(), 1);
    }

    void topologyOverlayLeavesTheLiveImage()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        QTest::keyClick(&stage.window, Qt::Key_F2);
        QVERIFY(stage.topology->isVisible());
        QCOMPARE(stage.seen(stage.live), stage.window.regionGeometry(Region::Live));
        QVERIFY(stage.window.regionGeometry(Region::Overlay).contains(stage.seen(stage.topology)));
        QTest::keyClick(QApplication::focusWidget(), Qt::Key_F1);
        QVERIFY(!stage.topology->isVisible());
    }

    void miniTopologyOpensTheWhole()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.refresh();
        QTRY_VERIFY(stage.mini->isVisible());
        QTest::mouseClick(stage.mini->viewport(), Qt::LeftButton);
        QTRY_VERIFY(stage.topology->isVisible());
    }

    void alarmColoursTheWholeBand_data()
    {
        QTest::addColumn<int>("priority");
        QTest::addColumn<QColor>("surface");
        QTest::newRow("high") << int(AlarmPriority::High) << QColor(colour::highSurface);
        QTest::newRow("medium") << int(AlarmPriority::Medium) << QColor(colour::medium);
        QTest::newRow("low") << int(AlarmPriority::Low) << QColor(colour::low);
    }

    void alarmColoursTheWholeBand()
    {
        QFETCH(int, priority);
        QFETCH(QColor, surface);
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.models.alarms.update({report(AlarmCondition::ForceWarn, AlarmPriority(priority), QStringLiteral("Force"))},
                                           stage.cockpit.now, 0);
        auto* band = stage.window.findChild<AlarmBand*>();
        const QImage picture = band->grab().toImage();
        QVERIFY(pixelsOf(picture, surface) > picture.width() * picture.height() / 2);
        QCOMPARE(picture.pixelColor(1, 1), surface);
        QCOMPARE(picture.pixelColor(picture.width() - 2, picture.height() - 2), surface);
    }

    void badgeFlashesAndTextStays()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.models.alarms.update({report(AlarmCondition::ForceStop, AlarmPriority::High, QStringLiteral("Force above 2 N"))},
                                           stage.cockpit.now, 0);
        auto* band = stage.window.findChild<AlarmBand*>();
        const int badge = band->width() / 12;
        const auto text = [&] { return band->grab(QRect(badge, 0, band->width() / 2, band->height())).toImage(); };
        const auto mark = [&] { return band->grab(QRect(0, 0, badge / 2, band->height())).toImage(); };
        const QImage textBefore = text();
        const QImage markBefore = mark();
        QTRY_VERIFY(mark() != markBefore);
        QCOMPARE(text(), textBefore);
        QTRY_VERIFY(mark() == markBefore);
    }

    void acknowledgeNamesTheAlarm()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        AlarmList& alarms = stage.cockpit.models.alarms;
        alarms.update({report(AlarmCondition::ForceWarn, AlarmPriority::Medium, QStringLiteral("Force"))}, stage.cockpit.now, 0);
        QSignalSpy asked(&stage.window, &CockpitWindow::acknowledgeRequested);
        auto* button = stage.named<QPushButton>(QStringLiteral("Acknowledge the alarm shown"));
        QVERIFY(button);
        QTest::mouseClick(button, Qt::LeftButton);
        QCOMPARE(asked.count(), 1);
        QCOMPARE(asked.first().first().toULongLong(), alarms.highest()->id);
        alarms.acknowledge(alarms.highest()->id, 0);
        QVERIFY(!button->isVisible());
    }

    void staleValuesLookStale()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        const Instant received = *stage.cockpit.models.instrument.robot().received;
        auto* panel = stage.window.findChild<AxisPanel*>();
        stage.window.refresh(received + std::chrono::milliseconds(10));
        const QImage fresh = panel->grab().toImage();
        stage.window.refresh(received + std::chrono::milliseconds(400));
        const QImage stale = panel->grab().toImage();
        QVERIFY(pixelsOf(fresh, colour::bright) > 50);
        QCOMPARE(pixelsOf(stale, colour::bright), 0);
        QVERIFY(pixelsOf(stale, colour::stale) > 20);
        QCOMPARE(pixelsOf(fresh, colour::stale), 0);
        QVERIFY(panel->accessibleDescription().contains(QStringLiteral("stale")));
    }

    void theArmsStateHasItsAge()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        const auto& arm = stage.cockpit.models.arm.status();
        const auto line = [&stage] {
            for (const auto* label : stage.window.findChildren<QLabel*>())
                if (label->isVisible() && label->text().startsWith(QStringLiteral("Robotic arm: ")))
                    return label->text();
            return QString();
        };
        stage.window.refresh(*arm.received + std::chrono::milliseconds(40));
        QCOMPARE(line(), QStringLiteral("Robotic arm: %1 \u00B7 age 40\u00A0ms").arg(word(arm.value.phase)));
        stage.window.refresh(*arm.received + std::chrono::milliseconds(2400));
        QCOMPARE(line(), QStringLiteral("Robotic arm: last known: %1 \u00B7 stale 2.4\u00A0s").arg(word(arm.value.phase)));
    }

    void unknownValuesAreDashes()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.refresh();
        QVERIFY(stage.window.findChild<AxisPanel*>()->accessibleDescription().startsWith(QChar(0x2014)));
        QVERIFY(stage.window.findChild<ForceGauge*>()->accessibleDescription().startsWith(QChar(0x2014)));
    }

    void forceTakesTheAlarmsColourAtItsMarks_data()
    {
        QTest::addColumn<double>("force");
        QTest::addColumn<QColor>("ink");
        QTest::newRow("calm") << 0.9 << QColor(colour::text);
        QTest::newRow("warn") << 1.2 << QColor(colour::medium);
        QTest::newRow("stop") << 2.1 << QColor(colour::high);
        QTest::newRow("pull counts, too") << -2.1 << QColor(colour::high);
    }

    void forceTakesTheAlarmsColourAtItsMarks()
    {
        QFETCH(double, force);
        QFETCH(QColor, ink);
        InventedCockpit cockpit;
        RobotStatus status = cockpit.status(RobotState::Ready);
        status.guidewireForce = force;
        cockpit.models.instrument.receiveRobot(status, cockpit.now);
        ForceGauge gauge;
        gauge.resize(360, 260);
        gauge.setState(cockpit.models.instrument, cockpit.now);
        const QImage picture = gauge.grab().toImage();
        QVERIFY(pixelsOf(picture, ink) > 150);
        for (const QColor& other : {QColor(colour::medium), QColor(colour::high)})
            if (other != ink)
                QCOMPARE(pixelsOf(picture, other), 0);
    }

    void modeWordFollowsThePermit()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        auto* strip = stage.window.findChild<StatusStrip*>();
        QCOMPARE(strip->mode(), Mode::Standby);
        stage.cockpit.openAll();
        stage.refresh();
        QCOMPARE(strip->mode(), Mode::Ready);
        stage.cockpit.arm();
        QCOMPARE(strip->mode(), Mode::Armed);
        stage.cockpit.engage();
        QCOMPARE(strip->mode(), Mode::Engaged);
        stage.cockpit.freezePicture();
        QCOMPARE(strip->mode(), Mode::Hold);
        stage.cockpit.loseRobot();
        stage.refresh();
        QCOMPARE(stage.cockpit.models.permit.phase(), PermitPhase::Incident);
        QCOMPARE(strip->mode(), Mode::Hold);
        stage.cockpit.reopenAll();
        stage.refresh();
        QCOMPARE(stage.cockpit.models.permit.phase(), PermitPhase::Verifying);
        QCOMPARE(strip->mode(), Mode::Hold);
    }

    void everyPhaseIsExplained_data()
    {
        QTest::addColumn<QString>("state");
        for (const char* state : {"idle", "open", "armed", "engaged", "frozen", "lost"})
            QTest::newRow(state) << QString::fromLatin1(state);
    }

    void everyPhaseIsExplained()
    {
        QFETCH(QString, state);
        InventedCockpit cockpit;
        if (state != QLatin1String("idle"))
            cockpit.openAll();
        if (state == QLatin1String("armed") || state == QLatin1String("engaged") || state == QLatin1String("frozen"))
            cockpit.arm();
        if (state == QLatin1String("engaged") || state == QLatin1String("frozen"))
            cockpit.engage();
        if (state == QLatin1String("frozen"))
            cockpit.freezePicture();
        if (state == QLatin1String("lost"))
            cockpit.loseRobot();
        const QString words = PermitBlock::explanation(cockpit.models.permit, cockpit.now);
        QVERIFY(!words.isEmpty());
        QVERIFY(!words.contains(QStringLiteral("resume")));
    }
};

QTEST_MAIN(TestCockpitWindow)
#include "test_cockpit_window.moc"
