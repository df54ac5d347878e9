// One TCP connection, in the clear or under TLS: bytes in, bytes out, and how it ended.
#pragma once

#include "liena/device_id.hpp"
#include "liena/error.hpp"
#include "security/datagram_seal.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace liena::security {
class TlsIdentity;
}

namespace liena::transport {

/// Network thread only. Shared, because an operation in flight and its owner end independently; after close() no callback comes any more.
class TcpChannel : public std::enable_shared_from_this<TcpChannel> {
public:
    class Listener {
    public:
        virtual ~Listener() = default;
        virtual void bytesRead(std::size_t count) = 0;
        virtual void bytesWritten() = 0;
        /// The connection failed or was closed by the peer; once. `identity`: TLS ended it over a certificate.
        virtual void channelLost(const std::string& detail, bool identity) = 0;
    };

    using HandshakeHandler = std::function<void(Result<void>)>;

    explicit TcpChannel(boost::asio::ip::tcp::socket socket);
    ~TcpChannel();

    /// Puts TLS on the connection; `handler` is called once, unless close() comes first.
    void secure(SSL_CTX* context, bool asServer, HandshakeHandler handler);

    /// The device that the peer's certificate names; nothing in the clear.
    Result<std::optional<DeviceId>> peerDevice();

    /// The key of the datagram path that belongs to this connection; an error in the clear.
    Result<security::DatagramKey> datagramKey(std::uint64_t token) const;

    /// Whether the certificates of both ends allow a new session over this connection; always in the clear.
    Result<void> admitSession(security::TlsIdentity& identity);

    void setListener(Listener* listener) { m_listener = listener; }

    /// One read in flight at a time; `buffer` stays until bytesRead or close().
    void read(std::span<std::byte> buffer);

    /// One write in flight at a time; all of `bytes`, which stay until bytesWritten or close().
    void write(std::span<const std::byte> bytes);

    /// At once and without a word on the wire; harmless when repeated.
    void close();

    /// Bytes written that the peer's kernel has not acknowledged.
    std::size_t unacknowledged() const;

    bool isClosed() const { return m_closed; }
    boost::asio::ip::tcp::endpoint remote() const { return m_remote; }

private:
    using TlsStream = boost::asio::ssl::stream<boost::asio::ip::tcp::socket&>;

    void finishRead(const boost::system::error_code& error, std::size_t count);
    void finishWrite(const boost::system::error_code& error);
    void lose(const boost::system::error_code& error);

    boost::asio::ip::tcp::socket m_socket;
    boost::asio::ip::tcp::endpoint m_remote;
    std::optional<boost::asio::ssl::context> m_context;
    std::unique_ptr<TlsStream> m_tls;
    Listener* m_listener = nullptr;
    bool m_closed = false;
};

} // namespace liena::transport
