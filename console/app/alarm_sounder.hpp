// Gives the alarms their sound, and the self-test the same.
#pragma once

#include "model/console_models.hpp"
#include "model/sound_schedule.hpp"
#include "sound/alarm_voice.hpp"

#include <QObject>

namespace console {

/// GUI thread only. Both must outlive it.
class AlarmSounder : public QObject {
    Q_OBJECT
public:
    AlarmSounder(ConsoleModels& models, AlarmVoice& voice, QObject* parent = nullptr);

    /// Ten times a second, and with every change of the alarms.
    void update(Instant now);

private:
    void testSound();
    void acknowledge(AlarmPriority priority);
    void silence();

    ConsoleModels& m_models;
    AlarmVoice& m_voice;
    SoundSchedule m_schedule;
    bool m_sounding = false;
    bool m_testSounds = false; ///< what was played last is the self-test's
};

} // namespace console
