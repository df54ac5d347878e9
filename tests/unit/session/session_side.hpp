// One session machine in virtual time, and its actions in words.
#pragma once

#include "session/session_machine.hpp"

#include <string>
#include <type_traits>

namespace liena::test {

using namespace std::chrono_literals;

inline constexpr DeviceId robotId(0x00008208U);   // the lower id: it leads
inline constexpr DeviceId cockpitId(0x40018208U); // the higher id
inline const Sha256 topologyHash = Sha256::of(std::string_view("topology"));
inline const Sha256 robotSet = Sha256::of(std::string_view("robot set"));
inline const Sha256 cockpitSet = Sha256::of(std::string_view("cockpit set"));

inline std::string nameOf(SessionState state)
{
    static constexpr const char* names[] = {"Closed", "Opening", "Open", "Suspect", "Reconnecting", "StandBy", "Reopening", "Closing"};
    return names[static_cast<std::size_t>(state)];
}

inline std::string nameOf(RejectReason reason)
{
    static constexpr const char* names[] = {
        "None", "UnknownPeer",       "NoLink",  "TopologyMismatch", "ProtocolVersion", "MessageSetInvalid", "StandBy",
        "Busy", "ProtocolViolation", "Timeout", "ShuttingDown",     "AlreadyOpen",     "MessageSetChanged", "NotAdmitted"};
    return names[static_cast<std::size_t>(reason)];
}

inline std::string nameOf(LossCause cause)
{
    static constexpr const char* names[] = {"None", "HeartbeatLost", "ConnectionLost", "PeerRestarted", "ProtocolViolation", "LocalStall"};
    return names[static_cast<std::size_t>(cause)];
}

/// `Handshake` for what is sent, `Refuse:StandBy`, `Lost:HeartbeatLost`; Entered is left out: the state says it.
inline std::string wordOf(const session::SessionAction& action)
{
    using namespace session;
    return std::visit(
        [](const auto& a) -> std::string {
            using A = std::decay_t<decltype(a)>;
            if constexpr (std::is_same_v<A, ConnectLaneZero>)
                return "Connect";
            else if constexpr (std::is_same_v<A, CloseLanes>)
                return "CloseLanes";
            else if constexpr (std::is_same_v<A, Adopt>)
                return "Adopt";
            else if constexpr (std::is_same_v<A, Refuse>)
                return "Refuse:" + nameOf(a.reason);
            else if constexpr (std::is_same_v<A, Ignore>)
                return "Ignore";
            else if constexpr (std::is_same_v<A, Send>)
                return std::string(protocol::nameOf(a.message)) + (a.afterOutput ? "(last)" : "");
            else if constexpr (std::is_same_v<A, SendOwnSet>)
                return "OwnSet";
            else if constexpr (std::is_same_v<A, DiscardControl>)
                return "DiscardControl";
            else if constexpr (std::is_same_v<A, DiscardAll>)
                return "DiscardAll";
            else if constexpr (std::is_same_v<A, SessionOpened>)
                return a.reopened ? "ReOpened" : "Opened";
            else if constexpr (std::is_same_v<A, OpenFailed>)
                return "Failed:" + nameOf(a.reason);
            else if constexpr (std::is_same_v<A, SessionClosed>)
                return a.byPeer ? "ClosedByPeer" : "Closed";
            else if constexpr (std::is_same_v<A, SessionInterrupted>)
                return "Interrupted";
            else if constexpr (std::is_same_v<A, SessionLost>)
                return "Lost:" + nameOf(a.diagnosis.cause);
            else
                return {};
        },
        action);
}

inline std::string wordsOf(const session::SessionActions& actions)
{
    std::string words;
    for (const auto& action : actions)
        if (const auto word = wordOf(action); !word.empty())
            words += (words.empty() ? "" : " ") + word;
    return words;
}

template <typename T>
const T* find(const session::SessionActions& actions)
{
    for (const auto& action : actions)
        if (const auto* found = std::get_if<T>(&action))
            return found;
    return nullptr;
}

/// The session message of that type among the actions, or null.
template <typename T>
const T* findSent(const session::SessionActions& actions)
{
    for (const auto& action : actions)
        if (const auto* send = std::get_if<session::Send>(&action))
            if (const auto* message = std::get_if<T>(&send->message))
                return message;
    return nullptr;
}

/// A machine, its clock, and a peer that is only words.
struct Side {
    static session::SessionSettings settings(DeviceId self)
    {
        const bool robot = self == robotId;
        return {self, robot ? cockpitId : robotId, LinkTiming(), topologyHash, robot ? robotSet : cockpitSet, "test"};
    }

    explicit Side(DeviceId self = robotId) : machine(settings(self)), peerSet(self == robotId ? cockpitSet : robotSet) {}

    session::SessionMachine machine;
    Sha256 peerSet;
    session::Now now{session::Instant(1h), Timestamp{1'000'000'000'000}};
    std::uint32_t peerSequence = 0;
    std::uint32_t peerEpoch = 1;
    SessionState peerState = SessionState::Open;

    void pass(std::chrono::nanoseconds time)
    {
        now.mono += time;
        now.wall.ns += static_cast<std::uint64_t>(time.count());
    }

    session::SessionActions handle(const session::SessionInput& input) { return machine.handle(input, now); }
    session::SessionActions hear(const protocol::SessionMessage& message) { return handle(session::SessionMessageHeard{message}); }
    session::SessionActions tick(std::chrono::nanoseconds after = 0ns)
    {
        pass(after);
        return handle(session::Tick{});
    }

    session::HandshakeHeard handshake(std::uint64_t token, bool diagnosis = false, std::uint64_t previous = 0) const
    {
        return {7, {token, topologyHash, peerSet, {"peer"}}, diagnosis, previous, session::SetStanding::Held};
    }
    session::CommitHeard commit(bool diagnosis = false) const
    {
        return {{machine.token(), peerSet, false, {"peer"}}, diagnosis, 0, session::SetStanding::Held};
    }

    /// The peer's next heartbeat, as the shell tells of it: life, then the message.
    session::SessionActions beat(session::LifePath path = session::LifePath::LaneZero)
    {
        auto actions = handle(session::LifeHeard{path});
        protocol::Heartbeat heartbeat;
        heartbeat.sequence = ++peerSequence;
        heartbeat.sentNs = now.wall.ns;
        heartbeat.state = peerState;
        heartbeat.epoch = peerEpoch;
        for (auto& action : hear(heartbeat))
            actions.push_back(std::move(action));
        return actions;
    }

    /// Beats and ticks every 20 ms, until just before `time` has passed.
    void live(std::chrono::nanoseconds time)
    {
        for (auto step = 20ms; step <= time; step += 20ms) {
            pass(20ms);
            handle(session::Tick{});
            beat();
        }
    }

    void becomeOpening(std::uint64_t token = 100)
    {
        handle(session::OpenRequested{token});
        handle(session::OutgoingUp{});
        handle(session::IncomingUp{});
        handle(session::Tick{});
    }
    void becomeResponder(std::uint64_t token = 100)
    {
        handle(handshake(token));
        handle(session::OutgoingUp{});
        handle(session::Tick{});
    }
    void becomeOpen(std::uint64_t token = 100)
    {
        becomeOpening(token);
        handle(commit());
        peerSequence = 0;
        beat();
    }
    void becomeSuspect()
    {
        becomeOpen();
        tick(70ms);
    }
    void becomeReconnecting()
    {
        becomeOpen();
        tick(110ms);
    }
    void becomeStandBy()
    {
        becomeOpen();
        handle(session::ViolationFound{"a violation"});
    }
    void becomeReopening(std::uint64_t token = 200)
    {
        becomeStandBy();
        handle(session::ReopenRequested{token});
        handle(session::OutgoingUp{});
        handle(session::IncomingUp{});
        handle(session::Tick{});
    }
    void becomeReopeningResponder(std::uint64_t token = 200)
    {
        becomeStandBy();
        handle(handshake(token, true, 100));
        handle(session::OutgoingUp{});
        handle(session::Tick{});
    }
    void becomeClosing()
    {
        becomeOpen();
        handle(session::CloseRequested{"done"});
    }
    void becomeClosingByPeer()
    {
        becomeOpen();
        hear(protocol::Disengagement{machine.token(), {"done"}});
    }
};

} // namespace liena::test
