// From alarms to bursts.
#include "app/alarm_sounder.hpp"

#include <chrono>

namespace console {

AlarmSounder::AlarmSounder(ConsoleModels& models, AlarmVoice& voice, QObject* parent) : QObject(parent), m_models(models), m_voice(voice)
{
    connect(&models.alarms, &AlarmList::changed, this, [this] { update(std::chrono::steady_clock::now()); });
    connect(&models.alarms, &AlarmList::acknowledged, this, &AlarmSounder::acknowledge);
    connect(&models.selfTest, &AlarmSelfTest::changed, this, &AlarmSounder::testSound);
}

void AlarmSounder::testSound()
{
    const auto signal = m_models.selfTest.signal();
    if (signal)
        m_voice.play(*signal);
    else if (m_testSounds) // an alarm that sounds meanwhile goes on
        m_voice.silence();
    else
        return;
    m_testSounds = signal.has_value();
    m_sounding = m_testSounds;
}

void AlarmSounder::update(Instant now)
{
    // A few seconds: a high alarm ends the test, and while it only waits for its answer alarms sound as ever.
    if (m_models.selfTest.signal())
        return;
    const auto& alarms = m_models.alarms.alarms();
    const bool paused = m_models.alarms.audioPauseLeft(now).has_value();
    if (const auto burst = m_schedule.next(alarms, paused, now)) {
        m_voice.play(*burst);
        m_sounding = true;
        m_testSounds = false;
    } else if (m_sounding && paused) {
        silence();
    }
}

/// While a self-test sounds, that is what is heard.
void AlarmSounder::acknowledge(AlarmPriority priority)
{
    const bool over = m_schedule.acknowledge(priority, m_models.alarms.alarms(), std::chrono::steady_clock::now());
    if (over && m_sounding && !m_testSounds)
        silence();
}

void AlarmSounder::silence()
{
    m_voice.silence();
    m_sounding = false;
}

} // namespace console
