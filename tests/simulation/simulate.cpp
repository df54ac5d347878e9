// simulate: runs seeds of the simulation and prints what they showed.
#include "runs.hpp"

#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <optional>

namespace {

using namespace liena::simulation;

struct Options {
    std::optional<std::uint64_t> seed;
    std::string seeds;
    std::uint64_t fresh = 0;
    std::uint64_t faults = 0;
    std::uint64_t commands = 0;
    std::uint64_t single = 0;
    double hours = 0;
    double loss = 0;
    std::string roundTrip = "2ms";
    bool noDatagrams = false;
    bool withCommands = false;
    bool mutants = false;
    bool trace = false;
    bool hashes = false;
    std::string golden;
    bool coverage = false;
    std::uint64_t mostFailures = 5;
};

constexpr const char* footer = R"(
Without --seed, --seeds or --fresh it begins at seed 1. With --faults or --commands it goes on from there
until that many were injected or judged.

Examples:
  simulate --seeds 1..200                     fixed seeds
  simulate --fresh 100                        seeds made from today's date
  simulate --faults 1000000 --coverage        a full run; fails on a transition that never happened
  simulate --seed 4711 --trace                everything that happened in one seed
  simulate --hours 10 --loss 1                false alarms per hour on a path that loses 1 percent
  simulate --single 500                       eight devices and one loss each: detection, and who knows when
  simulate --golden tests/simulation/golden_hashes   the same traces as ever
  simulate --mutants                          puts each fault of mutant.hpp into the shell; every one must be found)";

void addOptions(CLI::App& app, Options& options)
{
    app.add_option("--seed", options.seed, "One seed");
    app.add_option("--seeds", options.seeds, "A range of seeds: 1..200");
    app.add_option("--fresh", options.fresh, "That many seeds, made from the date");
    app.add_option("--faults", options.faults, "Go on until that many faults were injected");
    app.add_option("--commands", options.commands, "Go on until that many commands were judged");
    app.add_option("--single", options.single, "That many worlds of eight devices with one loss each");
    app.add_option("--hours", options.hours, "A quiet pair for that many hours of simulated time");
    app.add_option("--loss", options.loss, "Packets lost on the quiet path, in percent");
    app.add_option("--rtt", options.roundTrip, "Round trip on the quiet path, such as 2ms or 500us");
    app.add_flag("--no-datagrams", options.noDatagrams, "The quiet pair has lane 0 alone");
    app.add_flag("--with-commands", options.withCommands, "The quiet pair commands and reports as in use");
    app.add_flag("--mutants", options.mutants, "Run every mutant until it is found");
    app.add_option("--golden", options.golden, "Run the seeds of that file, and compare each trace hash with the one kept there");
    app.add_flag("--hashes", options.hashes, "Print the trace hash of each seed, and no table");
    app.add_flag("--trace", options.trace, "Print every observation");
    app.add_flag("--coverage", options.coverage, "Print what happened how often, and fail where something never did");
    app.add_option("--most-failures", options.mostFailures, "Stop after that many seeds that failed")->capture_default_str();
    app.footer(footer);
}

std::optional<Nanoseconds> durationFrom(const std::string& text)
{
    std::size_t digits = 0;
    while (digits < text.size() && text[digits] >= '0' && text[digits] <= '9')
        ++digits;
    if (digits == 0 || digits > 9)
        return std::nullopt;
    const auto value = std::stol(text.substr(0, digits));
    const auto unit = text.substr(digits);
    if (unit == "us")
        return std::chrono::microseconds(value);
    if (unit == "ms")
        return std::chrono::milliseconds(value);
    return std::nullopt;
}

World::Onlooker printer()
{
    return [](Instant at, const Observation& observation) {
        const auto since = at - Instant(std::chrono::hours(1));
        fmt::print("{:14.6f} {}\n", static_cast<double>(since.count()) / 1e6, describe(observation));
    };
}

/// True when the run may go on.
bool runOne(const Scenario& scenario, const Options& options, Tally& tally)
{
    World world(scenario, options.trace ? printer() : World::Onlooker());
    const auto outcome = world.run();
    tally.add(outcome);
    if (options.hashes)
        fmt::print("{} {:016x}\n", scenario.seed, outcome.hash);
    if (!outcome.violations.empty()) {
        fmt::print("{}", report(scenario, outcome));
        std::fflush(stdout);
    }
    return tally.failed < options.mostFailures;
}

std::uint64_t dateSeed()
{
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::seconds>(now).count()) * 1000;
}

void runSeeds(const Options& options, Tally& tally)
{
    std::uint64_t first = 1;
    std::uint64_t last = 0;
    if (options.seed) {
        first = last = *options.seed;
    } else if (const auto dots = options.seeds.find(".."); dots != std::string::npos) {
        first = std::stoull(options.seeds.substr(0, dots));
        last = std::stoull(options.seeds.substr(dots + 2));
    } else if (options.fresh > 0) {
        first = dateSeed();
        last = first + options.fresh - 1;
        fmt::print("fresh seeds {}..{}\n", first, last);
    }
    const auto goesOn = [&](std::uint64_t seed) {
        return seed <= last || tally.total.faults < options.faults || tally.total.commandsJudged < options.commands;
    };
    for (auto seed = first; goesOn(seed); ++seed)
        if (!runOne(Scenario::chaotic(seed), options, tally))
            return;
}

void runSingles(const Options& options, Tally& tally)
{
    for (std::uint64_t seed = 1; seed <= options.single; ++seed)
        if (!runOne(Scenario::single(seed), options, tally))
            return;
}

int runQuiet(const Options& options, Tally& tally)
{
    const auto roundTrip = durationFrom(options.roundTrip);
    if (!roundTrip) {
        fmt::print(stderr, "simulate: --rtt is a number and us or ms, such as 2ms\n");
        return 2;
    }
    const auto loss = static_cast<std::uint32_t>(options.loss * 10'000);
    // An hour each, so that a figure per hour has a spread.
    for (double hour = 0; hour < options.hours; hour += 1) {
        World world(Scenario::quiet(static_cast<std::uint64_t>(hour) + 1, *roundTrip, loss, !options.noDatagrams, options.withCommands));
        const auto length = std::min(1.0, options.hours - hour);
        const auto outcome = world.runQuiet(Nanoseconds(static_cast<std::int64_t>(length * 3.6e12)));
        for (const auto& violation : outcome.violations)
            fmt::print("hour {} breaks {}: {}\n", hour + 1, violation.invariant, violation.what);
        tally.add(outcome);
    }
    fmt::print("per hour, both ends counted: {:.2f} interruptions, {:.2f} stand-bys\n",
               static_cast<double>(tally.total.interruptions) / options.hours, static_cast<double>(tally.total.standBys) / options.hours);
    return 0;
}

int runMutants()
{
    constexpr std::uint64_t mostSeeds = 400;
    int missed = 0;
    for (const auto mutant : mutants) {
        const auto found = caught(mutant, mostSeeds);
        missed += found ? 0 : 1;
        fmt::print("{:<24} {}\n", nameOf(mutant),
                   found ? fmt::format("seed {:<4} {}: {}", found->seed, found->violation.invariant, found->violation.what) : "NOT FOUND");
        std::fflush(stdout);
    }
    return missed;
}

/// The fixed seeds, each with the hash that was kept for it.
int runGolden(const Options& options, Tally& tally)
{
    const auto hashes = readHashes(options.golden);
    if (hashes.empty()) {
        fmt::print(stderr, "simulate: {} holds no hashes; --hashes prints such lines\n", options.golden);
        return 2;
    }
    int differing = 0;
    for (const auto& [seed, kept] : hashes) {
        World world(Scenario::chaotic(seed));
        const auto outcome = world.run();
        tally.add(outcome);
        if (outcome.hash == kept)
            continue;
        fmt::print("seed {} has the trace hash {:016x}, and {} was kept\n", seed, outcome.hash, fmt::format("{:016x}", kept));
        ++differing;
    }
    fmt::print("{} of {} fixed seeds have the trace hash that was kept\n", hashes.size() - static_cast<std::size_t>(differing),
               hashes.size());
    return differing == 0 ? 0 : 1;
}

int judgeCoverage(const Coverage& coverage)
{
    fmt::print("\n{}\n", coverage.table());
    int missing = 0;
    for (const auto& [what, entries] :
         {std::pair("never happened", coverage.missingTransitions()), std::pair("never happened", coverage.missingFaults()),
          std::pair("is in no diagram", coverage.unknownTransitions())})
        for (const auto& entry : entries) {
            fmt::print("{}: {}\n", entry, what);
            ++missing;
        }
    return missing;
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Real sessions, codec and drive gate of 2 to 8 devices in virtual time, under faults drawn from a seed.", "simulate");
    Options options;
    addOptions(app, options);
    CLI11_PARSE(app, argc, argv);

    if (options.mutants)
        return runMutants() == 0 ? 0 : 1;
    Tally tally;
    const auto began = std::chrono::steady_clock::now();
    if (!options.golden.empty()) {
        if (const auto status = runGolden(options, tally); status != 0)
            return status;
    } else if (options.hours > 0) {
        if (const auto status = runQuiet(options, tally); status != 0)
            return status;
    } else if (options.single > 0) {
        runSingles(options, tally);
    } else {
        runSeeds(options, tally);
    }
    if (!options.hashes)
        fmt::print("{}", table(tally, std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count()));
    const int missing = options.coverage ? judgeCoverage(tally.total.coverage) : 0;
    return tally.failed == 0 && missing == 0 ? 0 : 1;
}
