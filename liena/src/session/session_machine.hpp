// The life of one session as a pure machine (protocol section 8 and its rulings).
#pragma once

#include "liena/session_event.hpp"
#include "liena/session_state.hpp"
#include "liena/system_topology.hpp"
#include "protocol/session_messages.hpp"
#include "session/clock_offset.hpp"
#include "session/control_guard.hpp"
#include "session/heartbeat_monitor.hpp"
#include "session/instant.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace liena::session {

/// How a set that a peer shows stands here.
enum class SetStanding : std::uint8_t { Held, Unknown, Changed, Invalid };

/// A connection that brought an Attach with a fresh token; the number is the shell's.
using ConnectionNumber = std::uint64_t;

// What can happen to a session. The shell checks link, identity, token and set before it tells.

struct OpenRequested {
    std::uint64_t token = 0; ///< fresh and random
};
struct ReopenRequested {
    std::uint64_t token = 0;
    IncidentId seen = 0; ///< the one that the person was shown; 0: none was known
};
struct CloseRequested {
    std::string reason;
};
/// Our connection for lane 0 stands and its Attach was written.
struct OutgoingUp {};
struct OutgoingFailed {
    ProbeResult probe = ProbeResult::NotProbed;
    std::string detail;
};
struct OutgoingLost {
    ProbeResult probe = ProbeResult::NotProbed; ///< TlsFailure when the peer refused our identity
    std::string detail;
};
/// The peer's connection for lane 0 brought an Attach with this session's token.
struct IncomingUp {};
struct IncomingLost {
    std::string detail;
};
struct HandshakeHeard {
    ConnectionNumber connection = 0;
    protocol::Handshake handshake;
    bool diagnosis = false;
    std::uint64_t previous = 0;
    SetStanding standing = SetStanding::Held;
    std::string notAdmitted{}; ///< why this device begins no session with the peer now; empty when it does
};
struct CommitHeard {
    protocol::HandshakeCommit commit;
    bool diagnosis = false;
    std::uint64_t previous = 0;
    SetStanding standing = SetStanding::Held;
};
/// The peer's set arrived; Held when it passed every check and was stored.
struct SetHeard {
    SetStanding standing = SetStanding::Held;
    std::string detail;
};
/// A session message that is none of the above.
struct SessionMessageHeard {
    protocol::SessionMessage message;
};
/// A valid datagram of the peer, delivered or not.
struct LifeHeard {
    LifePath path = LifePath::LaneZero;
};
struct ViolationFound {
    std::string detail;
};
/// This process did not run for that long.
struct Stalled {
    Nanoseconds gap{};
};
/// An incident of this pair is held, or none is any more.
struct IncidentHeld {
    IncidentId incident = 0;
    IncidentId ended = 0; ///< another one, which is over now
};
struct IncidentGone {};
/// Time has passed.
struct Tick {};

using SessionInput = std::variant<OpenRequested, ReopenRequested, CloseRequested, OutgoingUp, OutgoingFailed, OutgoingLost, IncomingUp,
                                  IncomingLost, HandshakeHeard, CommitHeard, SetHeard, SessionMessageHeard, LifeHeard, ViolationFound,
                                  Stalled, IncidentHeld, IncidentGone, Tick>;

// What a session asks its shell to do, in this order.

/// Connect lane 0 to the peer, write Attach with the session's token, and tell OutgoingUp or OutgoingFailed; an older attempt ends
/// silently.
struct ConnectLaneZero {};
/// Close every connection of the session; what is queued for lane 0 may leave within `grace`.
struct CloseLanes {
    Nanoseconds grace{};
};
/// That connection is the peer's lane 0 now.
struct Adopt {
    ConnectionNumber connection = 0;
};
/// Say Rejected for the attempt that came on that connection, and close it.
struct Refuse {
    ConnectionNumber connection = 0;
    std::uint64_t token = 0;
    RejectReason reason = RejectReason::None;
    std::string detail;
};
/// Read nothing from that connection; the peer will withdraw it.
struct Ignore {
    ConnectionNumber connection = 0;
};
struct Send {
    protocol::SessionMessage message;
    bool afterOutput = false; ///< behind everything that is queued for lane 0
};
/// Our own set, in a MessageSet message.
struct SendOwnSet {};
/// Everything queued for lane 0 that is control is thrown away and reported.
struct DiscardControl {};
/// Everything queued is thrown away and reported, both ways.
struct DiscardAll {};
struct Entered {
    SessionState from;
    SessionState to;
};
struct SessionOpened {
    bool reopened = false;
    std::uint64_t token = 0;
    IncidentId incident = 0; ///< the one named in the dialogue; 0 when none was
    bool initiator = false;
    Nanoseconds duration{};
};
struct OpenFailed {
    RejectReason reason = RejectReason::None;
    ProbeResult probe = ProbeResult::NotProbed;
    std::string detail;
};
struct SessionClosed {
    std::string detail;
    bool byPeer = false;
};
struct SessionInterrupted {
    Nanoseconds duration{};
};
struct SessionLost {
    IncidentId incident = 0;
    Diagnosis diagnosis;
};

using SessionAction = std::variant<ConnectLaneZero, CloseLanes, Adopt, Refuse, Ignore, Send, SendOwnSet, DiscardControl, DiscardAll,
                                   Entered, SessionOpened, OpenFailed, SessionClosed, SessionInterrupted, SessionLost>;
using SessionActions = std::vector<SessionAction>;

struct SessionSettings {
    DeviceId self;
    DeviceId peer;
    LinkTiming timing;
    Sha256 topology;
    Sha256 ownSet;
    std::string software;
};

/// One per link.
///
///              OpenRequested / Handshake            opened
///   Closed ───────────────────────────────► Opening ───────► Open ◄──── life ────► Suspect
///     ▲ ▲                                      │              │ ▲   silence suspect   │
///     │ └──────────── failed ──────────────────┘              │ └── healed ──┐        │ silence lost,
///     │                                                       ▼              │        ▼ lane 0 broken
///   Closing ◄──── CloseRequested / Disengagement ─────── (any of the open ones)  Reconnecting
///                                                                                     │ reconnect passed
///   Reopening ◄──── a person's ReopenRequested / DiagnosisHandshake ──── StandBy ◄────┘ violation, restart
///     └─ opened: Open, failed: StandBy (or Closed on a side that knew of no incident)
class SessionMachine {
public:
    explicit SessionMachine(SessionSettings settings);

    /// Applies one input; the actions are to be done in order.
    SessionActions handle(const SessionInput& input, Now now);

    /// When a Tick is due; nothing while only inputs can change something.
    std::optional<Instant> nextDeadline() const;

    /// Raises the epoch: the application revokes what it permitted. The heartbeat that says so is among the actions.
    SessionActions revoke(Now now);

    /// For the next heartbeats.
    void setIncidents(std::uint16_t count) { m_incidents = count; }

    SessionState state() const { return m_state; }
    std::uint64_t token() const { return m_token; }
    IncidentId incident() const { return m_incident; }

    /// Lane 0 of the peer, or of ours, stands.
    bool isIncomingUp() const { return m_incomingUp; }
    bool isOutgoingUp() const { return m_outgoingUp; }

    /// The peer's set was asked for and did not arrive yet.
    bool awaitsSet() const { return isDialogue() && m_setOutstanding; }
    /// The hash of its set, as the peer has announced it in this attempt.
    const Sha256& announcedSet() const { return m_announcedSet; }

    ControlGuard& guard() { return m_guard; }
    const ControlGuard& guard() const { return m_guard; }
    ControlStamper& stamper() { return m_stamper; }
    const ControlStamper& stamper() const { return m_stamper; }
    const HeartbeatMonitor& monitor() const { return m_monitor; }

    /// Packets that the peer heard on the datagram path, as it last said; 0 before its first heartbeat.
    std::uint8_t datagramsHeardByPeer() const { return m_newest.datagramsHeard; }
    const ClockOffset& clock() const { return m_clock; }
    Nanoseconds jitter() const { return m_jitter; }

private:
    enum class Duty : std::uint8_t { Initiator, Responder };

    // session_dialogue.cpp: opening, re-opening; what a peer says
    void on(const OpenRequested& input);
    void on(const ReopenRequested& input);
    void on(const OutgoingUp& input);
    void on(const OutgoingFailed& input);
    void on(const HandshakeHeard& input);
    void on(const CommitHeard& input);
    void on(const SetHeard& input);
    void on(const SessionMessageHeard& input);
    void initiate(std::uint64_t token, bool diagnosis);
    void respond(const HandshakeHeard& input);
    std::optional<std::pair<RejectReason, std::string>> objection(const HandshakeHeard& input) const;
    void refuse(const HandshakeHeard& input, RejectReason reason, std::string detail);
    void handshakeInDialogue(const HandshakeHeard& input);
    void handshakeInSession(const HandshakeHeard& input);
    void yieldTo(const HandshakeHeard& input, const std::string& detail);
    void sendHandshake();
    void sendCommit();
    void finishAsInitiator();
    void finishAsResponder(std::uint64_t token);
    void enterOpen();
    void abandonAttempt(RejectReason reason, ProbeResult probe, std::string detail, bool tellPeer);
    void heardRejected(const protocol::Rejected& rejected);
    bool isDialogue() const { return m_state == SessionState::Opening || m_state == SessionState::Reopening; }

    // session_closing.cpp
    void on(const CloseRequested& input);
    void heardDisengagement(const protocol::Disengagement& message);
    void heardDisengagementCommit();
    void heardChannelClosed();
    void finishClosing(std::string detail);

    // session_liveness.cpp: heartbeats, silence, reconnecting, stand-by
    void on(const OutgoingLost& input);
    void on(const IncomingUp& input);
    void on(const IncomingLost& input);
    void on(const LifeHeard& input);
    void on(const ViolationFound& input);
    void on(const Stalled& input);
    void on(const IncidentHeld& input);
    void on(const IncidentGone& input);
    void on(const Tick& input);
    void heardHeartbeat(const protocol::Heartbeat& heartbeat);
    void measureWay(const protocol::Heartbeat& heartbeat);
    void sendHeartbeat();
    void helpWaitingPeer(SessionState peerState);
    void sendDueHeartbeat();
    void judgeLiveness();
    void judgeDialogue();
    void judgeReconnecting();
    void awaitProof();
    void judgeProof();
    void enterReconnecting(LossCause cause, std::string detail);
    void healIfWhole();
    void enterStandBy(LossCause cause, const std::string& detail);
    void lostInDialogue(ProbeResult probe, const std::string& detail);
    void connect();
    bool isLive() const { return carriesMessages(m_state) || m_state == SessionState::Reconnecting; }
    bool beats() const { return m_beating && m_outgoingUp; }

    // session_machine.cpp
    void enter(SessionState state);
    void emit(SessionAction action) { m_actions.push_back(std::move(action)); }
    void closeLanes(Nanoseconds grace);
    void resetSession();
    Diagnosis diagnose(LossCause cause, const std::string& detail) const;

    SessionSettings m_settings;
    SessionState m_state = SessionState::Closed;
    SessionActions m_actions;
    Now m_now; ///< of the input in hand

    // The attempt or session in hand
    Duty m_duty = Duty::Initiator;
    bool m_diagnosis = false;
    std::uint64_t m_token = 0;
    IncidentId m_incident = 0;      ///< of this pair, held here
    bool m_peerStandsBy = false;    ///< the peer holds an incident of this pair that is not known here: this device was restarted
    IncidentId m_namedIncident = 0; ///< the one that the re-opening ends
    SetStanding m_peerSet = SetStanding::Held;
    Sha256 m_announcedSet;
    bool m_committed = false;      ///< the Commit was heard (initiator)
    bool m_setOutstanding = false; ///< the peer's set is on its way
    bool m_ownSetSent = false;
    bool m_ownSetAsked = false; ///< our set was asked for: by want_set, or by a request
    Instant m_begun;
    Instant m_deadline;                    ///< of the dialogue in hand
    std::optional<Instant> m_rejectedWait; ///< lane 0 was lost in a dialogue: a Rejected may still come until then
    std::string m_lostDetail;
    ProbeResult m_lostProbe = ProbeResult::NotProbed;
    std::string m_closeReason;
    bool m_closedByPeer = false;

    // Lanes
    bool m_outgoingUp = false;
    bool m_connecting = false; ///< a connection for lane 0 is being made; an older one may still stand
    bool m_incomingUp = false;
    bool m_incomingSilent = false; ///< it was given up for its silence, and it stands
    unsigned m_peerWaits = 0;      ///< heartbeats of the peer in a row that say Reconnecting
    bool m_renewed = false;        ///< lane 0 was connected again for this waiting of the peer

    // Liveness
    HeartbeatMonitor m_monitor;
    ClockOffset m_clock;
    Nanoseconds m_jitter{};
    ControlGuard m_guard;
    ControlStamper m_stamper;
    bool m_beating = false;
    bool m_openedBefore = false;
    std::uint32_t m_sequence = 0;
    Instant m_nextHeartbeat;
    protocol::Heartbeat m_newest; ///< of the peer
    Now m_newestArrival;
    std::uint16_t m_incidents = 0;

    // Reconnecting
    LossCause m_cause = LossCause::None;
    Instant m_lossAt;
    std::optional<Instant> m_retryAt;

    /// A handshake while the session is open: the peer restarted, unless the session proves to live within one and a half heartbeats. In
    /// an interruption it waits only where that is our own stall.
    std::optional<HandshakeHeard> m_pending;
    Instant m_proofDeadline;
};

} // namespace liena::session
