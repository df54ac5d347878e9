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

} // namespace

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
        const bool still = std::any_of(present.begin(), present.end(), [&alarm](const AlarmReport& report) {
            return report.condition == alarm.condition && report.subject == alarm.subject;
        });
        if (alarm.present && !still) {
            alarm.present = false;
            different = true;
            write(wallMs, alarm.priority, Text::tr("ended: %1").arg(alarm.text));
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
    const auto known = std::find_if(m_alarms.begin(), m_alarms.end(), [&report](const Alarm& alarm) {
        return report.condition == alarm.condition && report.subject == alarm.subject;
    });
    const bool stands = known != m_alarms.end() && known->present && report.priority <= known->priority && report.step <= known->step &&
                        (report.causes & ~known->causes) == 0;
    if (stands) {
        const auto lessUrgent = known->acknowledged && report.priority < known->priority; // if it rises again, it is raised anew
        const bool differs = lessUrgent || known->text != report.text;
        if (lessUrgent)
            known->priority = report.priority;
        known->text = report.text;
        known->remedy = report.remedy;
        known->causes = report.causes;
        return differs;
    }
    // One that ended latched, or that rose, demands attention anew.
    if (known != m_alarms.end())
        m_alarms.erase(known);
    m_alarms.push_back({m_nextId++, report.condition, report.subject, report.priority, report.text, report.remedy, now, wallMs, true,
                        report.latching, false, report.step, report.causes});
    ++m_raised;
    if (report.priority == AlarmPriority::High)
        m_audioPausedUntil.reset();
    write(wallMs, report.priority, Text::tr("raised: %1").arg(report.text));
    Q_EMIT raised(m_alarms.back().id);
    return true;
}

void AlarmList::acknowledge(quint64 id, qint64 wallMs, const QString& who)
{
    const auto place = std::find_if(m_alarms.begin(), m_alarms.end(), [id](const Alarm& alarm) { return alarm.id == id; });
    if (place == m_alarms.end() || place->acknowledged)
        return;
    place->acknowledged = true;
    write(wallMs, place->priority,
          who.isEmpty() ? Text::tr("acknowledged: %1").arg(place->text) : Text::tr("acknowledged by %1: %2").arg(who, place->text));
    if (!place->present)
        m_alarms.erase(place);
    sort();
    Q_EMIT changed();
}

void AlarmList::pauseAudio(Instant now, qint64 wallMs, const QString& who)
{
    m_audioPausedUntil = now + m_audioPause;
    note(wallMs, who.isEmpty() ? Text::tr("audio paused") : Text::tr("audio paused by %1").arg(who));
    Q_EMIT changed();
}

void AlarmList::resumeAudio(qint64 wallMs)
{
    m_audioPausedUntil.reset();
    note(wallMs, Text::tr("audio pause ended"));
    Q_EMIT changed();
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

void AlarmList::write(qint64 wallMs, AlarmPriority priority, const QString& text)
{
    m_log.push_back({wallMs, priority, text});
    while (m_log.size() > logLimit)
        m_log.pop_front();
    Q_EMIT logged(m_log.back());
}

void AlarmList::sort()
{
    std::stable_sort(m_alarms.begin(), m_alarms.end(), [](const Alarm& a, const Alarm& b) {
        return std::tuple(b.priority, a.acknowledged, b.raised) < std::tuple(a.priority, b.acknowledged, a.raised);
    });
}

} // namespace console
