// What this computer does without us: 64 bytes and their echo over plain TCP between two threads, in a fixed rhythm.
#pragma once

#include <chrono>

namespace liena::bench {

struct RawPair {
    double p50Us = 0; ///< round trip
    double p99Us = 0;
    double largestStallMs = 0; ///< by which a timer of 1 ms came late
};

/// Takes as long as `length`. Throws std::system_error.
RawPair measureRawPair(std::chrono::milliseconds length);

} // namespace liena::bench
