// What one write brings: headers and short messages in a buffer of its own, and long messages where they lie.
#pragma once

#include "protocol/datagram_encoder.hpp"

#include <boost/container/small_vector.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace liena::tasks {

/// The bytes stay where they are from the write's beginning until clear(); a long message is kept alive for as long, whatever becomes of it
/// in its queue.
class OutputBatch {
public:
    /// A body of at least so many bytes is worth a place of its own in the list that the kernel is given.
    static constexpr std::size_t longBody = 4096;

    /// `room`: bytes that it will hold without asking for memory. `refers`: long bodies stay where they are; else all are copied, since TLS
    /// seals a header and its body as one.
    OutputBatch(std::size_t room, bool refers) : m_refers(refers) { m_own.reserve(room); }

    /// `owner` keeps the body; null: it is copied.
    void append(const protocol::Segment& segment, const std::shared_ptr<const void>& owner);

    std::size_t size() const { return m_size; }
    bool empty() const { return m_size == 0; }
    void clear();

    /// In order; valid until the batch changes.
    std::span<const std::span<const std::byte>> parts();

private:
    /// A run of our own bytes, and what follows it.
    struct Piece {
        std::size_t own = 0;
        std::span<const std::byte> foreign;
    };

    bool m_refers;
    std::size_t m_size = 0;
    std::size_t m_listed = 0; ///< of our own bytes, before the run that is open
    std::vector<std::byte> m_own;
    boost::container::small_vector<Piece, 8> m_pieces;
    boost::container::small_vector<std::shared_ptr<const void>, 4> m_owners;
    boost::container::small_vector<std::span<const std::byte>, 16> m_parts;
};

} // namespace liena::tasks
