// Accepting connections, and their short life before the Attach.
#pragma once

#include "fresh_connections.hpp"

#include <functional>
#include <list>

namespace liena::simulation {

/// Plays transport::TcpServer; TLS has told already who connects.
class SimulatedServer {
public:
    using Attached = std::function<void(AttachedConnection)>;

    SimulatedServer(Program& program, DeviceId self, Attached attached);
    ~SimulatedServer();

    void admit(ConnectionNumber connection, HostIndex from, DeviceId peer);
    std::size_t pending() const { return m_pending.size(); }

private:
    class Pending;
    void forget(const Pending* pending);

    static constexpr std::size_t mostPending = 64;
    static constexpr std::size_t mostPerAddress = 8;

    Program& m_program;
    DeviceId m_self;
    Attached m_attached;
    std::list<std::unique_ptr<Pending>> m_pending;
};

} // namespace liena::simulation
