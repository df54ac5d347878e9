// Bookkeeping of life signs.
#include "session/heartbeat_monitor.hpp"

#include <algorithm>

namespace liena::session {

void HeartbeatMonitor::start(Instant now)
{
    m_lastHeard = now;
    m_lastLaneZero = now;
    m_unwellSince.reset();
    m_onTimeRun = 0;
    m_lastHeartbeat.reset();
}

void HeartbeatMonitor::heard(Instant now, LifePath path)
{
    m_lastHeard = std::max(m_lastHeard, now);
    if (path == LifePath::LaneZero)
        m_lastLaneZero = std::max(m_lastLaneZero, now);
    else if (path == LifePath::Packet) {
        m_packets[m_nextPacket] = now;
        m_nextPacket = (m_nextPacket + 1) % m_packets.size();
    }
}

std::uint8_t HeartbeatMonitor::packetsHeard(Instant now) const
{
    const auto since = std::max(now - 8 * m_timing.heartbeat, Instant{});
    std::uint8_t count = 0;
    // From the newest on: those that count are few, and the others are asked of every session many times a second.
    for (auto place = m_nextPacket; count < m_packets.size(); ++count) {
        place = (place == 0 ? m_packets.size() : place) - 1;
        if (m_packets[place] <= since)
            break;
    }
    return count;
}

void HeartbeatMonitor::heartbeat(Instant now, std::uint32_t sequence, SessionState peerState)
{
    m_peerState = peerState;
    if (carriesMessages(peerState))
        m_unwellSince.reset();
    else if (!m_unwellSince)
        m_unwellSince = now;

    // On time: not later than the next one was due, and none left out.
    const bool follows = sequence == m_lastSequence + 1;
    const bool onTime = m_lastHeartbeat && follows && now - *m_lastHeartbeat < 2 * m_timing.heartbeat;
    m_onTimeRun = onTime ? m_onTimeRun + 1 : 0;
    if (m_lastSequence != 0 && sequence > m_lastSequence + 1)
        m_missed += sequence - m_lastSequence - 1;
    m_lastSequence = sequence;
    m_lastHeartbeat = now;
    ++m_received;

    m_recent.push_back(now);
    while (m_recent.front() + std::chrono::seconds(1) < now)
        m_recent.pop_front();
}

Instant HeartbeatMonitor::nextChange(bool suspectAlready) const
{
    auto next = std::min(m_lastHeard + (suspectAlready ? m_timing.lost - reaction : m_timing.suspect), m_lastLaneZero + m_timing.reconnect);
    if (m_unwellSince)
        next = std::min(next, *m_unwellSince + m_timing.reconnect);
    return next;
}

std::uint64_t HeartbeatMonitor::receivedInLastSecond(Instant now) const
{
    return static_cast<std::uint64_t>(
        std::count_if(m_recent.begin(), m_recent.end(), [&](Instant at) { return at + std::chrono::seconds(1) >= now; }));
}

} // namespace liena::session
