// Cuts an encoded message into datagrams (protocol section 2).
#pragma once

#include "liena/message.hpp"
#include "protocol/datagram.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace liena::protocol {

/// The bytes of an information part: the message's own, and behind them those that were lent to it.
struct PartBytes {
    std::span<const std::byte> own;
    std::span<const std::byte> lent;

    std::size_t size() const { return own.size() + lent.size(); }
};

/// A message in wire form on its way out.
struct EncodedMessage {
    EncodedMessage() {} // not defaulted: else `{}` fills the inline part of `part` with zeros first, for each message that is sent
    EncodedMessage(const DatagramHeader& itsHeader, FieldBytes itsPart) : header(itsHeader), part(std::move(itsPart)) {}

    DatagramHeader header; ///< length and moreSegments are written per segment
    FieldBytes part;       ///< the information part with its safety record, if any, up to what was lent
    std::shared_ptr<const LentBytes> lent;

    PartBytes bytes() const { return {{part.data(), part.size()}, lent ? lent->bytes : std::span<const std::byte>()}; }
    std::size_t size() const { return bytes().size(); }
};

/// One datagram whose body lies where its message lies.
struct Segment {
    HeaderBytes header;
    std::span<const std::byte> lead; ///< the body's beginning where the rest of it is lent; else empty
    std::span<const std::byte> body;
    bool last = false;   ///< of its message
    bool isLent = false; ///< `body` is

    std::size_t size() const { return header.size() + lead.size() + body.size(); }
};

/// How far a message has been cut. It does not hold the message, so that a queue may move it.
class DatagramEncoder {
public:
    /// The next segment of the message of this header and information part, with a body of at most `maximum` bytes.
    Segment next(const DatagramHeader& header, PartBytes part, std::size_t maximum);

    /// Appends the next segment of `message` to `out`; true when it was the last.
    bool appendSegment(const EncodedMessage& message, std::size_t maximum, std::vector<std::byte>& out);

    bool begun() const { return m_begun; }

private:
    std::size_t m_sent = 0;
    bool m_begun = false;
};

/// Appends the bytes of `segment`.
void appendTo(std::vector<std::byte>& out, const Segment& segment);

} // namespace liena::protocol
