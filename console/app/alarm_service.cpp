// Sound, log, self-test and watchdog of the alarms.
#include "app/alarm_service.hpp"

#include "model/present_readings.hpp"

#include <QDateTime>

namespace console {

namespace {

constexpr std::chrono::milliseconds period{50};

qint64 wallTime() { return QDateTime::currentMSecsSinceEpoch(); }

/// `ENGAGED, picture LIVE, AGE 98 ms, force 0.12 N`.
QString howThingsStand(const ConsoleModels& models, Instant now)
{
    const PictureReading picture = models.picture.reading(now);
    const auto& robot = models.instrument.robot();
    const bool fresh = robot.freshness(now, InstrumentState::statusLimit) == Freshness::Fresh;
    const QString age =
        picture.age ? AlarmService::tr("AGE %1 ms").arg(milliseconds(*picture.age), 0, 'f', 0) : AlarmService::tr("AGE unknown");
    const QString force =
        fresh ? AlarmService::tr("force %1 N").arg(robot.value.guidewireForce, 0, 'f', 2) : AlarmService::tr("force unknown");
    return QStringList{word(models.permit.phase()), AlarmService::tr("picture %1").arg(word(picture.condition)), age, force}.join(
        AlarmService::tr(", "));
}

QString named(const QString& who) { return who.isEmpty() ? AlarmService::tr("the operator") : who; }

} // namespace

bool attended(const PermitState& permit, bool unacknowledgedHigh, bool holdAwaited)
{
    if (holdAwaited)
        return true;
    switch (permit.phase) {
    case PermitPhase::Armed:
    case PermitPhase::Engaged:
    case PermitPhase::Hold:
        return true;
    case PermitPhase::Arming:
        return permit.awaitingRobot || unacknowledgedHigh;
    case PermitPhase::Off:
    case PermitPhase::Standby:
    case PermitPhase::Ready:
    case PermitPhase::Incident:
    case PermitPhase::Verifying:
        break;
    }
    return unacknowledgedHigh;
}

AlarmService::AlarmService(ConsoleModels& models, AlarmWatch& watch, const AlarmSettings& settings, QObject* parent)
    : QObject(parent),
      m_models(models),
      m_watch(watch),
      m_loudspeaker(settings.voice != nullptr ? nullptr : std::make_unique<Loudspeaker>(settings.player)),
      m_voice(settings.voice != nullptr ? *settings.voice : *m_loudspeaker),
      m_sounder(models, m_voice)
{
    openJournal(settings);
    listen(settings);
    m_timer.setTimerType(Qt::PreciseTimer);
    m_timer.setInterval(period);
    connect(&m_timer, &QTimer::timeout, this, &AlarmService::run);
    connect(&models.permit, &PermitModel::phaseChanged, this,
            [this](PermitPhase, PermitPhase to) { m_models.selfTest.follow(to, std::chrono::steady_clock::now()); });
}

void AlarmService::openJournal(const AlarmSettings& settings)
{
    if (settings.logFolder.isEmpty())
        return noteRecorder(tr("alarms are not kept, no folder was named"), false);
    m_journal = std::make_unique<AlarmJournal>(settings.logFolder, settings.logName);
    m_models.alarms.restoreLog(m_journal->restored());
    noteRecorder(m_journal->trouble(), m_journal->keeps());
    connect(m_journal.get(), &AlarmJournal::troubleChanged, this,
            [this](const QString& trouble) { noteRecorder(trouble, m_journal->keeps()); });
    connect(&m_models.alarms, &AlarmList::logged, m_journal.get(), &AlarmJournal::append);
    m_models.log.append(LogKind::Note, tr("alarm log: %1").arg(m_journal->fileName()), wallTime());
    if (!m_journal->remark().isEmpty())
        m_models.log.append(LogKind::Trouble, m_journal->remark().trimmed(), wallTime());
    m_models.alarms.note(wallTime(), tr("console started. %1").arg(m_journal->remark()).trimmed());
}

void AlarmService::noteRecorder(const QString& trouble, bool kept)
{
    m_models.recorder.logTrouble = trouble;
    m_models.recorder.logKept = kept;
}

void AlarmService::listen(const AlarmSettings& settings)
{
    connect(&m_voice, &AlarmVoice::troubleChanged, this, [this](const QString& trouble) {
        m_soundTrouble = trouble;
        m_watch.setSoundTrouble(trouble);
        tell(trouble, tr("alarm sound is there"));
        noteWatchdog();
    });
    if (settings.watchdog.isEmpty())
        return m_watch.setWatchdogTrouble(tr("no watchdog was named"));
    m_watchdog = std::make_unique<WatchdogProcess>(settings.watchdog);
    connect(m_watchdog.get(), &WatchdogProcess::troubleChanged, this, [this](const QString& trouble) {
        m_watchdogTrouble = trouble;
        tell(trouble, tr("the watchdog watches"));
        noteWatchdog();
    });
    connect(m_watchdog.get(), &WatchdogProcess::silentChanged, this, [this](bool silent) {
        m_watchdogSilent = silent;
        tell(silent ? tr("its watchdog has no sound") : QString(), tr("the watchdog has sound"));
        noteWatchdog();
    });
}

void AlarmService::tell(const QString& trouble, const QString& good)
{
    m_models.log.append(trouble.isEmpty() ? LogKind::Note : LogKind::Trouble, trouble.isEmpty() ? good : trouble, wallTime());
}

/// Where this console has no sound either, that is one cause, and told already.
void AlarmService::noteWatchdog()
{
    const bool alone = m_watchdogSilent && m_soundTrouble.isEmpty();
    m_watch.setWatchdogTrouble(m_watchdogTrouble.isEmpty() && alone ? tr("its watchdog has no sound") : m_watchdogTrouble);
}

void AlarmService::start()
{
    if (m_loudspeaker)
        m_loudspeaker->start();
    m_timer.start();
}

void AlarmService::run()
{
    const auto now = std::chrono::steady_clock::now();
    const bool high = m_models.alarms.unacknowledgedHigh();
    if (m_watchdog)
        m_watchdog->beat(attended(m_models.permit.state(), high, m_watch.holdAwaited() || m_models.instrument.stopUnheard()), now);
    m_models.selfTest.update(high, now);
    m_sounder.update(now);
}

void AlarmService::acknowledge(quint64 alarm, const QString& who) { m_models.alarms.acknowledge(alarm, wallTime(), who); }

void AlarmService::toggleAudioPause(const QString& who)
{
    const auto now = std::chrono::steady_clock::now();
    if (m_models.alarms.audioPauseLeft(now))
        return m_models.alarms.resumeAudio(now, wallTime());
    if (soundStaysFor(m_models, now))
        return m_models.log.append(
            LogKind::Operator,
            tr("audio not paused again: armed, and the sound is back for less than %1 s").arg(AlarmList::leastAudible.count()), wallTime());
    m_models.alarms.pauseAudio(now, wallTime(), who);
}

void AlarmService::markIncident(const QString& who)
{
    const auto text = tr("incident marked by %1: %2").arg(named(who), howThingsStand(m_models, std::chrono::steady_clock::now()));
    m_models.alarms.note(wallTime(), text);
    m_models.log.append(LogKind::Operator, text, wallTime());
}

void AlarmService::beginSelfTest()
{
    if (!m_models.alarms.unacknowledgedHigh())
        m_models.selfTest.begin(std::chrono::steady_clock::now());
}

void AlarmService::answerSelfTest(bool seenAndHeard, const QString& who)
{
    if (seenAndHeard)
        m_models.selfTest.confirm();
    else
        m_models.selfTest.refuse();
    m_models.alarms.note(
        wallTime(),
        (m_models.selfTest.passed() ? tr("alarm self-test confirmed by %1") : tr("alarm self-test not confirmed, by %1")).arg(named(who)));
}

void AlarmService::noteClosed(const QString& who) { m_models.alarms.note(wallTime(), tr("console closed by %1").arg(named(who))); }

} // namespace console
