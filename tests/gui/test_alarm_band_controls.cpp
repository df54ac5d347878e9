// What a hand does at the alarm band: the self-test, the pause of the sound, an incident's mark, a folded sheet.
#include "cockpit_stage.hpp"
#include "painted_band.hpp"
#include "widgets/self_test_block.hpp"

#include <QApplication>
#include <QPointer>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

class TestAlarmBandControls : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { theme::apply(*qApp); }

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

    /// Pressed, it opens its sheet, and there is a chip for the one that was open instead.
    void aChipMayGoWhileItIsPressed()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        auto* band = stage.window.findChild<AlarmBand*>();
        connect(band, &AlarmBand::sheetRequested, band, [band] { band->setFoldedSheets({{2, QStringLiteral("Arm link lost")}}); });
        band->setFoldedSheets({{1, QStringLiteral("Robot link lost")}});
        QPointer<QPushButton> chip = stage.named<QPushButton>(QStringLiteral("Show again: Robot link lost"));
        QVERIFY(chip);
        QTest::mouseClick(chip, Qt::LeftButton);
        QVERIFY(!chip || !chip->isVisible());
        QVERIFY(stage.named<QPushButton>(QStringLiteral("Show again: Arm link lost")));
    }

    /// Who hears that the keys went from a chip that goes may set others at once: the newest are what stays, each once.
    void chipsMayBeSetWhileSomeGo()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        QVERIFY(QTest::qWaitForWindowActive(&stage.window));
        auto* band = stage.window.findChild<AlarmBand*>();
        band->setFoldedSheets({{1, QStringLiteral("Robot link lost")}, {2, QStringLiteral("Arm link lost")}});
        stage.named<QPushButton>(QStringLiteral("Show again: Robot link lost"))->setFocus();
        int heard = 0;
        const auto set = [&] {
            if (heard++ == 0)
                band->setFoldedSheets({{3, QStringLiteral("X-ray link lost")}});
        };
        const auto hears = connect(qApp, &QApplication::focusChanged, band, set);
        band->setFoldedSheets({{4, QStringLiteral("Cockpit link lost")}, {5, QStringLiteral("Table link lost")}});
        disconnect(hears);
        QVERIFY(heard > 0);
        QStringList chips;
        for (const auto* button : band->findChildren<QPushButton*>())
            if (button->isVisible() && button->accessibleName().startsWith(QStringLiteral("Show again")))
                chips << button->text();
        QCOMPARE(chips, QStringList{QStringLiteral("X-ray link lost")});
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

    /// Else it looks as if the key or the console were dead.
    void aPauseThatMayNotBeginYetIsCountedDownOnItsButton()
    {
        CockpitStage stage;
        QVERIFY(stage.ready());
        stage.cockpit.openAll();
        auto& alarms = stage.cockpit.models.alarms;
        const auto now = std::chrono::steady_clock::now();
        alarms.update({{AlarmCondition::ForceWarn, 0, AlarmPriority::Medium, false, QStringLiteral("Force"), QStringLiteral("Stop."), 0}},
                      now, 0);
        const auto* pause = stage.named<QPushButton>(QStringLiteral("Pause the alarm sound for a while, or end the pause"));
        QVERIFY(pause);
        const auto saidAfter = [&](Duration passed) {
            stage.window.refresh(now + passed);
            return pause->text();
        };
        alarms.pauseAudio(now);
        alarms.resumeAudio(now, 0);
        QCOMPARE(saidAfter(3s), QStringLiteral("Pause sound (F9)")); // nothing is armed: it may
        const int width = pause->width();
        stage.cockpit.arm();
        QCOMPARE(saidAfter(3s), QStringLiteral("Sound stays on 7 s"));
        stage.cockpit.engage();
        QCOMPARE(saidAfter(9500ms), QStringLiteral("Sound stays on 1 s"));
        QVERIFY(pause->isVisible());
        QCOMPARE(pause->width(), width);
        QCOMPARE(saidAfter(10s), QStringLiteral("Pause sound (F9)"));
        alarms.pauseAudio(now + 10s);
        QCOMPARE(saidAfter(11s), QStringLiteral("AUDIO PAUSED 59 s"));
    }
};

QTEST_MAIN(TestAlarmBandControls)
#include "test_alarm_band_controls.moc"
