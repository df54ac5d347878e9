// Which burst sounds when: the highest, in its rhythm.
#include "model/sound_schedule.hpp"

#include <algorithm>

namespace console {

namespace {

const Alarm* highestSounding(const std::vector<Alarm>& alarms)
{
    const Alarm* highest = nullptr;
    for (const auto& alarm : alarms)
        if (alarm.sounds() && (highest == nullptr || alarm.priority > highest->priority))
            highest = &alarm;
    return highest;
}

quint64 newestSounding(const std::vector<Alarm>& alarms, AlarmPriority priority)
{
    quint64 newest = 0;
    for (const auto& alarm : alarms)
        if (alarm.sounds() && alarm.priority == priority)
            newest = std::max(newest, alarm.id);
    return newest;
}

} // namespace

bool SoundSchedule::demandsSound(const std::vector<Alarm>& alarms) { return highestSounding(alarms) != nullptr; }

bool SoundSchedule::acknowledge(AlarmPriority priority, const std::vector<Alarm>& alarms, Instant now)
{
    const bool tells =
        std::any_of(alarms.begin(), alarms.end(), [priority](const Alarm& alarm) { return alarm.sounds() && alarm.priority == priority; });
    if (m_current != priority || tells)
        return false;
    m_current.reset();
    m_ends = now; // it is cut short: what comes next need not wait for its end
    return true;
}

bool SoundSchedule::due(AlarmPriority priority, quint64 newest, Instant now) const
{
    if (newest > m_heard.at(std::size_t(priority)))
        return true;
    const auto repeat = burstRepeat(priority);
    return repeat && (m_current != priority || now - m_begun >= *repeat);
}

std::optional<AlarmPriority> SoundSchedule::next(const std::vector<Alarm>& alarms, bool paused, Instant now)
{
    if (paused) {
        m_current.reset();
        m_ends = now; // cut short, too
        return std::nullopt;
    }
    const Alarm* highest = highestSounding(alarms);
    if (highest == nullptr) {
        if (now >= m_ends)
            m_current.reset();
        return std::nullopt;
    }
    const auto priority = highest->priority;
    const auto newest = newestSounding(alarms, priority);
    const bool interrupts = m_current && priority > *m_current;
    if (!due(priority, newest, now) || (now < m_ends && !interrupts))
        return std::nullopt;
    m_current = priority;
    m_begun = now;
    m_ends = now + burstLength(priority);
    m_heard.at(std::size_t(priority)) = newest;
    return priority;
}

} // namespace console
