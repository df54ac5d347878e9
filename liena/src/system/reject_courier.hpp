// Brings Rejected to a device that has no lane of ours yet (ruling A5): connect back, Attach, Rejected, within one second.
#pragma once

#include "system/fresh_connection.hpp"
#include "system/module_host.hpp"
#include "tasks/output_lane.hpp"

#include <list>
#include <memory>

namespace liena::system {

/// Network thread. Best effort: the refused connection is closed 100 ms after Rejected was written, or at once when it cannot be delivered.
class RejectCouriers {
public:
    RejectCouriers(ModuleHost& host, TopologyDevice peer) : m_host(host), m_peer(std::move(peer)) {}

    void send(std::unique_ptr<FreshConnection> refused, protocol::EncodedMessage attach, protocol::EncodedMessage rejected);
    void clear() { m_trips.clear(); }

private:
    struct Trip {
        Trip(ModuleHost& host, const TopologyDevice& peer, tasks::OutputLane::Handlers handlers)
            : lane(host.io(), peer, host.identity(), {}, std::move(handlers)), timer(host.io())
        {}
        std::unique_ptr<FreshConnection> refused;
        tasks::OutputLane lane;
        transport::Timer timer;
    };

    void end(const Trip* trip);

    static constexpr std::size_t mostTrips = 8;

    ModuleHost& m_host;
    TopologyDevice m_peer;
    std::list<std::shared_ptr<Trip>> m_trips;
};

} // namespace liena::system
