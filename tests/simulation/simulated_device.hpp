// One run of a simulated device: its modules, its ledger of incidents, its server, and the application above.
#pragma once

#include "mutant.hpp"
#include "simulated_module.hpp"
#include "simulated_server.hpp"

#include "session/stall_watch.hpp"
#include "session/stand_by_ledger.hpp"

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <vector>

namespace liena::simulation {

class Application;

/// What stays when the program ends.
struct Disk {
    std::set<Sha256> sets; ///< message sets that are held here
};

struct DeviceSettings {
    HostIndex host = 0;
    DeviceId id;
    std::shared_ptr<const MessageSet> set;
    struct Neighbour {
        HostIndex host = 0;
        LinkTiming timing;
    };
    std::vector<Neighbour> neighbours;
    bool datagrams = false;
    Mutant mutant = Mutant::None;
};

/// What a device cannot know or do by itself.
class Surroundings {
public:
    virtual ~Surroundings() = default;
    virtual void observe(const Observation& observation) = 0;
    virtual std::uint64_t freshToken() = 0;
    virtual DeviceId idOf(HostIndex host) const = 0;
    virtual HostIndex hostOf(DeviceId id) const = 0;
    /// The set that a device of this system really has.
    virtual std::shared_ptr<const MessageSet> setOf(HostIndex host) const = 0;
    /// A datagram leaves: it may be changed, and others may be put behind it.
    virtual void leaving(HostIndex device, HostIndex peer, std::vector<std::byte>& bytes, std::size_t begin) = 0;
};

/// Plays DistributedSystem::State; each decision here is one of its.
class SimulatedDevice : public Program {
public:
    SimulatedDevice(Network& network, const DeviceClock& clock, Surroundings& surroundings, DeviceSettings settings, Disk& disk,
                    std::unique_ptr<Application> application);
    ~SimulatedDevice();

    void start();
    void accepted(HostIndex from, ConnectionNumber connection);
    void datagramArrived(HostIndex from, std::span<const std::byte> packet);

    // The application's and the persons'
    SimulatedModule* module(HostIndex peer);
    std::map<HostIndex, std::unique_ptr<SimulatedModule>>& modules() { return m_modules; }
    void every(Nanoseconds period, std::function<void()> task);
    void publish(const Message& message);
    void revokeControl();
    void confirmHold(bool holding);
    void dismiss(IncidentId incident);

    // For modules
    const DeviceSettings& settings() const { return m_settings; }
    Surroundings& surroundings() { return m_surroundings; }
    protocol::PartialBudget& budget() { return m_budget; }
    Timestamp stamp() { return m_stamps.next(now().wall); }
    void observe(const Observation& observation) { m_surroundings.observe(observation); }
    void turned();
    bool isTokenUsed(HostIndex asking, std::uint64_t token);
    session::SetStanding standingOf(HostIndex peer, const Sha256& set);
    std::shared_ptr<const MessageSet> heldSet(HostIndex peer, const Sha256& set);
    session::SetHeard learn(HostIndex peer, const Sha256& set, std::span<const std::byte> xml);
    bool standsBy() const { return m_ledger.standsBy(); }
    void sessionOpened(HostIndex peer, const session::SessionOpened& opened);
    void sessionHealed(HostIndex peer);
    void sessionLost(HostIndex peer, const session::SessionLost& lost);
    void heardBroadcast(HostIndex from, const protocol::SessionMessage& message);
    void deliver(HostIndex peer, const Message& message);
    void tell(SessionEvent event);

    const session::StandByLedger& ledger() const { return m_ledger; }
    Application& application() { return *m_application; }
    Holdings holdings();

    /// Something that ends when its timer does, and is released by the timer's own call.
    void keep(std::shared_ptr<void> object, std::shared_ptr<Timer> timer) { m_kept.emplace_back(std::move(object), std::move(timer)); }
    void release(const Timer* timer)
    {
        std::erase_if(m_kept, [timer](const auto& entry) { return entry.second.get() == timer; });
    }

private:
    void perform(const session::LedgerActions& actions);
    void performBroadcast(const session::Broadcast& broadcast);
    void told(const SessionEvent& event);
    void startPeriodic(std::size_t index);
    void attached(AttachedConnection connection);

    struct Periodic {
        Nanoseconds period;
        std::function<void()> task;
        std::unique_ptr<Timer> timer;
        Instant due;
    };

    Surroundings& m_surroundings;
    DeviceSettings m_settings;
    Disk& m_disk;
    std::unique_ptr<Application> m_application;
    protocol::PartialBudget m_budget;
    TimestampSource m_stamps;
    session::StandByLedger m_ledger;
    session::StallWatch m_stallWatch;
    std::vector<std::unique_ptr<Periodic>> m_periodics;
    std::map<HostIndex, std::unique_ptr<SimulatedModule>> m_modules;
    SimulatedServer m_server;
    std::vector<std::pair<std::shared_ptr<void>, std::shared_ptr<Timer>>> m_kept;
    bool m_handlingStall = false;
};

/// What runs on a device: made with it, told what it hears.
class Application {
public:
    virtual ~Application() = default;
    virtual void start(SimulatedDevice& device) = 0;
    virtual void heard(const SessionEvent& event) = 0;
    virtual void delivered(HostIndex peer, const Message& message) = 0;
};

} // namespace liena::simulation
