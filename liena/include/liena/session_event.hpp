// What happens to sessions and to the system, as the application hears it.
#pragma once

#include "liena/device_id.hpp"
#include "liena/session_state.hpp"
#include "liena/timestamp.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace liena {

/// What is known about a lost session: heard, counted, and found by a probe.
struct Diagnosis {
    LossCause cause = LossCause::None;
    ProbeResult probe = ProbeResult::NotProbed;
    std::string probeDetail;
    Timestamp since;                      ///< start of the silence or of the loss, local wall clock
    std::chrono::nanoseconds silence{};   ///< between the last datagram heard and the decision
    std::uint64_t heartbeatsExpected = 0; ///< in the session's last second
    std::uint64_t heartbeatsReceived = 0; ///< in the session's last second
    std::optional<std::chrono::nanoseconds> lastRoundTrip;
    bool toPeerConnected = false;                  ///< our connection to the peer stood at the decision
    bool fromPeerConnected = false;                ///< the peer's connection to us stood at the decision
    SessionState peerState = SessionState::Closed; ///< as the peer last said it
    std::string detail;                            ///< what the transport or the protocol check said
};

struct HoldReport {
    DeviceId device;
    bool holding = false;
    Timestamp confirmed; ///< on that device's clock
};

/// One loss that stands between the system and motion.
struct Incident {
    IncidentId id = 0;
    DeviceId a; ///< the lower id of the pair
    DeviceId b;
    LossCause cause = LossCause::None; ///< as the end saw it that first said so
    Timestamp since;                   ///< on the clock of the end that first said so
    std::vector<HoldReport> holds;
    LossCause causeOfA = LossCause::None; ///< as that end saw it; None when it was not heard
    LossCause causeOfB = LossCause::None;
};

struct SessionEvent {
    enum class Kind : std::uint8_t {
        StateChanged,    ///< peer, from, to
        Opened,          ///< peer, duration: from the request to Open
        OpenFailed,      ///< peer, reason, detail (an opening or a re-opening that ended)
        Closed,          ///< peer, reason, detail: closed in order by either side
        Interrupted,     ///< peer, duration: it was lost and healed within `reconnect`; permissions to move have ended
        Lost,            ///< peer, incident, diagnosis (not yet probed)
        Diagnosed,       ///< peer, incident, diagnosis of its loss with what a probe found
        ReOpened,        ///< peer, incident, duration
        IncidentRaised,  ///< incident: first heard here, own or another pair's
        IncidentEnded,   ///< incident, dismissed, detail; peer: who told it
        CauseReported,   ///< incident: now the cause is known as its other end saw it, too
        HoldReported,    ///< incident with its newest holds; hold
        StandByBegan,    ///< this device stands by: it holds at least one incident
        StandByEnded,    ///< no incident is left
        DeadlineMissed,  ///< peer, message: once per gap
        MessagesDropped, ///< peer, message (may be empty), count, detail: once per cause
        SendFailed,      ///< peer, message, detail: accepted by send() and lost before it left
        IdentityRefused, ///< peer (broadcast when unknown), count, detail: connections that were not let in; once per cause
        LocalStall,      ///< duration: this process did not run for longer than `suspect`
        AuditLost,       ///< detail: the audit file cannot be written; no new session opens until it can
        AuditRestored,   ///< it can be written again
    };

    Kind kind = Kind::StateChanged;
    std::chrono::steady_clock::time_point at;
    DeviceId peer;
    SessionState from = SessionState::Closed;
    SessionState to = SessionState::Closed;
    RejectReason reason = RejectReason::None;
    std::chrono::nanoseconds duration{};
    Incident incident;
    HoldReport hold;
    Diagnosis diagnosis;
    std::string message;
    std::uint64_t count = 0;
    bool dismissed = false;
    std::string detail;
};

std::string_view toString(SessionEvent::Kind kind);

/// One kind of bulk message to a peer, and what of the path is its own.
struct BulkStream {
    std::uint16_t number = 0;   ///< of the message
    std::optional<double> rate; ///< bytes per second that it can count on; nothing while its way was neither filled nor measured
};

/// The live figures of one link, a copy of one moment.
struct LinkStatus {
    DeviceId peer;
    SessionState state = SessionState::Closed;
    SessionState peerState = SessionState::Closed;                  ///< as the peer last said it
    std::optional<std::chrono::steady_clock::time_point> lastHeard; ///< the last datagram of the peer on any path
    std::optional<std::chrono::nanoseconds> roundTrip;              ///< of the newest echo
    std::chrono::nanoseconds jitter{};                              ///< RFC 3550 section 6.4.1, of the heartbeats' transit
    std::optional<std::chrono::nanoseconds> clockOffset;            ///< peer's clock − ours; nothing before 8 samples
    std::chrono::nanoseconds clockUncertainty{};                    ///< half the least delay
    std::uint32_t heartbeatsOnTime = 0;                             ///< consecutive, until now
    std::uint64_t heartbeatsReceived = 0;
    std::uint64_t heartbeatsMissed = 0;
    std::uint64_t messagesSent = 0;
    std::uint64_t messagesReceived = 0;
    std::uint64_t messagesDropped = 0;    ///< for every cause, here
    std::uint64_t messagesSuperseded = 0; ///< by newer ones of their kind, before they could leave
    std::uint64_t bulkSuperseded = 0;     ///< those of them that are bulk
    std::uint64_t messagesAbandoned = 0;  ///< begun by the peer and not sent to their end
    std::uint64_t bytesSent = 0;
    std::uint64_t bytesReceived = 0;
    std::uint32_t queuedMessages = 0; ///< accepted by send() and not yet given to the kernel
    std::uint8_t bulkLanes = 0;       ///< connections of ours for bulk
    std::uint8_t bulkLanesIn = 0;     ///< the peer's
    std::uint8_t bulkWorkers = 0;     ///< threads of this device that work on bulk now, for all links together
    /// Bytes per second that all bulk to this peer together can count on; nothing until the path has been filled or measured. It rises
    /// again after a path has healed, also while less than this is sent. A source steps up and down by its own: see bulkRateOf().
    std::optional<double> bulkRate;
    std::chrono::nanoseconds bulkRateAge{}; ///< since bulk last filled the path and so showed what it carries
    std::vector<BulkStream> bulkStreams;    ///< that were used within the last 2 s
    std::uint64_t bulkQueuedBytes = 0;      ///< of bulk that waits here or is under way to the peer's kernel
    std::uint32_t epoch = 0;                ///< ours, of what we receive
    std::uint32_t peerEpoch = 0;            ///< the peer's, as last heard; 0 before the first heartbeat
    std::uint32_t interruptions = 0;
    std::uint8_t packetsHeard = 0;       ///< by UDP in the last 8 heartbeat periods, at most 255
    std::uint8_t packetsHeardByPeer = 0; ///< the same as the peer last said it; 0: the datagram path to it does not work
    bool toPeerConnected = false;
    bool fromPeerConnected = false;
    std::string localAddress;  ///< of our newest connection for control: which of our interfaces it leaves by; empty before the first
    std::string remoteAddress; ///< and the peer's, as text; a host with several may be reached another way after an interruption
    IncidentId incident = 0;   ///< of this pair; 0 when there is none
    std::optional<std::chrono::nanoseconds> latency; ///< median of the last 200 ms (a slower heartbeat: of its period), ± clockUncertainty

    /// What messages of this number can count on, beside the other bulk to this peer that flows now; nothing while that is not known.
    std::optional<double> bulkRateOf(std::uint16_t number) const
    {
        for (const auto& stream : bulkStreams)
            if (stream.number == number)
                return stream.rate;
        return bulkRate ? std::optional(*bulkRate / static_cast<double>(bulkStreams.size() + 1)) : std::nullopt;
    }
};

/// Messages of one kind that were not delivered here for one cause, since the start.
struct DropCount {
    std::string cause;
    std::string message; ///< its name; its number in hex when nothing defines it
    std::uint64_t count = 0;
};

} // namespace liena
