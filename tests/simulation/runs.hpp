// Many seeds, one after another: what they showed together, and what is left of a seed that failed when everything needless is taken away.
#pragma once

#include "world.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace liena::simulation {

/// The sums and the worst of many worlds.
struct Tally {
    std::uint64_t seeds = 0;
    std::uint64_t failed = 0;
    Outcome total; ///< its hash is that of all hashes in order

    void add(const Outcome& outcome);
};

Outcome runScenario(const Scenario& scenario);

/// The scenario with as few faults as still break the same invariant; tries at most `most` worlds.
Scenario minimised(Scenario scenario, const std::string& invariant, int most = 400);

/// The seed, the violations, and the shortest list of faults that shows the first of them.
std::string report(const Scenario& scenario, const Outcome& outcome);

/// A seed that is clean, and is not with the mutant; nothing when `most` seeds show none.
struct Caught {
    std::uint64_t seed = 0;
    Violation violation;
};
std::optional<Caught> caught(Mutant mutant, std::uint64_t most);

/// The kept hash of each fixed seed, from lines `seed hash`; empty when the file cannot be read.
std::map<std::uint64_t, std::uint64_t> readHashes(const std::string& path);

/// `name value` lines with units.
std::string table(const Tally& tally, double wallSeconds);

} // namespace liena::simulation
