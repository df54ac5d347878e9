// Cuts an encoded message into datagrams (protocol section 2).
#pragma once

#include "liena/message.hpp"
#include "protocol/datagram.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace liena::protocol {

/// A message in wire form on its way out.
struct EncodedMessage {
    DatagramHeader header; ///< length and moreSegments are written per segment
    FieldBytes part;       ///< the information part with its safety record, if any
};

class DatagramEncoder {
public:
    explicit DatagramEncoder(const EncodedMessage& message) : m_message(message) {}

    /// Appends the next segment with a body of at most `maximum` bytes to `out`.
    void appendSegment(std::size_t maximum, std::vector<std::byte>& out);

    bool done() const { return m_done; }
    std::size_t remaining() const { return m_message.part.size() - m_sent; }

private:
    const EncodedMessage& m_message;
    std::size_t m_sent = 0;
    bool m_done = false;
};

} // namespace liena::protocol
