// The safety record's byte layout and check sum.
#include "protocol/safety_record.hpp"

#include "protocol/byte_reader.hpp"
#include "protocol/crc32c.hpp"

#include <cstring>

namespace liena::protocol {

namespace {

constexpr std::size_t guardedRecordSize = safetyRecordSize - sizeof(SafetyRecord::crc);

} // namespace

SafetyRecordBytes encodeSafetyRecord(const SafetyRecord& record)
{
    SafetyRecordBytes bytes{};
    const std::array<std::uint32_t, 4> words{record.epoch, record.sequence, record.echo, record.crc};
    std::memcpy(bytes.data(), words.data(), bytes.size());
    return bytes;
}

SafetyRecord decodeSafetyRecord(std::span<const std::byte, safetyRecordSize> bytes)
{
    ByteReader reader(bytes);
    SafetyRecord record;
    record.epoch = reader.read<std::uint32_t>();
    record.sequence = reader.read<std::uint32_t>();
    record.echo = reader.read<std::uint32_t>();
    record.crc = reader.read<std::uint32_t>();
    return record;
}

std::uint32_t safetyCrc(const DatagramHeader& header, const SafetyRecord& record, std::span<const std::byte> fields)
{
    DatagramHeader single = header;
    single.length = static_cast<std::uint16_t>(safetyRecordSize + fields.size());
    single.moreSegments = false;
    const auto headerBytes = encodeHeader(single);
    const auto recordBytes = encodeSafetyRecord(record);
    std::array<std::byte, headerSize + guardedRecordSize> front;
    std::memcpy(front.data(), headerBytes.data(), headerSize);
    std::memcpy(front.data() + headerSize, recordBytes.data(), guardedRecordSize);
    return crc32c(fields, crc32c(front));
}

} // namespace liena::protocol
