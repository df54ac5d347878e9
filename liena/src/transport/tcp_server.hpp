// A device's one listening socket: accepts, secures, and waits for the Attach (protocol section 6, ruling B7).
#pragma once

#include "liena/error.hpp"
#include "liena/log.hpp"
#include "liena/system_topology.hpp"
#include "protocol/datagram_decoder.hpp"
#include "protocol/session_messages.hpp"
#include "security/tls_identity.hpp"
#include "transport/tcp_channel.hpp"
#include "transport/timer.hpp"

#include <chrono>
#include <functional>
#include <list>
#include <memory>

namespace liena::transport {

/// A connection that said which session and lane it is. The decoder may hold bytes that came behind the Attach.
struct AttachedConnection {
    std::shared_ptr<TcpChannel> channel;
    std::unique_ptr<protocol::DatagramDecoder> decoder;
    DeviceId peer; ///< by certificate; in mode `none` as the header says
    protocol::Attach attach;
};

/// Network thread only.
class TcpServer {
public:
    struct Handlers {
        std::function<void(AttachedConnection)> attached;
        /// A connection that is not let in; `device` is the broadcast id when it proved to be none.
        std::function<void(DeviceId device, const std::string& cause, const boost::asio::ip::tcp::endpoint& from)> refused;
    };

    TcpServer(boost::asio::io_context& io, DeviceId self, std::shared_ptr<security::TlsIdentity> identity, Handlers handlers, LogSink log);
    ~TcpServer();
    TcpServer(const TcpServer&) = delete;
    TcpServer& operator=(const TcpServer&) = delete;

    /// Takes the port; an error names the address, the reason and what to do.
    Result<void> listen(const std::string& host, std::uint16_t port);

    /// Where it listens, once it does.
    boost::asio::ip::address address() const;

    /// The listening socket.
    int descriptor() { return m_acceptor.native_handle(); }

    void start();
    void close();

private:
    class Pending;

    void accept();
    void admit(boost::asio::ip::tcp::socket socket);
    void evictFor(const boost::asio::ip::address& address);
    void forget(Pending* pending);

    static constexpr std::size_t mostPending = 64;
    static constexpr std::size_t mostPerAddress = 8;

    boost::asio::io_context& m_io;
    DeviceId m_self;
    std::shared_ptr<security::TlsIdentity> m_identity;
    Handlers m_handlers;
    LogSink m_log;
    boost::asio::ip::tcp::acceptor m_acceptor;
    Timer m_retry;
    std::list<std::unique_ptr<Pending>> m_pending; ///< in order of arrival
    bool m_acceptFailed = false;
    std::shared_ptr<bool> m_alive = std::make_shared<bool>(true);
};

} // namespace liena::transport
