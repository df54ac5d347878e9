// Sockets with deadlines, TLS contexts, and sealing, for a scripted peer.
#include "support/tls_link.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

namespace liena::test {

using namespace wire;

namespace {

constexpr unsigned char alpnWire[] = "\x07liena/1";

void need(bool done, const char* what)
{
    if (done)
        return;
    char reason[256] = "";
    ERR_error_string_n(ERR_get_error(), reason, sizeof reason);
    throw std::runtime_error(std::string("the scripted peer: ") + what + ": " + reason);
}

sockaddr_in loopback(std::uint16_t port)
{
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

Descriptor openSocket(int kind)
{
    std::signal(SIGPIPE, SIG_IGN); // OpenSSL writes without MSG_NOSIGNAL
    return Descriptor(::socket(AF_INET, kind | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
}

Descriptor bound(int kind, std::uint16_t port)
{
    auto made = openSocket(kind);
    const int on = 1;
    if (kind == SOCK_STREAM)
        ::setsockopt(made.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    const auto address = loopback(port);
    if (::bind(made.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        throw std::runtime_error("the scripted peer cannot bind port " + std::to_string(port));
    return made;
}

ContextPtr context(const TlsFace& face, const SSL_METHOD* method)
{
    ContextPtr made(SSL_CTX_new(method), SSL_CTX_free);
    need(made != nullptr, "TLS context");
    SSL_CTX_set_security_level(made.get(), 0); // what is too weak is the other side's to refuse
    SSL_CTX_set_max_proto_version(made.get(), face.highestVersion);
    need(SSL_CTX_set1_groups_list(made.get(), face.groups.c_str()) == 1, "key exchange");
    SSL_CTX_set_mode(made.get(), SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
    if (!face.certificate.empty()) {
        need(SSL_CTX_use_certificate_file(made.get(), face.certificate.c_str(), SSL_FILETYPE_PEM) == 1, "certificate");
        need(SSL_CTX_use_PrivateKey_file(made.get(), face.key.c_str(), SSL_FILETYPE_PEM) == 1, "key");
    }
    if (!face.between.empty()) {
        const std::unique_ptr<BIO, int (*)(BIO*)> file(BIO_new_file(face.between.c_str(), "r"), BIO_free);
        X509* const between = file ? PEM_read_bio_X509(file.get(), nullptr, nullptr, nullptr) : nullptr;
        need(between != nullptr && SSL_CTX_add0_chain_cert(made.get(), between) == 1, "authority between");
    }
    if (!face.authority.empty()) {
        need(SSL_CTX_load_verify_locations(made.get(), face.authority.c_str(), nullptr) == 1, "authority");
        SSL_CTX_set_verify(made.get(), SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT, nullptr);
    }
    return made;
}

} // namespace

Descriptor::~Descriptor()
{
    if (m_number >= 0)
        ::close(m_number);
}

Descriptor tcpSocket()
{
    auto made = openSocket(SOCK_STREAM);
    const int on = 1;
    ::setsockopt(made.number(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    return made;
}

bool connectTo(const Descriptor& socket, std::uint16_t port)
{
    const auto address = loopback(port);
    return ::connect(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 || errno == EINPROGRESS;
}

Descriptor tcpTo(std::uint16_t port)
{
    auto made = tcpSocket();
    return connectTo(made, port) ? std::move(made) : Descriptor();
}

Descriptor listenAt(std::uint16_t port)
{
    auto made = bound(SOCK_STREAM, port);
    need(::listen(made.number(), 64) == 0, "listen");
    return made;
}

Descriptor udpAt(std::uint16_t port) { return bound(SOCK_DGRAM, port); }

bool waitFor(int descriptor, short events, std::chrono::milliseconds time)
{
    pollfd one{descriptor, events, 0};
    return ::poll(&one, 1, static_cast<int>(time.count())) > 0;
}

ContextPtr clientContext(const TlsFace& face)
{
    auto made = context(face, TLS_client_method());
    if (!face.alpn.empty()) {
        const Bytes wire = Words()
                               .u8(static_cast<std::uint8_t>(face.alpn.size()))
                               .raw({reinterpret_cast<const std::uint8_t*>(face.alpn.data()), face.alpn.size()});
        need(SSL_CTX_set_alpn_protos(made.get(), wire.data(), static_cast<unsigned>(wire.size())) == 0, "ALPN");
    }
    return made;
}

ContextPtr serverContext(const TlsFace& face)
{
    auto made = context(face, TLS_server_method());
    SSL_CTX_set_num_tickets(made.get(), 0);
    SSL_CTX_set_alpn_select_cb(
        made.get(),
        [](SSL*, const unsigned char** out, unsigned char* size, const unsigned char* in, unsigned length, void*) {
            unsigned char* chosen = nullptr;
            const auto found = SSL_select_next_proto(&chosen, size, alpnWire, sizeof alpnWire - 1, in, length);
            *out = chosen;
            return found == OPENSSL_NPN_NEGOTIATED ? SSL_TLSEXT_ERR_OK : SSL_TLSEXT_ERR_ALERT_FATAL;
        },
        nullptr);
    return made;
}

TlsLink::TlsLink(SSL_CTX* context, Descriptor socket, bool server) : m_socket(std::move(socket)), m_ssl(SSL_new(context), SSL_free)
{
    SSL_set_fd(m_ssl.get(), m_socket.number());
    server ? SSL_set_accept_state(m_ssl.get()) : SSL_set_connect_state(m_ssl.get());
}

std::unique_ptr<TlsLink> TlsLink::connect(SSL_CTX* context, std::uint16_t port)
{
    auto link = std::make_unique<TlsLink>(context, tcpTo(port), false);
    const auto deadline = std::chrono::steady_clock::now() + patience;
    waitFor(link->descriptor(), POLLOUT, patience);
    while (!link->handshake() && link->m_failure.empty()) {
        if (std::chrono::steady_clock::now() > deadline)
            link->m_failure = "no answer to the TLS handshake";
        else
            waitFor(link->descriptor(), SSL_want_write(link->m_ssl.get()) ? POLLOUT : POLLIN, std::chrono::milliseconds(100));
    }
    return link;
}

bool TlsLink::handshake()
{
    ERR_clear_error();
    const int result = SSL_do_handshake(m_ssl.get());
    return result == 1 || (again(result), false);
}

/// Whether the operation only has to wait; else the connection has ended and failure() says how.
bool TlsLink::again(int result)
{
    const int error = SSL_get_error(m_ssl.get(), result);
    if (error == SSL_ERROR_WANT_READ || error == SSL_ERROR_WANT_WRITE)
        return true;
    char text[256] = "closed";
    if (const auto code = ERR_get_error(); code != 0)
        ERR_error_string_n(code, text, sizeof text);
    if (m_failure.empty())
        m_failure = text;
    return false;
}

bool TlsLink::send(const Bytes& bytes)
{
    const auto deadline = std::chrono::steady_clock::now() + patience;
    std::size_t sent = 0;
    while (sent < bytes.size()) {
        ERR_clear_error();
        const int result = SSL_write(m_ssl.get(), bytes.data() + sent, static_cast<int>(bytes.size() - sent));
        if (result > 0) {
            sent += static_cast<std::size_t>(result);
            continue;
        }
        if (!again(result) || std::chrono::steady_clock::now() > deadline)
            return false;
        waitFor(descriptor(), POLLOUT, std::chrono::milliseconds(100));
    }
    return true;
}

bool TlsLink::receive(Bytes& into)
{
    if (!ready() && !handshake())
        return m_failure.empty();
    for (;;) {
        std::uint8_t chunk[16384];
        ERR_clear_error();
        const int result = SSL_read(m_ssl.get(), chunk, sizeof chunk);
        if (result <= 0)
            return again(result);
        into.insert(into.end(), chunk, chunk + result);
    }
}

bool TlsLink::closes(Bytes* said)
{
    const auto deadline = std::chrono::steady_clock::now() + patience;
    Bytes heard;
    while (receive(said != nullptr ? *said : heard)) {
        if (std::chrono::steady_clock::now() > deadline)
            return false;
        waitFor(descriptor(), POLLIN, std::chrono::milliseconds(100));
    }
    return true;
}

Bytes TlsLink::datagramKey(std::uint64_t token) const
{
    constexpr std::string_view label = "EXPORTER-liena-datagram";
    const Bytes context = Words().u64(token);
    Bytes key(44);
    need(SSL_export_keying_material(m_ssl.get(), key.data(), key.size(), label.data(), label.size(), context.data(), context.size(), 1) ==
             1,
         "exporter");
    return key;
}

namespace {

/// iv XOR the packet number, big-endian, padded on the left.
Bytes nonceOf(const Bytes& keyAndIv, std::uint64_t packet)
{
    Bytes nonce(keyAndIv.begin() + 32, keyAndIv.end());
    for (std::size_t i = 0; i < 8; ++i)
        nonce[11 - i] ^= static_cast<std::uint8_t>(packet >> (8 * i));
    return nonce;
}

using CipherPtr = std::unique_ptr<EVP_CIPHER_CTX, void (*)(EVP_CIPHER_CTX*)>;

} // namespace

Bytes sealed(const Bytes& keyAndIv, std::uint64_t token, std::uint64_t packet, const Bytes& datagram)
{
    Bytes result = Words().u64(token).u64(packet);
    const auto nonce = nonceOf(keyAndIv, packet);
    const CipherPtr cipher(EVP_CIPHER_CTX_new(), EVP_CIPHER_CTX_free);
    int size = 0;
    need(EVP_EncryptInit_ex(cipher.get(), EVP_aes_256_gcm(), nullptr, keyAndIv.data(), nonce.data()) == 1, "cipher");
    need(EVP_EncryptUpdate(cipher.get(), nullptr, &size, result.data(), 16) == 1, "additional data");
    result.resize(16 + datagram.size() + 16);
    need(EVP_EncryptUpdate(cipher.get(), result.data() + 16, &size, datagram.data(), static_cast<int>(datagram.size())) == 1, "sealing");
    need(EVP_EncryptFinal_ex(cipher.get(), result.data() + 16 + size, &size) == 1, "sealing");
    need(EVP_CIPHER_CTX_ctrl(cipher.get(), EVP_CTRL_GCM_GET_TAG, 16, result.data() + result.size() - 16) == 1, "tag");
    return result;
}

std::optional<Bytes> unsealed(const Bytes& keyAndIv, const Bytes& packet)
{
    if (packet.size() < 32)
        return std::nullopt;
    const auto nonce = nonceOf(keyAndIv, Reader(ByteSpan(packet).subspan(8)).u64());
    Bytes plain(packet.size() - 32);
    Bytes tag(packet.end() - 16, packet.end());
    const CipherPtr cipher(EVP_CIPHER_CTX_new(), EVP_CIPHER_CTX_free);
    int size = 0;
    need(EVP_DecryptInit_ex(cipher.get(), EVP_aes_256_gcm(), nullptr, keyAndIv.data(), nonce.data()) == 1, "cipher");
    need(EVP_DecryptUpdate(cipher.get(), nullptr, &size, packet.data(), 16) == 1, "additional data");
    need(EVP_DecryptUpdate(cipher.get(), plain.data(), &size, packet.data() + 16, static_cast<int>(plain.size())) == 1, "opening");
    need(EVP_CIPHER_CTX_ctrl(cipher.get(), EVP_CTRL_GCM_SET_TAG, 16, tag.data()) == 1, "tag");
    return EVP_DecryptFinal_ex(cipher.get(), plain.data() + size, &size) == 1 ? std::optional(plain) : std::nullopt;
}

} // namespace liena::test
