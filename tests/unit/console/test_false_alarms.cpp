// What looks like an alarm for a moment and is none, or one and not many: one late heartbeat, a value at its limit, what a
// device said before a loss.
#include "alarm_cases.hpp"
#include "watched_cockpit.hpp"

#include <QTest>

#include <algorithm>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;
using C = AlarmCondition;

namespace {

/// Lines of the alarm log, raised or ended.
int told(Watched& w, const QString& words)
{
    const auto& log = w.models().alarms.log();
    return int(std::count_if(log.begin(), log.end(), [&words](const AlarmLogEntry& entry) { return entry.text.contains(words); }));
}

void measure(Watched& w, Duration roundTrip)
{
    w.now += 100ms;
    w.figuresOf(robotId, [roundTrip](auto& figures) { figures.roundTrip = roundTrip; });
}

/// The link is lost, and a minute later open again.
void reopen(Watched& w, quint32 peer)
{
    w.models().sessions.setLinkState(peer, LinkState::StandBy, w.now);
    w.look();
    w.now += 60s;
    w.models().sessions.setLinkState(peer, LinkState::Reopening, w.now);
    w.models().sessions.setLinkState(peer, LinkState::Open, w.now);
}

} // namespace

class TestFalseAlarms : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void oneLateHeartbeatIsNoRoundTrip()
    {
        Watched w;
        measure(w, 900ms);
        QVERIFY(!w.priorityOf(C::CommandRoundTrip));
        measure(w, 901ms);
        QCOMPARE(w.priorityOf(C::CommandRoundTrip), std::optional(AlarmPriority::Low));
    }

    void aRoundTripAtItsLimitIsOneAlarm()
    {
        Watched w;
        for (int i = 0; i < 50; ++i) {
            measure(w, 248ms);
            w.look();
            measure(w, 252ms);
            w.look();
        }
        QVERIFY(w.priorityOf(C::CommandRoundTrip));
        QCOMPARE(told(w, QStringLiteral("there and back")), 1);
    }

    void aForceAtItsLimitIsOneAlarm()
    {
        Watched w;
        w.cockpit.arm();
        for (int i = 0; i < 100; ++i) {
            w.now += 100ms;
            auto status = w.robot();
            status.guidewireForce = i % 2 == 0 ? 1.02 : 0.98;
            w.receive(status);
            w.look();
        }
        QCOMPARE(told(w, QStringLiteral("Guidewire force")), 1);
    }

    /// The library tells what is missing until it gives a link up.
    void aReportThatWasOverdueBeforeALossIsNoneAfterTheReopening_data()
    {
        QTest::addColumn<quint32>("peer");
        QTest::addColumn<QString>("message");
        QTest::newRow("dose") << quint32(xrayId) << QStringLiteral("AcquisitionStatus");
        QTest::newRow("robot") << quint32(robotId) << QStringLiteral("RobotStatus");
        QTest::newRow("tip") << quint32(robotId) << QStringLiteral("TipPose");
    }

    void aReportThatWasOverdueBeforeALossIsNoneAfterTheReopening()
    {
        QFETCH(quint32, peer);
        QFETCH(QString, message);
        Watched w;
        w.models().sessions.setLinkState(peer, LinkState::Reconnecting, w.now);
        w.watch.noteDeadlineMissed(peer, message, w.now);
        reopen(w, peer);
        QVERIFY(!w.priorityOf(C::DeadlineMissed));
        w.now += 301ms;
        w.watch.noteDeadlineMissed(peer, message, w.now); // and none came
        QVERIFY(w.priorityOf(C::DeadlineMissed));
    }

    void theTipOfBeforeALossIsNoFaultUntilANewOneIsOverdue()
    {
        Watched w;
        reopen(w, robotId);
        QVERIFY(!w.priorityOf(C::TrackerStale));
        w.now += 200ms;
        QVERIFY(!w.priorityOf(C::TrackerStale));
        w.now += 1ms;
        QVERIFY(w.priorityOf(C::TrackerStale));
    }

    /// A link that is suspect and heals goes on: nothing new is awaited.
    void aTipIsNotWaitedForLongerWhereTheLinkWasOnlySuspect()
    {
        Watched w;
        w.now += 170ms; // the last one came 21 ms before
        w.models().sessions.setLinkState(robotId, LinkState::Suspect, w.now);
        w.models().sessions.setLinkState(robotId, LinkState::Open, w.now);
        w.now += 11ms;
        QVERIFY(w.priorityOf(C::TrackerStale));
    }

    void aTipThatIsInvalidAfterTheReopeningIsToldAtOnce()
    {
        Watched w;
        reopen(w, robotId);
        w.models().instrument.receiveTip(TipPose{}, w.now);
        QVERIFY(w.priorityOf(C::TrackerStale));
    }

    /// Whoever presses the pedal as soon as the link is open; what is armed is not told later.
    void anAgeIsUnknownWithoutAnAlarmWhileTheClocksAreCompared()
    {
        auto readings = calmReadings();
        readings.picture.condition = PictureCondition::Unknown;
        readings.picture.unknownFor = 1900ms;
        QVERIFY(presentAlarms(readings).empty());
        readings.picture.unknownFor = 2s;
        QCOMPARE(presentAlarms(readings).front().priority, AlarmPriority::Low);
        QVERIFY(presentAlarms(readings).front().remedy.contains(QStringLiteral("clocks")));
        readings.armed = true;
        readings.picture.unknownFor = 0ms;
        QCOMPARE(presentAlarms(readings).front().condition, C::PictureStale);
        QVERIFY(presentAlarms(readings).front().remedy.contains(QStringLiteral("dead-man")));
        readings.engaged = true;
        QCOMPARE(presentAlarms(readings).front().priority, AlarmPriority::High);
    }

    /// The picture of a run before stands there frozen: whoever gives dose for nothing has to hear of the pedal, and not of that one.
    void aRunWithoutAPictureIsOneAlarmThatNamesThePedal()
    {
        auto readings = calmReadings();
        readings.picture.condition = PictureCondition::Frozen;
        readings.picture.overdue = true;
        for (const QString& refusal : {QString(), QStringLiteral("17 bits are not known")}) {
            readings.picture.refusal = refusal;
            const auto reports = presentAlarms(readings);
            QCOMPARE(reports.size(), std::size_t(1));
            QCOMPARE(reports.front().condition, C::PictureStale);
            QVERIFY2(reports.front().remedy.contains(QStringLiteral("pedal")), qPrintable(reports.front().remedy));
            QVERIFY2(reports.front().text.endsWith(refusal), qPrintable(reports.front().text));
        }
    }
};

QTEST_GUILESS_MAIN(TestFalseAlarms)
#include "test_false_alarms.moc"
