// One device of a mesh, as a process of its own: does what its input says, and tells what it counted.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace liena::bench {

struct MeshDeviceOptions {
    std::filesystem::path folder; ///< with topology.xml, sets/ and the certificates
    std::size_t index = 0;        ///< it is called d0, d1 …
    std::size_t devices = 2;
    double rate = 100; ///< commands per second, to its peers in turn, each to be answered
};

std::string meshDeviceName(std::size_t index);

/// Runs until its input ends. One word a line: `open` its share of the sessions, `begin` and `end` asking, `counts`, `latencies`; each is
/// answered by one line.
int runMeshDevice(const MeshDeviceOptions& options);

} // namespace liena::bench
