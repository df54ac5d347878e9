// OpenSSL's handshake errors in plain words.
#include "security/tls_identity.hpp"

#include "security/identity.hpp"

#include <openssl/err.h>
#include <openssl/sslerr.h>

#include <fmt/format.h>

namespace liena::security {

namespace {

/// Null for reasons that have no words of their own.
const char* wordsFor(int reason)
{
    switch (reason) {
    case SSL_R_PEER_DID_NOT_RETURN_A_CERTIFICATE:
        return "the peer showed no certificate";
    case SSL_R_TLSV13_ALERT_CERTIFICATE_REQUIRED:
        return "the peer asks for a certificate and got none";
    case SSL_R_UNSUPPORTED_PROTOCOL:
    case SSL_R_WRONG_VERSION_NUMBER:
    case SSL_R_WRONG_SSL_VERSION:
    case SSL_R_TLSV1_ALERT_PROTOCOL_VERSION:
        return "the two ends have no TLS version in common; LiENa needs TLS 1.3, and topologies with the same security mode";
    case SSL_R_NO_APPLICATION_PROTOCOL:
    case SSL_R_TLSV1_ALERT_NO_APPLICATION_PROTOCOL:
    case SSL_R_CALLBACK_FAILED: // requireOffer() refused
        return "the two ends have no application protocol (ALPN) in common; LiENa devices offer liena/1";
    case SSL_R_BAD_EXTENSION:
        return "the peer's answer is not one to our offer, such as another application protocol (ALPN) than liena/1";
    case SSL_R_TLSV1_ALERT_UNKNOWN_CA:
        return "the peer does not know the authority of our certificate; all devices need certificates of one site's authority";
    case SSL_R_SSLV3_ALERT_CERTIFICATE_REVOKED:
        return "the peer's revocation list names our certificate: it was revoked; issue a new one for this device";
    case SSL_R_SSLV3_ALERT_CERTIFICATE_EXPIRED:
        return "the peer finds our certificate expired or not valid yet; issue a new one, or compare the clocks";
    case SSL_R_SSLV3_ALERT_BAD_CERTIFICATE:
    case SSL_R_SSLV3_ALERT_CERTIFICATE_UNKNOWN:
    case SSL_R_SSLV3_ALERT_UNSUPPORTED_CERTIFICATE:
        return "the peer refuses our certificate; see `liena pki show` for what it says";
    case SSL_R_TLSV1_ALERT_DECRYPT_ERROR:
    case SSL_R_BAD_SIGNATURE:
        return "a signature is wrong: certificate and key of one end do not belong together";
    case SSL_R_EXCESSIVE_MESSAGE_SIZE:
        return "the peer's certificates are too long; it may show its own and one authority's";
    case SSL_R_HTTP_REQUEST:
    case SSL_R_HTTPS_PROXY_REQUEST:
        return "the peer is a web client, not a LiENa device";
    case SSL_R_NO_SUITABLE_SIGNATURE_ALGORITHM:
    case SSL_R_NO_SHARED_CIPHER:
    case SSL_R_NO_SUITABLE_KEY_SHARE:
    case SSL_R_NO_SHARED_GROUPS:
    case SSL_R_SSLV3_ALERT_HANDSHAKE_FAILURE:
    case SSL_R_TLSV1_ALERT_INSUFFICIENT_SECURITY:
        return "the two ends have no means of encryption or signature in common";
    case SSL_R_UNEXPECTED_EOF_WHILE_READING:
        return "the peer ended the connection in the middle of the handshake; its log says why";
    default:
        return nullptr;
    }
}

} // namespace

std::string explainTlsFailure(unsigned long opensslError, long verifyResult)
{
    if (verifyResult != X509_V_OK)
        return "the peer's certificate was refused: " + explainVerification(verifyResult);
    if (ERR_GET_LIB(opensslError) == ERR_LIB_SSL)
        if (const char* words = wordsFor(ERR_GET_REASON(opensslError)))
            return words;
    const char* reason = ERR_reason_error_string(opensslError);
    return fmt::format("the TLS handshake failed: {}", reason != nullptr ? reason : "no reason given");
}

} // namespace liena::security
