// Which burst sounds when, in virtual time.
#include "model/sound_schedule.hpp"

#include <QTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

constexpr auto High = AlarmPriority::High, Medium = AlarmPriority::Medium, Low = AlarmPriority::Low;

using Conditions = std::vector<std::pair<AlarmCondition, AlarmPriority>>;

/// Ten looks a second, as the console has them.
class Listener {
public:
    AlarmList list;

    void present(const Conditions& conditions, bool latching = false)
    {
        std::vector<AlarmReport> reports;
        for (const auto& [condition, priority] : conditions)
            reports.push_back({condition, 0, priority, latching, QStringLiteral("text"), QStringLiteral("Do."), 0});
        list.update(reports, m_now, 0);
    }

    void acknowledgeAll()
    {
        for (const auto& alarm : std::vector<Alarm>(list.alarms())) {
            list.acknowledge(alarm.id, 0);
            m_schedule.acknowledge(alarm.priority, list.alarms(), m_now);
        }
    }

    void pause() { list.pauseAudio(m_now); }

    /// What began within that time, as "H0 H5000": priority and milliseconds.
    QString hear(Duration time)
    {
        QStringList heard;
        for (const auto from = m_now; m_now < from + time; m_now += 100ms)
            if (const auto burst = m_schedule.next(list.alarms(), list.audioPauseLeft(m_now).has_value(), m_now))
                heard << word(*burst).left(1).toUpper() + QString::number(qint64(milliseconds(m_now - from)));
        return heard.join(QLatin1Char(' '));
    }

private:
    SoundSchedule m_schedule;
    Instant m_now = Instant{} + 1h;
};

} // namespace

class TestSoundSchedule : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void burstsHaveThePulsesOfTheirPriority()
    {
        QCOMPARE(burstOf(High).size(), std::size_t(10));
        QCOMPARE(burstOf(Medium).size(), std::size_t(3));
        QCOMPARE(burstOf(Low).size(), std::size_t(2));
        const auto high = burstOf(High);
        const auto gap = [&](std::size_t i) { return high[i].start - high[i - 1].start; };
        for (std::size_t i = 1; i < 10; ++i)
            QVERIFY(i == 5 || gap(i) < gap(5)); // two groups of five
        for (const auto priority : {High, Medium})
            QVERIFY(burstLength(priority) < *burstRepeat(priority));
    }

    void highSoundsEveryFiveSecondsAndMediumEveryTen()
    {
        Listener high;
        high.present({{AlarmCondition::ForceStop, High}});
        QCOMPARE(high.hear(16s), QStringLiteral("H0 H5000 H10000 H15000"));
        Listener medium;
        medium.present({{AlarmCondition::ForceWarn, Medium}});
        QCOMPARE(medium.hear(21s), QStringLiteral("M0 M10000 M20000"));
    }

    void lowSoundsOnceForEachAlarm()
    {
        Listener room;
        room.present({{AlarmCondition::SoftLimit, Low}});
        QCOMPARE(room.hear(60s), QStringLiteral("L0"));
        room.present({{AlarmCondition::SoftLimit, Low}, {AlarmCondition::LinkUnsteady, Low}});
        QCOMPARE(room.hear(60s), QStringLiteral("L0"));
    }

    void onlyTheHighestSounds()
    {
        Listener room;
        room.present(
            {{AlarmCondition::SystemDiffers, Medium}, {AlarmCondition::RoadmapRemoved, Low}, {AlarmCondition::EmergencyStop, High}});
        QCOMPARE(room.hear(9s), QStringLiteral("H0 H5000"));
        room.present({{AlarmCondition::SystemDiffers, Medium}, {AlarmCondition::RoadmapRemoved, Low}});
        QCOMPARE(room.hear(9s), QStringLiteral("M0"));
        room.present({{AlarmCondition::RoadmapRemoved, Low}});
        QCOMPARE(room.hear(9s), QStringLiteral("L0"));
    }

    void aHigherOneInterruptsAndALowerOneWaits()
    {
        Listener room;
        room.present({{AlarmCondition::SystemDiffers, Medium}});
        QCOMPARE(room.hear(300ms), QStringLiteral("M0"));
        room.present({{AlarmCondition::SystemDiffers, Medium}, {AlarmCondition::EmergencyStop, High}});
        QCOMPARE(room.hear(300ms), QStringLiteral("H0"));
        room.present({{AlarmCondition::SystemDiffers, Medium}});
        QCOMPARE(room.hear(5s), QStringLiteral("M2500")); // the burst of 2.74 s ends first
    }

    void aNewConditionOfThatPrioritySoundsAtOnce()
    {
        Listener room;
        room.present({{AlarmCondition::ForceStop, High}});
        QCOMPARE(room.hear(4s), QStringLiteral("H0"));
        room.present({{AlarmCondition::ForceStop, High}, {AlarmCondition::DriveFault, High}});
        QCOMPARE(room.hear(6s), QStringLiteral("H0 H5000"));
    }

    void pauseSilencesForAMinuteAndWhatStandsSoundsThen()
    {
        Listener room;
        room.present({{AlarmCondition::ForceWarn, Medium}});
        QCOMPARE(room.hear(5s), QStringLiteral("M0"));
        room.pause();
        QCOMPARE(room.hear(60s), QString());
        QCOMPARE(room.hear(11s), QStringLiteral("M0 M10000"));
    }

    void aNewHighAlarmEndsThePause()
    {
        Listener room;
        room.present({{AlarmCondition::ForceStop, High}});
        (void)room.hear(4s);
        room.pause();
        QCOMPARE(room.hear(4s), QString());
        room.present({{AlarmCondition::ForceStop, High}, {AlarmCondition::DriveFault, High}});
        QCOMPARE(room.hear(1s), QStringLiteral("H0"));
    }

    void aBurstThatWasCutShortDelaysNothing()
    {
        Listener room;
        room.present({{AlarmCondition::ForceStop, High}});
        (void)room.hear(300ms);
        room.pause();
        QCOMPARE(room.hear(300ms), QString());
        room.present({{AlarmCondition::ForceStop, High}, {AlarmCondition::DriveFault, High}});
        QCOMPARE(room.hear(1s), QStringLiteral("H0"));
        room.acknowledgeAll();
        QCOMPARE(room.hear(300ms), QString());
        room.present({{AlarmCondition::LinkLost, High}});
        QCOMPARE(room.hear(1s), QStringLiteral("H0"));
    }

    /// What comes next waits for its end, unless it is more urgent.
    void aBurstOfWhatEndedByItselfIsHeardWhole()
    {
        Listener room;
        room.present({{AlarmCondition::LinkLost, High}});
        QCOMPARE(room.hear(300ms), QStringLiteral("H0"));
        room.present({});
        QVERIFY(!SoundSchedule::demandsSound(room.list.alarms()));
        QCOMPARE(room.hear(300ms), QString());
        room.present({{AlarmCondition::SystemDiffers, Medium}});
        QCOMPARE(room.hear(4s), QStringLiteral("M2200"));
        room.present({});
        QCOMPARE(room.hear(10s), QString());
        room.present({{AlarmCondition::SystemDiffers, Medium}});
        QCOMPARE(room.hear(100ms), QStringLiteral("M0"));
        room.present({});
        QCOMPARE(room.hear(100ms), QString());
        room.present({{AlarmCondition::LinkLost, High}});
        QCOMPARE(room.hear(100ms), QStringLiteral("H0"));
    }

    void acknowledgedIsSilentUntilItEndsAndReturns()
    {
        Listener room;
        room.present({{AlarmCondition::EmergencyStop, High}});
        (void)room.hear(3s);
        room.acknowledgeAll();
        QCOMPARE(room.hear(30s), QString());
        room.present({});
        QCOMPARE(room.hear(1s), QString());
        room.present({{AlarmCondition::EmergencyStop, High}});
        QCOMPARE(room.hear(1s), QStringLiteral("H0"));
    }

    /// One alarm in the list, so one rhythm; and nothing is cut short.
    void whatTremblesAtItsLimitSoundsInItsRhythm()
    {
        Listener room;
        QStringList heard;
        for (int tenth = 0; tenth < 201; ++tenth) {
            room.present(tenth % 2 == 0 ? Conditions{{AlarmCondition::ForceWarn, Medium}} : Conditions{});
            QVERIFY(SoundSchedule::demandsSound(room.list.alarms()));
            if (!room.hear(100ms).isEmpty())
                heard << QString::number(tenth);
        }
        QCOMPARE(heard.join(QLatin1Char(' ')), QStringLiteral("0 100 200"));
    }

    void whatEndedLatchedIsSilent()
    {
        Listener room;
        room.present({{AlarmCondition::LinkLost, High}}, true);
        (void)room.hear(3s);
        room.present({});
        QVERIFY(room.list.unacknowledgedHigh());
        QVERIFY(!SoundSchedule::demandsSound(room.list.alarms()));
        QCOMPARE(room.hear(30s), QString());
    }
};

QTEST_GUILESS_MAIN(TestSoundSchedule)
#include "test_sound_schedule.moc"
