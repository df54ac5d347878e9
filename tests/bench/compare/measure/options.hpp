// The command line that all peers have in common.
#pragma once

#include "measure/stamp.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace liena::compare {

enum class Role : std::uint8_t { Client, Echo };
enum class WorkloadKind : std::uint8_t { RoundTrip, Paced, Load, Frames, Messages };

struct Options {
    Role role = Role::Client;
    WorkloadKind workload = WorkloadKind::RoundTrip;
    std::string host = "127.0.0.1";
    std::uint16_t port = 52300;
    unsigned pair = 0;        ///< of ends that run at once on one link: what finds its peer by itself looks among its own
    double seconds = 3;       ///< that are measured
    double warmUp = 1;        ///< before them
    double commandRate = 500; ///< per second: load and paced
    double frameRate = 0;     ///< per second: load
    double secondRate = 0;    ///< per second, of a second stream of frames beside that: load
    bool timeline = false;    ///< of load: every single latency is told
    std::size_t frameBytes = std::size_t{2} << 20U;
    bool spins = false;   ///< looks for work without ever sleeping, where the transport can
    bool asleep = false;  ///< sleeps whenever there is nothing to do, also within a dialogue, where the transport has a choice
    bool status = false;  ///< frames as messages of the class status, which share the connection of the commands, where there are classes
    bool packets = false; ///< commands and echoes as UDP packets of their own, where the transport has a choice
    std::optional<unsigned> workers; ///< threads that seal and open frames, where the transport has a choice; nothing: as it chooses
    std::filesystem::path files;     ///< topology.xml and pki/, for the peers that need certificates

    bool sendsFrames() const { return workload == WorkloadKind::Frames || frameRate > 0; }
    std::size_t streams() const { return secondRate > 0 ? 2 : 1; } ///< of frames
};

/// Ends the program when it cannot be understood.
Options readOptions(int argc, char** argv, const std::string& transport);

} // namespace liena::compare
