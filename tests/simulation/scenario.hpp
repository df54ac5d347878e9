// Everything that one seed decides before a simulated world starts: its devices, its network, its persons and its faults.
#pragma once

#include "mutant.hpp"
#include "network.hpp"

#include "liena/device_id.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace liena::simulation {

enum class FaultKind : std::uint8_t {
    Cut,           ///< both ways, silent
    CutOneWay,     ///< one way, silent
    Burst,         ///< a short cut
    Loss,          ///< packets are lost at random
    Delay,         ///< the way becomes longer
    Jitter,        ///< and uneven
    Hold,          ///< nothing arrives, then everything at once
    Collapse,      ///< the bottleneck's rate
    Reset,         ///< one connection is reset
    SwallowEnds,   ///< nobody hears that a connection ended
    NoDatagrams,   ///< a firewall drops them
    Refuse,        ///< nobody listens
    Pause,         ///< the program does not run
    Crash,         ///< the program dies, its kernel says so; it is started again
    PowerCut,      ///< the computer falls silent; it is started again
    ClockStep,     ///< of the wall clock
    SlowReader,    ///< one connection is not read
    Flood,         ///< status messages without end
    Replay,        ///< what left earlier leaves again
    Corrupt,       ///< a bit of a command flips behind its check sum
    SilentSockets, ///< connections that say nothing
    StaleAttach,   ///< a connection that names an old session
    Lie,           ///< the credentialed peer sends rubbish
    PersonPresses, ///< re-open at a moment of no meaning
    PersonCloses,
    PersonDismisses,
    PersonStops, ///< emergency stop
};
inline constexpr std::size_t faultKinds = 27;

std::string_view nameOf(FaultKind kind);

struct Fault {
    Nanoseconds at{}; ///< after the start
    FaultKind kind = FaultKind::Cut;
    HostIndex a = 0;
    HostIndex b = 0; ///< equal to a for faults of one device
    std::uint32_t amount = 0;
    Nanoseconds duration{};
};

std::string describe(const Fault& fault);

enum class DeviceKind : std::uint8_t { Robot, Cockpit, Arm, Xray };

/// What a liar does: all that it can think of, or one thing again and again.
enum class LieKind : std::uint8_t { Every, Origins, EndlessMessages };

/// How a person answers a prompt while there is chaos.
enum class Manner : std::uint8_t { Prompt, Late, Twice, Never, Stale };

struct DevicePlan {
    DeviceKind kind = DeviceKind::Robot;
    DeviceId id;
    Manner manner = Manner::Prompt;
    bool opens = true;     ///< opens its links from Closed
    bool knowsSets = true; ///< holds the others' message sets from the start
    std::int64_t drift = 0;
    std::int64_t wall = 0;
};

struct Scenario {
    std::uint64_t seed = 0;
    std::vector<DevicePlan> devices;
    std::vector<std::pair<HostIndex, HostIndex>> links;
    bool datagrams = false;
    bool pictures = false;
    Nanoseconds commandPeriod = std::chrono::milliseconds(2);
    Nanoseconds statusPeriod = std::chrono::milliseconds(20);
    Nanoseconds delay = std::chrono::milliseconds(1);
    Nanoseconds jitter{};
    std::uint32_t loss = 0;
    std::size_t sendBuffer = 64 << 10; ///< of a connection; a small one makes writers wait
    std::optional<HostIndex> liar;
    LieKind lies = LieKind::Every;
    Nanoseconds chaos = std::chrono::seconds(8);
    std::vector<Fault> faults;
    bool everybodyKnows = false; ///< at the end of chaos each incident must be known wherever word can reach
    Mutant mutant = Mutant::None;

    bool linked(HostIndex a, HostIndex b) const;

    /// Swarm: each seed draws its own configuration and weights.
    static Scenario chaotic(std::uint64_t seed);

    /// Chaotic, and one device tells one kind of lie from early on, for the guards that nothing else puts to the test.
    static Scenario lying(std::uint64_t seed, LieKind lies);

    /// Two devices, commands only where asked, no fault but the path's own loss.
    static Scenario quiet(std::uint64_t seed, Nanoseconds roundTrip, std::uint32_t loss, bool datagrams, bool commands);

    /// Eight devices and one loss in an otherwise healthy network, for the times of detection and of knowing.
    static Scenario single(std::uint64_t seed);
};

} // namespace liena::simulation
