// What a seed draws.
#include "scenario.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace liena::simulation {

using namespace std::chrono_literals;

namespace {

constexpr std::array<std::string_view, faultKinds> names{"cut",
                                                         "cut-one-way",
                                                         "burst",
                                                         "loss",
                                                         "delay",
                                                         "jitter",
                                                         "hold",
                                                         "collapse",
                                                         "reset",
                                                         "swallow-ends",
                                                         "no-datagrams",
                                                         "refuse",
                                                         "pause",
                                                         "crash",
                                                         "power-cut",
                                                         "clock-step",
                                                         "slow-reader",
                                                         "flood",
                                                         "replay",
                                                         "corrupt",
                                                         "silent-sockets",
                                                         "stale-attach",
                                                         "lie",
                                                         "person-presses",
                                                         "person-closes",
                                                         "person-dismisses",
                                                         "person-stops"};

/// Of the register in resources/devices, with an index.
DeviceId idOf(DeviceKind kind, std::uint32_t index)
{
    constexpr std::array<std::uint32_t, 4> types{0x00008208U, 0x40018208U, 0x60008208U, 0x20010208U};
    return DeviceId(types[static_cast<std::size_t>(kind)] + index);
}

bool ofOneDevice(FaultKind kind)
{
    switch (kind) {
    case FaultKind::Refuse:
    case FaultKind::Pause:
    case FaultKind::Crash:
    case FaultKind::PowerCut:
    case FaultKind::ClockStep:
    case FaultKind::Flood:
    case FaultKind::Lie:
    case FaultKind::PersonDismisses:
    case FaultKind::PersonStops:
        return true;
    default:
        return false;
    }
}

std::vector<DevicePlan> drawDevices(SeededRandom random, std::size_t count)
{
    std::array<std::uint32_t, 4> used{};
    std::vector<DevicePlan> plans;
    for (std::size_t i = 0; i < count; ++i) {
        DevicePlan plan;
        plan.kind = i < 2 ? static_cast<DeviceKind>(i) : static_cast<DeviceKind>(random.below(4));
        plan.id = idOf(plan.kind, used[static_cast<std::size_t>(plan.kind)]++);
        if (plan.id.index() > 6)
            plan.id = idOf(plan.kind = DeviceKind::Arm, used[2]++);
        plan.manner = static_cast<Manner>(random.below(5));
        plan.opens = random.below(3) != 0;
        plan.knowsSets = random.below(4) != 0;
        plan.drift = static_cast<std::int64_t>(random.below(401)) - 200;
        plan.wall = static_cast<std::int64_t>(1'700'000'000'000'000'000 + random.below(2'000'000'000));
        plans.push_back(plan);
    }
    return plans;
}

/// A tree that holds all together, and some more.
std::vector<std::pair<HostIndex, HostIndex>> drawLinks(SeededRandom random, std::size_t count)
{
    std::vector<std::pair<HostIndex, HostIndex>> links;
    const auto density = random.below(100);
    for (HostIndex b = 1; b < count; ++b) {
        const auto parent = static_cast<HostIndex>(b == 1 ? 0 : random.below(b));
        for (HostIndex a = 0; a < b; ++a)
            if (a == parent || random.below(100) < density)
                links.emplace_back(a, b);
    }
    return links;
}

Nanoseconds drawDuration(SeededRandom& random)
{
    switch (random.below(4)) {
    case 0:
        return random.between(Nanoseconds(1ms), Nanoseconds(70ms));
    case 1:
        return random.between(Nanoseconds(60ms), Nanoseconds(150ms));
    case 2:
        return random.between(Nanoseconds(100ms), Nanoseconds(700ms));
    default:
        return random.between(Nanoseconds(500ms), Nanoseconds(3s));
    }
}

/// From a fault now and then to a hail of them.
Nanoseconds drawPace(SeededRandom& random)
{
    switch (random.below(3)) {
    case 0:
        return random.between(Nanoseconds(1ms), Nanoseconds(6ms));
    case 1:
        return random.between(Nanoseconds(4ms), Nanoseconds(30ms));
    default:
        return random.between(Nanoseconds(20ms), Nanoseconds(200ms));
    }
}

std::array<std::uint64_t, faultKinds> drawWeights(SeededRandom& random, const Scenario& scenario)
{
    std::array<std::uint64_t, faultKinds> weights{};
    for (auto& weight : weights)
        weight = random.below(3) == 0 ? 0 : random.between(1, 20);
    const auto rare = [&](FaultKind kind) { weights[static_cast<std::size_t>(kind)] = weights[static_cast<std::size_t>(kind)] / 5; };
    for (const auto kind :
         {FaultKind::Crash, FaultKind::PowerCut, FaultKind::PersonCloses, FaultKind::PersonDismisses, FaultKind::PersonStops})
        rare(kind);
    if (!scenario.liar)
        weights[static_cast<std::size_t>(FaultKind::Lie)] = 0;
    if (!scenario.datagrams)
        weights[static_cast<std::size_t>(FaultKind::NoDatagrams)] = 0;
    weights[static_cast<std::size_t>(FaultKind::Loss)] += 1; // never none at all
    return weights;
}

Fault drawFault(SeededRandom& random, const Scenario& scenario, const std::array<std::uint64_t, faultKinds>& weights, std::uint64_t total)
{
    Fault fault;
    auto draw = random.below(total);
    std::size_t kind = 0;
    while (draw >= weights[kind])
        draw -= weights[kind++];
    fault.kind = static_cast<FaultKind>(kind);
    const auto& [a, b] = scenario.links[random.below(scenario.links.size())];
    const bool turned = random.below(2) == 0;
    fault.a = turned ? b : a;
    fault.b = turned ? a : b;
    if (fault.kind == FaultKind::Lie)
        fault.a = *scenario.liar;
    if (ofOneDevice(fault.kind))
        fault.b = fault.a;
    fault.amount = static_cast<std::uint32_t>(random.next());
    fault.duration = drawDuration(random);
    return fault;
}

} // namespace

std::string_view nameOf(FaultKind kind) { return names[static_cast<std::size_t>(kind)]; }

std::string describe(const Fault& fault)
{
    const auto ms = [](Nanoseconds time) { return static_cast<double>(time.count()) / 1e6; };
    const auto where = fault.a == fault.b ? fmt::format("device {}", fault.a) : fmt::format("{} -> {}", fault.a, fault.b);
    return fmt::format("{:11.3f} ms  {:<16} {:<10} amount {:<10} for {:.3f} ms", ms(fault.at), nameOf(fault.kind), where, fault.amount,
                       ms(fault.duration));
}

bool Scenario::linked(HostIndex a, HostIndex b) const
{
    return std::find(links.begin(), links.end(), std::pair(std::min(a, b), std::max(a, b))) != links.end();
}

Scenario Scenario::chaotic(std::uint64_t seed)
{
    Scenario scenario;
    scenario.seed = seed;
    SeededRandom random(seed, "configuration");
    const auto small = random.below(3) != 0;
    const auto count = small ? random.between(2, 3) : random.between(3, 8);
    scenario.devices = drawDevices(SeededRandom(seed, "devices"), count);
    scenario.links = drawLinks(SeededRandom(seed, "links"), count);
    scenario.datagrams = random.below(2) == 0;
    scenario.pictures = random.below(4) == 0;
    scenario.commandPeriod = std::array<Nanoseconds, 4>{2ms, 5ms, 10ms, 20ms}[random.below(4)];
    scenario.statusPeriod = std::array<Nanoseconds, 3>{10ms, 20ms, 50ms}[random.below(3)];
    scenario.delay = random.between(Nanoseconds(100us), Nanoseconds(5ms));
    scenario.jitter = random.below(2) == 0 ? Nanoseconds(0) : random.between(Nanoseconds(0), Nanoseconds(3ms));
    scenario.loss = random.below(2) == 0 ? 0 : static_cast<std::uint32_t>(random.below(20'000));
    if (count > 2 && random.below(4) == 0)
        scenario.liar = static_cast<HostIndex>(random.below(count));
    scenario.chaos = random.between(Nanoseconds(3s), Nanoseconds(9s));
    scenario.sendBuffer = std::array<std::size_t, 3>{512, 4 << 10, 64 << 10}[random.below(3)];

    SeededRandom faults(seed, "faults");
    const auto weights = drawWeights(faults, scenario);
    std::uint64_t total = 0;
    for (const auto weight : weights)
        total += weight;
    const auto mean = drawPace(faults) / static_cast<std::int64_t>(1 + scenario.links.size() / 3);
    for (auto at = faults.between(Nanoseconds(0), Nanoseconds(1500ms)); at < scenario.chaos;) {
        auto fault = drawFault(faults, scenario, weights, total);
        fault.at = at;
        scenario.faults.push_back(fault);
        // Now and then it comes thick, and now and then there is a pause in which sessions can open.
        const auto gap = faults.below(12);
        at += gap == 0  ? faults.between(Nanoseconds(300ms), Nanoseconds(1200ms))
              : gap < 4 ? mean / 10
                        : faults.between(Nanoseconds(0), 2 * mean);
    }
    return scenario;
}

Scenario Scenario::lying(std::uint64_t seed, LieKind lies)
{
    auto scenario = chaotic(seed);
    scenario.liar = static_cast<HostIndex>(seed % 2); // the robot, or the cockpit: both report
    scenario.lies = lies;
    scenario.faults.push_back({300ms, FaultKind::Lie, *scenario.liar, *scenario.liar, 0, scenario.chaos});
    return scenario;
}

Scenario Scenario::quiet(std::uint64_t seed, Nanoseconds roundTrip, std::uint32_t loss, bool datagrams, bool commands)
{
    Scenario scenario;
    scenario.seed = seed;
    scenario.devices = drawDevices(SeededRandom(seed, "devices"), 2);
    for (auto& device : scenario.devices) {
        device.manner = Manner::Prompt;
        device.opens = device.knowsSets = true;
    }
    scenario.links = {{0, 1}};
    scenario.datagrams = datagrams;
    scenario.commandPeriod = commands ? Nanoseconds(2ms) : Nanoseconds(0);
    scenario.statusPeriod = commands ? Nanoseconds(10ms) : Nanoseconds(0);
    scenario.delay = roundTrip / 2;
    scenario.loss = loss;
    scenario.chaos = 0s;
    return scenario;
}

Scenario Scenario::single(std::uint64_t seed)
{
    Scenario scenario;
    scenario.seed = seed;
    SeededRandom random(seed, "configuration");
    scenario.devices = drawDevices(SeededRandom(seed, "devices"), 8);
    for (auto& device : scenario.devices) {
        device.manner = Manner::Never;
        device.opens = device.knowsSets = true;
    }
    scenario.links = drawLinks(SeededRandom(seed, "links"), 8);
    scenario.datagrams = random.below(2) == 0;
    scenario.commandPeriod = 10ms;
    scenario.statusPeriod = 20ms;
    scenario.delay = random.between(Nanoseconds(100us), Nanoseconds(2ms));
    scenario.chaos = 2500ms;
    scenario.everybodyKnows = true;
    constexpr std::array kinds{FaultKind::Cut, FaultKind::PowerCut, FaultKind::Pause, FaultKind::Crash};
    Fault fault;
    fault.kind = kinds[random.below(kinds.size())];
    const auto& [a, b] = scenario.links[random.below(scenario.links.size())];
    fault.a = a;
    fault.b = fault.kind == FaultKind::Cut ? b : a;
    fault.at = random.between(Nanoseconds(1s), Nanoseconds(1200ms));
    fault.duration = 10s; // it lasts until everything is healed
    scenario.faults.push_back(fault);
    return scenario;
}

} // namespace liena::simulation
