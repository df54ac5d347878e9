// What the devices of a mesh count, and the line in which they tell it.
#pragma once

#include <cstdint>
#include <iomanip>
#include <istream>
#include <ostream>

namespace liena::bench {

/// Of one device or of all together, since their start.
struct MeshCounts {
    double at = 0;                 ///< seconds, monotonic clock; the mean of the devices' answers
    std::uint64_t sessionEnds = 0; ///< Open, and a heartbeat was heard
    std::uint64_t heartbeats = 0;  ///< heard
    std::uint64_t missed = 0;
    std::uint64_t troubles = 0; ///< sessions suspect, interrupted or lost, and messages that did not arrive
    std::uint64_t retries = 0;  ///< openings that had to be repeated
    std::uint64_t asked = 0;
    std::uint64_t heard = 0;
    std::uint64_t answered = 0;
};

inline std::ostream& operator<<(std::ostream& line, const MeshCounts& one)
{
    return line << std::fixed << one.at << ' ' << one.sessionEnds << ' ' << one.heartbeats << ' ' << one.missed << ' ' << one.troubles
                << ' ' << one.retries << ' ' << one.asked << ' ' << one.heard << ' ' << one.answered;
}

inline std::istream& operator>>(std::istream& line, MeshCounts& one)
{
    return line >> one.at >> one.sessionEnds >> one.heartbeats >> one.missed >> one.troubles >> one.retries >> one.asked >> one.heard >>
           one.answered;
}

} // namespace liena::bench
