// One peer of a simulated device: the real session machine, fed and obeyed as system::DistributedModule does.
#pragma once

#include "datagram_path.hpp"
#include "fresh_connections.hpp"
#include "observation.hpp"

#include "liena/message.hpp"
#include "protocol/header_judge.hpp"
#include "session/session_machine.hpp"

#include <map>
#include <memory>
#include <optional>

namespace liena::simulation {

class SimulatedDevice;

/// Each decision is one of DistributedModule's and has its name there; what that does for the log and the application's figures is left
/// out.
class SimulatedModule : public ReceptionOwner {
public:
    SimulatedModule(SimulatedDevice& device, HostIndex peer, const LinkTiming& timing);

    // A person, or a keeper of links; false when the state does not allow it.
    bool open(bool byPerson);
    bool reopen(bool byPerson, IncidentId shown);
    bool close();
    void revoke();

    bool send(const Message& message);
    void attached(AttachedConnection connection);
    void datagramArrived(std::span<const std::byte> packet);
    void sendSession(const protocol::SessionMessage& message, DeviceId target);
    void setIncident(IncidentId incident, IncidentId ended);
    void setIncidentCount(std::size_t count) { m_machine.setIncidents(static_cast<std::uint16_t>(std::min<std::size_t>(count, 0xFFFF))); }
    void endForViolation(const std::string& detail) { violation(detail); }
    void stalled(Nanoseconds gap);
    void housekeeping();

    bool owns(std::uint64_t token) const;
    SessionState state() const { return m_machine.state(); }
    HostIndex peer() const { return m_peer; }
    const LinkTiming& timing() const { return m_timing; }
    const session::SessionMachine& machine() const { return m_machine; }
    std::size_t queuedBytes() { return m_laneZero.queue().bytes() + m_bulk.queue().bytes(); }
    Nanoseconds silence() const;
    std::size_t freshCount() const { return m_fresh.size(); }

private:
    struct Doer;

    // module_reception.cpp
    void turned() override;
    Judgement judge(std::uint8_t lane, const protocol::DatagramHeader& header) override;
    void received(std::uint8_t lane, const protocol::DatagramHeader& header, std::span<const std::byte> part) override;
    void kept(std::uint8_t lane, const protocol::DatagramHeader& header, std::size_t bytes) override;
    void violated(std::uint8_t lane, const std::string& detail) override { violation(std::to_string(lane) + ": " + detail); }
    void laneLost(std::uint8_t lane, const std::string& detail) override;
    protocol::HeaderJudgement judgeHeader(std::uint8_t lane, protocol::DatagramHeader header) const;
    protocol::Ends ends() const;
    bool isNewest(const MessageDefinition& definition, const protocol::DatagramHeader& header) const;
    SimulatedReception* incoming(std::uint8_t lane) const;
    Judgement violation(const std::string& detail);
    void receivedSession(std::uint8_t lane, const protocol::DatagramHeader& header, std::span<const std::byte> part);
    void commitHeard(const protocol::HandshakeCommit& commit, bool diagnosis, std::uint64_t previous);
    void setHeard(const protocol::MessageSetAnswer& answer);
    void setLearnt(std::uint64_t token, const Sha256& set, const session::SetHeard& heard);
    void receivedApplication(const protocol::DatagramHeader& header, std::span<const std::byte> part);
    bool passesGuard(const MessageDefinition& definition, const protocol::DatagramHeader& header, std::span<const std::byte> part);
    bool isForgiven(session::ControlFault fault) const;
    void deliver(const MessageDefinition& definition, const protocol::DatagramHeader& header, std::span<const std::byte> part);
    void drop(std::string_view cause, const protocol::DatagramHeader& header);

    // simulated_module.cpp: sessions
    void handle(const session::SessionInput& input);
    void perform(session::SessionActions actions);
    void armTimer();
    void sendMessage(const session::Send& send);
    void sendHeartbeat(protocol::Heartbeat heartbeat);
    void opened(const session::SessionOpened& opened);
    void entered(const session::Entered& change);
    void tell(SessionEvent::Kind kind, IncidentId incident = 0);
    protocol::EncodedMessage encode(const protocol::SessionMessage& message, DeviceId target);

    // module_lanes.cpp
    SimulatedLane::Handlers laneZeroHandlers();
    SimulatedLane::Handlers bulkHandlers();
    void connectLaneZero();
    void connectBulk();
    void retryBulk();
    void closeLanes(Nanoseconds grace);
    void adopt(session::ConnectionNumber number);
    void refuse(const session::Refuse& refusal);
    void admitFresh(AttachedConnection connection);
    void admitBulk(AttachedConnection connection);
    void endFresh(session::ConnectionNumber number);
    void handshakeHeard(session::ConnectionNumber number, const protocol::SessionMessage& message);
    bool sendPacket(const protocol::EncodedMessage& message);
    void laneZeroUp();
    void unsent(const tasks::OutputQueue::Entry& entry, tasks::OutputQueue::Fate fate);
    void leaving(std::vector<std::byte>& bytes, std::size_t begin);

    static constexpr std::uint8_t bulkLane = 1;

    SimulatedDevice& m_device;
    HostIndex m_peer;
    LinkTiming m_timing;
    session::SessionMachine m_machine;
    std::shared_ptr<const MessageSet> m_peerSet;

    SimulatedLane m_laneZero;
    SimulatedLane m_bulk;
    Program::Timer m_bulkRetry;
    std::unique_ptr<SimulatedReception> m_incoming;
    std::map<std::uint8_t, std::unique_ptr<SimulatedReception>> m_incomingBulk;
    std::map<session::ConnectionNumber, std::unique_ptr<SimulatedFresh>> m_fresh;
    session::ConnectionNumber m_nextConnection = 0;
    SimulatedCouriers m_couriers;
    DatagramPath m_datagrams;
    std::map<std::uint16_t, Timestamp> m_newest; ///< of the messages that may come on either path

    Program::Timer m_timer;
    std::optional<Instant> m_armed;
    Instant m_nextReport;
    std::uint32_t m_firstEpoch = 0; ///< for the mutant that never raises it
};

} // namespace liena::simulation
