// Segment by segment.
#include "protocol/datagram_encoder.hpp"

#include "protocol/byte_writer.hpp"

#include <algorithm>

namespace liena::protocol {

bool DatagramEncoder::appendSegment(const EncodedMessage& message, std::size_t maximum, std::vector<std::byte>& out)
{
    const auto remaining = message.part.size() - m_sent;
    const auto size = std::min({remaining, maximum, maximumBody});
    auto header = message.header;
    header.length = static_cast<std::uint16_t>(size);
    header.moreSegments = size < remaining;
    ByteWriter writer(out);
    const auto bytes = encodeHeader(header);
    writer.append(std::span<const std::byte>(bytes));
    writer.append(std::span(message.part.data() + m_sent, size));
    m_sent += size;
    m_begun = true;
    return !header.moreSegments;
}

} // namespace liena::protocol
