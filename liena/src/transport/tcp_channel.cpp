// Reading, writing and ending of one connection.
#include "transport/tcp_channel.hpp"

#include "security/tls_identity.hpp"

#include <boost/asio/ssl/error.hpp>
#include <boost/asio/write.hpp>

#include <openssl/ssl.h>

#include <linux/sockios.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

namespace liena::transport {

namespace asio = boost::asio;

namespace {

/// What is lost twice waits for a timer of at least 200 ms and stalls the lane that long, twice that when it is lost again. Where the
/// kernel can (Linux 6.15: TCP_RTO_MIN_US, which Debian's header does not name), the timer may be as short as a heartbeat.
void retransmitSoon(int socket)
{
    constexpr int rtoMinUs = 45;
    constexpr int soonest = 20'000;
    (void)::setsockopt(socket, IPPROTO_TCP, rtoMinUs, &soonest, sizeof soonest); // without it all works as before
}

} // namespace

TcpChannel::TcpChannel(asio::ip::tcp::socket socket) : m_socket(std::move(socket))
{
    boost::system::error_code ignored;
    m_socket.set_option(asio::ip::tcp::no_delay(true), ignored);
    retransmitSoon(m_socket.native_handle());
    m_remote = m_socket.remote_endpoint(ignored);
}

TcpChannel::~TcpChannel() { close(); }

void TcpChannel::secure(SSL_CTX* context, bool asServer, HandshakeHandler handler)
{
    SSL_CTX_up_ref(context); // the wrapper gives this reference back
    m_context.emplace(context);
    m_tls = std::make_unique<TlsStream>(m_socket, *m_context);
    const auto side = asServer ? asio::ssl::stream_base::server : asio::ssl::stream_base::client;
    m_tls->async_handshake(side, [self = shared_from_this(), handler = std::move(handler)](const boost::system::error_code& error) {
        if (self->m_closed)
            return;
        if (!error)
            return handler(ok());
        auto* ssl = self->m_tls->native_handle();
        handler(fail(Errc::CertificateInvalid,
                     error.category() == asio::error::get_ssl_category()
                         ? security::explainTlsFailure(static_cast<unsigned long>(error.value()), SSL_get_verify_result(ssl))
                         : "the connection ended during the TLS handshake: " + error.message()));
    });
}

Result<std::optional<DeviceId>> TcpChannel::peerDevice()
{
    if (!m_tls)
        return std::optional<DeviceId>();
    const auto device = security::peerDevice(m_tls->native_handle());
    if (!device)
        return device.as_failure();
    return std::optional(device.value());
}

Result<security::DatagramKey> TcpChannel::datagramKey(std::uint64_t token) const
{
    if (!m_tls)
        return fail(Errc::CertificateInvalid, "a connection in the clear has no keys");
    return security::exportDatagramKey(m_tls->native_handle(), token);
}

Result<void> TcpChannel::admitSession(security::TlsIdentity& identity)
{
    return m_tls ? identity.trust().admitSession(m_tls->native_handle()) : ok();
}

void TcpChannel::read(std::span<std::byte> buffer)
{
    auto handler = [self = shared_from_this()](const boost::system::error_code& error, std::size_t count) {
        self->finishRead(error, count);
    };
    const asio::mutable_buffer target(buffer.data(), buffer.size());
    if (m_tls)
        m_tls->async_read_some(target, std::move(handler));
    else
        m_socket.async_read_some(target, std::move(handler));
}

void TcpChannel::write(std::span<const std::byte> bytes)
{
    auto handler = [self = shared_from_this()](const boost::system::error_code& error, std::size_t /*count*/) { self->finishWrite(error); };
    const asio::const_buffer source(bytes.data(), bytes.size());
    if (m_tls)
        asio::async_write(*m_tls, source, std::move(handler));
    else
        asio::async_write(m_socket, source, std::move(handler));
}

void TcpChannel::finishRead(const boost::system::error_code& error, std::size_t count)
{
    if (m_closed)
        return;
    if (error)
        lose(error);
    else if (m_listener != nullptr)
        m_listener->bytesRead(count);
}

void TcpChannel::finishWrite(const boost::system::error_code& error)
{
    if (m_closed)
        return;
    if (error)
        lose(error);
    else if (m_listener != nullptr)
        m_listener->bytesWritten();
}

void TcpChannel::lose(const boost::system::error_code& error)
{
    const bool tls = error.category() == asio::error::get_ssl_category();
    const auto detail = tls                         ? security::explainTlsFailure(static_cast<unsigned long>(error.value()), X509_V_OK)
                        : error == asio::error::eof ? std::string("the peer closed the connection")
                                                    : error.message();
    const bool truncated = error == asio::ssl::error::stream_truncated;
    close();
    if (auto* listener = std::exchange(m_listener, nullptr))
        listener->channelLost(truncated ? "the peer closed the connection" : detail, tls && !truncated);
}

std::size_t TcpChannel::unacknowledged() const
{
    int bytes = 0;
    auto& socket = const_cast<asio::ip::tcp::socket&>(m_socket); // Asio's native_handle() is not const
    return !m_closed && ::ioctl(socket.native_handle(), SIOCOUTQ, &bytes) == 0 && bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
}

void TcpChannel::close()
{
    if (std::exchange(m_closed, true))
        return;
    boost::system::error_code ignored;
    m_socket.close(ignored);
}

} // namespace liena::transport
