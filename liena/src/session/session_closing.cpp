// The dialogue that closes a session (protocol section 8).
#include "session/session_machine.hpp"

#include <utility>

namespace liena::session {

using namespace std::chrono_literals;

namespace {

constexpr auto closingLimit = 1s;
constexpr auto lastWordGrace = 100ms; ///< between writing the last word and closing

} // namespace

void SessionMachine::on(const CloseRequested& input)
{
    if (isDialogue()) {
        abandonAttempt(RejectReason::ShuttingDown, ProbeResult::NotProbed,
                       input.reason.empty() ? "closed by the application" : input.reason, true);
        return;
    }
    if (!isLive())
        return;
    m_closeReason = input.reason;
    m_deadline = m_now.mono + closingLimit;
    emit(DiscardControl{});
    enter(SessionState::Closing);
    emit(Send{protocol::Disengagement{m_token, {input.reason}}});
}

void SessionMachine::heardDisengagement(const protocol::Disengagement& message)
{
    if (m_state != SessionState::Closing) {
        m_closedByPeer = true;
        m_closeReason = message.reason.value;
        m_deadline = m_now.mono + closingLimit;
        emit(DiscardControl{});
        enter(SessionState::Closing);
    }
    emit(Send{protocol::DisengagementCommit{m_token}, true});
}

void SessionMachine::heardDisengagementCommit()
{
    if (m_closedByPeer)
        return;
    emit(Send{protocol::ChannelClosed{m_token}});
    finishClosing(m_closeReason);
}

void SessionMachine::heardChannelClosed() { finishClosing(m_closeReason); }

void SessionMachine::finishClosing(std::string detail)
{
    closeLanes(lastWordGrace);
    enter(m_incident != 0 ? SessionState::StandBy : SessionState::Closed);
    emit(SessionClosed{std::move(detail), m_closedByPeer});
}

} // namespace liena::session
