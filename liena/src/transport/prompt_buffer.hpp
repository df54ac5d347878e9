// How much the kernel may hold of a connection whose messages must not wait.
#pragma once

#include "transport/path_facts.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace liena::transport {

/// Pure; in bytes. What the kernel has can no longer give way to a command, and on a narrow path it stands in queues there; but a long path
/// needs as much under way as a round trip carries. So the send buffer begins small, and each write that has to wait says which of both it
/// is.
struct PromptBuffer {
    static constexpr int unsent = 4 * 1024;      ///< that are not on the wire yet: behind them the next message waits
    static constexpr int unsentHere = 16 * 1024; ///< where both ends are on one computer
    static constexpr int smallest = 32 * 1024;
    static constexpr int largest = 256 * 1024;

    /// After `present`, when a write has to wait; the kernel was told to take no more when so many are unsent.
    static int next(int present, const PathFacts& facts, int mostUnsent)
    {
        using namespace std::chrono_literals;
        if (facts.roundTrip > 2 * facts.leastRoundTrip + 1ms)
            return std::max(present / 2, smallest);                       // queues build up, of ours or of others
        const bool isFull = std::cmp_less(facts.bytesUnsent, mostUnsent); // of what is under way
        return isFull ? std::min(2 * present, largest) : present;
    }
};

} // namespace liena::transport
