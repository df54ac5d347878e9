// One peer: its session machine, its lanes, and what crosses them.
#pragma once

#include "base/cause_books.hpp"
#include "protocol/header_judge.hpp"
#include "session/session_machine.hpp"
#include "system/datagram_path.hpp"
#include "system/deadline_watch.hpp"
#include "system/fresh_connection.hpp"
#include "system/line_measurement.hpp"
#include "system/module_host.hpp"
#include "system/reject_courier.hpp"
#include "system/session_encoding.hpp"
#include "system/traffic_books.hpp"
#include "tasks/bulk_lanes.hpp"
#include "tasks/output_lane.hpp"
#include "tasks/reception_task.hpp"
#include "transport/tcp_server.hpp"
#include "transport/timer.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace liena::system {

/// Network thread. The shell around SessionMachine: it moves bytes and time in, and does what the machine says.
class DistributedModule : public tasks::LaneSink {
public:
    DistributedModule(ModuleHost& host, TopologyDevice peer, TopologyLink link);

    // Dialogues; the outcome is an event.
    Result<void> open();
    Result<void> reopen(IncidentId seen);
    Result<void> close(std::string_view reason);
    void probe();

    void revoke();

    /// Accepts a message for the peer or says why not.
    Result<void> send(Message&& message);

    /// From its beginning to its end what is sent by lane 0 only waits there.
    void gather(bool begins) { m_laneZero.gather(begins); }

    /// Measures the line to the peer, beside all else.
    Result<void> measure(MeasurementPlan plan, DistributedSystem::MeasurementHandler done);
    void stopMeasuring() { m_measurement.stop("it was stopped"); }
    /// Of the line to the peer, whoever asked.
    int measurementsRunning() const { return m_measurement.running(); }

    /// When a command, a safety message or an image was sent or delivered last.
    session::Instant lastUse() const { return m_usedSince ? std::chrono::steady_clock::now() : m_lastUse; }

    /// A connection of the peer with its Attach.
    void attached(transport::AttachedConnection connection);

    /// A UDP packet with that token is for this module.
    bool owns(std::uint64_t token) const;
    void packetHeard(std::span<std::byte> packet);

    /// To the peer alone, or as the next hop of a broadcast.
    void sendSession(const protocol::SessionMessage& message, DeviceId target);

    /// This pair's incident, 0 when it has none any more.
    void setIncident(IncidentId incident, IncidentId ended);
    void setIncidentCount(std::size_t count);

    /// A set of the peer is in the store, or why not; `token` is that of the attempt in which it was sent.
    void setLearnt(std::uint64_t token, const Sha256& set, const session::SetHeard& heard);

    /// What the peer told breaks the protocol.
    void endForViolation(const std::string& detail) { violation(detail); }
    /// An incident message of the peer is passed over, and it is not to blame.
    void notTaken(const std::string& cause, std::uint16_t number) { drop(cause, number); }

    /// The thread did not run for `gap`.
    void stalled(session::Nanoseconds gap);
    /// There is a session, and its peer may have missed us.
    bool isConcernedBy(session::Nanoseconds gap) const
    {
        return gap >= m_link.timing.suspect && (carriesMessages(state()) || state() == SessionState::Reconnecting);
    }

    /// Once per heartbeat or so: deadlines, reports, figures.
    void housekeeping();

    SessionState state() const { return m_machine.state(); }
    std::uint64_t token() const { return m_machine.token(); }
    const TopologyDevice& peer() const { return m_peer; }
    const LinkTiming& timing() const { return m_link.timing; }
    std::shared_ptr<const MessageSet> peerSet() const { return m_peerSet; }

    /// What the application makes commands from: the register's set until a session brings one. The link board shows it to other threads.
    const std::shared_ptr<const MessageSet>& knownSet() const { return m_knownSet; }
    void setKnown(std::shared_ptr<const MessageSet> set) { m_knownSet = std::move(set); }
    LinkStatus status() const;

    /// Ends everything at once, without a word.
    void abort();

private:
    // LaneSink (module_reception.cpp)
    void turned() override
    {
        m_lifeTold = false;
        m_host.turned();
    }
    tasks::Judgement judge(std::uint8_t lane, const protocol::DatagramHeader& header) override;
    void received(std::uint8_t lane, const protocol::DatagramHeader& header, std::span<const std::byte> part, FieldBytes* owned) override;
    void overBudget(const protocol::DatagramHeader& header, const protocol::Reassembler::OverBudget& passed) override;
    void violated(std::uint8_t lane, const std::string& detail) override;
    void laneLost(std::uint8_t lane, const std::string& detail) override;

    tasks::Judgement violation(const std::string& detail);
    void skip(const protocol::DatagramHeader& header, const std::string& why);
    void receivedInVain(const protocol::DatagramHeader& header, std::size_t bytes);
    void hearFrom(std::shared_ptr<const MessageSet> set);
    const MessageDefinition* definitionOf(std::uint16_t number) const;
    void receivedSession(std::uint8_t lane, const protocol::DatagramHeader& header, std::span<const std::byte> part);
    void receivedApplication(const protocol::DatagramHeader& header, std::span<const std::byte> part, FieldBytes* owned);
    bool passesGuard(const MessageDefinition& definition, const protocol::DatagramHeader& header, std::span<const std::byte> part,
                     session::Instant now);
    void deliver(const MessageDefinition& definition, const protocol::DatagramHeader& header, std::span<const std::byte> fields,
                 FieldBytes* owned, session::Now now);
    void commitHeard(const protocol::HandshakeCommit& commit, bool diagnosis, std::uint64_t previous);
    void setHeard(const protocol::MessageSetAnswer& answer);
    bool isNewest(const MessageDefinition& definition, const protocol::DatagramHeader& header) const;
    tasks::ReceptionTask* incoming(std::uint8_t lane) const;

    // module_measurement.cpp
    LineMeasurement::Ways measuringWays();
    bool admitsProbe(std::uint8_t lane, const protocol::DatagramHeader& header);
    bool heardMeasurement(protocol::ProbeWay arrived, const protocol::DatagramHeader& header, std::span<const std::byte> part);

    // module_datagrams.cpp
    void packetViolation(const std::string& detail, const protocol::DatagramHeader& header);
    void sendHeartbeat(const protocol::Heartbeat& heartbeat);

    void drop(const std::string& cause, std::uint16_t number, const std::string& detail = {});

    // Sessions (distributed_module.cpp) and their lanes (module_lanes.cpp)
    void handle(const session::SessionInput& input);
    void perform(session::SessionActions actions);
    void perform(session::SessionAction& action);
    void connectLaneZero();
    void laneZeroUp();
    void bulkLaneLost(std::uint8_t lane, const std::string& detail);
    std::size_t backlog() const;
    void notSent(const tasks::OutputQueue::Entry& entry, tasks::OutputQueue::Fate fate);
    void closeLanes(session::Nanoseconds grace);
    void adopt(session::ConnectionNumber number);
    void refuse(const session::Refuse& refusal);
    void entered(const session::Entered& change);
    void opened(const session::SessionOpened& opened);
    void lost(const session::SessionLost& lost);
    void openFailed(const session::OpenFailed& failed);
    void handshakeHeard(session::ConnectionNumber number, const protocol::SessionMessage& message, const Result<void>& certificates);
    void admitFresh(transport::AttachedConnection connection);
    void admitBulk(transport::AttachedConnection connection);
    void endFresh(session::ConnectionNumber number);
    void armTimer();
    void greetAnew();
    void showStatus();
    void sendReport(session::Instant now);
    void checkDeadlines(session::Instant now);
    void showDrops();
    void settle(const tasks::ReceptionTask& ended);
    void bury(std::shared_ptr<void> ended);
    Result<void> notAdmitted(Result<void> why);
    Result<void> admit(transport::TcpChannel& channel) const;
    Result<void> checkSendable(const Message& message) const;
    SessionEvent event(SessionEvent::Kind kind) const;
    void say(LogLevel level, std::string_view event, const std::string& text) const;
    protocol::EncodedMessage abandon(const protocol::DatagramHeader& begun);
    protocol::EncodedMessage encode(const protocol::SessionMessage& message, DeviceId target);

    ModuleHost& m_host;
    TopologyDevice m_peer;
    TopologyLink m_link;
    session::SessionMachine m_machine;
    std::shared_ptr<const MessageSet> m_peerSet;  ///< pinned or learnt; null while unknown
    std::shared_ptr<const MessageSet> m_knownSet; ///< before a session, too
    protocol::Ends m_ends;
    const MessageDefinition* m_judged = nullptr; ///< of the header that was judged last; inside one of the sets of m_ends

    tasks::OutputLane m_laneZero;
    tasks::BulkLanes m_bulk;
    DatagramPath m_datagrams;
    std::map<std::uint16_t, Timestamp> m_newest; ///< delivered, of each message that may travel by UDP
    std::unique_ptr<tasks::ReceptionTask> m_incoming;
    std::map<std::uint8_t, std::unique_ptr<tasks::ReceptionTask>> m_incomingBulk;
    std::map<session::ConnectionNumber, std::unique_ptr<FreshConnection>> m_fresh;
    session::ConnectionNumber m_nextConnection = 0;
    RejectCouriers m_couriers;

    transport::Timer m_timer;
    std::optional<session::Instant> m_armed;
    std::unique_ptr<transport::TcpClient> m_probe;
    session::SessionLost m_loss{}; ///< the last one, in words that may be printed

    LineMeasurement m_measurement;
    session::Instant m_lastUse;
    bool m_usedSince = false; ///< the last housekeeping

    TrafficBooks m_books;
    DeadlineWatch m_deadlines;
    session::Instant m_nextReport;
    session::Instant m_nextDrops;
    std::optional<std::chrono::nanoseconds> m_latency;         ///< of the last report
    base::CauseBooks m_failures{64, std::chrono::seconds(60)}; ///< to open, for the log
    base::CauseBooks m_refusals{64};                           ///< of handshakes
    std::uint32_t m_interruptions = 0;
    bool m_greetingDue = false;        ///< so much of incidents waited that something was left out
    bool m_lifeTold = false;           ///< what one read brings is one sign of life
    std::uint64_t m_bytesReceived = 0; ///< of lanes that ended
    std::uint64_t m_abandoned = 0;     ///< of lanes that ended

    std::shared_ptr<const bool> m_alive = std::make_shared<const bool>(true); ///< gone with us: what we posted may come later
};

} // namespace liena::system
