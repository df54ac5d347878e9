// The dialogues of a session: open and re-open (protocol section 8; rulings A5 to A7, A10, A13, B16 to B18).
#include "session/session_machine.hpp"

#include <utility>

namespace liena::session {

using namespace std::chrono_literals;

namespace {

constexpr auto dialogueLimit = 3s;
constexpr auto rejectedGrace = 100ms; ///< between writing Rejected and closing

template <typename... Kinds>
bool isOneOf(const protocol::SessionMessage& message)
{
    return (std::holds_alternative<Kinds>(message) || ...);
}

bool belongsToAnOpenSession(const protocol::SessionMessage& message)
{
    return isOneOf<protocol::StandBy, protocol::StandByReport, protocol::IncidentDismissed, protocol::LinkReport, protocol::Abandon,
                   protocol::MeasureRequest, protocol::MeasureAnswer, protocol::Probe, protocol::ProbeEcho>(message);
}

} // namespace

void SessionMachine::on(const OpenRequested& input)
{
    if (m_state == SessionState::Closed)
        initiate(input.token, false);
}

void SessionMachine::on(const ReopenRequested& input)
{
    // A confirmation counts for the incident that it was given for, not for one that took its place.
    if (m_state == SessionState::StandBy && (input.seen == 0 || input.seen == m_incident))
        initiate(input.token, true);
}

void SessionMachine::initiate(std::uint64_t token, bool diagnosis)
{
    resetSession();
    m_duty = Duty::Initiator;
    m_diagnosis = diagnosis;
    m_token = token;
    m_begun = m_now.mono;
    m_deadline = m_now.mono + dialogueLimit;
    enter(diagnosis ? SessionState::Reopening : SessionState::Opening);
    connect();
}

void SessionMachine::on(const OutgoingUp& /*input*/)
{
    if (!m_connecting)
        return;
    m_connecting = false;
    m_outgoingUp = true;
    if (isDialogue()) {
        if (m_duty == Duty::Initiator)
            sendHandshake();
        else
            sendCommit();
        m_beating = true;
        m_nextHeartbeat = m_now.mono;
    } else {
        m_renewed = true;
        sendHeartbeat(); // the peer waits for one to be whole again
    }
}

void SessionMachine::on(const OutgoingFailed& input)
{
    if (!m_connecting)
        return;
    m_connecting = false;
    if (isDialogue())
        abandonAttempt(RejectReason::None, input.probe, input.detail, false);
    else if (m_state == SessionState::Reconnecting)
        m_retryAt = m_now.mono + 50ms;
}

void SessionMachine::sendHandshake()
{
    const protocol::Handshake handshake{m_token, m_settings.topology, m_settings.ownSet, {m_settings.software}};
    if (m_diagnosis)
        emit(Send{protocol::DiagnosisHandshake{handshake, m_incident}});
    else
        emit(Send{handshake});
}

void SessionMachine::sendCommit()
{
    const protocol::HandshakeCommit commit{m_token, m_settings.ownSet, m_peerSet == SetStanding::Unknown, {m_settings.software}};
    m_setOutstanding = commit.wantSet;
    if (m_diagnosis)
        emit(Send{protocol::DiagnosisHandshakeCommit{commit, m_incident}});
    else
        emit(Send{commit});
}

std::optional<std::pair<RejectReason, std::string>> SessionMachine::objection(const HandshakeHeard& input) const
{
    if (input.handshake.topology != m_settings.topology)
        return std::pair(RejectReason::TopologyMismatch, "this device holds topology " + m_settings.topology.toHex().substr(0, 6) +
                                                             ", the peer " + input.handshake.topology.toHex().substr(0, 6) +
                                                             ": give both the same file");
    if (!input.notAdmitted.empty())
        return std::pair(RejectReason::NotAdmitted, input.notAdmitted);
    if (input.standing == SetStanding::Changed)
        return std::pair(RejectReason::MessageSetChanged,
                         "the message set shown is not the one known here for this type of device; a person must accept it");
    if (input.standing == SetStanding::Invalid)
        return std::pair(RejectReason::MessageSetInvalid, "the message set shown does not belong to this device");
    return std::nullopt;
}

void SessionMachine::refuse(const HandshakeHeard& input, RejectReason reason, std::string detail)
{
    emit(Refuse{input.connection, input.handshake.token, reason, std::move(detail)});
}

void SessionMachine::on(const HandshakeHeard& input)
{
    switch (m_state) {
    case SessionState::Closed:
        respond(input);
        break;
    case SessionState::StandBy:
        if (input.diagnosis)
            respond(input);
        else
            refuse(input, RejectReason::StandBy, "this link is in stand-by: it has to be re-opened by a person");
        break;
    case SessionState::Opening:
    case SessionState::Reopening:
        handshakeInDialogue(input);
        break;
    case SessionState::Open:
    case SessionState::Suspect:
    case SessionState::Reconnecting:
        handshakeInSession(input);
        break;
    case SessionState::Closing:
        refuse(input, RejectReason::Busy, "the session is being closed");
        break;
    }
}

void SessionMachine::respond(const HandshakeHeard& input)
{
    if (const auto why = objection(input)) {
        refuse(input, why->first, why->second);
        return;
    }
    resetSession();
    m_duty = Duty::Responder;
    m_diagnosis = input.diagnosis;
    m_token = input.handshake.token;
    m_namedIncident = input.previous;
    m_peerSet = input.standing;
    m_announcedSet = input.handshake.set;
    m_begun = m_now.mono;
    m_deadline = m_now.mono + dialogueLimit;
    enter(input.diagnosis ? SessionState::Reopening : SessionState::Opening);
    m_incomingUp = true;
    emit(Adopt{input.connection});
    connect();
}

void SessionMachine::handshakeInDialogue(const HandshakeHeard& input)
{
    // The lower id leads; its attempt is never replaced, a responder's is (ruling B17).
    if (m_duty == Duty::Initiator && m_settings.self < m_settings.peer) {
        emit(Ignore{input.connection});
        return;
    }
    if (m_incident != 0 && !input.diagnosis) {
        refuse(input, RejectReason::StandBy, "this link is in stand-by: it has to be re-opened by a person");
        return;
    }
    if (const auto why = objection(input)) {
        refuse(input, why->first, why->second);
        return;
    }
    closeLanes(0ns);
    respond(input);
}

void SessionMachine::handshakeInSession(const HandshakeHeard& input)
{
    // One that does not name this session as lost may have been withdrawn by its sender before this session began, and be read late.
    const bool namesThisLoss = input.diagnosis && input.previous == m_token;
    // After a stall of our own it is only what was read first: what refutes it may lie unread.
    const bool interrupted = m_state == SessionState::Reconnecting && m_cause != LossCause::LocalStall;
    if (namesThisLoss || interrupted) {
        yieldTo(input, "the peer opens anew");
        return;
    }
    if (m_pending)
        refuse(*m_pending, RejectReason::Busy, "a newer handshake of the same device replaced this one");
    m_pending = input;
    awaitProof();
}

void SessionMachine::yieldTo(const HandshakeHeard& input, const std::string& detail)
{
    enterStandBy(LossCause::PeerRestarted, detail);
    if (input.diagnosis)
        respond(input);
    else
        refuse(input, RejectReason::StandBy, "the old session was lost by your restart: it has to be re-opened by a person");
}

void SessionMachine::on(const CommitHeard& input)
{
    if (!isDialogue() || m_duty != Duty::Initiator || m_committed || m_diagnosis != input.diagnosis || input.commit.token != m_token) {
        on(ViolationFound{"a commit that nothing asked for"});
        return;
    }
    m_committed = true;
    m_announcedSet = input.commit.set;
    if (m_incident == 0)
        m_namedIncident = input.previous;
    if (input.standing == SetStanding::Changed || input.standing == SetStanding::Invalid) {
        const bool changed = input.standing == SetStanding::Changed;
        abandonAttempt(changed ? RejectReason::MessageSetChanged : RejectReason::MessageSetInvalid, ProbeResult::NotProbed,
                       changed ? "the peer shows another message set than the one known here for its type; a person must accept it"
                               : "the peer shows a message set that does not belong to it",
                       true);
        return;
    }
    m_ownSetAsked = input.commit.wantSet;
    if (m_ownSetAsked) {
        emit(SendOwnSet{});
        m_ownSetSent = true;
    }
    if (input.standing == SetStanding::Unknown) {
        m_setOutstanding = true;
        emit(Send{protocol::MessageSetRequest{input.commit.set}});
        return;
    }
    finishAsInitiator();
}

void SessionMachine::on(const SetHeard& input)
{
    if (!isDialogue() || !m_setOutstanding) {
        on(ViolationFound{"a message set that nobody asked for"});
        return;
    }
    m_setOutstanding = false;
    if (input.standing != SetStanding::Held) {
        abandonAttempt(input.standing == SetStanding::Changed ? RejectReason::MessageSetChanged : RejectReason::MessageSetInvalid,
                       ProbeResult::NotProbed, input.detail, true);
        return;
    }
    if (m_duty == Duty::Initiator)
        finishAsInitiator();
}

void SessionMachine::finishAsInitiator()
{
    if (m_rejectedWait)
        return; // our lane 0 is gone: what is said now does not arrive, and the attempt ends with the wait
    if (m_diagnosis) {
        const auto incident = m_incident != 0 ? m_incident : m_namedIncident;
        const auto [a, b] = std::minmax(m_settings.self, m_settings.peer);
        emit(Send{protocol::ChannelReOpened{m_token, incident, a, b}});
    } else {
        emit(Send{protocol::ChannelOpened{m_token}});
    }
    enterOpen();
}

void SessionMachine::finishAsResponder(std::uint64_t token)
{
    if (isDialogue() && m_rejectedWait)
        return;
    if (!isDialogue() || m_duty != Duty::Responder || !m_outgoingUp || m_setOutstanding || token != m_token)
        on(ViolationFound{"the channel cannot be open yet"});
    else
        enterOpen();
}

void SessionMachine::enterOpen()
{
    if (m_openedBefore)
        m_guard.raiseEpoch(m_now.mono);
    m_openedBefore = true;
    const auto incident = m_incident != 0 ? m_incident : m_namedIncident;
    if (m_diagnosis)
        m_incident = 0;
    m_peerStandsBy = false;
    m_rejectedWait.reset();
    m_monitor.start(m_now.mono);
    m_lossAt = m_now.mono;
    enter(SessionState::Open);
    emit(SessionOpened{m_diagnosis, m_token, incident, m_duty == Duty::Initiator, m_now.mono - m_begun});
    sendHeartbeat(); // says the epoch, so that control can flow at once
}

void SessionMachine::abandonAttempt(RejectReason reason, ProbeResult probe, std::string detail, bool tellPeer)
{
    if (tellPeer)
        emit(Send{protocol::Rejected{m_token, reason, {detail}}});
    closeLanes(tellPeer ? rejectedGrace : 0ns);
    enter(m_incident != 0 || m_peerStandsBy ? SessionState::StandBy : SessionState::Closed);
    emit(OpenFailed{reason, probe, std::move(detail)});
}

void SessionMachine::on(const SessionMessageHeard& input)
{
    // A lane was lost, and with it perhaps what makes sense of the rest: only why the peer refuses matters still.
    if (isDialogue() && m_rejectedWait && !std::holds_alternative<protocol::Rejected>(input.message))
        return;
    const auto refuseUnless = [this](bool allowed, const char* what) {
        if (!allowed)
            on(ViolationFound{what});
        return allowed;
    };
    const bool closable = isLive() || m_state == SessionState::Closing;
    if (const auto* heartbeat = std::get_if<protocol::Heartbeat>(&input.message)) {
        heardHeartbeat(*heartbeat);
    } else if (const auto* rejected = std::get_if<protocol::Rejected>(&input.message)) {
        heardRejected(*rejected);
    } else if (const auto* request = std::get_if<protocol::MessageSetRequest>(&input.message)) {
        const bool once = isDialogue() && m_duty == Duty::Responder && !m_ownSetSent && request->set == m_settings.ownSet;
        if (refuseUnless(once, "a request for a set that cannot be asked for now")) {
            m_ownSetSent = true;
            emit(SendOwnSet{});
        }
    } else if (const auto* opened = std::get_if<protocol::ChannelOpened>(&input.message)) {
        if (refuseUnless(!m_diagnosis, "ChannelOpened in a re-opening"))
            finishAsResponder(opened->token);
    } else if (const auto* reopened = std::get_if<protocol::ChannelReOpened>(&input.message)) {
        if (refuseUnless(m_diagnosis, "ChannelReOpened in an opening")) {
            m_namedIncident = reopened->incident;
            finishAsResponder(reopened->token);
        }
    } else if (const auto* disengagement = std::get_if<protocol::Disengagement>(&input.message)) {
        if (refuseUnless(closable && disengagement->token == m_token, "Disengagement without a session"))
            heardDisengagement(*disengagement);
    } else if (std::holds_alternative<protocol::DisengagementCommit>(input.message)) {
        if (refuseUnless(m_state == SessionState::Closing && std::get<protocol::DisengagementCommit>(input.message).token == m_token,
                         "DisengagementCommit outside a closing"))
            heardDisengagementCommit();
    } else if (std::holds_alternative<protocol::ChannelClosed>(input.message)) {
        if (refuseUnless(m_state == SessionState::Closing && std::get<protocol::ChannelClosed>(input.message).token == m_token,
                         "ChannelClosed outside a closing"))
            heardChannelClosed();
    } else {
        if (!closable || !belongsToAnOpenSession(input.message))
            on(ViolationFound{std::string(protocol::nameOf(input.message)) + " where the session's state does not allow it"});
    }
}

void SessionMachine::heardRejected(const protocol::Rejected& rejected)
{
    const auto detail = rejected.detail.value;
    if (isDialogue() && rejected.token == m_token) {
        // A device that was restarted does not know the incident; its person must be able to re-open all the same.
        m_peerStandsBy = rejected.reason == RejectReason::StandBy;
        abandonAttempt(rejected.reason, ProbeResult::NotProbed, detail, false);
    } else if (isLive())
        enterStandBy(LossCause::ProtocolViolation, "the peer ended the session: " + detail);
    else if (m_state == SessionState::Closing)
        finishClosing(detail);
}

} // namespace liena::session
