// Connections of a peer whose handshake is still to come, and the couriers that refuse them.
#pragma once

#include "simulated_lane.hpp"
#include "simulated_reception.hpp"

#include "protocol/session_messages.hpp"

#include <functional>
#include <list>
#include <memory>

namespace liena::simulation {

/// What the acceptor knows of a connection once its Attach was read.
struct AttachedConnection {
    ConnectionNumber connection = 0;
    HostIndex from = 0;
    DeviceId peer; ///< authenticated
    std::unique_ptr<protocol::DatagramDecoder> decoder;
    protocol::Attach attach;
};

/// Plays system::FreshConnection.
class SimulatedFresh : public ReceptionOwner {
public:
    struct Handlers {
        std::function<void()> turned;
        std::function<void(const protocol::SessionMessage&)> handshake;
        std::function<void()> ended;
    };

    SimulatedFresh(Program& program, AttachedConnection connection, DeviceId self, protocol::PartialBudget& budget, Handlers handlers);

    void start();
    void ignore();
    std::unique_ptr<SimulatedReception> release();
    void close();
    std::uint64_t token() const { return m_token; }

private:
    void turned() override { m_handlers.turned(); }
    Judgement judge(std::uint8_t lane, const protocol::DatagramHeader& header) override;
    void received(std::uint8_t lane, const protocol::DatagramHeader& header, std::span<const std::byte> part) override;
    void violated(std::uint8_t lane, const std::string& detail) override;
    void laneLost(std::uint8_t lane, const std::string& detail) override;

    std::uint64_t m_token;
    DeviceId m_peer;
    DeviceId m_self;
    Handlers m_handlers;
    Program::Timer m_timer;
    std::unique_ptr<SimulatedReception> m_reception;
    bool m_heard = false;
};

/// Plays system::RejectCouriers.
class SimulatedCouriers {
public:
    SimulatedCouriers(Program& program, HostIndex peer) : m_program(program), m_peer(peer) {}

    void send(std::unique_ptr<SimulatedFresh> refused, const protocol::EncodedMessage& attach, protocol::EncodedMessage rejected);
    std::size_t size() const { return m_trips.size(); }

private:
    struct Trip {
        Trip(Program& program, HostIndex peer, SimulatedLane::Handlers handlers)
            : lane(program, peer, {}, std::move(handlers)), timer(program)
        {}
        std::unique_ptr<SimulatedFresh> refused;
        SimulatedLane lane;
        Program::Timer timer;
    };

    void end(const Trip* trip);

    Program& m_program;
    HostIndex m_peer;
    std::list<std::shared_ptr<Trip>> m_trips;
};

} // namespace liena::simulation
