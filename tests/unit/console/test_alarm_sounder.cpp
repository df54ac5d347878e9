// Alarms and self-test, heard through an invented voice.
#include "app/alarm_sounder.hpp"

#include <QTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

class InventedVoice : public AlarmVoice {
public:
    void play(AlarmPriority priority) override { heard << word(priority); }
    void silence() override { heard << QStringLiteral("silence"); }

    QStringList heard;
};

AlarmReport report(AlarmCondition condition, AlarmPriority priority)
{
    return {condition, 0, priority, false, QStringLiteral("text"), QStringLiteral("Do."), 0};
}

} // namespace

class TestAlarmSounder : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void soundsWhenTheAlarmIsRaisedAndNotATickLater()
    {
        ConsoleModels models;
        InventedVoice voice;
        const AlarmSounder sounder(models, voice);
        models.alarms.update({report(AlarmCondition::ForceStop, AlarmPriority::High)}, Instant{} + 1h, 0);
        QCOMPARE(voice.heard, QStringList{QStringLiteral("high")});
    }

    void acknowledgingSilencesTheBurst()
    {
        ConsoleModels models;
        InventedVoice voice;
        const AlarmSounder sounder(models, voice);
        models.alarms.update({report(AlarmCondition::ForceStop, AlarmPriority::High)}, Instant{} + 1h, 0);
        models.alarms.acknowledge(models.alarms.highest()->id, 0);
        QCOMPARE(voice.heard.back(), QStringLiteral("silence"));
    }

    /// Of an event that is over at once enough is heard to know it by.
    void whatEndsByItselfIsHeardToTheEndOfItsBurst()
    {
        ConsoleModels models;
        InventedVoice voice;
        AlarmSounder sounder(models, voice);
        models.alarms.update({report(AlarmCondition::LinkLost, AlarmPriority::High)}, Instant{} + 1h, 0);
        models.alarms.update({}, Instant{} + 1h + 60ms, 0);
        sounder.update(std::chrono::steady_clock::now());
        QCOMPARE(voice.heard, QStringList{QStringLiteral("high")});
    }

    void acknowledgingAnotherPrioritySilencesNothing()
    {
        ConsoleModels models;
        InventedVoice voice;
        const AlarmSounder sounder(models, voice);
        models.alarms.update(
            {report(AlarmCondition::ForceStop, AlarmPriority::High), report(AlarmCondition::SoftLimit, AlarmPriority::Low)}, Instant{} + 1h,
            0);
        models.alarms.acknowledge(models.alarms.alarms().back().id, 0);
        QCOMPARE(voice.heard, QStringList{QStringLiteral("high")});
    }

    void pauseSilencesTheBurst()
    {
        ConsoleModels models;
        InventedVoice voice;
        const AlarmSounder sounder(models, voice);
        models.alarms.update({report(AlarmCondition::ForceWarn, AlarmPriority::Medium)}, Instant{} + 1h, 0);
        models.alarms.pauseAudio(std::chrono::steady_clock::now());
        QCOMPARE(voice.heard, (QStringList{QStringLiteral("medium"), QStringLiteral("silence")}));
    }

    void selfTestSoundsEachBurst()
    {
        ConsoleModels models;
        InventedVoice voice;
        const AlarmSounder sounder(models, voice);
        auto now = Instant{} + 1h;
        models.selfTest.begin(now);
        for (int i = 0; i < 70; ++i)
            models.selfTest.update(false, now += 100ms);
        QCOMPARE(voice.heard,
                 (QStringList{QStringLiteral("high"), QStringLiteral("medium"), QStringLiteral("low"), QStringLiteral("silence")}));
    }

    void anUnansweredSelfTestSilencesNothing()
    {
        ConsoleModels models;
        InventedVoice voice;
        const AlarmSounder sounder(models, voice);
        auto now = Instant{} + 1h;
        models.selfTest.begin(now);
        for (int i = 0; i < 70; ++i)
            models.selfTest.update(false, now += 100ms);
        voice.heard.clear();
        models.alarms.update({report(AlarmCondition::ForceWarn, AlarmPriority::Medium)}, now, 0);
        QCOMPARE(voice.heard, QStringList{QStringLiteral("medium")});
    }

    void aHighAlarmBeforeTheAnswerIsNotCutShort()
    {
        ConsoleModels models;
        InventedVoice voice;
        const AlarmSounder sounder(models, voice);
        auto now = Instant{} + 1h;
        models.selfTest.begin(now);
        for (int i = 0; i < 70; ++i)
            models.selfTest.update(false, now += 100ms);
        voice.heard.clear();
        models.alarms.update({report(AlarmCondition::ForceStop, AlarmPriority::High)}, now, 0);
        models.selfTest.update(models.alarms.unacknowledgedHigh(), now += 50ms);
        QCOMPARE(models.selfTest.step(), AlarmSelfTest::Step::NotDone);
        QCOMPARE(voice.heard, QStringList{QStringLiteral("high")});
    }

    void aHighAlarmDuringTheSelfTestSounds()
    {
        ConsoleModels models;
        InventedVoice voice;
        AlarmSounder sounder(models, voice);
        auto now = Instant{} + 1h;
        models.selfTest.begin(now);
        models.alarms.update({report(AlarmCondition::ForceStop, AlarmPriority::High)}, now, 0);
        models.selfTest.update(models.alarms.unacknowledgedHigh(), now);
        voice.heard.clear();
        sounder.update(now + 100ms);
        QCOMPARE(voice.heard, QStringList{QStringLiteral("high")});
    }
};

QTEST_GUILESS_MAIN(TestAlarmSounder)
#include "test_alarm_sounder.moc"
