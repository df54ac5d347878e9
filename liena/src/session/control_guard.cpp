// The judgement over control messages.
#include "session/control_guard.hpp"

#include <limits>

namespace liena::session {

std::string_view toString(ControlFault fault)
{
    switch (fault) {
    case ControlFault::None:
        return "accepted";
    case ControlFault::Crc:
        return "check sum wrong";
    case ControlFault::OldEpoch:
        return "from before the epoch rose";
    case ControlFault::WrongEpoch:
        return "epoch never announced";
    case ControlFault::NotNewer:
        return "not newer than the last delivered";
    case ControlFault::UnknownEcho:
        return "echoes a heartbeat that was not sent";
    case ControlFault::TooOld:
        return "older than its max-age";
    }
    return "refused";
}

void ControlStamper::heardHeartbeat(std::uint32_t epoch, std::uint32_t sequence)
{
    if (epoch != m_epoch) {
        m_epoch = epoch;
        m_sequences.clear();
    }
    m_echo = sequence;
}

void ControlStamper::reset() { *this = ControlStamper(); }

std::optional<protocol::SafetyRecord> ControlStamper::next(const protocol::DatagramHeader& header, std::span<const std::byte> fields)
{
    auto& sequence = m_sequences[header.message.number];
    if (sequence == std::numeric_limits<std::uint32_t>::max())
        return std::nullopt;
    protocol::SafetyRecord record{m_epoch, ++sequence, m_echo, 0};
    record.crc = protocol::safetyCrc(header, record, fields);
    return record;
}

void ControlGuard::raiseEpoch(Instant now)
{
    ++m_epoch;
    m_epochRose = now;
    m_delivered.clear();
}

void ControlGuard::reset()
{
    m_sent = {};
    m_faults = {};
    m_delivered.clear();
}

void ControlGuard::sentHeartbeat(std::uint32_t sequence, Instant now) { m_sent[sequence % remembered] = {sequence, now}; }

std::optional<Instant> ControlGuard::sentAt(std::uint32_t sequence) const
{
    const auto& sent = m_sent[sequence % remembered];
    return sequence != 0 && sent.sequence == sequence ? std::optional(sent.at) : std::nullopt;
}

ControlFault ControlGuard::judge(const protocol::DatagramHeader& header, const protocol::SafetyRecord& record,
                                 std::span<const std::byte> fields, Nanoseconds maxAge, Instant now)
{
    auto& delivered = m_delivered[header.message.number];
    const auto echoed = sentAt(record.echo);
    auto fault = ControlFault::None;
    if (record.crc != protocol::safetyCrc(header, record, fields))
        fault = ControlFault::Crc;
    else if (record.epoch < m_epoch)
        fault = ControlFault::OldEpoch;
    else if (record.epoch > m_epoch)
        fault = ControlFault::WrongEpoch;
    else if (record.sequence <= delivered)
        fault = ControlFault::NotNewer;
    else if (!echoed)
        fault = ControlFault::UnknownEcho;
    else if (now - *echoed > maxAge)
        fault = ControlFault::TooOld;
    if (fault == ControlFault::None)
        delivered = record.sequence;
    else
        count(fault, now);
    return fault;
}

void ControlGuard::count(ControlFault fault, Instant now)
{
    // A revocation crosses commands that are on their way; only what still comes after `lost` speaks against the peer (ruling A2).
    if (fault == ControlFault::OldEpoch && now - m_epochRose <= m_timing.lost)
        return;
    // One stall of a computer makes a whole burst late at once; a burst within one heartbeat is one fault.
    if (fault == ControlFault::TooOld) {
        if (now - m_lastTooOld < m_timing.heartbeat)
            return;
        m_lastTooOld = now;
    }
    m_faults[m_nextFault] = now;
    m_nextFault = (m_nextFault + 1) % m_faults.size();
}

bool ControlGuard::isExceeded(Instant now) const
{
    // The ring is full of faults within the last second when its oldest is.
    const auto oldest = m_faults[m_nextFault];
    return oldest != Instant{} && now - oldest <= std::chrono::seconds(1);
}

} // namespace liena::session
