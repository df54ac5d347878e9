// Everything behind the facade: the modules of all peers, the ledger, and the network thread that runs them.
#pragma once

#include "audit/audit_log.hpp"
#include "base/cause_books.hpp"
#include "cache/link_board.hpp"
#include "cache/message_cache_access.hpp"
#include "cache/outbox.hpp"
#include "cache/returned_buffers.hpp"
#include "liena/distributed_system.hpp"
#include "session/stall_watch.hpp"
#include "session/stand_by_ledger.hpp"
#include "system/distributed_module.hpp"
#include "system/elastic_work.hpp"
#include "system/module_host.hpp"
#include "system/packet_owners.hpp"
#include "system/paired_clocks.hpp"
#include "system/set_keeper.hpp"
#include "tasks/attention.hpp"
#include "topology/local_store.hpp"
#include "topology/registry.hpp"
#include "transport/handler_memory.hpp"
#include "transport/status_server.hpp"
#include "transport/tcp_server.hpp"
#include "transport/timer.hpp"
#include "transport/udp_socket.hpp"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace liena {

struct DistributedSystem::State final : public system::ModuleHost {
    /// The same folder twice, since each is for one thread.
    struct Stores {
        std::optional<LocalStore> reading;
        std::optional<LocalStore> writing;
    };
    State(Settings given, SystemTopology read, TopologyDevice own, Registry sets, Stores stores, std::shared_ptr<security::TlsIdentity> tls,
          std::unique_ptr<audit::AuditLog> auditLog);
    ~State() override;

    Result<void> listen();
    void start();
    void stop();
    bool isNetworkThread() const { return std::this_thread::get_id() == threadId.load(); }

    void post(std::function<void()> task);
    system::DistributedModule* module(DeviceId peer) const;
    Result<DeviceId> linkedPeer(DeviceId peer) const;
    void recordCommand(std::string_view event, std::optional<DeviceId> peer, IncidentId incident, std::string_view reason);
    std::shared_ptr<const MessageSet> knownSet(DeviceId device) const;
    Result<void> checkSend(DeviceId target, const Message& message) const;
    Result<void> sendFromHere(DeviceId target, Message&& message);
    std::size_t openSessions() const;
    Result<void> checkKnown(std::string_view message) const;
    std::shared_ptr<const Message> kept(Message&& message);
    void takeReturned();
    void sendNow(DeviceId target, Message&& message);
    Result<void> sendBy(system::DistributedModule& one, Message&& message);
    void publishNow(Message message, std::chrono::nanoseconds stall = {});
    void drainOutbox();
    void withdrawOutbox(std::chrono::nanoseconds gap);
    static SessionEvent sendFailed(DeviceId peer, const std::string& message, std::string_view detail);
    void gather(bool begins);
    void heardHold(DeviceId from, const protocol::StandByReport& report);
    void perform(const session::LedgerActions& actions);
    void showIncidents();
    void logIncident(const SessionEvent& event);
    void performBroadcast(const session::Broadcast& broadcast);
    void housekeeping();
    void watchAudit();
    void offerStatus();
    std::function<void()> measureFor(const std::string& request, const transport::StatusServer::Reply& reply);
    void attached(transport::AttachedConnection connection);
    void packetHeard(std::span<std::byte> packet);
    void identityRefused(DeviceId device, const std::string& cause, const std::string& detail);
    void rejectUnlinked(transport::AttachedConnection connection);
    bool allClosed() const;

    // ModuleHost
    boost::asio::io_context& io() override { return context; }
    const TopologyDevice& ownDevice() const override { return ownTopologyDevice; }
    const Sha256& topologyHash() const override { return topology.hash(); }
    const std::shared_ptr<const MessageSet>& ownSet() const override { return ownMessageSet; }
    const PacketMarks& marks() const override { return settings.marks; }
    const MeasuringBudget& measuring() const override { return settings.measuring; }
    bool isInUse() const override;
    std::vector<std::string> measuredLines() const override;
    const std::string& software() const override { return settings.software; }
    std::shared_ptr<security::TlsIdentity> identity() override { return tlsIdentity; }
    tasks::InterfaceShares& interfaces() override { return interfaceShares; }
    protocol::PartialBudget& budget() override { return partialBudget; }
    transport::UdpSocket& packets() override { return udpSocket; }
    transport::WorkerThreads& workers() override { return elasticWork.workers(); }
    session::Now now() const override { return clocks.now(); }
    Timestamp stamp(session::Now now) override { return stamps.next(now.wall); }
    std::uint64_t freshToken() override;
    bool isTokenUsed(DeviceId asking, std::uint64_t token) const override;
    void turned() override;
    session::SetStanding standingOf(DeviceId peer, const Sha256& set) override;
    std::shared_ptr<const MessageSet> setOf(DeviceId peer, const Sha256& set) override;
    void learn(DeviceId peer, const Sha256& set, std::vector<std::byte> xml) override;
    Result<void> admitSession(bool reopening) override;
    bool standsBy() const override { return ledger.standsBy(); }
    void sessionOpened(DeviceId peer, const session::SessionOpened& opened) override;
    void greet(DeviceId peer) override { perform(ledger.greet(peer)); }
    void sessionLost(DeviceId peer, const session::SessionLost& lost, SessionEvent event) override;
    void heardBroadcast(DeviceId from, const protocol::SessionMessage& message) override;
    void deliver(Message&& message) override;
    void tell(SessionEvent event) override;
    void show(const LinkStatus& status) override { board.show(status); }
    void showDrops(DeviceId peer, std::vector<DropCount> drops) override { board.showDrops(peer, std::move(drops)); }
    void log(const LogLine& line) override
    {
        auto own = line;
        own.device = ownTopologyDevice.name;
        settings.log(own);
    }
    void log(LogLevel level, std::string_view event, const std::string& text) { log(LogLine{level, text, event}); }
    void record(audit::Entry entry) override
    {
        if (audit)
            audit->put(std::move(entry));
    }

    Settings settings;
    SystemTopology topology;
    TopologyDevice ownTopologyDevice;
    Registry registry;
    std::optional<LocalStore> store;
    std::unique_ptr<audit::AuditLog> audit; ///< null: none is written
    bool auditLost = false;
    std::unique_ptr<transport::StatusServer> statusServer; ///< null: nobody can watch
    std::shared_ptr<security::TlsIdentity> tlsIdentity;
    std::shared_ptr<const MessageSet> ownMessageSet;

    // Shared with other threads
    MessageCache messageCache;
    cache::LinkBoard board;
    struct OutboxCall;
    transport::HandlerMemory outboxMemory; ///< of the call that empties the outbox, which outlives the context
    cache::Outbox outbox;
    cache::Outbox::Letters letters; ///< those in hand; its memory is used again
    std::atomic<bool> stopped = false;
    std::atomic<std::thread::id> threadId{};
    /// Shared, since the application may keep messages for longer than this object lives.
    std::shared_ptr<cache::ReturnedBuffers> returned = std::make_shared<cache::ReturnedBuffers>();
    std::vector<FieldBytes> returnedHere; ///< those in hand; its memory is used again

    // The network thread's, after start()
    protocol::PartialBudget partialBudget; ///< what the context still holds at its end gives back to it
    boost::asio::io_context context{1};
    boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work{context.get_executor()};
    system::ElasticWork elasticWork{context, settings};
    tasks::Attention attention;
    tasks::InterfaceShares interfaceShares;
    TimestampSource stamps;
    mutable system::PairedClocks clocks; ///< remembers what it read
    system::SetKeeper setKeeper;
    session::StandByLedger ledger;
    base::CauseBooks refusals{64};   ///< of connections
    base::CauseBooks holdsHeard{64}; ///< for the log
    session::StallWatch stallWatch;
    std::chrono::nanoseconds shortestSuspect = std::chrono::nanoseconds::max(); ///< of our links: a shorter gap concerns no session
    struct Subscription {
        std::vector<MessageHandler> handlers;
        KeepingHandler keeper;     ///< comes last; there may be none
        bool isOwnCommand = false; ///< a peer's report of that name is another message, and is not meant
    };
    Subscription& newSubscription(std::string_view message);
    using Subscriptions = std::map<std::string, Subscription, std::less<>>;
    Subscriptions subscriptions; ///< by the name of the message; none is taken out
    Subscriptions::const_iterator lastSubscription = subscriptions.end();
    const Subscription* subscriptionTo(const Message& message);
    std::vector<EventHandler> eventHandlers;
    struct Periodic {
        std::chrono::nanoseconds period;
        std::function<void()> task;
        std::unique_ptr<transport::Timer> timer;
        std::chrono::steady_clock::time_point due;
    };
    std::vector<std::unique_ptr<Periodic>> periodics;
    transport::UdpSocket udpSocket;
    std::map<DeviceId, std::unique_ptr<system::DistributedModule>> modules;
    system::PacketOwners<system::DistributedModule> packetOwners;
    std::map<DeviceId, system::RejectCouriers> unlinked; ///< to devices of the topology that ask for a session without a link
    transport::TcpServer server;
    std::thread thread;
    bool handlingStall = false;

private:
    void startPeriodic(Periodic& periodic);
    void closeAll();
    void endWhenClosed(std::chrono::steady_clock::time_point limit);

    transport::Timer closingTimer{context};
};

} // namespace liena
