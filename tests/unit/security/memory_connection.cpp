// Drives two TLS ends over a pair of memory pipes.
#include "memory_connection.hpp"

#include "security/tls_identity.hpp"

#include <openssl/err.h>

#include <stdexcept>
#include <vector>

namespace liena::test {

using namespace security;

namespace {

int takeAnyProtocol(SSL*, const unsigned char** chosen, unsigned char* size, const unsigned char* offer, unsigned int, void* wanted)
{
    const auto& name = *static_cast<const std::string*>(wanted);
    *size = static_cast<unsigned char>(name.size());
    *chosen = reinterpret_cast<const unsigned char*>(name.data());
    return offer != nullptr ? SSL_TLSEXT_ERR_OK : SSL_TLSEXT_ERR_NOACK;
}

ContextPtr strangerContext(const SSL_METHOD* method, const Stranger& stranger)
{
    ContextPtr context(SSL_CTX_new(method));
    SSL_CTX_set_security_level(context.get(), 0);
    SSL_CTX_set_min_proto_version(context.get(), stranger.lowestVersion);
    SSL_CTX_set_max_proto_version(context.get(), stranger.highestVersion);
    SSL_CTX_set1_groups_list(context.get(), stranger.groups.c_str());
    if (stranger.certificate != nullptr &&
        (SSL_CTX_use_certificate(context.get(), stranger.certificate) != 1 || SSL_CTX_use_PrivateKey(context.get(), stranger.key) != 1))
        throw std::runtime_error("the stranger cannot use its certificate: " + takeOpensslReason());
    if (stranger.intermediate != nullptr)
        SSL_CTX_add1_chain_cert(context.get(), stranger.intermediate);
    return context;
}

} // namespace

ContextPtr strangerServer(const Stranger& stranger)
{
    auto context = strangerContext(TLS_server_method(), stranger);
    if (!stranger.alpn.empty())
        SSL_CTX_set_alpn_select_cb(context.get(), takeAnyProtocol, const_cast<std::string*>(&stranger.alpn));
    return context;
}

ContextPtr strangerClient(const Stranger& stranger)
{
    auto context = strangerContext(TLS_client_method(), stranger);
    std::vector<unsigned char> offer{static_cast<unsigned char>(stranger.alpn.size())};
    offer.insert(offer.end(), stranger.alpn.begin(), stranger.alpn.end());
    if (!stranger.alpn.empty())
        SSL_CTX_set_alpn_protos(context.get(), offer.data(), static_cast<unsigned int>(offer.size()));
    return context;
}

MemoryConnection::MemoryConnection(SSL_CTX* server, SSL_CTX* client) : m_server(SSL_new(server)), m_client(SSL_new(client))
{
    BIO* serverEnd = nullptr;
    BIO* clientEnd = nullptr;
    if (BIO_new_bio_pair(&serverEnd, 0, &clientEnd, 0) != 1)
        throw std::runtime_error("no memory pipe");
    SSL_set_bio(m_server.get(), serverEnd, serverEnd);
    SSL_set_bio(m_client.get(), clientEnd, clientEnd);
    SSL_set_accept_state(m_server.get());
    SSL_set_connect_state(m_client.get());
}

bool MemoryConnection::advance(SSL* end, std::string& failure)
{
    if (!failure.empty())
        return false;
    ERR_clear_error();
    const bool complete = SSL_is_init_finished(end) == 1;
    // After the handshake a byte is asked for, so that an alert of the other end is heard.
    char byte = 0;
    const int outcome = complete ? SSL_read(end, &byte, 1) : SSL_do_handshake(end);
    const int error = SSL_get_error(end, outcome);
    if (outcome <= 0 && error != SSL_ERROR_WANT_READ && error != SSL_ERROR_WANT_WRITE)
        failure = explainTlsFailure(ERR_get_error(), SSL_get_verify_result(end));
    return outcome > 0;
}

void MemoryConnection::handshake()
{
    constexpr int enough = 20; // flights; TLS 1.3 needs three
    for (int flight = 0; flight < enough; ++flight) {
        advance(m_client.get(), m_clientFailure);
        advance(m_server.get(), m_serverFailure);
    }
}

} // namespace liena::test
