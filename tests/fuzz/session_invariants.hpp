// A session machine that is watched: after each event, everything that must hold in any state is asked.
#pragma once

#include "session/session_machine.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>

namespace liena::fuzz {

/// Keeps virtual time and what was seen so far.
class CheckedMachine {
public:
    explicit CheckedMachine(session::SessionSettings settings) : m_timing(settings.timing), m_machine(std::move(settings)) {}

    const session::SessionMachine* operator->() const { return &m_machine; }
    session::Now now() const { return m_now; }

    /// Never given before, never 0.
    std::uint64_t freshToken() { return ++m_lastToken; }
    session::ConnectionNumber freshConnection() { return ++m_lastConnection; }

    void pass(session::Nanoseconds time);

    /// To the machine's next deadline, and a Tick there.
    void passToDeadline();
    void handle(const session::SessionInput& input);
    void revoke();

    /// Nothing is heard any more: Closed or StandBy follows, in bounded time and with a bounded number of Ticks.
    void endsInSilence();

private:
    void noteBefore(const session::SessionInput& input);
    void checkConsequences(const session::SessionInput& input, SessionState before) const;
    void check(const session::SessionActions& actions, SessionState before);
    void checkAction(const session::SessionAction& action);
    void entered(const session::Entered& change);
    void sent(const session::Send& send);
    void answered(session::ConnectionNumber connection);
    void checkState(SessionState before);
    void checkTick() const;
    session::Instant latestTick() const;  ///< of the state in hand: what is due then changes it
    session::Instant latestProof() const; ///< a handshake that waits is answered before

    LinkTiming m_timing;
    session::SessionMachine m_machine;
    session::Now m_now{session::Instant(std::chrono::hours(1)), Timestamp{1'767'225'600'000'000'000}};
    std::uint64_t m_lastToken = 1000;
    session::ConnectionNumber m_lastConnection = 0;

    SessionState m_state = SessionState::Closed; ///< as the actions say it
    session::Instant m_since;                    ///< of that state, or of the newest attempt in it
    std::uint64_t m_token = 0;                   ///< of the session before the event in hand
    std::uint32_t m_epoch = 1;
    std::uint32_t m_sentSequence = 0; ///< of the newest heartbeat of the attempt or session in hand
    bool m_discarded = false;         ///< in the actions in hand: control that was queued is thrown away
    bool m_left = false;              ///< in the actions in hand: the session stopped carrying messages
    int m_outcomes = 0;               ///< in the actions in hand: opened, failed, closed, interrupted or lost
    std::set<session::ConnectionNumber> m_unanswered;
    session::Instant m_waitsSince;              ///< of the newest handshake that is unanswered, or of a stall since
    bool m_hearsOfStall = false;                ///< the event in hand is a stall of this device
    bool m_ownStall = false;                    ///< which interrupted the session
    std::optional<session::Instant> m_laneLost; ///< in the dialogue in hand
    bool m_mayReopen = false;                   ///< the person was shown the incident that is held
};

} // namespace liena::fuzz
