// What LiENa devices say, byte for byte, written from PROTOCOL.md alone: this file knows nothing of the library's sources.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace liena::test::wire {

using Bytes = std::vector<std::uint8_t>;
using ByteSpan = std::span<const std::uint8_t>;
using Hash = std::array<std::uint8_t, 32>;

/// Integers little-endian; strings and byte fields with their length before them (section 3).
class Words {
public:
    Words& u8(std::uint8_t value) { return little(value, 1); }
    Words& u16(std::uint16_t value) { return little(value, 2); }
    Words& u32(std::uint32_t value) { return little(value, 4); }
    Words& u64(std::uint64_t value) { return little(value, 8); }
    Words& f32(float value);
    Words& raw(ByteSpan bytes);
    Words& text(std::string_view text);     ///< uint16 length
    Words& bytes(std::string_view content); ///< uint32 length

    operator Bytes() const { return m_bytes; } // NOLINT: a body is its bytes
    const Bytes& value() const { return m_bytes; }

private:
    Words& little(std::uint64_t value, int size);
    Bytes m_bytes;
};

/// Reads what Words writes; past the end everything is 0 and `whole` turns false.
class Reader {
public:
    explicit Reader(ByteSpan bytes) : m_left(bytes) {}
    std::uint8_t u8() { return static_cast<std::uint8_t>(little(1)); }
    std::uint16_t u16() { return static_cast<std::uint16_t>(little(2)); }
    std::uint32_t u32() { return static_cast<std::uint32_t>(little(4)); }
    std::uint64_t u64() { return little(8); }
    std::string text();
    bool whole = true;

private:
    std::uint64_t little(std::size_t size);
    ByteSpan m_left;
};

// Section 2: the datagram.

inline constexpr std::size_t headerBytes = 20;
inline constexpr std::uint32_t everyone = 0xFFFFFFFFU;

struct Header {
    std::uint16_t number = 0;
    std::uint32_t origin = 0;
    std::uint32_t target = 0;
    std::uint64_t timestamp = 0;
    std::uint16_t length = 0;
    bool more = false;
};

struct Datagram {
    Header header;
    Bytes body;
};

Bytes encoded(const Header& header);
std::optional<Header> headerOf(ByteSpan bytes);

/// Header and body; the header's length becomes the body's.
Bytes datagram(Header header, const Bytes& body);

/// Takes the whole datagrams from the front of `stream`.
std::vector<Datagram> takeDatagrams(Bytes& stream);

// Section 3: the safety record.

std::uint32_t crc32c(ByteSpan bytes, std::uint32_t before = 0);

/// The body of a control message: the record for this header, then the fields.
Bytes guarded(Header header, std::uint32_t epoch, std::uint32_t sequence, std::uint32_t echo, const Bytes& fields);

// Section 7: session management.

namespace number {
inline constexpr std::uint16_t attach = 0x01, handshake = 0x02, handshakeCommit = 0x03, messageSetRequest = 0x04, messageSet = 0x05,
                               channelOpened = 0x06, rejected = 0x07, heartbeat = 0x10, disengagement = 0x20, disengagementCommit = 0x21,
                               channelClosed = 0x22, diagnosisHandshake = 0x30, diagnosisHandshakeCommit = 0x31, channelReOpened = 0x32,
                               standBy = 0x40, standByReport = 0x41, incidentDismissed = 0x42, linkReport = 0x50, abandon = 0x51;
} // namespace number

namespace state {
inline constexpr std::uint8_t closed = 0, opening = 1, open = 2, suspect = 3, reconnecting = 4, standBy = 5, reopening = 6, closing = 7;
} // namespace state

namespace reason {
inline constexpr std::uint8_t unknownPeer = 1, noLink = 2, topologyMismatch = 3, protocolVersion = 4, messageSetInvalid = 5, standBy = 6,
                              busy = 7, protocolViolation = 8, timeout = 9, shuttingDown = 10, alreadyOpen = 11, messageSetChanged = 12;
} // namespace reason

struct Heartbeat {
    std::uint32_t sequence = 0;
    std::uint64_t sent = 0;
    std::uint32_t echoSequence = 0;
    std::uint64_t echoSent = 0;
    std::uint64_t echoReceived = 0;
    std::uint8_t datagramsHeard = 0;
    std::uint8_t state = 0;
    std::uint16_t incidents = 0;
    std::uint32_t epoch = 0;
};

Bytes attach(std::uint64_t token, std::uint8_t lane, std::uint16_t protocol = 1);
Bytes handshake(std::uint64_t token, const Hash& topology, const Hash& set, std::string_view software = "scripted");
Bytes handshakeCommit(std::uint64_t token, const Hash& set, bool wantSet = false, std::string_view software = "scripted");
Bytes diagnosisHandshake(std::uint64_t token, const Hash& topology, const Hash& set, std::uint64_t previous);
Bytes messageSet(const Hash& hash, std::string_view xml);
Bytes rejected(std::uint64_t token, std::uint8_t reason, std::string_view detail);
Bytes heartbeat(const Heartbeat& beat);
std::optional<Heartbeat> heartbeatOf(ByteSpan body);
Bytes reOpened(std::uint64_t token, std::uint64_t incident, std::uint32_t x, std::uint32_t y);
Bytes standBy(std::uint64_t incident, std::uint32_t x, std::uint32_t y, std::uint8_t cause, std::uint64_t since, std::uint32_t device);
Bytes standByReport(std::uint64_t incident, std::uint32_t device, bool holding, std::uint64_t confirmed);
Bytes abandon(std::uint16_t message, std::uint64_t timestamp);

/// A body that is a token and nothing else: ChannelOpened, DisengagementCommit, ChannelClosed.
inline Bytes tokenOnly(std::uint64_t token) { return Words().u64(token); }

Hash sha256(ByteSpan bytes);
std::string fileText(const std::filesystem::path& file);
Hash hashOf(std::string_view text);

} // namespace liena::test::wire
