// Entry, deadlines and what the parts of the session machine share.
#include "session/session_machine.hpp"

#include <algorithm>

namespace liena::session {

SessionMachine::SessionMachine(SessionSettings settings)
    : m_settings(std::move(settings)), m_monitor(m_settings.timing), m_guard(m_settings.timing)
{}

SessionActions SessionMachine::handle(const SessionInput& input, Now now)
{
    m_now = now;
    m_actions.clear();
    std::visit([this](const auto& i) { on(i); }, input);
    return std::move(m_actions);
}

SessionActions SessionMachine::revoke(Now now)
{
    m_now = now;
    m_actions.clear();
    m_guard.raiseEpoch(now.mono);
    if (beats())
        sendHeartbeat();
    return std::move(m_actions);
}

std::optional<Instant> SessionMachine::nextDeadline() const
{
    std::optional<Instant> next;
    const auto consider = [&](Instant at) { next = next ? std::min(*next, at) : at; };
    if (beats())
        consider(m_nextHeartbeat);
    switch (m_state) {
    case SessionState::Opening:
    case SessionState::Reopening:
        consider(m_rejectedWait ? std::min(*m_rejectedWait, m_deadline) : m_deadline);
        break;
    case SessionState::Closing:
        consider(m_deadline);
        break;
    case SessionState::Open:
    case SessionState::Suspect:
        consider(m_monitor.nextChange(m_state == SessionState::Suspect));
        if (m_pending)
            consider(m_proofDeadline);
        break;
    case SessionState::Reconnecting:
        consider(m_lossAt + m_settings.timing.reconnect);
        if (m_retryAt)
            consider(*m_retryAt);
        if (m_pending)
            consider(m_proofDeadline);
        break;
    case SessionState::Closed:
    case SessionState::StandBy:
        break;
    }
    return next;
}

void SessionMachine::enter(SessionState state)
{
    if (state == m_state)
        return;
    emit(Entered{m_state, state});
    m_state = state;
}

void SessionMachine::closeLanes(Nanoseconds grace)
{
    if (m_pending) {
        const auto reason = m_state == SessionState::Closing ? RejectReason::Busy : RejectReason::StandBy;
        refuse(*m_pending, reason, "the session with this device ended while the handshake waited");
        m_pending.reset();
    }
    emit(CloseLanes{grace});
    m_outgoingUp = false;
    m_connecting = false;
    m_incomingUp = false;
    m_incomingSilent = false;
    m_peerWaits = 0;
    m_renewed = false;
    m_beating = false;
    m_retryAt.reset();
    m_rejectedWait.reset();
}

void SessionMachine::connect()
{
    m_connecting = true;
    m_retryAt.reset();
    emit(ConnectLaneZero{});
}

void SessionMachine::resetSession()
{
    m_committed = false;
    m_setOutstanding = false;
    m_ownSetSent = false;
    m_ownSetAsked = false;
    m_namedIncident = 0;
    m_rejectedWait.reset();
    m_lostDetail.clear();
    m_lostProbe = ProbeResult::NotProbed;
    m_closeReason.clear();
    m_closedByPeer = false;
    m_monitor = HeartbeatMonitor(m_settings.timing);
    m_clock.reset();
    m_jitter = {};
    m_guard.reset();
    m_stamper.reset();
    m_beating = false;
    m_sequence = 0;
    m_newest = {};
    m_newestArrival = {};
    m_cause = LossCause::None;
    m_retryAt.reset();
}

Diagnosis SessionMachine::diagnose(LossCause cause, const std::string& detail) const
{
    Diagnosis diagnosis;
    diagnosis.cause = cause;
    diagnosis.silence = m_now.mono - m_monitor.lastHeard();
    diagnosis.since = Timestamp{m_now.wall.ns - static_cast<std::uint64_t>(std::max<std::int64_t>((m_now.mono - m_lossAt).count(), 0))};
    diagnosis.heartbeatsReceived = m_monitor.receivedInLastSecond(m_lossAt);
    diagnosis.heartbeatsExpected = static_cast<std::uint64_t>(std::chrono::seconds(1) / m_settings.timing.heartbeat);
    diagnosis.lastRoundTrip = m_clock.lastDelay();
    diagnosis.toPeerConnected = m_outgoingUp;
    diagnosis.fromPeerConnected = m_incomingUp;
    diagnosis.peerState = m_monitor.peerState();
    diagnosis.detail = detail;
    return diagnosis;
}

} // namespace liena::session
