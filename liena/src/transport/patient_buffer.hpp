// How much the kernel may hold of what is long and may be passed by a command.
#pragma once

#include "transport/path_facts.hpp"
#include "transport/prompt_buffer.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace liena::transport {

/// In bytes. As much as keeps a short way busy and a long one half busy, and little more, since behind it the next command waits. What is
/// under way of commands takes room here, too, so that a long way is never given less than they need.
class PatientBuffer {
public:
    static constexpr int smallest = 2304; ///< the least that Linux takes; it doubles it for what it needs itself
    static constexpr int largest = PromptBuffer::largest;

    /// On a way that takes so long: a thousand commands a second, each of which the kernel counts as some 1.3 KiB.
    static int smallestOn(std::chrono::nanoseconds leastRoundTrip)
    {
        const auto ms = std::chrono::duration<double, std::milli>(leastRoundTrip).count();
        return std::min(smallest + static_cast<int>(1152 * ms), PromptBuffer::smallest);
    }

    int bytes() const { return m_bytes; }

    /// That leave in one piece: two packets, or more where more may be under way.
    std::size_t write() const { return std::clamp(static_cast<std::size_t>(m_bytes) / 2, leastWrite, mostWrite); }

    /// A write has to wait. What was under way when one had to before must have come, so that it shows in the mean round trip: that is the
    /// kernel's, and commands in between, which met no queue, have a part in it.
    void full(const PathFacts& facts)
    {
        using namespace std::chrono_literals;
        m_isLong = facts.leastRoundTrip > 2ms;
        m_floor = smallestOn(facts.leastRoundTrip);
        m_bytes = std::max(m_bytes, m_floor);
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
        else if (queued < mayQueue * 2 / 5 && facts.bytesUnsent < writable)
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
        m_bytes = std::clamp(static_cast<int>(bytes), m_floor, largest);
        m_awaited.reset(); // the next time that it is full, as many are under way
    }

    static constexpr std::uint32_t writable = PromptBuffer::unsent / 2; ///< of so many unsent bytes on Linux tells of no room

    int m_bytes = smallest;
    int m_floor = smallest;
    double m_growth = bold;
    bool m_isLong = false;
    std::optional<std::uint64_t> m_awaited; ///< sent and unacknowledged the last time that it was full
};

} // namespace liena::transport
