// Sound, log, self-test and watchdog together: what fails of them is an alarm of its own.
#include "app/alarm_service.hpp"
#include "invented_cockpit.hpp"
#include "model/log_roles.hpp"

#include <QDir>
#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;
using C = AlarmCondition;

namespace {

class QuietVoice : public AlarmVoice {
public:
    void play(AlarmPriority) override {}
    void silence() override {}
};

struct Room {
    InventedCockpit cockpit;
    AlarmWatch watch{cockpit.models, robotId};
    QTemporaryDir folder;

    AlarmSettings settings(const QString& watchdog = {}) const
    {
        return {folder.filePath(QStringLiteral("log")), QStringLiteral("alarms-test"), watchdog,
                QStringLiteral(LIENA_PROGRAM_DIR "/liena-console-player")};
    }

    const Alarm* find(AlarmCondition condition)
    {
        watch.update(std::chrono::steady_clock::now(), 0);
        for (const auto& alarm : cockpit.models.alarms.alarms())
            if (alarm.condition == condition && alarm.present)
                return &alarm;
        return nullptr;
    }

    /// The event log on the screen.
    bool logTells(const QString& text) const
    {
        const auto& log = cockpit.models.log;
        for (int row = 0; row < log.rowCount(); ++row)
            if (log.index(row).data(LogTextRole).toString().contains(text))
                return true;
        return false;
    }

    QByteArray logged() const
    {
        QFile file(folder.filePath(QStringLiteral("log/alarms-test.jsonl")));
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    }
};

} // namespace

class TestAlarmService : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase() { qputenv("PULSE_SERVER", "unix:/nowhere"); }

    void aMachineWithoutSoundRaisesItsAlarmAndGoesOn()
    {
        Room room;
        AlarmService service(room.cockpit.models, room.watch, room.settings());
        QVERIFY(!room.find(C::SoundFailed));
        service.start();
        const auto told = [&room] {
            const auto* alarm = room.find(C::SoundFailed);
            return alarm != nullptr && alarm->text.contains(QStringLiteral("no sound output"));
        };
        QTRY_VERIFY_WITH_TIMEOUT(told(), 30000);
        QVERIFY(!room.find(C::RecorderStopped));
    }

    void aConsoleWithoutAPlayerRaisesItsAlarm()
    {
        Room room;
        auto settings = room.settings();
        settings.player = QStringLiteral("/nowhere/player");
        AlarmService service(room.cockpit.models, room.watch, settings);
        service.start();
        QTRY_VERIFY(room.find(C::SoundFailed));
        QVERIFY2(room.find(C::SoundFailed)->text.contains(settings.player), qPrintable(room.find(C::SoundFailed)->text));
    }

    void aWatchdogThatIsNotThereRaisesItsAlarm()
    {
        Room room;
        AlarmService service(room.cockpit.models, room.watch, room.settings(QStringLiteral("/no/such/watchdog")));
        service.start();
        QTRY_VERIFY(room.find(C::WatchdogGone));
        QVERIFY(room.find(C::WatchdogGone)->text.contains(QStringLiteral("/no/such/watchdog")));
    }

    /// A program in its place that says of itself what the real one says where nothing would be heard.
    void aWatchdogThatHasNoSoundIsAnAlarmWhereThisConsoleHasSome_data()
    {
        QTest::addColumn<bool>("sound");
        QTest::newRow("this console has sound") << true;
        QTest::newRow("it has none either, which is told already") << false;
    }

    void aWatchdogThatHasNoSoundIsAnAlarmWhereThisConsoleHasSome()
    {
        QFETCH(bool, sound);
        Room room;
        const QString program = room.folder.filePath(QStringLiteral("silent"));
        QFile script(program);
        QVERIFY(script.open(QIODevice::WriteOnly));
        script.write("#!/bin/sh\nexec stdbuf -o0 tr a-z '!'\n");
        script.close();
        QVERIFY(script.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner));
        QuietVoice voice;
        auto settings = room.settings(program);
        settings.voice = &voice;
        AlarmService service(room.cockpit.models, room.watch, settings);
        if (!sound)
            Q_EMIT voice.troubleChanged(QStringLiteral("no sound output"));
        service.start();
        QTRY_VERIFY(room.logTells(QStringLiteral("its watchdog has no sound")));
        const auto* alarm = room.find(C::WatchdogGone);
        QCOMPARE(alarm != nullptr, sound);
        QVERIFY(!sound || alarm->text.contains(QStringLiteral("no sound")));
    }

    void aLogThatCannotBeWrittenRaisesItsAlarm()
    {
        Room room;
        QFile plain(room.folder.filePath(QStringLiteral("log")));
        QVERIFY(plain.open(QIODevice::WriteOnly));
        const AlarmService service(room.cockpit.models, room.watch, room.settings());
        QVERIFY(room.find(C::RecorderStopped));
        QCOMPARE(room.find(C::RecorderStopped)->priority, AlarmPriority::Low);
    }

    void whatHappensIsOnTheDiskBeforeTheEnd()
    {
        Room room;
        AlarmService service(room.cockpit.models, room.watch, room.settings());
        room.cockpit.models.alarms.update(
            {{C::ForceStop, 0, AlarmPriority::High, true, QStringLiteral("FORCE"), QStringLiteral("Stop."), 0}}, room.cockpit.now, 1000);
        service.acknowledge(room.cockpit.models.alarms.highest()->id, QStringLiteral("Dr Wu"));
        QTRY_VERIFY(room.logged().contains("acknowledged by Dr Wu: FORCE"));
        QVERIFY(room.logged().contains("raised: FORCE"));
    }

    void theNextStartHasTheLogOfTheLast()
    {
        QTemporaryDir folder;
        for (int run = 1; run <= 2; ++run) {
            InventedCockpit cockpit;
            AlarmWatch watch{cockpit.models, robotId};
            AlarmService service(cockpit.models, watch, {folder.path(), QStringLiteral("alarms"), {}});
            QCOMPARE(cockpit.models.alarms.log().size(), std::size_t(run)); // one "console started" a run
            QVERIFY(cockpit.models.alarms.log().back().text.startsWith(QStringLiteral("console started")));
        }
    }

    void noSelfTestBesideAHighAlarm()
    {
        Room room;
        AlarmService service(room.cockpit.models, room.watch, room.settings());
        auto& alarms = room.cockpit.models.alarms;
        auto& test = room.cockpit.models.selfTest;
        QSignalSpy changed(&test, &AlarmSelfTest::changed);
        alarms.update({{C::ForceStop, 0, AlarmPriority::High, true, QStringLiteral("FORCE"), QStringLiteral("Stop."), 0}}, room.cockpit.now,
                      1000);
        service.beginSelfTest();
        QCOMPARE(changed.count(), 0);
        service.acknowledge(alarms.highest()->id, QString());
        service.beginSelfTest();
        QCOMPARE(test.signal(), std::optional(AlarmPriority::High));
    }

    void anArmingUsesTheSelfTestUp()
    {
        Room room;
        const AlarmService service(room.cockpit.models, room.watch, room.settings());
        auto& test = room.cockpit.models.selfTest;
        room.cockpit.openAll();
        auto now = Instant{} + 1h;
        test.begin(now);
        for (int i = 0; i < 70; ++i)
            test.update(false, now += 100ms);
        test.confirm();
        QVERIFY(test.passed());
        room.cockpit.arm();
        QCOMPARE(room.cockpit.models.permit.phase(), PermitPhase::Armed);
        QVERIFY(!test.passed());
        PermitEvent panic;
        panic.kind = PermitEventKind::PanicHold;
        room.cockpit.models.permit.apply(panic, room.cockpit.now);
        QCOMPARE(test.step(), AlarmSelfTest::Step::NotDone);
    }

    /// Pause, end, pause: each press by itself is allowed, and all together would be silence for good.
    void noPauseFollowsAPauseWhileArmed()
    {
        Room room;
        AlarmService service(room.cockpit.models, room.watch, room.settings());
        auto& models = room.cockpit.models;
        const auto pausedAfterAPress = [&] {
            service.toggleAudioPause({});
            return models.alarms.audioPauseLeft(std::chrono::steady_clock::now()).has_value();
        };
        room.cockpit.openAll();
        for (int i = 0; i < 3; ++i) // nothing is armed
            QVERIFY(pausedAfterAPress() && !pausedAfterAPress());
        QVERIFY(pausedAfterAPress());
        room.cockpit.arm();
        QCOMPARE(models.permit.phase(), PermitPhase::Armed);
        for (int i = 0; i < 5; ++i) // the first ends the pause
            QVERIFY(!pausedAfterAPress());
        QCOMPARE(models.log.lines().back().text, QStringLiteral("audio not paused again: armed, and the sound is back for less than 10 s"));
        QCOMPARE(models.alarms.log().back().text, QStringLiteral("audio pause ended")); // which no press pushes out
        room.cockpit.engage();
        QCOMPARE(models.permit.phase(), PermitPhase::Engaged);
        QVERIFY(!pausedAfterAPress());
        PermitEvent panic;
        panic.kind = PermitEventKind::PanicHold;
        models.permit.apply(panic, room.cockpit.now);
        QVERIFY(pausedAfterAPress()); // motion has ended
    }

    void aHangIsHeardWheneverSomebodyReliesOnTheSound_data()
    {
        QTest::addColumn<int>("phase");
        QTest::addColumn<bool>("awaitingRobot");
        QTest::addColumn<bool>("highAlarm");
        QTest::addColumn<bool>("holdAwaited");
        QTest::addColumn<bool>("relied");
        for (const auto phase : {PermitPhase::Off, PermitPhase::Standby, PermitPhase::Ready, PermitPhase::Incident, PermitPhase::Verifying})
            for (const bool high : {false, true})
                QTest::addRow("%s%s", qPrintable(word(phase)), high ? ", high alarm" : "") << int(phase) << false << high << false << high;
        for (const auto phase : {PermitPhase::Armed, PermitPhase::Engaged, PermitPhase::Hold})
            QTest::addRow("%s", qPrintable(word(phase))) << int(phase) << false << false << false << true;
        QTest::newRow("ARM is held") << int(PermitPhase::Arming) << false << false << false << false;
        QTest::newRow("the robot was asked to arm") << int(PermitPhase::Arming) << true << false << false << true;
        QTest::newRow("ARM is held, high alarm") << int(PermitPhase::Arming) << false << true << false << true;
        for (const auto phase : {PermitPhase::Off, PermitPhase::Incident})
            QTest::addRow("%s, the robot has not said that it holds", qPrintable(word(phase)))
                << int(phase) << false << false << true << true;
    }

    void aHangIsHeardWheneverSomebodyReliesOnTheSound()
    {
        QFETCH(int, phase);
        QFETCH(bool, awaitingRobot);
        QFETCH(bool, highAlarm);
        QFETCH(bool, holdAwaited);
        QFETCH(bool, relied);
        PermitState permit;
        permit.phase = PermitPhase(phase);
        permit.awaitingRobot = awaitingRobot;
        QCOMPARE(attended(permit, highAlarm, holdAwaited), relied);
    }

    /// What the service beats, as the watchdog's pipe has it.
    void aHighAlarmAloneIsBeatenAsAttended()
    {
        Room room;
        const QString program = room.folder.filePath(QStringLiteral("listener"));
        const QString heard = room.folder.filePath(QStringLiteral("heard"));
        QFile script(program);
        QVERIFY(script.open(QIODevice::WriteOnly));
        script.write("#!/bin/sh\nexec cat > '" + heard.toUtf8() + "'\n");
        script.close();
        QVERIFY(script.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner));
        const auto beats = [&heard] {
            QFile file(heard);
            return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
        };
        AlarmService service(room.cockpit.models, room.watch, room.settings(program));
        service.start();
        QTRY_VERIFY(beats().contains('i'));
        QVERIFY(!beats().contains('a'));
        room.cockpit.models.alarms.update(
            {{C::ForceStop, 0, AlarmPriority::High, true, QStringLiteral("FORCE"), QStringLiteral("Stop."), 0}}, room.cockpit.now, 1000);
        QTRY_VERIFY(beats().contains('a'));
        service.acknowledge(room.cockpit.models.alarms.highest()->id, QString());
        QTRY_VERIFY(beats().endsWith('i'));
    }

    /// A console that is closed is told from one that died.
    void aConsoleThatIsClosedIsInTheAlarmLog()
    {
        Room room;
        AlarmService service(room.cockpit.models, room.watch, room.settings());
        service.noteClosed(QStringLiteral("Dr Invented"));
        QCOMPARE(room.cockpit.models.alarms.log().back().text, QStringLiteral("console closed by Dr Invented"));
        QTRY_VERIFY(room.logged().contains("console closed by Dr Invented"));
    }

    /// Where it survives, and where it is read; with how things stood.
    void aMarkedIncidentIsInBothLogs()
    {
        Room room;
        AlarmService service(room.cockpit.models, room.watch, room.settings());
        auto& models = room.cockpit.models;
        service.markIncident({});
        const QString unknown = QStringLiteral("incident marked by the operator: OFF, picture NO PICTURE, AGE unknown, force unknown");
        QCOMPARE(models.alarms.log().back().text, unknown);
        RobotStatus status;
        status.guidewireForce = 0.25;
        models.instrument.receiveRobot(status, std::chrono::steady_clock::now());
        service.markIncident(QStringLiteral("Dr Wu"));
        const QString marked = models.alarms.log().back().text;
        QVERIFY2(marked.startsWith(QStringLiteral("incident marked by Dr Wu: ")) && marked.endsWith(QStringLiteral("force 0.25 N")),
                 qPrintable(marked));
        const auto line = models.log.index(models.log.rowCount() - 1);
        QCOMPARE(line.data(LogTextRole).toString(), marked);
        QCOMPARE(line.data(LogKindRole).toInt(), int(LogKind::Operator));
        QTRY_VERIFY(room.logged().contains(marked.toUtf8()));
        QVERIFY(models.alarms.alarms().empty()); // it raises nothing
    }

    void theSelfTestIsLoggedWithWhoConfirmedIt()
    {
        Room room;
        AlarmService service(room.cockpit.models, room.watch, room.settings());
        auto& test = room.cockpit.models.selfTest;
        auto now = Instant{} + 1h;
        test.begin(now);
        for (int i = 0; i < 70; ++i)
            test.update(false, now += 100ms);
        service.answerSelfTest(true, QStringLiteral("Dr Wu"));
        QVERIFY(test.passed());
        QCOMPARE(room.cockpit.models.alarms.log().back().text, QStringLiteral("alarm self-test confirmed by Dr Wu"));
    }
};

QTEST_GUILESS_MAIN(TestAlarmService)
#include "test_alarm_service.moc"
