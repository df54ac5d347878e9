// Jitter and loss above their limits: from the library's figures, translated as ever, to the alarm; and that it does not chatter.
#include "app/alarm_watch.hpp"
#include "invented_cockpit.hpp"
#include "link/session_intake.hpp"

#include <QTest>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

constexpr auto turn = 100ms;
constexpr quint64 beats = 5; ///< heartbeats of 20 ms in a turn

/// A robot's link whose heartbeats come as the test says.
struct Line {
    InventedCockpit cockpit;
    SessionIntake intake{cockpit.models};
    AlarmWatch watch{cockpit.models, robotId};
    liena::LinkStatus status;
    Instant now = cockpit.now;
    quint64 raisedBefore = 0;

    Line()
    {
        cockpit.openAll();
        status.peer = liena::DeviceId(robotId);
        status.heartbeatsReceived = 20000; // more than was invented before: the same session
        status.heartbeatsMissed = 10;
        run(12s, 1ms, 0);
        raisedBefore = cockpit.models.alarms.raisedInAll();
    }

    /// `missedOf`: one of so many heartbeats is missed; 0: none.
    void run(Duration time, std::chrono::nanoseconds jitter, quint64 missedOf)
    {
        for (Duration passed{}; passed < time; passed += turn) {
            now += turn;
            for (quint64 beat = 0; beat < beats; ++beat) {
                const bool missed = missedOf != 0 && ++m_count % missedOf == 0;
                ++(missed ? status.heartbeatsMissed : status.heartbeatsReceived);
            }
            status.jitter = jitter;
            status.lastHeard = now;
            intake.takeFigures({status}, now);
            watch.update(now, 0);
        }
    }

    const Alarm* alarm(AlarmCondition condition = AlarmCondition::LinkUnsteady) const
    {
        for (const auto& one : cockpit.models.alarms.alarms())
            if (one.condition == condition && one.subject == robotId && one.present)
                return &one;
        return nullptr;
    }

    /// Log lines of this condition, raised or ended.
    int told() const
    {
        const auto& log = cockpit.models.alarms.log();
        return int(std::count_if(log.begin(), log.end(),
                                 [](const AlarmLogEntry& entry) { return entry.text.contains(QStringLiteral("unsteady")); }));
    }

private:
    quint64 m_count = 0;
};

} // namespace

class TestLineAlarm : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aGoodLineIsNoAlarm()
    {
        Line line;
        line.run(30s, 9ms, 200);
        QVERIFY2(line.alarm() == nullptr, line.alarm() ? qPrintable(line.alarm()->text) : "");
    }

    void jitterAboveTheLimitIsLow()
    {
        Line line;
        line.run(1900ms, 11ms, 0);
        QVERIFY(line.alarm() == nullptr); // not for a moment's sake
        line.run(1s, 11ms, 0);
        QVERIFY(line.alarm() != nullptr);
        QCOMPARE(line.alarm()->priority, AlarmPriority::Low);
        QVERIFY2(line.alarm()->text.contains(QStringLiteral("jitter above 10 ms")), qPrintable(line.alarm()->text));
    }

    void lossAboveTheLimitIsLow()
    {
        Line line;
        line.run(20s, 1ms, 50);
        QVERIFY(line.alarm() != nullptr);
        QCOMPARE(line.alarm()->priority, AlarmPriority::Low);
        QVERIFY2(line.alarm()->text.contains(QStringLiteral("more than 1 % lost")), qPrintable(line.alarm()->text));
        line.run(20s, 1ms, 0);
        QVERIFY(line.alarm() == nullptr);
    }

    /// The session goes on by TCP, and somebody is told.
    void packetsThatPassNoMoreAreLow()
    {
        Line line;
        QVERIFY(line.alarm(AlarmCondition::PacketsLost) == nullptr); // where none ever passed, none is lost
        line.status.packetsHeard = 8;
        line.status.packetsHeardByPeer = 7;
        line.run(1s, 1ms, 0);
        line.status.packetsHeardByPeer = 0; // one direction is enough
        line.run(1900ms, 1ms, 0);
        QVERIFY(line.alarm(AlarmCondition::PacketsLost) == nullptr);
        line.run(1s, 1ms, 0);
        QVERIFY(line.alarm(AlarmCondition::PacketsLost) != nullptr);
        QCOMPARE(line.alarm(AlarmCondition::PacketsLost)->priority, AlarmPriority::Low);
        line.status.packetsHeardByPeer = 1;
        line.run(6s, 1ms, 0);
        QVERIFY(line.alarm(AlarmCondition::PacketsLost) == nullptr);
    }

    void thePatientsProfileSetsTheLimit()
    {
        Line line;
        line.cockpit.models.picture.setProfile(PictureProfile::Coronary);
        line.run(10s, 14ms, 0);
        QVERIFY(line.alarm() == nullptr);
        line.run(10s, 16ms, 0);
        QVERIFY(line.alarm() != nullptr);
        QVERIFY(line.alarm()->text.contains(QStringLiteral("jitter above 15 ms")));
    }

    void aFigureAboutTheLimitDoesNotChatter()
    {
        Line line;
        for (int i = 0; i < 100; ++i) {
            line.run(3s, 11ms, 0);
            line.run(3s, 8ms, 0); // below the limit, and not yet good
        }
        QVERIFY(line.alarm() != nullptr);
        QCOMPARE(line.told(), 1);
        for (int i = 0; i < 100; ++i) {
            line.run(4s, 5ms, 0); // good, and not for long enough
            line.run(200ms, 8ms, 0);
        }
        QCOMPARE(line.told(), 1);
        line.run(6s, 5ms, 0);
        QVERIFY(line.alarm() == nullptr);
        QCOMPARE(line.told(), 2);
    }

    void aSecondCauseIsRaisedAnew()
    {
        Line line;
        line.run(5s, 11ms, 0);
        QVERIFY(line.alarm() != nullptr);
        const auto first = line.alarm()->id;
        line.run(20s, 11ms, 20);
        QVERIFY(line.alarm()->id != first);
        QVERIFY2(line.alarm()->text.contains(QStringLiteral("jitter above 10 ms, more than 1 % lost")), qPrintable(line.alarm()->text));
    }

    void aLostLinkIsAlarmedAsLostAndBeginsAnew()
    {
        Line line;
        line.run(20s, 11ms, 20);
        QVERIFY(line.alarm() != nullptr);
        line.cockpit.models.sessions.setLinkState(robotId, LinkState::StandBy, line.now);
        line.watch.update(line.now, 0);
        QVERIFY(line.alarm() == nullptr);
        line.cockpit.models.sessions.setLinkState(robotId, LinkState::Open, line.now);
        line.status.heartbeatsReceived = 0;
        line.status.heartbeatsMissed = 0;
        line.run(4s, 1ms, 4);
        QVERIFY(line.alarm() == nullptr); // not enough is counted yet
    }

    /// 8 and 16: whether it is an alarm the line decides, and how urgent it is the permit.
    void aSlowLineIsMoreUrgentWhileArmed()
    {
        Line line;
        const auto priority = [&line](AlarmCondition condition) {
            const auto* alarm = line.alarm(condition);
            return alarm != nullptr ? std::optional(alarm->priority) : std::nullopt;
        };
        QVERIFY(!priority(AlarmCondition::CommandRoundTrip) && !priority(AlarmCondition::ClockUncertain));
        line.status.roundTrip = 260ms; // this profile: 250 ms there and back, clocks to within 125 ms
        line.status.clockOffset = 0ms;
        line.status.clockUncertainty = 130ms;
        line.run(3s, 1ms, 0);
        QCOMPARE(priority(AlarmCondition::CommandRoundTrip), std::optional(AlarmPriority::Low));
        QCOMPARE(priority(AlarmCondition::ClockUncertain), std::optional(AlarmPriority::Low));
        line.cockpit.arm();
        QCOMPARE(line.cockpit.models.permit.phase(), PermitPhase::Armed);
        line.run(turn, 1ms, 0);
        QCOMPARE(priority(AlarmCondition::CommandRoundTrip), std::optional(AlarmPriority::Medium));
        QCOMPARE(priority(AlarmCondition::ClockUncertain), std::optional(AlarmPriority::Medium));
    }

    void unknownJitterIsNotJudged()
    {
        LineQuality quality;
        LinkFigures figures;
        for (int i = 0; i < 1000; ++i)
            quality.note(figures, lineLimits(PictureProfile::Neuro), Instant{} + 1h + i * turn);
        QVERIFY(!quality.jittery() && !quality.lossy());
        QVERIFY(!quality.lossPercent());
    }
};

QTEST_GUILESS_MAIN(TestLineAlarm)
#include "test_line_alarm.moc"
