// Alarm conditions: raised, latched, acknowledged, logged.
#include "model/alarm_list.hpp"

#include <QCoreApplication>

#include <algorithm>
#include <tuple>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::AlarmList)
};

/// Whether something has been so for that long without a gap; `since` remembers from when on.
bool lasts(bool isSo, std::optional<Instant>& since, Duration time, Instant now)
{
    if (!isSo) {
        since.reset();
        return false;
    }
    if (!since)
        since = now;
    return now - *since >= time;
}

bool isAbout(const Alarm& alarm, const AlarmReport& report)
{
    return report.condition == alarm.condition && report.subject == alarm.subject && report.other == alarm.other;
}

} // namespace

Duration endDelay(AlarmCondition condition)
{
    switch (condition) {
    case AlarmCondition::LinkLost: // events: a device, a person or this program ends it
    case AlarmCondition::HoldNotConfirmed:
    case AlarmCondition::ImageLost:
    case AlarmCondition::EmergencyStop:
    case AlarmCondition::StopUnheard:
    case AlarmCondition::RoadmapRemoved:
    case AlarmCondition::AirKerma:
    case AlarmCondition::FluoroscopyTime:
    case AlarmCondition::SystemDiffers:
    case AlarmCondition::SoundFailed:
    case AlarmCondition::WatchdogGone:
    case AlarmCondition::PictureSlow: // these wait for some seconds of a good line already
    case AlarmCondition::LinkUnsteady:
    case AlarmCondition::PacketsLost:
        return Duration::zero();
    case AlarmCondition::PictureStale:
    case AlarmCondition::PictureReduced:
    case AlarmCondition::ForceStop:
    case AlarmCondition::ForceWarn:
    case AlarmCondition::DriveFault:
    case AlarmCondition::DeadlineMissed:
    case AlarmCondition::ClockUncertain:
    case AlarmCondition::SoftLimit:
    case AlarmCondition::HardLimit:
    case AlarmCondition::CommandRoundTrip:
    case AlarmCondition::TrackerStale:
    case AlarmCondition::ContrastLow:
    case AlarmCondition::ContrastEmpty:
    case AlarmCondition::PaintingBehind:
    case AlarmCondition::RecorderStopped:
        break;
    }
    return AlarmList::longestEndDelay;
}

AlarmList::AlarmList(QObject* parent) : QObject(parent) {}

int AlarmList::count(AlarmPriority priority) const
{
    return static_cast<int>(
        std::count_if(m_alarms.begin(), m_alarms.end(), [priority](const Alarm& alarm) { return alarm.priority == priority; }));
}

bool AlarmList::unacknowledgedHigh() const
{
    return std::any_of(m_alarms.begin(), m_alarms.end(),
                       [](const Alarm& alarm) { return alarm.priority == AlarmPriority::High && !alarm.acknowledged; });
}

bool AlarmList::stands(AlarmCondition condition) const
{
    return std::any_of(m_alarms.begin(), m_alarms.end(),
                       [condition](const Alarm& alarm) { return alarm.condition == condition && alarm.present; });
}

void AlarmList::update(const std::vector<AlarmReport>& present, Instant now, qint64 wallMs)
{
    const auto before = m_alarms.size();
    bool different = false;
    for (auto& alarm : m_alarms) {
        const bool missing =
            std::none_of(present.begin(), present.end(), [&alarm](const AlarmReport& report) { return isAbout(alarm, report); });
        if (lasts(missing, alarm.missingSince, endDelay(alarm.condition), now) && alarm.present) {
            alarm.present = false;
            alarm.endedWallMs = wallMs;
            different = true;
            write(wallMs, alarm.priority, Text::tr("ended: %1").arg(alarm.text), now);
        }
    }
    std::erase_if(m_alarms, [](const Alarm& alarm) { return !alarm.present && (!alarm.latching || alarm.acknowledged); });
    for (const auto& report : present)
        different = raise(report, now, wallMs) || different;
    if (!different && before == m_alarms.size())
        return;
    sort();
    Q_EMIT changed();
}

bool AlarmList::raise(const AlarmReport& report, Instant now, qint64 wallMs)
{
    const auto known = std::find_if(m_alarms.begin(), m_alarms.end(), [&report](const Alarm& alarm) { return isAbout(alarm, report); });
    const bool stands = known != m_alarms.end() && known->present && report.priority <= known->priority && report.step <= known->step &&
                        (report.causes & ~known->causes) == 0;
    if (stands) {
        const bool lessUrgent = known->acknowledged && report.priority < known->priority;
        const bool lesser = lessUrgent || report.causes != known->causes;
        const bool differs = known->text != report.text;
        known->text = report.text;
        known->remedy = report.remedy;
        if (!lasts(lesser, known->lesserSince, endDelay(report.condition), now))
            return differs;
        // What it falls back to now it can rise from, and is raised anew then.
        known->causes = report.causes;
        if (lessUrgent)
            known->priority = report.priority;
        known->lesserSince.reset();
        return differs || lessUrgent;
    }
    // One that ended latched, or that rose, demands attention anew. Causes that were there a moment ago are no news when they come back.
    quint64 causes = report.causes;
    if (known != m_alarms.end()) {
        causes |= known->present ? known->causes : 0;
        m_alarms.erase(known);
    }
    m_alarms.push_back({m_nextId++,
                        report.condition,
                        report.subject,
                        report.priority,
                        report.text,
                        report.remedy,
                        now,
                        wallMs,
                        true,
                        report.latching,
                        false,
                        report.step,
                        causes,
                        {},
                        {},
                        report.other});
    ++m_raised;
    if (report.priority == AlarmPriority::High)
        endPause(now);
    write(wallMs, report.priority, Text::tr("raised: %1").arg(report.text), now);
    Q_EMIT raised(m_alarms.back().id);
    return true;
}

void AlarmList::acknowledge(quint64 id, qint64 wallMs, const QString& who, Instant now)
{
    const auto place = std::find_if(m_alarms.begin(), m_alarms.end(), [id](const Alarm& alarm) { return alarm.id == id; });
    if (place == m_alarms.end() || place->acknowledged)
        return;
    place->acknowledged = true;
    write(wallMs, place->priority,
          who.isEmpty() ? Text::tr("acknowledged: %1").arg(place->text) : Text::tr("acknowledged by %1: %2").arg(who, place->text), now);
    const auto priority = place->priority;
    if (!place->present)
        m_alarms.erase(place);
    sort();
    Q_EMIT acknowledged(priority);
    Q_EMIT changed();
}

void AlarmList::pauseAudio(Instant now, qint64 wallMs, const QString& who)
{
    m_audioPausedUntil = now + m_audioPause;
    m_audibleSince = m_audioPausedUntil;
    note(wallMs, who.isEmpty() ? Text::tr("audio paused") : Text::tr("audio paused by %1").arg(who), now);
    Q_EMIT changed();
}

void AlarmList::resumeAudio(Instant now, qint64 wallMs)
{
    endPause(now);
    note(wallMs, Text::tr("audio pause ended"), now);
    Q_EMIT changed();
}

void AlarmList::endPause(Instant now)
{
    if (audioPauseLeft(now))
        m_audibleSince = now;
    m_audioPausedUntil.reset();
}

void AlarmList::restoreLog(const std::vector<AlarmLogEntry>& entries)
{
    m_log.insert(m_log.begin(), entries.begin(), entries.end());
    while (m_log.size() > logLimit)
        m_log.pop_front();
    Q_EMIT logRestored();
}

std::optional<Duration> AlarmList::audioPauseLeft(Instant now) const
{
    if (!m_audioPausedUntil || now >= *m_audioPausedUntil)
        return std::nullopt;
    return *m_audioPausedUntil - now;
}

Duration AlarmList::audibleForLongIn(Instant now) const
{
    return m_audibleSince ? std::max(Duration::zero(), Duration(*m_audibleSince + leastAudible - now)) : Duration::zero();
}

void AlarmList::write(qint64 wallMs, AlarmPriority priority, const QString& text, Instant now)
{
    m_log.push_back({wallMs, priority, text, now});
    while (m_log.size() > logLimit)
        m_log.pop_front();
    Q_EMIT logged(m_log.back());
}

void AlarmList::sort()
{
    std::stable_sort(m_alarms.begin(), m_alarms.end(), [](const Alarm& a, const Alarm& b) {
        return std::tuple(b.priority, b.present, a.acknowledged, b.raised) < std::tuple(a.priority, a.present, b.acknowledged, a.raised);
    });
}

} // namespace console
