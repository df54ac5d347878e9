// Segment by segment.
#include "protocol/datagram_encoder.hpp"

#include "protocol/byte_writer.hpp"

#include <algorithm>

namespace liena::protocol {

Segment DatagramEncoder::next(const DatagramHeader& header, PartBytes part, std::size_t maximum)
{
    const auto remaining = part.size() - m_sent;
    const auto size = std::min({remaining, maximum, maximumBody});
    auto own = header;
    own.length = static_cast<std::uint16_t>(size);
    own.moreSegments = size < remaining;
    Segment segment{encodeHeader(own), {}, {}, !own.moreSegments};
    const auto ours = part.own.subspan(std::min(m_sent, part.own.size()));
    if (ours.size() >= size) {
        segment.body = ours.first(size);
    } else {
        segment.lead = ours;
        segment.body = part.lent.subspan(m_sent + ours.size() - part.own.size(), size - ours.size());
        segment.isLent = true;
    }
    m_sent += size;
    m_begun = true;
    return segment;
}

bool DatagramEncoder::appendSegment(const EncodedMessage& message, std::size_t maximum, std::vector<std::byte>& out)
{
    const auto segment = next(message.header, message.bytes(), maximum);
    appendTo(out, segment);
    return segment.last;
}

void appendTo(std::vector<std::byte>& out, const Segment& segment)
{
    ByteWriter(out).append(std::span<const std::byte>(segment.header)).append(segment.lead).append(segment.body);
}

} // namespace liena::protocol
