// What the peer's datagrams say about its life: silences, heartbeats on time, the state it reports (protocol section 8, Liveness).
#pragma once

#include "liena/session_state.hpp"
#include "liena/system_topology.hpp"
#include "session/instant.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace liena::session {

/// Where a datagram of the peer came.
enum class LifePath : std::uint8_t { LaneZero, BulkLane, Packet };

/// Pure: it is told what arrives and when, and answers how things stand.
class HeartbeatMonitor {
public:
    explicit HeartbeatMonitor(const LinkTiming& timing) : m_timing(timing) {}

    /// Counting begins: the session is Open from now.
    void start(Instant now);

    /// Any valid datagram of the peer.
    void heard(Instant now, LifePath path);

    /// A heartbeat with its sequence and the state that the peer reports.
    void heartbeat(Instant now, std::uint32_t sequence, SessionState peerState);

    bool isSuspect(Instant now) const { return now - m_lastHeard >= m_timing.suspect; }
    bool isLost(Instant now) const { return now - m_lastHeard >= m_timing.lost - reaction; }

    /// Lane 0 says nothing although other paths do.
    bool isLaneZeroLost(Instant now) const { return now - m_lastLaneZero >= m_timing.reconnect; }

    /// The peer lives and says for longer than `reconnect` that this session is not open on its side.
    bool isUnwell(Instant now) const { return m_unwellSince && now - *m_unwellSince >= m_timing.reconnect; }

    /// The next moment at which one of the answers above can change by silence alone.
    Instant nextChange(bool suspectAlready) const;

    Instant lastHeard() const { return m_lastHeard; }
    SessionState peerState() const { return m_peerState; }
    std::uint32_t onTimeRun() const { return m_onTimeRun; }
    std::uint64_t received() const { return m_received; }
    std::uint64_t missed() const { return m_missed; }
    std::uint64_t receivedInLastSecond(Instant now) const;

    /// Packets of the datagram path in the last 8 heartbeat periods, at most 255.
    std::uint8_t packetsHeard(Instant now) const;

private:
    /// `lost` is when a dead peer is known to be gone. The way here and a timer that comes late take this part of it.
    static constexpr Nanoseconds reaction = std::chrono::milliseconds(3);

    LinkTiming m_timing;
    Instant m_lastHeard;
    Instant m_lastLaneZero;
    std::optional<Instant> m_unwellSince;
    SessionState m_peerState = SessionState::Closed;
    std::optional<Instant> m_lastHeartbeat;
    std::uint32_t m_lastSequence = 0;
    std::uint32_t m_onTimeRun = 0;
    std::uint64_t m_received = 0;
    std::uint64_t m_missed = 0;
    std::deque<Instant> m_recent;         ///< arrivals of the last second
    std::array<Instant, 255> m_packets{}; ///< arrivals of the newest packets, as a ring
    std::size_t m_nextPacket = 0;
};

} // namespace liena::session
