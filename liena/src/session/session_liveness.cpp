// Heartbeats, silence, reconnecting and stand-by (protocol section 8; rulings A3, A9 to A13, B3, B18, B19).
#include "session/session_machine.hpp"

#include <algorithm>

namespace liena::session {

using namespace std::chrono_literals;

namespace {

constexpr auto rejectedWait = 200ms; ///< a side that loses lane 0 in a dialogue waits that long for a Rejected (ruling A5)
constexpr auto partingGrace = 100ms; ///< between telling of the stand-by and closing

} // namespace

void SessionMachine::on(const Tick& /*input*/)
{
    sendDueHeartbeat();
    if (isDialogue())
        judgeDialogue();
    else if (carriesMessages(m_state))
        judgeLiveness();
    else if (m_state == SessionState::Reconnecting)
        judgeReconnecting();
    else if (m_state == SessionState::Closing && m_now.mono >= m_deadline)
        finishClosing(m_closeReason);
    if (m_pending && isLive())
        judgeProof();
}

void SessionMachine::sendDueHeartbeat()
{
    if (beats() && m_now.mono >= m_nextHeartbeat)
        sendHeartbeat();
}

void SessionMachine::sendHeartbeat()
{
    if (!beats())
        return;
    protocol::Heartbeat heartbeat;
    heartbeat.sequence = ++m_sequence;
    heartbeat.sentNs = m_now.wall.ns;
    heartbeat.echoSequence = m_newest.sequence;
    heartbeat.echoSentNs = m_newest.sentNs;
    heartbeat.echoReceivedNs = m_newestArrival.wall.ns;
    heartbeat.datagramsHeard = m_monitor.packetsHeard(m_now.mono);
    heartbeat.state = m_state;
    heartbeat.incidents = m_incidents;
    heartbeat.epoch = m_guard.epoch();
    m_guard.sentHeartbeat(heartbeat.sequence, m_now.mono);
    if (m_nextHeartbeat <= m_now.mono) // one that is sent early does not delay the beat
        m_nextHeartbeat = std::max(m_nextHeartbeat + m_settings.timing.heartbeat, m_now.mono + m_settings.timing.heartbeat / 2);
    emit(Send{heartbeat});
}

void SessionMachine::heardHeartbeat(const protocol::Heartbeat& heartbeat)
{
    if (m_state == SessionState::Closed || m_state == SessionState::StandBy || heartbeat.sequence <= m_newest.sequence)
        return;
    m_monitor.heartbeat(m_now.mono, heartbeat.sequence, heartbeat.state);
    measureWay(heartbeat);
    m_newest = heartbeat;
    m_newestArrival = m_now;
    m_stamper.heardHeartbeat(heartbeat.epoch, heartbeat.sequence);
    // A peer that is still in the dialogue never heard that it is open: what said so was lost with the connection.
    if (m_state == SessionState::Reconnecting && (carriesMessages(heartbeat.state) || heartbeat.state == SessionState::Reconnecting))
        healIfWhole();
    helpWaitingPeer(heartbeat.state);
    if (m_pending && isLive() && carriesMessages(heartbeat.state)) {
        refuse(*m_pending, RejectReason::AlreadyOpen, "this device already has a session here and is healthy in it");
        m_pending.reset();
    }
}

/// How long it takes and how evenly it comes. One that tells of a stepped clock tells nothing of the way.
void SessionMachine::measureWay(const protocol::Heartbeat& heartbeat)
{
    const auto sent = m_guard.sentAt(heartbeat.echoSequence);
    if (!sent)
        return;
    const Exchange exchange{*sent, {heartbeat.echoReceivedNs}, {heartbeat.sentNs}, m_now};
    const bool isNew = heartbeat.echoSequence != m_newest.echoSequence;
    const bool isSound = isNew ? m_clock.add(exchange) : exchange.delay().has_value();
    if (!isSound || m_newest.sequence == 0)
        return;
    const auto later = (m_now.mono - m_newestArrival.mono) - difference({heartbeat.sentNs}, {m_newest.sentNs});
    m_jitter += (std::chrono::abs(later) - m_jitter) / 16;
}

/// The peer misses our lane 0, which may look whole from here: it is connected again, once, and the old one serves until then.
void SessionMachine::helpWaitingPeer(SessionState peerState)
{
    if (peerState != SessionState::Reconnecting || !carriesMessages(m_state)) {
        m_peerWaits = 0;
        m_renewed = false;
    } else if (++m_peerWaits > 1 && !m_renewed && !m_connecting) {
        connect();
    }
}

void SessionMachine::on(const LifeHeard& input)
{
    m_monitor.heard(m_now.mono, input.path);
    if (input.path == LifePath::LaneZero && m_incomingSilent) {
        m_incomingSilent = false;
        m_incomingUp = true; // it was late, and is not lost
    }
    if (m_state == SessionState::Suspect && !m_monitor.isSuspect(m_now.mono))
        enter(SessionState::Open);
}

void SessionMachine::judgeLiveness()
{
    if (m_monitor.isLost(m_now.mono))
        enterReconnecting(LossCause::HeartbeatLost, "nothing was heard of the peer");
    else if (m_monitor.isLaneZeroLost(m_now.mono)) {
        m_incomingUp = false;
        m_incomingSilent = true;
        enterReconnecting(LossCause::ConnectionLost, "lane 0 was silent while other paths were not");
    } else if (m_monitor.isUnwell(m_now.mono))
        enterStandBy(LossCause::HeartbeatLost, "the peer lives, but says that it is not open");
    else if (m_monitor.isSuspect(m_now.mono))
        enter(SessionState::Suspect);
}

void SessionMachine::judgeDialogue()
{
    if (m_now.mono >= m_deadline)
        abandonAttempt(RejectReason::Timeout, ProbeResult::PeerSilent, "the dialogue took longer than 3 s", m_outgoingUp);
    else if (m_rejectedWait && m_now.mono >= *m_rejectedWait)
        abandonAttempt(RejectReason::None, m_lostProbe, m_lostDetail, false);
}

void SessionMachine::judgeReconnecting()
{
    if (m_now.mono >= m_lossAt + m_settings.timing.reconnect) {
        enterStandBy(m_cause, m_lostDetail);
    } else if (m_retryAt && m_now.mono >= *m_retryAt) {
        connect();
    }
}

/// The old session may prove that it lives until then.
void SessionMachine::awaitProof() { m_proofDeadline = m_now.mono + m_settings.timing.heartbeat + m_settings.timing.heartbeat / 2; }

void SessionMachine::judgeProof()
{
    if (m_now.mono < m_proofDeadline)
        return;
    const auto pending = *m_pending;
    m_pending.reset();
    yieldTo(pending, "the peer opens anew and was not heard in the old session any more");
}

void SessionMachine::enterReconnecting(LossCause cause, std::string detail)
{
    if (m_pending && cause == LossCause::LocalStall) {
        awaitProof(); // what refutes it may have come while nobody read
    } else if (m_pending) {
        const auto pending = *m_pending;
        m_pending.reset();
        m_lossAt = m_now.mono;
        yieldTo(pending, "the peer opens anew");
        return;
    }
    m_cause = cause;
    m_lossAt = m_now.mono;
    m_lostDetail = std::move(detail);
    m_guard.raiseEpoch(m_now.mono);
    if (cause == LossCause::LocalStall)
        emit(DiscardAll{});
    else
        emit(DiscardControl{});
    enter(SessionState::Reconnecting);
    sendHeartbeat();
    // After silence lane 0 is connected again even if it looks whole; the old one serves until the new one stands.
    if (!m_outgoingUp || cause == LossCause::HeartbeatLost)
        connect();
}

void SessionMachine::healIfWhole()
{
    if (!m_outgoingUp || !m_incomingUp)
        return;
    m_retryAt.reset();
    const auto duration = m_now.mono - m_lossAt;
    m_monitor.start(m_now.mono);
    enter(SessionState::Open);
    emit(SessionInterrupted{duration});
    sendHeartbeat();
}

void SessionMachine::on(const OutgoingLost& input)
{
    if (!m_outgoingUp)
        return;
    m_outgoingUp = false;
    if (isDialogue()) {
        lostInDialogue(input.probe, input.detail);
    } else if (carriesMessages(m_state)) {
        enterReconnecting(LossCause::ConnectionLost, input.detail);
    } else if (m_state == SessionState::Reconnecting) {
        if (!m_connecting)
            m_retryAt = m_now.mono + 50ms;
    } else if (m_state == SessionState::Closing) {
        finishClosing(m_closeReason);
    }
}

void SessionMachine::on(const IncomingUp& /*input*/)
{
    // A peer connects again only in a session that is open there: what opens it here may have been lost with the connection before.
    if (isDialogue() && m_incomingUp)
        lostInDialogue(ProbeResult::NotProbed, "the peer connected anew");
    m_incomingUp = true;
    m_incomingSilent = false;
}

void SessionMachine::on(const IncomingLost& input)
{
    m_incomingUp = false;
    m_incomingSilent = false;
    if (isDialogue())
        lostInDialogue(ProbeResult::NotProbed, input.detail);
    else if (carriesMessages(m_state))
        enterReconnecting(LossCause::ConnectionLost, input.detail);
    else if (m_state == SessionState::Closing)
        finishClosing(m_closeReason);
}

void SessionMachine::lostInDialogue(ProbeResult probe, const std::string& detail)
{
    if (probe != ProbeResult::NotProbed)
        m_lostProbe = probe;
    if (!m_rejectedWait)
        m_rejectedWait = m_now.mono + rejectedWait;
    m_lostDetail = "the connection was lost during the dialogue: " + detail;
}

void SessionMachine::on(const ViolationFound& input)
{
    const auto tell = [&] {
        if (m_outgoingUp)
            emit(Send{protocol::Rejected{m_token, RejectReason::ProtocolViolation, {input.detail}}});
    };
    if (isDialogue() && m_rejectedWait) {
        abandonAttempt(RejectReason::None, m_lostProbe, m_lostDetail, false); // the first cause is the one to name
    } else if (isDialogue()) {
        abandonAttempt(RejectReason::ProtocolViolation, ProbeResult::NotProbed, input.detail, m_outgoingUp);
    } else if (isLive()) {
        tell();
        if (carriesMessages(m_state))
            m_lossAt = m_now.mono;
        enterStandBy(LossCause::ProtocolViolation, input.detail);
    } else if (m_state == SessionState::Closing) {
        tell();
        finishClosing(input.detail);
    }
}

void SessionMachine::on(const Stalled& /*input*/)
{
    if (carriesMessages(m_state))
        enterReconnecting(LossCause::LocalStall, "this device itself did not run");
    else if (m_state == SessionState::Reconnecting) {
        emit(DiscardAll{});
        awaitProof();
    }
}

void SessionMachine::on(const IncidentHeld& input)
{
    if (isLive() && input.incident == m_token) {
        enterStandBy(LossCause::ConnectionLost, "the other end says that this session is lost");
    } else if (m_state == SessionState::Opening || (m_state == SessionState::Reopening && input.incident == m_token)) {
        // Where this session is lost already, it was open at the other end: what is still to be read of it opens nothing here.
        m_incident = input.incident;
        abandonAttempt(RejectReason::StandBy, ProbeResult::NotProbed, "this link is in stand-by: it has to be re-opened by a person",
                       m_outgoingUp);
    } else if (m_incident == 0 || m_incident == input.ended) {
        m_incident = input.incident;
        if (m_state == SessionState::Closed)
            enter(SessionState::StandBy);
    }
}

void SessionMachine::on(const IncidentGone& /*input*/)
{
    m_incident = 0;
    m_peerStandsBy = false;
    if (m_state == SessionState::StandBy)
        enter(SessionState::Closed);
}

void SessionMachine::enterStandBy(LossCause cause, const std::string& detail)
{
    if (m_state != SessionState::Reconnecting)
        m_lossAt = m_now.mono;
    const auto diagnosis = diagnose(cause, detail);
    m_guard.raiseEpoch(m_now.mono);
    m_incident = m_token;
    emit(DiscardAll{});
    closeLanes(partingGrace);
    enter(SessionState::StandBy);
    emit(SessionLost{m_incident, diagnosis});
}

} // namespace liena::session
