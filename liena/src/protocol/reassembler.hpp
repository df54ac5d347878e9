// Puts the segments of one lane together again, within bounds (protocol section 2, rulings B6 and A12).
#pragma once

#include "liena/message.hpp"
#include "protocol/datagram.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>

namespace liena::protocol {

/// The bytes that all partial messages of a process may hold together.
class PartialBudget {
public:
    explicit PartialBudget(std::size_t limit = std::size_t{64} << 20U) : m_limit(limit) {}

    bool take(std::size_t bytes)
    {
        if (bytes > m_limit - m_used)
            return false;
        m_used += bytes;
        return true;
    }
    void giveBack(std::size_t bytes) { m_used -= bytes; }
    std::size_t used() const { return m_used; }

private:
    std::size_t m_limit;
    std::size_t m_used = 0;
};

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
    /// With this segment the partials of the process would hold too much; the rest of the message is passed over.
    struct OverBudget {};
    using Outcome = std::variant<Incomplete, Whole, Assembled, OverBudget, Violation>;

    /// `maximum`: the most bytes that the message's definition allows.
    Outcome take(const DatagramHeader& header, std::span<const std::byte> body, std::size_t maximum);

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
        FieldBytes bytes;
        std::size_t heard = 0;    ///< bytes of its segments so far, kept or not
        std::size_t reserved = 0; ///< taken from the budget
        bool discarding = false;  ///< over budget: the rest is passed over
    };
    using Partials = std::map<std::uint16_t, Partial>;

    Outcome begin(const DatagramHeader& header, std::span<const std::byte> body);
    Outcome extend(Partials::iterator partial, const DatagramHeader& header, std::span<const std::byte> body, std::size_t maximum);
    Outcome append(Partial& partial, std::span<const std::byte> body);
    void drop(Partials::iterator partial);

    PartialBudget& m_budget;
    Partials m_partials;
    std::uint64_t m_abandoned = 0;
};

} // namespace liena::protocol
