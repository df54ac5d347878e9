// All devices of a mesh, fully joined by sessions, a process each: as they run in a hospital, and so that each one's share can be told.
#pragma once

#include "runner/process.hpp"
#include "scale/mesh_counts.hpp"
#include "support/test_system.hpp"

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace liena::bench {

struct MeshPlan {
    std::size_t devices = 2;
    std::string timing; ///< the attributes of the topology's <timing>
    double rate = 1000; ///< round trips per second, of all devices together
    std::filesystem::path program;
    bool plain = false; ///< sockets instead of LiENa

    std::size_t sessionEnds() const { return devices * (devices - 1); }
};

/// All of this computer's loopback interface, since its start; bytes with 14 of a link header for each packet.
struct LoopbackTraffic {
    std::uint64_t bytes = 0;
    std::uint64_t packets = 0;
};
LoopbackTraffic loopbackTraffic();

struct MeshMemory {
    std::uint64_t allocatedKiB = 0; ///< anonymous and touched
    std::uint64_t residentKiB = 0;
    std::uint64_t descriptors = 0;
};

/// What the limits of this user and of this computer do not allow, in a sentence with the remedy; empty: they do.
std::string meshRefusal(std::size_t devices, std::uint64_t mostFiles);

/// Raises this process's limit of open files as far as it may be, and tells it; children inherit it.
std::uint64_t raiseFileLimit();

/// Whoever does not answer makes a call throw std::runtime_error.
class Mesh {
public:
    explicit Mesh(const MeshPlan& plan);

    MeshCounts open();
    void ask(bool on);
    MeshCounts counts();
    MeshMemory memory() const;
    double processorSeconds() const;
    std::vector<std::int64_t> latencies(); ///< ns, since the last call

    /// Ends one of them, without a word to the others.
    void end(std::size_t device) { m_devices.at(device).process->signal(SIGKILL); }

private:
    struct Device {
        std::unique_ptr<lab::Process> process;
        std::string heard;
    };

    static std::string nextLine(Device& device);
    std::vector<std::string> everyone(const std::string& word);
    MeshCounts sumOf(const std::string& word);

    MeshPlan m_plan;
    test::TestSystem m_files;
    std::vector<Device> m_devices;
};

} // namespace liena::bench
