// What happened in a simulated world, as an onlooker sees it: the input of the reference model and of the trace's hash.
#pragma once

#include "network.hpp"

#include "liena/session_state.hpp"
#include "protocol/datagram.hpp"

#include <cstdint>
#include <string>
#include <variant>

namespace liena::simulation {

/// Names one application message: origins stamp strictly increasing.
struct MessageName {
    std::uint32_t origin = 0;
    std::uint16_t number = 0;
    std::uint64_t stamp = 0;
    friend constexpr auto operator<=>(const MessageName&, const MessageName&) = default;
};

inline MessageName nameOf(const protocol::DatagramHeader& header)
{
    return {header.message.origin.value(), header.message.number, header.timestamp.ns};
}

struct Started {
    HostIndex device = 0;
};
struct Ended {
    HostIndex device = 0;
};
/// A dialogue began here with a fresh token.
struct Requested {
    HostIndex device = 0;
    HostIndex peer = 0;
    std::uint64_t token = 0;
    bool reopen = false;
    bool byPerson = false;
    IncidentId incident = 0; ///< the one that the person was shown; 0 for a plain opening
};
struct Entered {
    HostIndex device = 0;
    HostIndex peer = 0;
    SessionState from = SessionState::Closed;
    SessionState to = SessionState::Closed;
    std::uint64_t token = 0;
    Nanoseconds silence{}; ///< since the peer was heard last
};
/// The session is given up; its token names the incident.
struct Lost {
    HostIndex device = 0;
    HostIndex peer = 0;
    IncidentId incident = 0;
};
/// A lane of the peer is read from now on as one of the session's.
struct LaneTaken {
    HostIndex device = 0;
    HostIndex peer = 0;
    std::uint64_t attachToken = 0;
    std::uint64_t sessionToken = 0;
};
/// The dialogue ended in Open, or the session healed.
struct Opened {
    HostIndex device = 0;
    HostIndex peer = 0;
    std::uint64_t token = 0;
    bool reopened = false;
    bool healed = false;
    std::uint32_t epoch = 0;
};
struct Revoked {
    HostIndex device = 0;
};
struct Raised {
    HostIndex device = 0;
    IncidentId incident = 0;
    HostIndex first = 0;
    HostIndex second = 0;
};
struct Over {
    HostIndex device = 0;
    IncidentId incident = 0;
    bool dismissed = false;
    HostIndex teller = 0;
};
struct Dismissed {
    HostIndex device = 0;
    IncidentId incident = 0;
};
/// Accepted by the sending side.
struct Composed {
    HostIndex device = 0;
    HostIndex target = 0;
    MessageName name;
    bool control = false;
    bool engaged = false; ///< asks a robot to move
    std::uint32_t content = 0;
};
/// A heartbeat leaves: what this end says of itself.
struct Beat {
    HostIndex device = 0;
    HostIndex target = 0;
    SessionState state = SessionState::Closed;
    std::uint32_t epoch = 0;
};
/// Its last byte was written to a connection, or it went out as a packet.
struct Left {
    HostIndex device = 0;
    HostIndex target = 0;
    MessageName name;
};
enum class Fate : std::uint8_t { Superseded, Expired, Discarded };
struct Unsent {
    HostIndex device = 0;
    HostIndex target = 0;
    MessageName name;
    Fate fate = Fate::Superseded;
};
/// A segment of a message that is not whole yet was taken.
struct Kept {
    HostIndex device = 0;
    HostIndex peer = 0;
    std::uint8_t lane = 0;
    MessageName name;
    std::size_t bytes = 0; ///< with those before it
};
struct Delivered {
    HostIndex device = 0;
    HostIndex peer = 0; ///< whose identity the connection has
    MessageName name;
    bool control = false;
    bool refusedInStandBy = false; ///< its definition says so
    bool forUs = true;             ///< its target is this device or everybody
    std::uint32_t epoch = 0;
    std::uint32_t sequence = 0;
    std::uint32_t content = 0;
};
struct Dropped {
    HostIndex device = 0;
    HostIndex peer = 0;
    MessageName name;
    std::string_view cause;
};
/// The robot applied a motion command.
struct Applied {
    HostIndex device = 0;
    HostIndex owner = 0;
    MessageName name;
    bool engaged = false;
};
/// The drives ran until now.
struct Drove {
    HostIndex device = 0;
    bool moving = false;
    bool faster = false;        ///< some axis gained speed
    bool withinEnvelope = true; ///< speeds, and what was moved, are within the limits
    Nanoseconds passed{};       ///< since they ran before
};
struct Holdings {
    HostIndex device = 0;
    std::size_t partialBytes = 0;
    std::size_t queuedBytes = 0;
    std::size_t fresh = 0;
    std::size_t pending = 0;
    std::size_t incidents = 0;
    Nanoseconds silence{}; ///< the longest of an open session
};
/// How things stand when everything is healed.
struct Settled {
    HostIndex device = 0;
    HostIndex peer = 0;
    SessionState state = SessionState::Closed;
    std::uint64_t token = 0;
    std::uint32_t epoch = 0;
    std::uint32_t peerEpoch = 0; ///< as the peer said it
    std::size_t incidents = 0;   ///< that the device holds
};
struct Paused {
    HostIndex device = 0;
    bool paused = false;
};
/// A peer that may lie about incidents; what it sends cannot be held against the others.
struct Lies {
    HostIndex device = 0;
};

using Observation = std::variant<Started, Ended, Requested, Entered, Lost, LaneTaken, Opened, Revoked, Raised, Over, Dismissed, Composed,
                                 Beat, Left, Unsent, Kept, Delivered, Dropped, Applied, Drove, Holdings, Settled, Paused, Lies>;

/// One line for a person.
std::string describe(const Observation& observation);

/// Of everything that was observed, with its time; the same on every computer.
class TraceHash {
public:
    void add(Instant at, const Observation& observation);
    std::uint64_t value() const { return m_hash; }
    std::uint64_t count() const { return m_count; }

private:
    void mix(std::uint64_t value)
    {
        m_hash = (m_hash ^ value) * 0x100000001B3U;
        m_hash ^= m_hash >> 29U;
    }

    std::uint64_t m_hash = 0xCBF29CE484222325U;
    std::uint64_t m_count = 0;
};

} // namespace liena::simulation
