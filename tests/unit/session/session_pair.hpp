// Two devices and everything that is on its way between them, in virtual time.
#pragma once

#include "session_side.hpp"

#include <functional>
#include <map>
#include <set>
#include <utility>

namespace liena::test {

inline constexpr auto delay = 2ms; ///< of everything that crosses

/// One device: its machine, its connection for lane 0 to the other, and what it has told.
struct Node {
    Node(DeviceId self, std::uint64_t firstToken) : machine(Side::settings(self)), nextToken(firstToken) {}

    session::SessionMachine machine;
    std::uint64_t nextToken;
    std::uint64_t lane = 0; ///< the connection that stands towards the other; 0: none
    std::uint64_t attempt = 0;
    std::uint64_t incoming = 0; ///< the connection of the other that is its lane 0 here
    bool silent = false;        ///< what it sends gets lost, its connections stand
    bool unreachable = false;   ///< nobody can connect to it
    std::string told;           ///< the events for the application
};

/// The world: two nodes and everything that is on its way between them.
class Pair {
public:
    Node robot{robotId, 100};
    Node cockpit{cockpitId, 500};

    void open(Node& node) { feed(node, session::OpenRequested{node.nextToken++}); }
    void reopen(Node& node) { feed(node, session::ReopenRequested{node.nextToken++}); }
    void close(Node& node) { feed(node, session::CloseRequested{"done"}); }

    /// The connection that `node` made breaks for both.
    void cut(Node& node)
    {
        const auto connection = std::exchange(node.lane, 0);
        if (connection == 0)
            return;
        later([this, &node] { feed(node, session::OutgoingLost{ProbeResult::NotProbed, "reset"}); });
        endAt(other(node), connection);
    }

    void run(std::chrono::nanoseconds time)
    {
        const auto until = m_now.mono + time;
        for (;;) {
            auto next = until;
            for (auto* node : {&robot, &cockpit})
                if (const auto due = node->machine.nextDeadline())
                    next = std::min(next, *due);
            if (!m_coming.empty())
                next = std::min(next, m_coming.begin()->first);
            if (next > m_now.mono) {
                m_now.wall.ns += static_cast<std::uint64_t>((next - m_now.mono).count());
                m_now.mono = next;
            }
            if (m_now.mono >= until)
                return;
            while (!m_coming.empty() && m_coming.begin()->first <= m_now.mono) {
                const auto event = std::move(m_coming.begin()->second);
                m_coming.erase(m_coming.begin());
                event();
            }
            for (auto* node : {&robot, &cockpit})
                feed(*node, session::Tick{});
        }
    }

    bool bothAre(SessionState state) const { return robot.machine.state() == state && cockpit.machine.state() == state; }

private:
    Node& other(Node& node) { return &node == &robot ? cockpit : robot; }
    void later(std::function<void()> event) { m_coming.emplace(m_now.mono + delay, std::move(event)); }

    void endAt(Node& node, std::uint64_t connection)
    {
        later([this, &node, connection] {
            m_fresh.erase(connection);
            if (node.incoming != connection)
                return;
            node.incoming = 0;
            feed(node, session::IncomingLost{"closed"});
        });
    }

    void feed(Node& node, const session::SessionInput& input)
    {
        for (const auto& action : node.machine.handle(input, m_now))
            std::visit([&](const auto& a) { perform(node, a); }, action);
    }

    void perform(Node& node, const session::ConnectLaneZero&)
    {
        const auto attempt = node.attempt = ++m_connections;
        const auto token = node.machine.token();
        later([this, &node, attempt, token] {
            if (node.attempt != attempt)
                return;
            node.attempt = 0;
            if (other(node).unreachable)
                return feed(node, session::OutgoingFailed{ProbeResult::HostUnreachable, "no answer"});
            if (node.lane != 0)
                endAt(other(node), node.lane);
            node.lane = attempt;
            attach(other(node), attempt, token);
            feed(node, session::OutgoingUp{});
        });
    }

    /// Attach arrives: of the session in hand it is lane 0, otherwise it waits for its Handshake.
    void attach(Node& node, std::uint64_t connection, std::uint64_t token)
    {
        const auto state = node.machine.state();
        const bool inSession = state != SessionState::Closed && state != SessionState::StandBy && node.machine.token() == token;
        if (inSession) {
            node.incoming = connection;
            feed(node, session::IncomingUp{});
        } else {
            m_fresh.insert_or_assign(connection, token);
        }
    }

    void perform(Node& node, const session::Send& send)
    {
        if (node.lane == 0 || node.silent)
            return;
        const auto connection = node.lane;
        later([this, &node, connection, message = send.message] { arrive(other(node), connection, message); });
    }

    void arrive(Node& to, std::uint64_t connection, const protocol::SessionMessage& message)
    {
        if (const auto fresh = m_fresh.find(connection); fresh != m_fresh.end()) {
            const auto* plain = std::get_if<protocol::Handshake>(&message);
            const auto* diagnosis = std::get_if<protocol::DiagnosisHandshake>(&message);
            if (plain != nullptr)
                feed(to, session::HandshakeHeard{connection, *plain, false, 0, session::SetStanding::Held});
            else if (diagnosis != nullptr)
                feed(to, session::HandshakeHeard{connection, diagnosis->handshake, true, diagnosis->previous, session::SetStanding::Held});
            return;
        }
        if (to.incoming != connection || m_ended.contains(connection))
            return;
        feed(to, session::LifeHeard{});
        if (const auto* commit = std::get_if<protocol::HandshakeCommit>(&message))
            feed(to, session::CommitHeard{*commit, false, 0, session::SetStanding::Held});
        else if (const auto* again = std::get_if<protocol::DiagnosisHandshakeCommit>(&message))
            feed(to, session::CommitHeard{again->commit, true, again->previous, session::SetStanding::Held});
        else
            feed(to, session::SessionMessageHeard{message});
    }

    void perform(Node& node, const session::CloseLanes&)
    {
        node.attempt = 0;
        if (const auto lane = std::exchange(node.lane, 0); lane != 0)
            endAt(other(node), lane);
        if (const auto incoming = std::exchange(node.incoming, 0); incoming != 0) {
            m_ended.insert(incoming);
            auto& peer = other(node);
            later([this, &peer, incoming] {
                if (peer.lane != incoming)
                    return;
                peer.lane = 0;
                feed(peer, session::OutgoingLost{ProbeResult::NotProbed, "closed by the peer"});
            });
        }
    }

    void perform(Node& node, const session::Adopt& adopt)
    {
        m_fresh.erase(adopt.connection);
        node.incoming = adopt.connection;
    }

    void perform(Node& node, const session::Refuse& refuse)
    {
        m_fresh.erase(refuse.connection);
        auto& peer = other(node);
        const protocol::Rejected rejected{refuse.token, refuse.reason, {refuse.detail}};
        later([this, &peer, rejected] {
            if (peer.machine.token() == rejected.token)
                feed(peer, session::SessionMessageHeard{rejected});
        });
    }

    void perform(Node& node, const session::SessionOpened& opened) { tell(node, opened.reopened ? "reopened" : "opened"); }
    void perform(Node& node, const session::OpenFailed& failed) { tell(node, "failed:" + nameOf(failed.reason)); }
    void perform(Node& node, const session::SessionClosed& closed) { tell(node, closed.byPeer ? "closed-by-peer" : "closed"); }
    void perform(Node& node, const session::SessionInterrupted&) { tell(node, "interrupted"); }
    void perform(Node& node, const session::SessionLost& lost) { tell(node, "lost:" + nameOf(lost.diagnosis.cause)); }
    void perform(Node& node, const session::Entered& entered)
    {
        if (entered.to == SessionState::Suspect)
            tell(node, "suspect");
        else if (entered.to == SessionState::Reconnecting)
            tell(node, "reconnecting");
    }
    void perform(Node&, const auto&) {}

    static void tell(Node& node, const std::string& word) { node.told += (node.told.empty() ? "" : " ") + word; }

    session::Now m_now{session::Instant(1h), Timestamp{1'000'000'000'000}};
    std::multimap<session::Instant, std::function<void()>> m_coming;
    std::map<std::uint64_t, std::uint64_t> m_fresh; ///< connections whose Handshake is awaited, with the token of their Attach
    std::set<std::uint64_t> m_ended;                ///< connections that the receiver closed
    std::uint64_t m_connections = 0;
};

} // namespace liena::test
