// Everything about alarms that is not on the screen: their sound, their log on the disk, the self-test's time, and the watchdog.
#pragma once

#include "app/alarm_journal.hpp"
#include "app/alarm_sounder.hpp"
#include "app/alarm_watch.hpp"
#include "app/watchdog_process.hpp"
#include "sound/loudspeaker.hpp"

#include <QTimer>

#include <memory>

namespace console {

struct AlarmSettings {
    QString logFolder; ///< empty: alarms are not kept, and an alarm says so
    QString logName;
    QString watchdog;            ///< program; empty: nobody watches, and an alarm says so
    QString player{};            ///< program that sounds them; empty: none, and an alarm says so
    AlarmVoice* voice = nullptr; ///< sounds in place of the loudspeaker, for measurements; outlives the service
};

/// A person relies on what this console sounds: a hang must not be silent then. With a high alarm that nobody acknowledged, since the
/// hang would end its sound; in hold, and wherever the robot has not confirmed a hold or a stop yet, since that may turn out to be an
/// alarm; and from the request to arm on, since the robot may be armed before its answer is read.
bool attended(const PermitState& permit, bool unacknowledgedHigh, bool holdAwaited);

/// GUI thread only. What of it fails is itself an alarm, and stops nothing.
class AlarmService : public QObject {
    Q_OBJECT
public:
    AlarmService(ConsoleModels& models, AlarmWatch& watch, const AlarmSettings& settings, QObject* parent = nullptr);

    void start();

    // A person's wishes; `who` is for the log.
    void acknowledge(quint64 alarm, const QString& who);
    void toggleAudioPause(const QString& who); ///< no pause while soundStaysFor() bars it; the event log says so
    void markIncident(const QString& who);     ///< this moment, and how things stand, in the alarm log and the event log
    void beginSelfTest(); ///< nothing while a high alarm stands: its sound is not to be taken for the test's, nor cut short
    void answerSelfTest(bool seenAndHeard, const QString& who);
    void noteClosed(const QString& who); ///< the console ends, as somebody wished

private:
    void openJournal(const AlarmSettings& settings);
    void noteRecorder(const QString& trouble, bool kept);
    void listen(const AlarmSettings& settings);
    void tell(const QString& trouble, const QString& good);
    void noteWatchdog();
    void run();

    ConsoleModels& m_models;
    AlarmWatch& m_watch;
    std::unique_ptr<Loudspeaker> m_loudspeaker; ///< none when another voice was given
    AlarmVoice& m_voice;
    AlarmSounder m_sounder;
    std::unique_ptr<AlarmJournal> m_journal;
    std::unique_ptr<WatchdogProcess> m_watchdog;
    QString m_soundTrouble;
    QString m_watchdogTrouble;
    bool m_watchdogSilent = false;
    QTimer m_timer;
};

} // namespace console
