// One simulated system from its start to its end: devices, network, persons, faults, and whoever watches.
#pragma once

#include "coverage.hpp"
#include "liar.hpp"
#include "person.hpp"
#include "reference_model.hpp"
#include "scenario.hpp"
#include "simulated_device.hpp"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace liena::simulation {

struct Outcome {
    std::vector<Violation> violations;
    std::uint64_t hash = 0;   ///< of everything that was observed
    std::uint64_t course = 0; ///< of the sessions' states alone
    std::uint64_t observations = 0;
    std::uint64_t events = 0;
    std::uint64_t faults = 0;
    std::array<std::uint64_t, faultKinds> faultsOfKind{};
    std::uint64_t packetsLost = 0;
    std::uint64_t commandsSent = 0;
    std::uint64_t commandsJudged = 0; ///< by the end that they came to
    std::uint64_t commandsDelivered = 0;
    std::uint64_t standBys = 0;
    std::uint64_t falseStandBys = 0; ///< of a link that nothing disturbs, once everything was open
    std::uint64_t interruptions = 0; ///< Open or Suspect to Reconnecting
    Nanoseconds simulated{};
    Nanoseconds longestHeal{};      ///< from the end of chaos until every session was open and nothing was held
    Nanoseconds longestDetection{}; ///< silence until a loss was acted on, of all losses by silence
    Nanoseconds longestKnowing{};   ///< from the first end's stand-by until every live device that can be reached knew
    Coverage coverage;
};

class World : public HostPrograms, public Surroundings {
public:
    using Onlooker = std::function<void(Instant, const Observation&)>;

    explicit World(const Scenario& scenario, Onlooker onlooker = {});
    ~World() override;

    /// Chaos with the scenario's faults, then peace, in which everything has to open again within `healLimit`.
    Outcome run();

    /// The scenario's network as it is, for that long.
    Outcome runQuiet(Nanoseconds length);

    static constexpr Nanoseconds healLimit = std::chrono::seconds(3);

private:
    struct Host {
        DeviceClock clock{0, 0};
        Disk disk;
        std::unique_ptr<SimulatedDevice> device;
        std::unique_ptr<Person> person;
        std::vector<VirtualTime::Event> waiting; ///< while the program is paused
        std::uint32_t boot = 0;
        int pauses = 0;
        Instant resumed;
        int refusals = 0;
        int downs = 0;
        int lies = 0;
        int corruptions = 0;
        std::uint32_t replays = 0;
        int floods = 0;
    };

    // HostPrograms
    void whenRunning(HostIndex host, VirtualTime::Event event) override;
    Reception reception(HostIndex host) const override;
    void accepted(HostIndex host, HostIndex from, ConnectionNumber connection) override;
    void datagramArrived(HostIndex host, HostIndex from, std::span<const std::byte> bytes) override;

    // Surroundings
    void observe(const Observation& observation) override;
    std::uint64_t freshToken() override { return m_tokens.next() | 1U; }
    DeviceId idOf(HostIndex host) const override { return m_scenario.devices[host].id; }
    HostIndex hostOf(DeviceId id) const override;
    std::shared_ptr<const MessageSet> setOf(HostIndex host) const override;
    void leaving(HostIndex device, HostIndex peer, std::vector<std::byte>& bytes, std::size_t begin) override;

    // world_faults.cpp
    void apply(const Fault& fault);
    void applyToPath(const Fault& fault);
    void applyToHost(const Fault& fault);
    void applyToSockets(const Fault& fault);
    void later(const Fault& fault, std::function<void()> undo);
    void markFault(const Fault& fault);
    void openSocket(HostIndex from, HostIndex to, std::vector<std::byte> bytes, Nanoseconds length);
    void pause(HostIndex host);
    void resume(HostIndex host);
    void end(HostIndex host, bool tells);
    void boot(HostIndex host);
    void flood(HostIndex host);
    void heal();

    void setUp();
    Rules rules() const;
    DeviceSettings settingsFor(HostIndex host) const;
    bool isWhole();
    void settle();
    Outcome outcome();
    void measure(const Observation& observation);
    void judgeKnowing();
    bool isAlive(HostIndex host) const { return m_hosts[host].device && m_hosts[host].pauses == 0; }

    const Scenario m_scenario;
    Onlooker m_onlooker;
    VirtualTime m_time;
    SeededRandom m_tokens;
    SeededRandom m_faultRandom;
    SeededRandom m_workload;
    SeededRandom m_lieRandom;
    Network m_network;
    std::vector<Host> m_hosts;
    std::map<std::pair<HostIndex, HostIndex>, BlackChannel> m_channels;
    std::unique_ptr<Liar> m_liar;
    std::vector<std::uint64_t> m_oldTokens;
    ReferenceModel m_model;
    TraceHash m_hash;
    TraceHash m_course;
    Outcome m_outcome;
    Instant m_began;
    bool m_peace = false;
    bool m_whole = false; ///< and everything was open when one last looked
    std::map<IncidentId, Instant> m_firstStandBy;
};

} // namespace liena::simulation
