// What waits to leave on one lane: strict order between classes, fair turns of the streams within one.
#pragma once

#include "base/ring.hpp"
#include "liena/message_set.hpp"
#include "protocol/datagram_encoder.hpp"
#include "tasks/output_batch.hpp"

#include <boost/container/small_vector.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace liena::tasks {

/// The class of a message on its way out. Session management ranks with safety, but what is told to all about incidents: there may be
/// hundreds at once, and no heartbeat, stop or command waits behind them. Images that just measure leave while no other bulk waits.
enum class Rank : std::uint8_t { Safety, Control, Incident, Status, Bulk, Measuring, Last };

Rank rankOf(Priority priority);

/// Network thread. A message in several segments may be passed by a higher class between them.
///
/// The streams (message numbers) of the classes status and bulk take turns by deficit round robin (Shreedhar and Varghese, SIGCOMM 1995),
/// a segment's worth of bytes each; a stream keeps its order. Safety with session management, control, incidents, and what measures are one
/// stream each. The dialogues of session management count on its order, and what a hand does is to happen in the order in which it did it,
/// whichever messages say so: these are few and small, and none waits long for another.
class OutputQueue {
public:
    /// Of each class by itself, so that no command and no stop is refused for what waits behind it.
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
        std::shared_ptr<const MessageSet> set = nullptr;              ///< that `name` lives in: the peer's may be exchanged meanwhile
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

    /// False when its class is full; session management always fits.
    bool push(Entry&& entry);

    /// Appends the next segment to `out`, with a body of at most `maximumSegment` bytes, but a control message whole; false when nothing
    /// waits.
    bool appendNext(std::size_t maximumSegment, std::chrono::steady_clock::time_point now, OutputBatch& out);
    bool appendNext(std::size_t maximumSegment, std::chrono::steady_clock::time_point now, std::vector<std::byte>& out);

    /// The lane was connected anew: a message that was cut off begins again.
    void restart();

    void discard(Rank rank);
    /// Everything but session management; what was begun is abandoned.
    void discardApplication();

    /// Application messages that left whole.
    struct Left {
        std::uint64_t bytes = 0; ///< of their information parts
        std::size_t largest = 0;
    };
    const Left& left() const { return m_left; }

    /// A message of that class and number has not left whole.
    bool waits(Rank rank, std::uint16_t number) const;

    /// Something waits that is not to wait for what may be passed: session management, safety, control, or news of incidents.
    bool hasUrgent() const { return hasAny(Rank::Safety) || hasAny(Rank::Control) || hasAny(Rank::Incident); }

    bool empty() const { return m_count == 0; }
    std::size_t size() const { return m_count; }
    std::size_t bytes() const { return m_bytes; }
    /// Messages of one class, session management with them.
    std::size_t waiting(Rank rank) const;

private:
    struct Waiting {
        Entry entry;
        protocol::DatagramEncoder encoder;
        std::shared_ptr<const FieldBytes> begun = nullptr; ///< the part of a long message once it is being sent: a write may need it longer

        protocol::PartBytes part() const
        {
            auto bytes = entry.message.bytes();
            if (begun)
                bytes.own = {begun->data(), begun->size()};
            return bytes;
        }
    };
    using Places = boost::container::small_vector<std::size_t, 16>;

    struct Stream {
        base::Ring<Waiting> waiting;
        std::ptrdiff_t credit = 0; ///< bytes that it may still send in this turn
    };
    struct Load {
        std::size_t messages = 0;
        std::size_t bytes = 0;
    };
    struct Class {
        std::map<std::uint16_t, Stream> streams; ///< by message number
        base::Ring<Stream*> turns;               ///< those with something to send, the next one first
        Load bounded;                            ///< what waits of it; not session management
    };

    bool hasAny(Rank rank) const { return !m_classes[static_cast<std::size_t>(rank)].turns.empty(); }
    static bool isExpired(const Waiting& waiting, std::chrono::steady_clock::time_point now);
    Stream& streamOf(Class& ofRank, const Entry& entry);
    template <typename Out>
    bool appendNextTo(Out& out, std::size_t maximumSegment, std::chrono::steady_clock::time_point now);
    template <typename Out>
    void take(Class& from, std::size_t maximumSegment, Out& out);
    template <typename Out>
    bool expire(Class& from, std::size_t maximumSegment, std::chrono::steady_clock::time_point now, Out& out);
    void enters(const Entry& entry, std::size_t size);
    void leaves(const Entry& entry, std::size_t size);
    void drop(Stream& stream, std::size_t at, Fate fate);
    static void endTurn(Class& of);
    static Places superseded(const Stream& stream, const Entry& entry);
    template <typename Visit>
    void forEachStream(Visit visit);

    Report m_report;
    Abandoning m_abandoning;
    Limits m_limits;
    std::array<Class, 7> m_classes;
    std::size_t m_count = 0;
    std::size_t m_bytes = 0;
    Left m_left;
};

} // namespace liena::tasks
