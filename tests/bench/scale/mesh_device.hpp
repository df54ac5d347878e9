// One device of a mesh, as a process of its own: does what its input says, and tells what it counted.
#pragma once

#include "scale/mesh_counts.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace liena::bench {

struct MeshDeviceOptions {
    std::filesystem::path folder; ///< with topology.xml, sets/ and the certificates
    std::size_t index = 0;        ///< it is called d0, d1 …
    std::size_t devices = 2;
    double rate = 100;  ///< commands per second, to its peers in turn, each to be answered
    bool plain = false; ///< sockets instead of LiENa
};

std::string meshDeviceName(std::size_t index);

/// Whatever carries its messages. Ready to be opened once it is made.
class MeshDevice {
public:
    static constexpr std::chrono::seconds openingLimit{120};

    virtual ~MeshDevice() = default;
    virtual MeshCounts open() = 0; ///< its share of all pairs, and waits for the others' shares
    virtual MeshCounts counts() = 0;
    virtual std::vector<std::int64_t> takeLatencies() = 0; ///< of round trips in ns, since the last call

    virtual void post(std::function<void()> work) = 0; ///< onto the thread that sends
    virtual void ask() = 0;                            ///< the next peer; on that thread

protected:
    explicit MeshDevice(const MeshDeviceOptions& options);

    static std::int64_t nowNs()
    {
        return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
    }

    MeshCounts tally() const; ///< the time and what is counted here

    std::atomic<std::uint64_t> m_troubles = 0;
    std::atomic<std::uint64_t> m_asked = 0;
    std::atomic<std::uint64_t> m_heard = 0;
    std::atomic<std::uint64_t> m_answered = 0;
    std::vector<std::size_t> m_peers;  ///< nearest on the right first
    std::vector<std::size_t> m_toOpen; ///< of each pair one end opens
};

std::unique_ptr<MeshDevice> lienaDevice(const MeshDeviceOptions& options);

/// The same packets and threads, and nothing of what a session is besides: what the computer and its kernel take for them.
std::unique_ptr<MeshDevice> plainDevice(const MeshDeviceOptions& options);

/// Runs until its input ends. One word a line: `open` its share of the sessions, `begin` and `end` asking, `counts`, `latencies`; each is
/// answered by one line.
int runMeshDevice(const MeshDeviceOptions& options);

} // namespace liena::bench
