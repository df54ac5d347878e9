// How fast bulk may leave by what the peer says it received: a queue that our own kernel cannot see.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace liena::tasks {

/// Pure. `PathRate` sees queues as far as TCP's acknowledgements come from: not beyond a relay that ends the connection and makes another
/// one, nor in the buffers of a peer that is slow to take what arrives. There pictures grow old, seconds deep. The peer's LinkReports see
/// all of the way: what has left and is not received waits somewhere. What was lost and waits nowhere is the least of the last half minute;
/// of what left by UDP since then a quarter may be lost as well. Of what our own kernel holds `PathRate` knows more, and sooner. More than
/// a tenth of a second beyond all that, and beyond what is still on its way, is a queue, and what arrives while it stands is what the way
/// carries.
///
/// It only ever lowers the rate. A peer that reports nonsense slows down what itself receives, and nothing else.
class ArrivalLimit {
public:
    using Nanoseconds = std::chrono::nanoseconds;

    /// What one report says, and what had left when it came. Bytes are those of whole messages' information parts.
    struct Report {
        Nanoseconds window{};       ///< that it speaks of
        std::uint64_t received = 0; ///< in the window
        std::uint64_t sent = 0;     ///< of all that left so far; may begin anywhere
        std::uint64_t packets = 0;  ///< of it, in UDP packets, which the network may lose
        std::uint64_t held = 0;     ///< of it, by our kernel: not acknowledged
        std::size_t largest = 0;    ///< message that is sent, those of all lanes added: whole ones only are counted
        Nanoseconds roundTrip{};    ///< of a prompt message
    };

    void reported(const Report& report);

    /// Messages may have been lost on their way: what did not arrive does not wait.
    void restart() { *this = {}; }

    /// A report may be missing: what it counted as received would be a queue for half a minute. What the way carries is still known.
    void forgetWaiting();

    /// Bytes per second; nothing where the reports know no limit.
    std::optional<double> bytesPerSecond() const;

    /// Bytes that are not received, as last seen, beyond those that were lost.
    std::uint64_t waiting() const { return m_waiting; }

private:
    struct Arrival {
        std::int64_t under = 0; ///< way: sent and not received
        std::uint64_t received = 0;
        std::uint64_t sent = 0; ///< in the window
        std::uint64_t packets = 0;
        Nanoseconds window{};
    };

    /// While a queue stands.
    struct Full {
        std::uint64_t received = 0;
        Nanoseconds time{};
    };

    double recentRate() const;
    std::uint64_t sentWithin(Nanoseconds time) const;
    std::uint64_t sentInPackets() const;
    void meetQueue(const Report& report, double rate);
    void grow();

    std::deque<Arrival> m_arrivals; ///< of the last half minute
    std::int64_t m_under = 0;
    std::uint64_t m_sent = 0;
    std::uint64_t m_sentInPackets = 0;
    std::uint64_t m_waiting = 0;
    std::optional<Full> m_full;
    std::optional<double> m_carried; ///< bytes per second, as far as is known
    bool m_draining = false;
    int m_calm = 0; ///< reports without a queue since the last one
    double m_step = 1;
};

} // namespace liena::tasks
