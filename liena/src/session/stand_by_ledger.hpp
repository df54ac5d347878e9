// The incidents that a device holds, and how they spread and end (protocol section 8; rulings A8, B20).
#pragma once

#include "liena/session_event.hpp"
#include "protocol/session_messages.hpp"
#include "session/instant.hpp"

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace liena::session {

/// To every session that carries messages, except the one with `except` (from which it came).
struct Broadcast {
    protocol::SessionMessage message;
    std::optional<DeviceId> except;
};
/// To one neighbour.
struct Answer {
    DeviceId to;
    protocol::SessionMessage message;
};
/// For the application: one of the event kinds that begin with Incident, Hold or StandBy.
struct Tell {
    SessionEvent event;
};
/// The link between this device and `peer` holds that incident now, or none any more (0).
struct PairChanged {
    DeviceId peer;
    IncidentId incident = 0;
    IncidentId ended = 0; ///< the one that is over now, if one is
};
/// A neighbour told of an incident that cannot be.
struct LedgerViolation {
    DeviceId peer;
    std::string detail;
};

/// One incident more than is kept. Whoever told may have handed on what a third one invented: it is not blamed.
struct IncidentNotKept {
    DeviceId teller;
};

/// More news than is handed on of one neighbour. It is not blamed either.
struct NewsNotHandedOn {
    DeviceId teller;
    std::uint16_t number = 0; ///< of the message
};

using LedgerAction = std::variant<Broadcast, Answer, Tell, PairChanged, LedgerViolation, IncidentNotKept, NewsNotHandedOn>;
using LedgerActions = std::vector<LedgerAction>;

/// Pure; one per device. A device that holds an incident stands by.
///
/// News goes to every other neighbour, so what one of them may bring is bounded. Of each kind of message at once as many are handed on as
/// speak of a whole system in stand-by (both ends' causes and every device's hold, for as many incidents as are kept). Another time as many
/// are taken and kept here, so that a neighbour who hands on what a third one invents is heard for itself, too; twice as many come again in
/// 15 s. What ends an incident that is held is always handed on.
class StandByLedger {
public:
    /// `devices`: of the whole system.
    explicit StandByLedger(DeviceId self, std::size_t devices = 64)
        : m_self(self), m_mostNews(static_cast<double>(mostIncidents * (devices + 2)))
    {}

    bool standsBy() const { return !m_incidents.empty(); }
    std::size_t size() const { return m_incidents.size(); }
    std::vector<Incident> incidents() const;
    const Incident* find(IncidentId id) const;
    /// Held, or ended not long ago: no session may have that name.
    bool knows(IncidentId id, Now now) const { return m_incidents.contains(id) || findEnded(id, now) != nullptr; }

    /// Our session with a peer was lost.
    LedgerActions lost(DeviceId peer, IncidentId id, LossCause cause, Timestamp since, Now now);

    /// Our session with a peer was re-opened by the dialogue with that token.
    LedgerActions reopened(DeviceId peer, std::uint64_t token, IncidentId named, Now now);

    /// A person gives an incident up; empty when it is not held.
    LedgerActions dismiss(IncidentId id, const std::string& reason, Now now);

    /// This device holds, or no longer does.
    LedgerActions confirmHold(bool holding, Now now);

    /// A session was opened: what the new neighbour has to know.
    LedgerActions greet(DeviceId peer) const;

    LedgerActions heard(DeviceId from, const protocol::StandBy& message, Now now);
    LedgerActions heard(DeviceId from, const protocol::StandByReport& message, Now now);
    LedgerActions heard(DeviceId from, const protocol::IncidentDismissed& message, Now now);
    LedgerActions heard(DeviceId from, const protocol::ChannelReOpened& message, Now now);

private:
    enum class News : std::uint8_t { HandOn, Keep, Drop };
    struct Ended {
        IncidentId id = 0;
        protocol::SessionMessage by; ///< the ChannelReOpened or IncidentDismissed that ended it
        Instant at;
    };

    void raise(const protocol::StandBy& message, std::optional<DeviceId> from, LedgerActions& actions, Now now);
    void noteCause(const protocol::StandBy& message, std::optional<DeviceId> from, LedgerActions& actions, Now now);
    static LossCause& causeAt(Incident& incident, DeviceId end);
    void end(IncidentId id, const protocol::SessionMessage& by, DeviceId teller, bool dismissed, const std::string& detail,
             LedgerActions& actions, Now now);
    void report(IncidentId id, LedgerActions& actions) const;
    void rememberEnded(IncidentId id, const protocol::SessionMessage& by, Now now);
    const Ended* findEnded(IncidentId id, Now now) const;
    bool isRemembered(const protocol::ChannelReOpened& message) const;
    void remember(const protocol::ChannelReOpened& message);
    News judgeNews(DeviceId from, std::uint16_t number, Now now);
    static void keepHere(LedgerActions& actions, DeviceId teller, std::uint16_t number);
    std::optional<DeviceId> otherEnd(const Incident& incident) const;

    static constexpr std::size_t mostIncidents = 256;
    static constexpr std::size_t mostEnded = 4096;
    static constexpr auto endedLife = std::chrono::hours(24);
    static constexpr double newsPeriod = 15; // seconds

    struct Allowance {
        double left;
        Instant at;
    };

    DeviceId m_self;
    double m_mostNews;
    std::map<std::pair<DeviceId, std::uint16_t>, Allowance> m_allowances; ///< by neighbour and number of the message
    std::map<IncidentId, Incident> m_incidents;
    std::deque<Ended> m_ended;
    std::deque<std::pair<std::uint64_t, IncidentId>> m_reopenings; ///< ChannelReOpened already handed on: token and what it ends
    bool m_holding = false;
    Timestamp m_holdingSince;
};

} // namespace liena::session
