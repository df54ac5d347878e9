// Two TLS ends joined in memory: real handshakes without a socket.
#pragma once

#include "security/openssl_types.hpp"

#include <string>

namespace liena::test {

class MemoryConnection {
public:
    MemoryConnection(SSL_CTX* server, SSL_CTX* client);

    /// Runs both ends until neither gets further, and lets each hear a late alert of the other. A failed end's explanation is kept.
    void handshake();

    SSL* server() const { return m_server.get(); }
    SSL* client() const { return m_client.get(); }
    const std::string& serverFailure() const { return m_serverFailure; }
    const std::string& clientFailure() const { return m_clientFailure; }

private:
    bool advance(SSL* end, std::string& failure);

    security::SslPtr m_server;
    security::SslPtr m_client;
    std::string m_serverFailure;
    std::string m_clientFailure;
};

/// The plainest context there is: it shows `certificate` if given, verifies nobody, and offers or takes ALPN if `alpn` is not empty.
/// It must outlive the contexts made from it.
struct Stranger {
    X509* certificate = nullptr;
    EVP_PKEY* key = nullptr;
    X509* intermediate = nullptr;
    std::string alpn = "liena/1";
    std::string groups = "X25519:P-256:P-384:P-521:ffdhe8192";
    int lowestVersion = TLS1_2_VERSION;
    int highestVersion = TLS1_3_VERSION;
};
security::ContextPtr strangerServer(const Stranger& stranger);
security::ContextPtr strangerClient(const Stranger& stranger);

} // namespace liena::test
