// What must hold whatever happens: invariants I1 to I12 of the reliability study, judged from what an onlooker sees.
#pragma once

#include "observation.hpp"

#include <deque>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace liena::simulation {

struct Violation {
    std::string invariant; ///< `I2`
    Instant at;
    std::string what;
};

/// What the model has to know of the system; written down again here, not taken from the code under test.
struct Rules {
    std::set<std::pair<HostIndex, HostIndex>> links; ///< lower host first
    std::map<HostIndex, std::uint32_t> ids;
    Nanoseconds lost = std::chrono::milliseconds(110);
    Nanoseconds motionAge = std::chrono::milliseconds(50);
    Nanoseconds lease = std::chrono::milliseconds(50);
    Nanoseconds ramp = std::chrono::milliseconds(25);                   ///< from any speed to standstill
    Nanoseconds agreement = std::chrono::milliseconds(60);              ///< two heartbeats and a round trip
    std::map<std::pair<HostIndex, std::uint16_t>, std::size_t> largest; ///< of each message, by the device whose set defines it
    std::size_t partialBytes = std::size_t{4} << 20U;
    std::size_t queuedBytes = std::size_t{64} << 20U; ///< of one lane
};

/// Independent of everything that it judges: it keeps its own view of each session, incident, message and drive.
class ReferenceModel {
public:
    explicit ReferenceModel(Rules rules) : m_rules(std::move(rules)) {}

    void note(Instant at, const Observation& observation);
    const std::vector<Violation>& violations() const { return m_violations; }
    std::uint64_t controlDelivered() const { return m_controlDelivered; }

private:
    using Pair = std::pair<HostIndex, HostIndex>;
    /// One device's end of a session.
    struct End {
        SessionState state = SessionState::Closed;
        Instant permitted; ///< nothing that was composed before it may be delivered
        bool openedBefore = false;
        std::uint32_t epoch = 0;
        std::map<std::uint16_t, std::pair<std::uint32_t, std::uint32_t>> delivered; ///< newest epoch and sequence
        std::map<std::uint16_t, std::uint64_t> stamps;
    };
    struct Device {
        std::map<IncidentId, Pair> incidents;
        Instant standsBySince;
        Instant engagedAt; ///< the newest engaged command was applied
        Instant engagedComposed;
        HostIndex owner = 0;
        bool lies = false;
        Instant resumed;
        bool paused = false;
        std::map<HostIndex, Instant> closedSince;
    };
    struct Sent {
        Instant at;
        HostIndex target = 0;
        std::uint32_t content = 0;
        bool delivered = false;
    };
    struct Dialogue {
        HostIndex device = 0;
        bool reopen = false;
        bool byPerson = false;
        IncidentId incident = 0;
        std::set<HostIndex> opened;
    };
    struct IncidentFacts {
        Pair pair;
        bool over = false;
    };

    void on(const Started& o);
    void on(const Ended& o);
    void on(const Requested& o);
    void on(const Entered& o);
    void on(const Lost& o);
    void on(const LaneTaken& o);
    void on(const Opened& o);
    void on(const Revoked& o);
    void on(const Raised& o);
    void on(const Over& o);
    void on(const Dismissed& o);
    void on(const Composed& o);
    void on(const Beat& o);
    void on(const Left& o);
    void on(const Unsent& o);
    void on(const Kept& o);
    void on(const Delivered& o);
    void on(const Dropped&) {}
    void on(const Applied& o);
    void on(const Drove& o);
    void on(const Holdings& o);
    void on(const Settled& o);
    void on(const Paused& o);
    void on(const Lies& o);

    void require(bool holds, const char* invariant, const std::string& what);
    void judgeControl(const Delivered& o, const Sent* sent);
    void judgeConfirmation(const Entered& o);
    void judgeOpening(const Opened& o);
    void drained(HostIndex device, HostIndex target, const MessageName& name);
    void forgetOld();
    static bool open(const End& end) { return end.state == SessionState::Open || end.state == SessionState::Suspect; }
    static Pair pairOf(HostIndex a, HostIndex b) { return std::minmax(a, b); }
    bool someoneLies() const;

    Rules m_rules;
    Instant m_now;
    std::map<HostIndex, Device> m_devices;
    std::map<Pair, End> m_ends;
    std::map<std::uint64_t, Dialogue> m_dialogues;
    std::map<IncidentId, IncidentFacts> m_lost; ///< every session that was lost, by its token
    std::map<MessageName, Sent> m_sent;
    std::deque<std::pair<Instant, MessageName>> m_bySending;
    std::map<Pair, std::set<MessageName>> m_waitingControl; ///< accepted, and neither left nor reported
    std::map<Pair, Settled> m_settled;
    std::vector<Violation> m_violations;
    std::uint64_t m_controlDelivered = 0;
};

} // namespace liena::simulation
