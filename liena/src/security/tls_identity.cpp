// TLS contexts with everything switched off that LiENa does not need, and the check of the peer.
#include "security/tls_identity.hpp"

#include "security/certificate_fields.hpp"
#include "security/identity.hpp"
#include "security/peer_trust.hpp"

#include <openssl/tls1.h>

#include <fmt/format.h>

#include <array>
#include <string_view>

namespace liena::security {

namespace {

constexpr std::string_view applicationProtocol = "liena/1";
constexpr std::array<unsigned char, 8> offeredProtocols{7, 'l', 'i', 'e', 'n', 'a', '/', '1'};

/// The select callback is not called when the client offers no protocol at all, so that is refused here.
int requireOffer(SSL* connection, int* alert, void*)
{
    const unsigned char* offer = nullptr;
    std::size_t size = 0;
    if (SSL_client_hello_get0_ext(connection, TLSEXT_TYPE_application_layer_protocol_negotiation, &offer, &size) == 1)
        return SSL_CLIENT_HELLO_SUCCESS;
    *alert = SSL_AD_NO_APPLICATION_PROTOCOL;
    return SSL_CLIENT_HELLO_ERROR;
}

int selectProtocol(SSL*, const unsigned char** chosen, unsigned char* size, const unsigned char* offer, unsigned int offerSize, void*)
{
    unsigned char* match = nullptr;
    if (SSL_select_next_proto(&match, size, offeredProtocols.data(), offeredProtocols.size(), offer, offerSize) != OPENSSL_NPN_NEGOTIATED)
        return SSL_TLSEXT_ERR_ALERT_FATAL;
    *chosen = match;
    return SSL_TLSEXT_ERR_OK;
}

/// What a stranger may make us hold and calculate before we know who it is.
constexpr long longestCertificateList = 16L * 1024;
constexpr auto keyExchanges = "X25519:P-256:P-384";

bool limitProtocol(SSL_CTX* context)
{
    SSL_CTX_set_max_cert_list(context, longestCertificateList);
    SSL_CTX_set_security_level(context, securityLevel);
    SSL_CTX_set_options(context, SSL_OP_NO_TICKET | SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION);
    SSL_CTX_set_session_cache_mode(context, SSL_SESS_CACHE_OFF);
    SSL_CTX_set_verify(context, SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT, nullptr);
    SSL_CTX_set_verify_depth(context, longestChain);
    return SSL_CTX_set_min_proto_version(context, TLS1_3_VERSION) == 1 && SSL_CTX_set_max_proto_version(context, TLS1_3_VERSION) == 1 &&
           SSL_CTX_set_num_tickets(context, 0) == 1 && SSL_CTX_set_max_early_data(context, 0) == 1 &&
           SSL_CTX_set_recv_max_early_data(context, 0) == 1 && SSL_CTX_set1_groups_list(context, keyExchanges) == 1;
}

bool useIdentity(SSL_CTX* context, const Identity& identity)
{
    if (SSL_CTX_use_certificate(context, identity.certificates.front().get()) != 1 ||
        SSL_CTX_use_PrivateKey(context, identity.key.get()) != 1)
        return false;
    for (std::size_t i = 1; i < identity.certificates.size(); ++i)
        if (SSL_CTX_add1_chain_cert(context, identity.certificates[i].get()) != 1)
            return false;
    for (const auto& authority : identity.authorities)
        if (X509_STORE_add_cert(SSL_CTX_get_cert_store(context), authority.get()) != 1)
            return false;
    return true;
}

Result<ContextPtr> makeContext(const SSL_METHOD* method, const Identity& identity, const std::shared_ptr<PeerTrust>& trust,
                               const std::filesystem::path& certificate)
{
    ContextPtr context(SSL_CTX_new(method));
    if (!context || !limitProtocol(context.get()) || !useIdentity(context.get(), identity) || !PeerTrust::install(trust, context.get()))
        return fail(Errc::CertificateInvalid, fmt::format("{} cannot be used for TLS: {}", certificate.string(), takeOpensslReason()));
    return context;
}

auto refusedPeer(std::string_view reason) { return fail(Errc::CertificateInvalid, fmt::format("the peer {}", reason)); }

bool negotiatedLiena(SSL* connection)
{
    const unsigned char* protocol = nullptr;
    unsigned int size = 0;
    SSL_get0_alpn_selected(connection, &protocol, &size);
    return std::string_view(reinterpret_cast<const char*>(protocol), size) == applicationProtocol;
}

} // namespace

TlsIdentity::TlsIdentity(DeviceId self, std::shared_ptr<PeerTrust> trust, ContextPtr server, ContextPtr client)
    : m_self(self), m_trust(std::move(trust)), m_server(std::move(server)), m_client(std::move(client))
{}

Result<std::shared_ptr<TlsIdentity>> TlsIdentity::load(const std::filesystem::path& certificate, const std::filesystem::path& key,
                                                       const std::filesystem::path& authority, DeviceId self, Site site)
{
    const auto identity = loadIdentity(certificate, key, authority, self, site.clock());
    if (!identity)
        return identity.as_failure();
    const auto list = site.revocations.empty() ? revocationsBeside(authority) : site.revocations;
    auto revocations = Revocations::load(list, identity.value().authorities, site.clock(), site.log);
    if (!revocations)
        return revocations.as_failure();
    if (!site.revocations.empty() && !revocations.value().hasList())
        return fail(Errc::FileUnreadable, fmt::format("the revocation list {} is not there; a list that is named must be", list.string()));
    if (revocations.value().revokes(identity.value().certificates.front().get()))
        return fail(Errc::CertificateInvalid, fmt::format("{} was revoked by the site's authority (list {}); issue this device a new one",
                                                          certificate.string(), list.string()));
    auto trust = std::make_shared<PeerTrust>(identity.value(), certificate, std::move(revocations.value()), site.clock);
    auto server = makeContext(TLS_server_method(), identity.value(), trust, certificate);
    if (!server)
        return server.as_failure();
    auto client = makeContext(TLS_client_method(), identity.value(), trust, certificate);
    if (!client)
        return client.as_failure();
    SSL_CTX_set_client_hello_cb(server.value().get(), requireOffer, nullptr);
    SSL_CTX_set_alpn_select_cb(server.value().get(), selectProtocol, nullptr);
    // Unlike its neighbours this function returns 0 for success.
    if (SSL_CTX_set_alpn_protos(client.value().get(), offeredProtocols.data(), offeredProtocols.size()) != 0)
        return fail(Errc::CertificateInvalid, fmt::format("OpenSSL refuses ALPN {}: {}", applicationProtocol, takeOpensslReason()));
    return std::shared_ptr<TlsIdentity>(new TlsIdentity(self, std::move(trust), std::move(server.value()), std::move(client.value())));
}

Result<DeviceId> peerDevice(SSL* connection)
{
    if (SSL_is_init_finished(connection) != 1)
        return refusedPeer("has not completed the TLS handshake");
    if (SSL_version(connection) != TLS1_3_VERSION)
        return refusedPeer("does not speak TLS 1.3; update its software");
    if (SSL_session_reused(connection) != 0)
        return refusedPeer("resumed an old TLS session, which is not allowed");
    if (!negotiatedLiena(connection))
        return refusedPeer("did not agree on the application protocol liena/1 (ALPN); is it a LiENa device?");
    const CertificatePtr certificate(SSL_get1_peer_certificate(connection));
    if (!certificate)
        return refusedPeer("showed no certificate");
    // Without verification switched on OpenSSL answers "fine", so that is asked first.
    if ((SSL_get_verify_mode(connection) & SSL_VERIFY_PEER) == 0)
        return refusedPeer("was not verified");
    if (const auto verified = SSL_get_verify_result(connection); verified != X509_V_OK)
        return refusedPeer("was not verified: " + explainVerification(verified));
    return deviceOf(certificate.get());
}

Result<void> requirePeer(SSL* connection, DeviceId meant)
{
    const auto device = peerDevice(connection);
    if (!device)
        return device.as_failure();
    if (device.value() == meant)
        return ok();
    return refusedPeer(
        fmt::format("is device {}, but {} was meant; compare the addresses in the topology", device.value().toString(), meant.toString()));
}

} // namespace liena::security
