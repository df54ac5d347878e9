// What a module needs of the device it is part of.
#pragma once

#include "audit/audit_chain.hpp"
#include "liena/log.hpp"
#include "liena/message.hpp"
#include "liena/session_event.hpp"
#include "liena/settings.hpp"
#include "liena/system_topology.hpp"
#include "protocol/reassembler.hpp"
#include "security/tls_identity.hpp"
#include "session/session_machine.hpp"
#include "tasks/interface_shares.hpp"
#include "transport/udp_socket.hpp"
#include "transport/worker_threads.hpp"

#include <boost/asio/io_context.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace liena::system {

/// Network thread. Outlives its modules.
class ModuleHost {
public:
    virtual ~ModuleHost() = default;

    virtual boost::asio::io_context& io() = 0;
    virtual const TopologyDevice& ownDevice() const = 0;
    virtual const Sha256& topologyHash() const = 0;
    virtual const std::shared_ptr<const MessageSet>& ownSet() const = 0;
    virtual const std::string& software() const = 0;
    virtual std::shared_ptr<security::TlsIdentity> identity() = 0;
    virtual const PacketMarks& marks() const = 0;
    /// Where the bulk lanes of all modules meet.
    virtual tasks::InterfaceShares& interfaces() = 0;
    virtual const MeasuringBudget& measuring() const = 0;
    /// Commands, safety messages or images flowed lately, on any session.
    virtual bool isInUse() const = 0;
    /// The peers to which a line is being measured, whoever asked; one that both ends measure is there twice.
    virtual std::vector<std::string> measuredLines() const = 0;
    virtual protocol::PartialBudget& budget() = 0;
    virtual transport::UdpSocket& packets() = 0;
    virtual transport::WorkerThreads& workers() = 0;

    virtual session::Now now() const = 0;
    /// What is made now carries it; later than every one before.
    virtual Timestamp stamp(session::Now now) = 0;
    Timestamp stamp() { return stamp(now()); }
    virtual std::uint64_t freshToken() = 0;
    /// Another peer's session has it, or it names an incident.
    virtual bool isTokenUsed(DeviceId asking, std::uint64_t token) const = 0;

    /// The network thread turned; judged before anything is acted on.
    virtual void turned() = 0;

    /// The set with that hash as the set of `peer`: held, unknown, or not to be accepted.
    virtual session::SetStanding standingOf(DeviceId peer, const Sha256& set) = 0;
    virtual std::shared_ptr<const MessageSet> setOf(DeviceId peer, const Sha256& set) = 0;
    /// Checks and keeps a set that a peer has sent; its module hears setLearnt() later.
    virtual void learn(DeviceId peer, const Sha256& set, std::vector<std::byte> xml) = 0;

    /// Whether this device may begin a session now, or re-open one; an error says why not.
    virtual Result<void> admitSession(bool reopening) = 0;

    virtual bool standsBy() const = 0;
    virtual void sessionOpened(DeviceId peer, const session::SessionOpened& opened) = 0;
    /// Tells the peer what incidents are held here.
    virtual void greet(DeviceId peer) = 0;
    /// Tells `event`, once its incident is there to be asked for.
    virtual void sessionLost(DeviceId peer, const session::SessionLost& lost, SessionEvent event) = 0;
    virtual void heardBroadcast(DeviceId from, const protocol::SessionMessage& message) = 0;

    virtual void deliver(Message&& message) = 0;
    virtual void tell(SessionEvent event) = 0;
    virtual void show(const LinkStatus& status) = 0;
    virtual void showDrops(DeviceId peer, std::vector<DropCount> drops) = 0;
    virtual void log(const LogLine& line) = 0;
    virtual void record(audit::Entry entry) = 0;
};

} // namespace liena::system
