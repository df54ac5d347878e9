// The faults that the lab injects: what each is, and the system it happens to.
#pragma once

#include "runner/scene.hpp"

#include <functional>
#include <string>
#include <vector>

namespace liena::lab {

enum class Cast : std::uint8_t { Pair, WithPictures };

struct Fault {
    std::string name;     ///< as `--fault` takes it
    std::string row;      ///< of the failure model: F1 …
    std::string sentence; ///< what happens
    Cast cast = Cast::Pair;
    std::function<void(Scene&)> run;
    int most = 0;       ///< repetitions at most unless they are asked for; 0: as many as the others
    bool alone = false; ///< needs a fresh system for each repetition, which it starts itself
};

std::vector<Fault> linkFaults();     ///< cut, unplugged, flapping, one-way
std::vector<Fault> qualityFaults();  ///< loss, bursts, reordering, delay, bandwidth, one protocol only
std::vector<Fault> processFaults();  ///< killed, frozen, starved, two at once, an id twice
std::vector<Fault> resourceFaults(); ///< sockets, clocks, disks, descriptors, slow readers

/// All of them, in the order of the table.
std::vector<Fault> allFaults();

} // namespace liena::lab
