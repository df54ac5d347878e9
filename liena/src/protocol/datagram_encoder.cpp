// Segment by segment.
#include "protocol/datagram_encoder.hpp"

#include "protocol/byte_writer.hpp"

#include <algorithm>

namespace liena::protocol {

void DatagramEncoder::appendSegment(std::size_t maximum, std::vector<std::byte>& out)
{
    const auto size = std::min(remaining(), std::min(maximum, maximumBody));
    auto header = m_message.header;
    header.length = static_cast<std::uint16_t>(size);
    header.moreSegments = size < remaining();
    ByteWriter writer(out);
    const auto bytes = encodeHeader(header);
    writer.append(std::span<const std::byte>(bytes));
    writer.append(std::span(m_message.part.data() + m_sent, size));
    m_sent += size;
    m_done = !header.moreSegments;
}

} // namespace liena::protocol
