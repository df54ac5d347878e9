// Writes and judges the safety record of control messages (protocol section 3, rulings A1, A2, B1).
#pragma once

#include "liena/system_topology.hpp"
#include "protocol/safety_record.hpp"
#include "session/instant.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string_view>

namespace liena::session {

/// Why a control message is not delivered.
enum class ControlFault : std::uint8_t { None, Crc, OldEpoch, WrongEpoch, NotNewer, UnknownEcho, TooOld };

std::string_view toString(ControlFault fault);

/// The sender's side of one link.
class ControlStamper {
public:
    /// A heartbeat of the target was heard.
    void heardHeartbeat(std::uint32_t epoch, std::uint32_t sequence);

    /// A new session: nothing of the target was heard yet.
    void reset();

    /// Control can be sent: a heartbeat of this session was heard.
    bool ready() const { return m_epoch != 0; }
    std::uint32_t targetEpoch() const { return m_epoch; }

    /// The record of the next message of that number; nothing when the sequence is used up, which ends the session.
    std::optional<protocol::SafetyRecord> next(const protocol::DatagramHeader& header, std::span<const std::byte> fields);

private:
    std::uint32_t m_epoch = 0;
    std::uint32_t m_echo = 0;
    std::map<std::uint16_t, std::uint32_t> m_sequences;
};

/// The receiver's side of one link. Its epoch starts at 1 with the process and never falls.
class ControlGuard {
public:
    explicit ControlGuard(const LinkTiming& timing) : m_timing(timing) {}

    std::uint32_t epoch() const { return m_epoch; }

    /// No control message that was composed before the peer hears of this will be delivered.
    void raiseEpoch(Instant now);

    /// A new session: heartbeat sequences begin again.
    void reset();

    /// A heartbeat of ours left with that sequence.
    void sentHeartbeat(std::uint32_t sequence, Instant now);

    /// When the heartbeat with that sequence left; nothing when none did, or long ago.
    std::optional<Instant> sentAt(std::uint32_t sequence) const;

    ControlFault judge(const protocol::DatagramHeader& header, const protocol::SafetyRecord& record, std::span<const std::byte> fields,
                       Nanoseconds maxAge, Instant now);

    /// A control message that is too short for its record.
    void noteWithoutRecord(Instant now) { count(ControlFault::Crc, now); }

    /// More than ten faults in one second: the peer or the way to it can no longer be trusted.
    bool isExceeded(Instant now) const;

private:
    void count(ControlFault fault, Instant now);

    static constexpr std::size_t remembered = 1024; ///< heartbeats whose sending time is known
    static constexpr std::size_t tolerated = 10;

    LinkTiming m_timing;
    std::uint32_t m_epoch = 1;
    Instant m_epochRose;
    std::map<std::uint16_t, std::uint32_t> m_delivered; ///< newest sequence per number in this epoch
    struct Sent {
        std::uint32_t sequence = 0;
        Instant at;
    };
    std::array<Sent, remembered> m_sent{};
    std::array<Instant, tolerated + 1> m_faults{}; ///< the newest, as a ring
    std::size_t m_nextFault = 0;
    Instant m_lastTooOld;
};

} // namespace liena::session
