// Life, lateness and edges of a device on a cable.
#include "input/connected_master.hpp"

#include <utility>

namespace console {

MasterLife ConnectedMaster::life(Instant now) const
{
    if (!m_connected)
        return MasterLife::Gone;
    if (!m_polled || now - *m_polled > lateLimit)
        return MasterLife::Silent;
    if (!listening())
        return MasterLife::Unheard;
    return m_gate.open() ? MasterLife::Alive : MasterLife::Unreleased;
}

void ConnectedMaster::poll(Instant now)
{
    const bool late = m_polled && now - *m_polled > lateLimit;
    if (late)
        shut();
    m_polled = now;
    take(now);
    renew();
}

MasterReading ConnectedMaster::read(Instant now)
{
    if (life(now) != MasterLife::Alive)
        return {};
    return {true, m_counted.deadMan, m_counted.clutch, m_counted.motion};
}

void ConnectedMaster::rezero(Instant)
{
    m_gate.stillMotion();
    m_counted.motion = {}; // until the next poll
}

void ConnectedMaster::listeningChanged() { shut(); }

void ConnectedMaster::setConnected(bool connected)
{
    if (m_connected == connected)
        return;
    m_connected = connected;
    m_raw = {};
    const bool told = m_gate.open();
    shut();
    if (!told)
        Q_EMIT lifeChanged();
}

void ConnectedMaster::tell(const HandControls& controls)
{
    m_raw = controls;
    renew();
}

/// Life ends first, then what was held counts as let go.
void ConnectedMaster::shut()
{
    const bool was = m_gate.open();
    m_gate.close();
    if (was)
        Q_EMIT lifeChanged();
    const auto before = std::exchange(m_counted, {});
    if (before.deadMan)
        Q_EMIT deadManChanged(false);
    if (before.arm)
        Q_EMIT armHeldChanged(false);
}

void ConnectedMaster::renew()
{
    if (!m_connected || !listening())
        return;
    const bool was = m_gate.open();
    const auto before = std::exchange(m_counted, m_gate.pass(m_raw));
    const auto now = m_counted; // a receiver of the first signal may change what counts
    if (!was && m_gate.open())
        Q_EMIT lifeChanged();
    if (now.deadMan != before.deadMan)
        Q_EMIT deadManChanged(now.deadMan);
    if (now.arm != before.arm)
        Q_EMIT armHeldChanged(now.arm);
}

} // namespace console
