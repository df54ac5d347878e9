// Blocking sockets below OpenSSL.
#include "bare_handshake.hpp"

#include <openssl/ssl.h>

#include <stdexcept>

namespace liena::test {

namespace {

using boost::asio::ip::tcp;

std::shared_ptr<security::TlsIdentity> load(TestSystem& system, const std::string& device)
{
    const auto files = system.identityOf(device);
    return security::TlsIdentity::load(files.certificate, files.key, files.authority, system.idOf(device)).value();
}

security::SslPtr tlsOver(tcp::socket& socket, SSL_CTX* context)
{
    socket.set_option(tcp::no_delay(true));
    security::SslPtr tls(SSL_new(context));
    SSL_set_fd(tls.get(), socket.native_handle());
    return tls;
}

} // namespace

BareHandshakes::BareHandshakes(TestSystem& system, const std::string& client, const std::string& server)
    : m_client(load(system, client)),
      m_server(load(system, server)),
      m_acceptor(m_io, tcp::endpoint(boost::asio::ip::address_v4::loopback(), 0)),
      m_thread([this] { serve(); })
{}

BareHandshakes::~BareHandshakes()
{
    tcp::socket(m_io).connect(m_acceptor.local_endpoint()); // and no handshake: it ends
    m_thread.join();
}

void BareHandshakes::serve()
{
    for (;;) {
        auto socket = m_acceptor.accept();
        const auto tls = tlsOver(socket, m_server->serverContext());
        if (SSL_accept(tls.get()) != 1 || !security::peerDevice(tls.get()))
            return;
        SSL_write(tls.get(), "!", 1);
    }
}

std::chrono::nanoseconds BareHandshakes::next()
{
    const auto start = std::chrono::steady_clock::now();
    tcp::socket socket(m_io);
    socket.connect(m_acceptor.local_endpoint());
    const auto tls = tlsOver(socket, m_client->clientContext());
    char byte = 0;
    if (SSL_connect(tls.get()) != 1 || !security::peerDevice(tls.get()) || SSL_read(tls.get(), &byte, 1) != 1)
        throw std::runtime_error("a bare TLS handshake failed");
    return std::chrono::steady_clock::now() - start;
}

} // namespace liena::test
