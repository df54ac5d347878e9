// The books of one link: what was received, delivered, late and dropped, by cause.
#pragma once

#include "base/cause_books.hpp"
#include "protocol/session_messages.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace liena::system {

/// Of LinkReports: where life is told slowly, the figures are not told faster.
constexpr std::chrono::nanoseconds reportPeriod(std::chrono::nanoseconds heartbeat)
{
    return std::max<std::chrono::nanoseconds>(std::chrono::milliseconds(200), heartbeat);
}

class TrafficBooks {
public:
    using Instant = std::chrono::steady_clock::time_point;

    /// The count to report now, or nothing: the first of a cause is told at once, later ones at most every ten seconds.
    std::optional<std::uint64_t> dropped(const std::string& cause, std::uint16_t number, Instant now)
    {
        ++m_dropped;
        ++m_window.droppedMessages;
        return m_causes.count(cause, number, now);
    }

    void received(std::size_t bytes) { receivedSegment(bytes, true); }

    /// Of a message that is not put together.
    void receivedSegment(std::size_t bytes, bool last)
    {
        m_received += last ? 1 : 0;
        m_window.receivedMessages += last ? 1 : 0;
        m_window.receivedBytes += bytes;
    }
    void delivered(std::optional<std::chrono::nanoseconds> latency)
    {
        ++m_window.deliveredMessages;
        if (latency && m_latencies.size() < 4096)
            m_latencies.push_back(*latency);
    }
    void late() { ++m_window.lateMessages; }
    void sent() { ++m_sent; }
    void superseded(bool isBulk)
    {
        ++m_superseded;
        m_bulkSuperseded += isBulk ? 1 : 0;
    }

    /// By UDP, so many bytes of information part.
    void sentInPacket(std::size_t bytes)
    {
        ++m_sent;
        m_sentInPackets += bytes;
    }

    /// A session opens: what was counted before belongs to no report of it.
    void beginWindow(Instant now);

    /// The LinkReport of the window since the last call (ruling B15).
    protocol::LinkReport takeReport(Instant now, std::size_t backlog);

    /// Calls `tell(cause, number, count)` for each.
    template <typename Tell>
    void forEachDrop(Tell&& tell) const
    {
        m_causes.forEach(tell);
    }

    std::uint64_t messagesReceived() const { return m_received; }
    std::uint64_t messagesDropped() const { return m_dropped; }
    std::uint64_t messagesSent() const { return m_sent; }
    std::uint64_t messagesSuperseded() const { return m_superseded; }
    std::uint64_t bulkSuperseded() const { return m_bulkSuperseded; }
    std::uint64_t bytesSentInPackets() const { return m_sentInPackets; }

private:
    base::CauseBooks m_causes{4096}; // some twenty causes, and the messages of two sets
    std::uint64_t m_received = 0;
    std::uint64_t m_dropped = 0;
    std::uint64_t m_sent = 0;
    std::uint64_t m_superseded = 0;
    std::uint64_t m_bulkSuperseded = 0;
    std::uint64_t m_sentInPackets = 0;
    protocol::LinkReport m_window;
    std::vector<std::chrono::nanoseconds> m_latencies;
    std::optional<Instant> m_windowBegan;
};

} // namespace liena::system
