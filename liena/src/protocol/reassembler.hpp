// Puts the segments of one lane together again, within bounds (protocol section 2, rulings B6 and A12).
#pragma once

#include "liena/message.hpp"
#include "protocol/datagram.hpp"
#include "protocol/partial_budget.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>

namespace liena::protocol {

/// One per lane and direction; network thread. The origin of all segments is the same authenticated peer.
class Reassembler {
public:
    explicit Reassembler(PartialBudget& budget) : m_budget(budget) {}
    ~Reassembler() { clear(); }
    Reassembler(const Reassembler&) = delete;
    Reassembler& operator=(const Reassembler&) = delete;

    struct Incomplete {};
    struct Violation {
        std::string what;
    };
    /// A message that came in one segment: its bytes are those of the call.
    struct Whole {};
    /// A message that came in several.
    struct Assembled {
        FieldBytes bytes;
    };
    /// The segment is passed over: with one of its message the partials of the process would have held too much.
    struct OverBudget {
        std::size_t bytes = 0; ///< with the first, of the message's segments before it as well
        bool first = false;    ///< of its message
    };
    using Outcome = std::variant<Incomplete, Whole, Assembled, OverBudget, Violation>;

    /// `maximum`: the most bytes that the message's definition allows.
    Outcome take(const DatagramHeader& header, std::span<const std::byte> body, std::size_t maximum);

    /// The same for a body that comes in pieces, judged before they come. Incomplete: they go to add(), and then close() says what became
    /// of the segment. Anything else is final: Whole is for take(), with the whole body.
    Outcome open(const DatagramHeader& header, std::size_t length, std::size_t maximum);
    void add(std::span<const std::byte> piece);
    Outcome close();

    /// Where the next `bytes` bytes of that body will be in the end: a piece that lies there already is not copied by add(). Empty when
    /// there is no such place. The keeper keeps it, whatever becomes of the message.
    struct Place {
        std::span<std::byte> bytes;
        std::shared_ptr<const void> keeper;
    };
    Place place(std::size_t bytes);

    /// The sender gave the partial message up.
    void abandon(std::uint16_t number, Timestamp timestamp);

    /// Drops every partial; they count as abandoned.
    void clear();

    bool hasPartial() const { return !m_partials.empty(); }
    std::uint64_t abandoned() const { return m_abandoned; }

private:
    struct Partial {
        Timestamp timestamp;
        DeviceId target;
        std::shared_ptr<FieldBytes> bytes;
        std::size_t filled = 0;   ///< of `bytes`
        std::size_t heard = 0;    ///< bytes of its segments so far, kept or not
        std::size_t reserved = 0; ///< taken from the budget
        std::size_t room = 0;     ///< kept by the budget
        bool discarding = false;  ///< over budget: the rest is passed over
    };
    using Partials = std::map<std::uint16_t, Partial>;

    /// The segment that add() continues.
    struct Segment {
        Partials::iterator partial;
        std::size_t length = 0;
        bool last = false;
        bool overBudget = false; ///< with this segment
    };

    std::optional<Violation> judge(const Partial& partial, const DatagramHeader& header, std::size_t length, std::size_t maximum) const;
    Partials::iterator begin(const DatagramHeader& header, std::size_t maximum);
    bool reserve(Partial& partial, std::size_t bytes);
    static std::span<std::byte> tail(Partial& partial, std::size_t bytes);
    FieldBytes takeFitting(Partial& partial);
    void release(Partial& partial);
    void drop(Partials::iterator partial);

    PartialBudget& m_budget;
    Partials m_partials;
    std::optional<Segment> m_open;
    std::map<std::uint16_t, std::size_t> m_lastSize; ///< of each message number: the next is likely as long
    std::size_t m_held = 0;                          ///< of the budget, by all partials
    std::uint64_t m_abandoned = 0;
};

} // namespace liena::protocol
