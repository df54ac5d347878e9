// One size of the mesh, measured: opening, idle, and with commands.
#pragma once

#include "scale/mesh.hpp"
#include "scale/raw_pair.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace liena::bench {

struct ScaleOptions {
    std::vector<std::size_t> devices{2, 4, 8, 16, 32, 64};
    std::chrono::milliseconds heartbeat{20};
    double seconds = 4;     ///< of each interval
    int rounds = 3;         ///< of an idle interval and one with commands
    double rate = 1000;     ///< round trips per second, of all devices together
    bool keepAwake = false; ///< so that what waking a processor costs is not counted as a session's
    std::filesystem::path program;
};

/// Processor seconds per second of a mesh's devices together, and what they did in them.
struct MeshLoads {
    double closed = 0;              ///< no session open
    std::vector<double> idle;       ///< with all of them, a round each
    std::vector<double> asking;     ///< the same with commands
    double heartbeatsPerSecond = 0; ///< heard, idle
    double messagesPerSecond = 0;   ///< commands and their answers

    double meanIdle() const;
    double idleSpread() const; ///< largest less smallest load, over their mean

    /// Of processor time in µs, with all else that a session does. Nothing where it is no more than what the same load varies by; so with
    /// the others.
    std::optional<double> perHeartbeat() const;
    std::optional<double> perMessage() const;

private:
    std::optional<double> costOf(double difference, double perSecond) const;
};

struct ScaleRow {
    std::size_t devices = 0;
    std::size_t sessionEnds = 0;
    RawPair machine; ///< just before
    double openSeconds = 0;
    std::uint64_t retries = 0;
    MeshLoads loads;
    MeshLoads plain;             ///< the same packets over sockets without sessions, just after
    double bytesPerSecond = 0;   ///< over loopback, idle
    double packetsPerSecond = 0; ///< the same
    std::uint64_t missed = 0;    ///< heartbeats
    double roundTripP50Us = 0;
    double roundTripP99Us = 0;
    double allocatedKiB = 0;         ///< of a device, mean
    double bareKiB = 0;              ///< the same before the first session
    double descriptors = 0;          ///< of a device, mean
    std::vector<std::string> faults; ///< counts that are not what they must be; empty: the row counts

    std::optional<double> perSessionEnd() const; ///< µs of processor time and second
    double perSessionKiB() const { return (allocatedKiB - bareKiB) / static_cast<double>(devices - 1); }
};

ScaleRow measureScale(std::size_t devices, const ScaleOptions& options);

/// Suspicion and loss are judged late, so that a machine at its limit is measured and not interrupted.
std::string timingFor(std::chrono::milliseconds heartbeat);

} // namespace liena::bench
