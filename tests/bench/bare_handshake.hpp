// A TLS connection between two devices' certificates with nothing of ours above it: connect, handshake, one byte that says so, close.
#pragma once

#include "security/tls_identity.hpp"
#include "test_system.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <chrono>
#include <memory>
#include <string>
#include <thread>

namespace liena::test {

/// On loopback; the accepting end has a thread of its own. Throws when a handshake fails.
class BareHandshakes {
public:
    BareHandshakes(TestSystem& system, const std::string& client, const std::string& server);
    ~BareHandshakes();
    BareHandshakes(const BareHandshakes&) = delete;
    BareHandshakes& operator=(const BareHandshakes&) = delete;

    /// From the call of connect() to the byte by which the server says that it has verified the client.
    std::chrono::nanoseconds next();

private:
    void serve();

    std::shared_ptr<security::TlsIdentity> m_client;
    std::shared_ptr<security::TlsIdentity> m_server;
    boost::asio::io_context m_io;
    boost::asio::ip::tcp::acceptor m_acceptor;
    std::thread m_thread;
};

} // namespace liena::test
