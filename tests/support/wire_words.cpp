// Encoding and decoding of what devices say, as PROTOCOL.md describes it.
#include "support/wire_words.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace liena::test::wire {

Words& Words::little(std::uint64_t value, int size)
{
    for (int i = 0; i < size; ++i)
        m_bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    return *this;
}

Words& Words::f32(float value) { return u32(std::bit_cast<std::uint32_t>(value)); }

Words& Words::raw(ByteSpan bytes)
{
    m_bytes.insert(m_bytes.end(), bytes.begin(), bytes.end());
    return *this;
}

Words& Words::text(std::string_view text)
{
    u16(static_cast<std::uint16_t>(text.size()));
    m_bytes.insert(m_bytes.end(), text.begin(), text.end());
    return *this;
}

Words& Words::bytes(std::string_view content)
{
    u32(static_cast<std::uint32_t>(content.size()));
    m_bytes.insert(m_bytes.end(), content.begin(), content.end());
    return *this;
}

std::uint64_t Reader::little(std::size_t size)
{
    if (m_left.size() < size) {
        whole = false;
        return 0;
    }
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
        value |= std::uint64_t{m_left[i]} << (8 * i);
    m_left = m_left.subspan(size);
    return value;
}

std::string Reader::text()
{
    const std::size_t size = std::min<std::size_t>(u16(), m_left.size());
    std::string text(m_left.begin(), m_left.begin() + static_cast<std::ptrdiff_t>(size));
    m_left = m_left.subspan(size);
    return text;
}

Bytes encoded(const Header& header)
{
    return Words()
        .u16(header.number)
        .u32(header.origin)
        .u32(header.target)
        .u64(header.timestamp)
        .u16(static_cast<std::uint16_t>(header.length | (header.more ? 0x8000U : 0U)));
}

std::optional<Header> headerOf(ByteSpan bytes)
{
    Reader reader(bytes);
    Header header;
    header.number = reader.u16();
    header.origin = reader.u32();
    header.target = reader.u32();
    header.timestamp = reader.u64();
    const auto dlc = reader.u16();
    header.length = dlc & 0x7FFFU;
    header.more = (dlc & 0x8000U) != 0;
    return reader.whole ? std::optional(header) : std::nullopt;
}

Bytes datagram(Header header, const Bytes& body)
{
    header.length = static_cast<std::uint16_t>(body.size());
    return Words().raw(encoded(header)).raw(body);
}

std::vector<Datagram> takeDatagrams(Bytes& stream)
{
    std::vector<Datagram> taken;
    std::size_t at = 0;
    while (const auto header = headerOf(ByteSpan(stream).subspan(at))) {
        const auto end = at + headerBytes + header->length;
        if (end > stream.size())
            break;
        taken.push_back({*header, Bytes(stream.begin() + static_cast<std::ptrdiff_t>(at + headerBytes),
                                        stream.begin() + static_cast<std::ptrdiff_t>(end))});
        at = end;
    }
    stream.erase(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(at));
    return taken;
}

std::uint32_t crc32c(ByteSpan bytes, std::uint32_t before)
{
    std::uint32_t crc = ~before;
    for (const auto byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0x82F63B78U : 0U);
    }
    return ~crc;
}

Bytes guarded(Header header, std::uint32_t epoch, std::uint32_t sequence, std::uint32_t echo, const Bytes& fields)
{
    header.length = static_cast<std::uint16_t>(16 + fields.size());
    const Bytes record = Words().u32(epoch).u32(sequence).u32(echo);
    const auto crc = crc32c(fields, crc32c(record, crc32c(encoded(header))));
    return Words().raw(record).u32(crc).raw(fields);
}

Bytes attach(std::uint64_t token, std::uint8_t lane, std::uint16_t protocol) { return Words().u16(protocol).u64(token).u8(lane); }

Bytes handshake(std::uint64_t token, const Hash& topology, const Hash& set, std::string_view software)
{
    return Words().u64(token).raw(topology).raw(set).text(software);
}

Bytes handshakeCommit(std::uint64_t token, const Hash& set, bool wantSet, std::string_view software)
{
    return Words().u64(token).raw(set).u8(wantSet ? 1 : 0).text(software);
}

Bytes diagnosisHandshake(std::uint64_t token, const Hash& topology, const Hash& set, std::uint64_t previous)
{
    return Words().raw(handshake(token, topology, set)).u64(previous);
}

Bytes messageSet(const Hash& hash, std::string_view xml) { return Words().raw(hash).bytes(xml); }

Bytes rejected(std::uint64_t token, std::uint8_t reason, std::string_view detail) { return Words().u64(token).u8(reason).text(detail); }

Bytes heartbeat(const Heartbeat& beat)
{
    return Words()
        .u32(beat.sequence)
        .u64(beat.sent)
        .u32(beat.echoSequence)
        .u64(beat.echoSent)
        .u64(beat.echoReceived)
        .u8(beat.datagramsHeard)
        .u8(beat.state)
        .u16(beat.incidents)
        .u32(beat.epoch);
}

std::optional<Heartbeat> heartbeatOf(ByteSpan body)
{
    Reader reader(body);
    Heartbeat beat;
    beat.sequence = reader.u32();
    beat.sent = reader.u64();
    beat.echoSequence = reader.u32();
    beat.echoSent = reader.u64();
    beat.echoReceived = reader.u64();
    beat.datagramsHeard = reader.u8();
    beat.state = reader.u8();
    beat.incidents = reader.u16();
    beat.epoch = reader.u32();
    return reader.whole ? std::optional(beat) : std::nullopt;
}

Bytes reOpened(std::uint64_t token, std::uint64_t incident, std::uint32_t x, std::uint32_t y)
{
    return Words().u64(token).u64(incident).u32(std::min(x, y)).u32(std::max(x, y));
}

Bytes standBy(std::uint64_t incident, std::uint32_t x, std::uint32_t y, std::uint8_t cause, std::uint64_t since, std::uint32_t device)
{
    return Words().u64(incident).u32(std::min(x, y)).u32(std::max(x, y)).u8(cause).u64(since).u32(device);
}

Bytes standByReport(std::uint64_t incident, std::uint32_t device, bool holding, std::uint64_t confirmed)
{
    return Words().u64(incident).u32(device).u8(holding ? 1 : 0).u64(confirmed);
}

Bytes abandon(std::uint16_t message, std::uint64_t timestamp) { return Words().u16(message).u64(timestamp); }

Hash sha256(ByteSpan bytes)
{
    Hash hash{};
    unsigned size = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), hash.data(), &size, EVP_sha256(), nullptr) != 1)
        throw std::runtime_error("no SHA-256");
    return hash;
}

std::string fileText(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        throw std::runtime_error("cannot read " + file.string());
    return {std::istreambuf_iterator<char>(stream), {}};
}

Hash hashOf(std::string_view text) { return sha256({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}); }

} // namespace liena::test::wire
