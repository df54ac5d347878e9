// The rules of section 8 that hold whatever happens.
#include "session_invariants.hpp"

#include "fuzz_target.hpp"

#include <algorithm>

namespace liena::fuzz {

using namespace liena::session;
using namespace std::chrono_literals;
using State = SessionState;

namespace {

constexpr std::size_t mostActions = 24;
constexpr auto longestDialogue = 3s;
constexpr auto longestClosing = 1s;
constexpr auto longestRejectedWait = 200ms;

bool isDialogue(State state) { return state == State::Opening || state == State::Reopening; }
bool isOver(State state) { return state == State::Closed || state == State::StandBy; }
bool isLive(State state) { return carriesMessages(state) || state == State::Reconnecting; }

/// The arrows of the machine's diagram, and the shortcuts that its rules name.
bool isLegal(State from, State to)
{
    switch (from) {
    case State::Closed:
        return to == State::Opening || to == State::Reopening || to == State::StandBy;
    case State::Opening:
    case State::Reopening:
        return to == State::Open || isOver(to) || isDialogue(to);
    case State::Open:
        return to == State::Suspect || to == State::Reconnecting || to == State::StandBy || to == State::Closing;
    case State::Suspect:
        return to == State::Open || to == State::Reconnecting || to == State::StandBy || to == State::Closing;
    case State::Reconnecting:
        return to == State::Open || to == State::StandBy || to == State::Closing;
    case State::StandBy:
        return to == State::Reopening || to == State::Closed;
    case State::Closing:
        return isOver(to);
    }
    return false;
}

} // namespace

void CheckedMachine::pass(Nanoseconds time)
{
    m_now.mono += time;
    m_now.wall.ns += static_cast<std::uint64_t>(time.count());
}

void CheckedMachine::passToDeadline()
{
    if (const auto deadline = m_machine.nextDeadline(); deadline && *deadline > m_now.mono)
        pass(*deadline - m_now.mono);
    handle(Tick{});
}

void CheckedMachine::handle(const SessionInput& input)
{
    const auto before = m_state;
    noteBefore(input);
    check(m_machine.handle(input, m_now), before);
    checkConsequences(input, before);
    if (std::holds_alternative<Tick>(input))
        checkTick();
}

void CheckedMachine::noteBefore(const SessionInput& input)
{
    if (const auto* handshake = std::get_if<HandshakeHeard>(&input)) {
        m_unanswered.insert(handshake->connection);
        m_waitsSince = m_now.mono;
    }
    m_hearsOfStall = std::holds_alternative<Stalled>(input);
    if (m_hearsOfStall && isLive(m_state))
        m_waitsSince = m_now.mono; // nobody read meanwhile: what waits may prove itself anew
    if (const auto* request = std::get_if<ReopenRequested>(&input))
        m_mayReopen = m_state == State::StandBy && (request->seen == 0 || request->seen == m_machine.incident());
    const bool lost = (std::holds_alternative<OutgoingLost>(input) && m_machine.isOutgoingUp()) ||
                      std::holds_alternative<IncomingLost>(input) ||
                      (std::holds_alternative<IncomingUp>(input) && m_machine.isIncomingUp());
    if (isDialogue(m_state) && lost && !m_laneLost)
        m_laneLost = m_now.mono;
}

void CheckedMachine::checkConsequences(const SessionInput& input, State before) const
{
    if (std::holds_alternative<ReopenRequested>(input))
        expect((m_state != before) == m_mayReopen, "a confirmation re-opens after the incident that was seen, and after no other");
    if (m_state == State::Open && before == State::Reconnecting) {
        const auto* heard = std::get_if<SessionMessageHeard>(&input);
        const auto* heartbeat = heard == nullptr ? nullptr : std::get_if<protocol::Heartbeat>(&heard->message);
        expect(heartbeat != nullptr && (carriesMessages(heartbeat->state) || heartbeat->state == State::Reconnecting),
               "a session heals with a peer that says it is in it");
    }
    if (before == State::StandBy && (m_state == State::Opening || m_state == State::Reopening)) {
        const auto* handshake = std::get_if<HandshakeHeard>(&input);
        expect(std::holds_alternative<ReopenRequested>(input) || (handshake != nullptr && handshake->diagnosis),
               "after a loss only a person opens, here or there");
    }
}

void CheckedMachine::revoke()
{
    const auto epoch = m_machine.guard().epoch();
    check(m_machine.revoke(m_now), m_state);
    expect(m_machine.guard().epoch() > epoch, "a revocation raises the epoch");
}

void CheckedMachine::check(const SessionActions& actions, State before)
{
    expect(actions.size() <= mostActions, "an event has a bounded number of actions");
    m_discarded = false;
    m_left = false;
    m_outcomes = 0;
    for (const auto& action : actions)
        checkAction(action);
    expect(m_state == m_machine.state(), "the actions say which state was entered");
    expect(!m_left || m_discarded, "control that was queued never outlives the session's being open");
    if (before != m_state && (isOver(m_state) || m_state == State::Open) && before != State::Suspect && !isOver(before))
        expect(m_outcomes > 0, "the application hears how it ended");
    checkState(before);
    m_token = m_machine.token();
}

void CheckedMachine::checkAction(const SessionAction& action)
{
    if (const auto* change = std::get_if<Entered>(&action))
        entered(*change);
    else if (const auto* send = std::get_if<Send>(&action))
        sent(*send);
    else if (const auto* adopted = std::get_if<Adopt>(&action)) {
        m_since = m_now.mono; // a newer attempt may replace the one in hand
        m_laneLost.reset();
        m_sentSequence = 0;
        answered(adopted->connection);
    } else if (const auto* refused = std::get_if<Refuse>(&action))
        answered(refused->connection);
    else if (const auto* ignored = std::get_if<Ignore>(&action))
        answered(ignored->connection);
    else if (const auto* lost = std::get_if<SessionLost>(&action))
        expect(lost->incident != 0 && lost->incident == m_token, "an incident is named by the lost session's token");
    m_discarded = m_discarded || std::holds_alternative<DiscardControl>(action) || std::holds_alternative<DiscardAll>(action);
    m_outcomes += std::holds_alternative<SessionOpened>(action) || std::holds_alternative<OpenFailed>(action) ||
                          std::holds_alternative<SessionClosed>(action) || std::holds_alternative<SessionInterrupted>(action) ||
                          std::holds_alternative<SessionLost>(action)
                      ? 1
                      : 0;
}

void CheckedMachine::entered(const Entered& change)
{
    expect(change.from == m_state, "a state is left from where the session is");
    expect(isLegal(change.from, change.to), "the diagram has this arrow");
    if (carriesMessages(change.from) && !carriesMessages(change.to))
        m_left = true;
    expect(change.to != State::Open || !m_laneLost, "a dialogue that lost a lane opens nothing");
    if (!isDialogue(change.to) || !isDialogue(change.from))
        m_laneLost.reset();
    if (isDialogue(change.to))
        m_sentSequence = 0;
    if (change.to == State::Reconnecting)
        m_ownStall = m_hearsOfStall;
    const bool lost = change.to == State::Reconnecting || (change.to == State::StandBy && isLive(change.from));
    if (lost)
        expect(m_machine.guard().epoch() > m_epoch, "a loss raises the epoch");
    m_state = change.to;
    m_since = m_now.mono;
}

void CheckedMachine::sent(const Send& send)
{
    const auto* heartbeat = std::get_if<protocol::Heartbeat>(&send.message);
    if (heartbeat == nullptr)
        return;
    expect(heartbeat->sequence == m_sentSequence + 1, "heartbeats of a session are numbered without gaps");
    m_sentSequence = heartbeat->sequence;
    expect(heartbeat->epoch >= m_epoch && heartbeat->epoch <= m_machine.guard().epoch(), "a heartbeat says an epoch that holds");
    expect(!isOver(heartbeat->state), "no heartbeat says that there is no session");
}

void CheckedMachine::answered(ConnectionNumber connection) { expect(m_unanswered.erase(connection) == 1, "a handshake is answered once"); }

void CheckedMachine::checkState(State before)
{
    expect(m_machine.guard().epoch() >= m_epoch, "the epoch never falls");
    m_epoch = m_machine.guard().epoch();
    if (isOver(m_state)) {
        expect(!m_machine.isOutgoingUp() && !m_machine.isIncomingUp(), "a session that is over has no lane");
        expect(!m_machine.nextDeadline(), "a session that is over waits for nothing");
    } else {
        const auto next = m_machine.nextDeadline();
        expect(next.has_value(), "a session never waits for ever");
        expect(*next <= latestTick(), "a Tick is asked for when something is due");
    }
    if (m_state == State::Open && before == State::Reconnecting)
        expect(m_machine.isOutgoingUp() && m_machine.isIncomingUp(), "a session heals with both lanes");
    if (isDialogue(m_state) && !isDialogue(before))
        expect(!m_machine.stamper().ready(), "no control before a heartbeat of this session was heard");
    expect(m_unanswered.size() <= 1, "at most one handshake waits");
    if (!carriesMessages(m_state) && m_state != State::Closing && !(m_state == State::Reconnecting && m_ownStall))
        expect(m_unanswered.empty(), "no handshake waits for a session that is not open, interrupted by a stall of its own, or closing");
    if (m_machine.clock().samples() > 0)
        expect(m_machine.clock().uncertainty() >= 0ns, "an uncertainty is no less than nothing");
    expect(m_machine.jitter() >= 0ns, "a jitter is no less than nothing");
}

Instant CheckedMachine::latestTick() const
{
    switch (m_state) {
    case State::Opening:
    case State::Reopening:
        return std::min(m_since + longestDialogue, m_laneLost.value_or(Instant::max() - longestRejectedWait) + longestRejectedWait);
    case State::Closing:
        return m_since + longestClosing;
    case State::Reconnecting:
        return std::min(m_since + m_timing.reconnect, latestProof());
    case State::Open:
    case State::Suspect: {
        const auto silence = m_machine.monitor().lastHeard() + (m_state == State::Open ? m_timing.suspect : m_timing.lost);
        return std::min(silence, latestProof());
    }
    default:
        return Instant::max();
    }
}

Instant CheckedMachine::latestProof() const { return m_unanswered.empty() ? Instant::max() : m_waitsSince + m_timing.heartbeat * 3 / 2; }

void CheckedMachine::checkTick() const
{
    const auto deadline = m_machine.nextDeadline();
    expect(!deadline || *deadline > m_now.mono, "after a Tick the next one lies ahead");
    if (isDialogue(m_state))
        expect(m_now.mono < latestTick(), "a dialogue takes 3 s at most, and 200 ms without its lanes");
    else if (m_state == State::Closing)
        expect(m_now.mono < latestTick(), "a closing takes 1 s at most");
    else if (m_state == State::Reconnecting)
        expect(m_now.mono < latestTick(),
               "a loss heals within `reconnect` or is stand-by, and a handshake that a stall held up is answered");
    else if (carriesMessages(m_state))
        expect(m_now.mono < latestTick(), "silence is acted on, and a handshake waits for the proof of life of one heartbeat");
}

void CheckedMachine::endsInSilence()
{
    const auto limit = m_now.mono + 10s;
    for (int ticks = 0; !isOver(m_machine.state()); ++ticks) {
        expect(ticks < 2000 && m_now.mono < limit, "silence ends every session");
        passToDeadline();
    }
}

} // namespace liena::fuzz
