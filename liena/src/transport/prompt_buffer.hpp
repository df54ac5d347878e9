// How much the kernel may hold of a connection whose messages must not wait.
#pragma once

#include "transport/path_facts.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
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

/// The same for what a command may pass, and is long: as much as keeps the path busy, and little more, since behind it the next command
/// waits. Pure but for what it remembers.
class PatientBuffer {
public:
    static constexpr int smallest = 2304; ///< the least that Linux takes; it doubles it for what it needs itself
    static constexpr int largest = PromptBuffer::largest;

    int bytes() const { return m_bytes; }

    /// That leave in one piece: two packets at least, and up to four at once until the kernel is full.
    std::size_t write() const { return std::clamp(static_cast<std::size_t>(m_bytes) / 2, leastWrite, mostWrite); }

    /// A write has to wait. What was under way when one had to before must have come, so that it shows in the mean round trip: that is the
    /// kernel's, and commands in between, which met no queue, have a part in it.
    void full(const PathFacts& facts)
    {
        using namespace std::chrono_literals;
        m_isLong = facts.leastRoundTrip > 2ms;
        if (m_awaited && facts.bytesAcknowledged < *m_awaited)
            return;
        if (!m_awaited) {
            m_awaited = facts.bytesSent;
            return;
        }
        m_awaited = facts.bytesSent;
        const auto least = facts.leastRoundTrip;
        const auto queued = facts.roundTrip - least;
        const auto mayQueue = 250us + least / 8;
        if (queued > mayQueue * 8 / 5)
            meetQueue(static_cast<double>((least + mayQueue).count()) / static_cast<double>(facts.roundTrip.count()));
        else if (queued < mayQueue * 2 / 5 && facts.bytesUnsent < PromptBuffer::unsent)
            resize(m_bytes * m_growth);
    }

    /// Nothing waits any more. On a short way what is acknowledged until the next time says nothing of a full path; a long way is full of
    /// what was sent before.
    void pause()
    {
        if (!m_isLong)
            m_awaited.reset();
    }

private:
    static constexpr std::size_t leastWrite = 2854; // with a header and a seal: two packets of 1448 bytes
    static constexpr std::size_t mostWrite = 8192;

    // In one round trip, before the path was first seen to be full and since: what is too much stands in its queue.
    static constexpr double bold = 1.5;
    static constexpr double careful = 1.2;

    void meetQueue(double part)
    {
        m_growth = careful;
        resize(m_bytes * std::max(part, 0.5)); // a moment in which all stood still says little
    }

    void resize(double bytes)
    {
        m_bytes = std::clamp(static_cast<int>(bytes), smallest, largest);
        m_awaited.reset(); // the next time that it is full, as many are under way
    }

    int m_bytes = smallest;
    double m_growth = bold;
    bool m_isLong = false;
    std::optional<std::uint64_t> m_awaited; ///< sent and unacknowledged the last time that it was full
};

} // namespace liena::transport
