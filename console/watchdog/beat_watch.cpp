// Whether the console still runs.
#include "watchdog/beat_watch.hpp"

namespace console {

void BeatWatch::take(char beat, Instant now)
{
    if (m_state == State::Died || m_state == State::Over)
        return;
    m_lastBeat = now;
    m_attended = beat == static_cast<char>(Beat::Attended);
    m_state = beat == static_cast<char>(Beat::Goodbye) ? State::Over : State::Watching;
}

void BeatWatch::noteEnd(Instant now)
{
    if (m_state == State::Died || m_state == State::Over)
        return;
    m_state = m_attended ? State::Died : State::Over;
    m_died = now;
}

BeatWatch::State BeatWatch::look(Instant now)
{
    if (m_state == State::Watching && m_attended && silence(now) > patience)
        m_state = State::Hung;
    if (m_state == State::Died && now - m_died >= m_mourning)
        m_state = State::Over;
    return m_state;
}

} // namespace console
