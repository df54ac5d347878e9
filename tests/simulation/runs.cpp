// Sums, delta debugging, and the words for both.
#include "runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace liena::simulation {

namespace {

double milliseconds(Nanoseconds time) { return static_cast<double>(time.count()) / 1e6; }
double sinceStart(Instant at) { return milliseconds(at - Instant(std::chrono::hours(1))); }

bool breaks(const Scenario& scenario, const std::string& invariant)
{
    const auto outcome = runScenario(scenario);
    return std::any_of(outcome.violations.begin(), outcome.violations.end(),
                       [&](const Violation& violation) { return violation.invariant == invariant; });
}

Scenario without(const Scenario& scenario, std::size_t begin, std::size_t count)
{
    auto less = scenario;
    const auto first = less.faults.begin() + static_cast<std::ptrdiff_t>(begin);
    less.faults.erase(first, first + static_cast<std::ptrdiff_t>(std::min(count, less.faults.size() - begin)));
    return less;
}

} // namespace

Outcome runScenario(const Scenario& scenario)
{
    World world(scenario);
    return world.run();
}

void Tally::add(const Outcome& outcome)
{
    ++seeds;
    failed += outcome.violations.empty() ? 0 : 1;
    total.violations.insert(total.violations.end(), outcome.violations.begin(), outcome.violations.end());
    total.hash = (total.hash * 0x100000001B3U) ^ outcome.hash;
    total.observations += outcome.observations;
    total.events += outcome.events;
    total.faults += outcome.faults;
    for (std::size_t kind = 0; kind < faultKinds; ++kind)
        total.faultsOfKind[kind] += outcome.faultsOfKind[kind];
    total.commandsSent += outcome.commandsSent;
    total.falseStandBys += outcome.falseStandBys;
    total.packetsLost += outcome.packetsLost;
    total.commandsJudged += outcome.commandsJudged;
    total.commandsDelivered += outcome.commandsDelivered;
    total.standBys += outcome.standBys;
    total.interruptions += outcome.interruptions;
    total.simulated += outcome.simulated;
    total.longestHeal = std::max(total.longestHeal, outcome.longestHeal);
    total.longestDetection = std::max(total.longestDetection, outcome.longestDetection);
    total.longestKnowing = std::max(total.longestKnowing, outcome.longestKnowing);
    total.coverage.add(outcome.coverage);
}

Scenario minimised(Scenario scenario, const std::string& invariant, int most)
{
    int tried = 0;
    for (auto chunk = std::max<std::size_t>(scenario.faults.size() / 2, 1); tried < most;) {
        bool shorter = false;
        for (std::size_t begin = 0; begin < scenario.faults.size() && tried < most; ++tried) {
            auto less = without(scenario, begin, chunk);
            if (breaks(less, invariant)) {
                scenario = std::move(less);
                shorter = true;
            } else {
                begin += chunk;
            }
        }
        if (chunk == 1 && !shorter)
            break;
        chunk = std::max<std::size_t>(chunk / 2, 1);
    }
    return scenario;
}

std::string report(const Scenario& scenario, const Outcome& outcome)
{
    std::string text = fmt::format("seed {} breaks {} times\n", scenario.seed, outcome.violations.size());
    for (std::size_t i = 0; i < std::min<std::size_t>(outcome.violations.size(), 5); ++i) {
        const auto& violation = outcome.violations[i];
        text += fmt::format("  {} at {:.3f} ms: {}\n", violation.invariant, sinceStart(violation.at), violation.what);
    }
    const auto least = minimised(scenario, outcome.violations.front().invariant);
    text += fmt::format("  {} devices, {} links, datagrams {}; the faults that are needed for {}: {} of {}\n", least.devices.size(),
                        least.links.size(), least.datagrams ? "on" : "off", outcome.violations.front().invariant, least.faults.size(),
                        scenario.faults.size());
    for (const auto& fault : least.faults)
        text += "    " + describe(fault) + "\n";
    return text;
}

std::optional<Caught> caught(Mutant mutant, std::uint64_t most)
{
    const auto scenarioOf = [mutant](std::uint64_t seed) {
        if (mutant == Mutant::OriginNotCompared)
            return Scenario::lying(seed, LieKind::Origins);
        if (mutant == Mutant::LimitAfterAllocation)
            return Scenario::lying(seed, LieKind::EndlessMessages);
        return Scenario::chaotic(seed);
    };
    for (std::uint64_t seed = 1; seed <= most; ++seed) {
        const auto sound = scenarioOf(seed);
        auto scenario = sound;
        scenario.mutant = mutant;
        const auto outcome = runScenario(scenario);
        if (!outcome.violations.empty() && runScenario(sound).violations.empty())
            return Caught{seed, outcome.violations.front()};
    }
    return std::nullopt;
}

std::map<std::uint64_t, std::uint64_t> readHashes(const std::string& path)
{
    std::map<std::uint64_t, std::uint64_t> hashes;
    std::ifstream file(path);
    std::uint64_t seed = 0;
    std::uint64_t hash = 0;
    while (file >> std::dec >> seed >> std::hex >> hash)
        hashes[seed] = hash;
    return hashes;
}

std::string table(const Tally& tally, double wallSeconds)
{
    const auto& total = tally.total;
    std::string text;
    const auto row = [&](std::string_view name, const std::string& value) { text += fmt::format("{:<34}{}\n", name, value); };
    row("seeds", fmt::format("{}", tally.seeds));
    row("simulated time", fmt::format("{:.2f} h", static_cast<double>(total.simulated.count()) / 3.6e12));
    row("faults injected", fmt::format("{}", total.faults));
    for (std::size_t kind = 0; kind < faultKinds; ++kind)
        if (total.faultsOfKind[kind] != 0)
            row(fmt::format("  {}", nameOf(static_cast<FaultKind>(kind))), fmt::format("{}", total.faultsOfKind[kind]));
    row("packets lost", fmt::format("{}", total.packetsLost));
    row("events", fmt::format("{}", total.events));
    row("observations judged", fmt::format("{}", total.observations));
    row("commands sent", fmt::format("{}", total.commandsSent));
    row("commands judged on arrival", fmt::format("{}", total.commandsJudged));
    row("commands delivered", fmt::format("{}", total.commandsDelivered));
    row("interruptions", fmt::format("{}", total.interruptions));
    row("stand-bys (both ends counted)", fmt::format("{}", total.standBys));
    row("false stand-bys", fmt::format("{}", total.falseStandBys));
    row("seeds that failed", fmt::format("{}", tally.failed));
    row("violations", fmt::format("{}", total.violations.size()));
    row("longest silence before a loss", fmt::format("{:.3f} ms", milliseconds(total.longestDetection)));
    if (total.longestKnowing.count() != 0)
        row("longest until a stand-by is known", fmt::format("{:.3f} ms", milliseconds(total.longestKnowing)));
    row("longest until all is open again", fmt::format("{:.3f} ms", milliseconds(total.longestHeal)));
    row("hash of all traces", fmt::format("{:016x}", total.hash));
    row("wall time", fmt::format("{:.1f} s", wallSeconds));
    return text;
}

} // namespace liena::simulation
