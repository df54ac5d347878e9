// Keys of the datagram path, and how its packets are sealed and opened (protocol section 6): AES-256-GCM (NIST SP 800-38D) with the nonces
// of TLS 1.3 (RFC 8446 section 5.3) under keys of the TLS exporter (RFC 8446 section 7.5).
#pragma once

#include "liena/error.hpp"
#include "security/openssl_types.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace liena::security {

struct DatagramKey {
    std::array<std::byte, 32> key{};
    std::array<std::byte, 12> iv{};
};

/// What both ends of a TLS connection derive alike for the session with that token.
Result<DatagramKey> exportDatagramKey(SSL* connection, std::uint64_t token);

/// One key. Network thread; nothing is allocated per packet.
class DatagramSeal {
public:
    static constexpr std::size_t tagSize = 16;

    explicit DatagramSeal(const DatagramKey& key);

    /// Encrypts `plain` to `sealed` and writes the tag behind it; `sealed` is tagSize bytes longer and may begin where `plain` does.
    /// `number` must never have been used with this key. False when OpenSSL fails.
    bool seal(std::uint64_t number, std::span<const std::byte> clear, std::span<const std::byte> plain, std::span<std::byte> sealed);

    /// Decrypts `sealed`, which ends with the tag, to `plain`; false when `clear` or `sealed` are not what the peer has sealed, and what
    /// `plain` holds then must not be read.
    bool open(std::uint64_t number, std::span<const std::byte> clear, std::span<const std::byte> sealed, std::span<std::byte> plain);

private:
    using CipherPtr = std::unique_ptr<EVP_CIPHER_CTX, Released<EVP_CIPHER_CTX_free>>;

    std::array<unsigned char, 12> nonce(std::uint64_t number) const;

    CipherPtr m_sealing;
    CipherPtr m_opening;
    std::array<std::byte, 12> m_iv;
};

} // namespace liena::security
