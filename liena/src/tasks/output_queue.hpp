// What waits to leave on one lane: strict order between classes, first come first served within one.
#pragma once

#include "liena/message_set.hpp"
#include "protocol/datagram_encoder.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

namespace liena::tasks {

/// The class of a message on its way out. Session management ranks with safety.
enum class Rank : std::uint8_t { Safety, Control, Status, Bulk, Last };

Rank rankOf(Priority priority);

/// Network thread. A message in several segments may be passed by a higher class between them.
class OutputQueue {
public:
    struct Limits {
        std::size_t messages = 4096;
        std::size_t bytes = std::size_t{64} << 20U;
    };

    struct Entry {
        protocol::EncodedMessage message;
        Rank rank = Rank::Status;
        std::uint32_t history = 0;                                    ///< 0: kept until sent
        std::optional<std::chrono::steady_clock::time_point> expires; ///< lifespan
        std::string_view name;                                        ///< of the definition, for reports; empty for session management
    };

    /// Called for each message that is accepted and will not leave.
    enum class Fate : std::uint8_t { Superseded, Expired, Discarded };
    using Report = std::function<void(const Entry&, Fate)>;

    /// The Abandon for a message that was begun and will not be sent to its end.
    using Abandoning = std::function<protocol::EncodedMessage(const protocol::DatagramHeader& begun)>;

    OutputQueue(Report report, Abandoning abandoning) : OutputQueue(std::move(report), std::move(abandoning), Limits()) {}
    OutputQueue(Report report, Abandoning abandoning, Limits limits)
        : m_report(std::move(report)), m_abandoning(std::move(abandoning)), m_limits(limits)
    {}

    /// False when the queue is full; session management always fits.
    bool push(Entry entry);

    /// Appends the next segment to `out`, with a body of at most `maximumSegment` bytes; false when nothing waits.
    bool appendNext(std::size_t maximumSegment, std::chrono::steady_clock::time_point now, std::vector<std::byte>& out);

    /// The lane was connected anew: a message that was cut off begins again.
    void restart();

    void discard(Rank rank);
    /// Everything but session management; what was begun is abandoned.
    void discardApplication();

    bool empty() const { return m_count == 0; }
    std::size_t size() const { return m_count; }
    std::size_t bytes() const { return m_bytes; }

private:
    struct Waiting {
        Entry entry;
        protocol::DatagramEncoder encoder;
    };
    using Class = std::deque<Waiting>;

    static bool isExpired(const Waiting& waiting, std::chrono::steady_clock::time_point now);
    void drop(Class& waiting, Class::iterator at, Fate fate);
    static std::vector<std::size_t> superseded(const Class& waiting, const Entry& entry);

    Report m_report;
    Abandoning m_abandoning;
    Limits m_limits;
    std::array<Class, 5> m_classes;
    std::size_t m_count = 0;
    std::size_t m_bytes = 0;
};

} // namespace liena::tasks
