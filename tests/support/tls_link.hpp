// One TCP connection of a scripted peer, with TLS 1.3 by OpenSSL itself, and the seal of its datagrams (PROTOCOL.md section 6).
#pragma once

#include "support/wire_words.hpp"

#include <openssl/ssl.h>

#include <chrono>
#include <memory>
#include <string>
#include <utility>

namespace liena::test {

/// A socket that is closed with the object.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int number) : m_number(number) {}
    Descriptor(Descriptor&& other) noexcept : m_number(std::exchange(other.m_number, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept
    {
        std::swap(m_number, other.m_number);
        return *this;
    }
    ~Descriptor();
    int number() const { return m_number; }
    explicit operator bool() const { return m_number >= 0; }

private:
    int m_number = -1;
};

Descriptor tcpSocket();                                       ///< non-blocking; nothing when there are no descriptors left
bool connectTo(const Descriptor& socket, std::uint16_t port); ///< to 127.0.0.1:`port`, begun or made

/// Both of them. Nothing when one fails.
Descriptor tcpTo(std::uint16_t port);
Descriptor listenAt(std::uint16_t port);
Descriptor udpAt(std::uint16_t port); ///< 0: any port

bool waitFor(int descriptor, short events, std::chrono::milliseconds time);

using ContextPtr = std::unique_ptr<SSL_CTX, void (*)(SSL_CTX*)>;

/// What a peer shows of itself. Empty file names: it shows no certificate and believes any.
struct TlsFace {
    std::filesystem::path certificate;
    std::filesystem::path key;
    std::filesystem::path authority;
    std::filesystem::path between; ///< an authority between, shown along
    std::string alpn = "liena/1";  ///< empty: none
    int highestVersion = TLS1_3_VERSION;
    std::string groups = "X25519:P-256:P-384:P-521";
};

ContextPtr clientContext(const TlsFace& face);
ContextPtr serverContext(const TlsFace& face);

class TlsLink {
public:
    static constexpr std::chrono::seconds patience{20};

    /// Connects and completes the handshake as far as the client sees it; ask failure().
    static std::unique_ptr<TlsLink> connect(SSL_CTX* context, std::uint16_t port);

    /// Takes an accepted socket; the handshake goes on in receive().
    TlsLink(SSL_CTX* context, Descriptor socket, bool server);

    /// Writes all of it, or says no because the connection ended or `patience` did.
    bool send(const wire::Bytes& bytes);

    /// Reads what is there without waiting. False when the connection has ended.
    bool receive(wire::Bytes& into);

    /// Waits until the other side closes, and gives all that it said before. False: it did not within `patience`.
    bool closes(wire::Bytes* said = nullptr);

    bool ready() const { return SSL_is_init_finished(m_ssl.get()) == 1; }
    const std::string& failure() const { return m_failure; }
    int descriptor() const { return m_socket.number(); }

    /// 44 bytes for this token: 32 of key, 12 of iv.
    wire::Bytes datagramKey(std::uint64_t token) const;

private:
    bool handshake();
    bool again(int result);

    Descriptor m_socket;
    std::unique_ptr<SSL, void (*)(SSL*)> m_ssl;
    std::string m_failure;
};

/// `token`, `packet number`, the datagram sealed with AES-256-GCM, the tag.
wire::Bytes sealed(const wire::Bytes& keyAndIv, std::uint64_t token, std::uint64_t packet, const wire::Bytes& datagram);

/// The datagram, or nothing when the tag does not hold.
std::optional<wire::Bytes> unsealed(const wire::Bytes& keyAndIv, const wire::Bytes& packet);

} // namespace liena::test
