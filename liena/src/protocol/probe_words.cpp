// The same bytes as the session messages' visitor writes and reads.
#include "protocol/probe_words.hpp"

#include "protocol/byte_reader.hpp"
#include "protocol/byte_writer.hpp"

namespace liena::protocol {

FieldBytes encodeProbeHead(const ProbeHead& head, std::size_t padding)
{
    FieldBytes bytes;
    ByteWriter(bytes)
        .write(head.run)
        .write(static_cast<std::uint8_t>(head.way))
        .write(head.sequence)
        .write(head.sentNs)
        .write(static_cast<std::uint32_t>(padding));
    return bytes;
}

std::optional<ProbeHead> decodeProbe(std::span<const std::byte> body)
{
    ByteReader reader(body);
    ProbeHead head;
    head.run = reader.read<std::uint32_t>();
    head.way = static_cast<ProbeWay>(reader.read<std::uint8_t>());
    head.sequence = reader.read<std::uint32_t>();
    head.sentNs = reader.read<std::uint64_t>();
    const std::size_t padding = reader.read<std::uint32_t>();
    const bool declared = head.way >= ProbeWay::Prompt && head.way <= ProbeWay::Image;
    if (!reader.ok() || !declared || padding > maximumProbePadding || reader.remaining() != padding)
        return std::nullopt;
    return head;
}

} // namespace liena::protocol
