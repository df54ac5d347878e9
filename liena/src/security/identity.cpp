// Loading a device's three files, and checking its own certificate as a peer would.
#include "security/identity.hpp"

#include "security/certificate_fields.hpp"
#include "security/pem.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace liena::security {

namespace {

using Time = std::chrono::system_clock::time_point;

Result<StorePtr> trustIn(const std::vector<CertificatePtr>& authorities, const std::filesystem::path& file)
{
    StorePtr store(X509_STORE_new());
    for (const auto& authority : authorities) {
        if (X509_check_ca(authority.get()) != 1)
            return fail(Errc::CertificateInvalid, fmt::format("{}: \"{}\" is not an authority; give the site's ca.crt", file.string(),
                                                              nameText(X509_get_subject_name(authority.get()))));
        X509_STORE_add_cert(store.get(), authority.get());
    }
    return store;
}

/// The earliest end of the chain that was found.
Result<Time> verify(const Identity& identity, X509_STORE* store, const char* purpose, const std::filesystem::path& file, Time now)
{
    const ChainPtr others(sk_X509_new_null());
    for (std::size_t i = 1; i < identity.certificates.size(); ++i)
        sk_X509_push(others.get(), identity.certificates[i].get());
    const StoreContextPtr context(X509_STORE_CTX_new());
    X509_STORE_CTX_init(context.get(), store, identity.certificates.front().get(), others.get());
    X509_STORE_CTX_set_default(context.get(), purpose);
    X509_VERIFY_PARAM_set_auth_level(X509_STORE_CTX_get0_param(context.get()), securityLevel);
    X509_VERIFY_PARAM_set_depth(X509_STORE_CTX_get0_param(context.get()), longestChain);
    X509_STORE_CTX_set_time(context.get(), 0, std::chrono::system_clock::to_time_t(now));
    if (X509_verify_cert(context.get()) == 1) {
        auto end = Time::max();
        const auto* links = X509_STORE_CTX_get0_chain(context.get());
        for (int i = 0; i < sk_X509_num(links); ++i)
            end = std::min(end, timeOf(X509_get0_notAfter(sk_X509_value(links, i))));
        return end;
    }
    const auto reason = explainVerification(X509_STORE_CTX_get_error(context.get()));
    takeOpensslReason();
    const auto validity = fmt::format("valid {} to {}", dateText(timeOf(X509_get0_notBefore(identity.certificates.front().get()))),
                                      dateText(timeOf(X509_get0_notAfter(identity.certificates.front().get()))));
    return fail(Errc::CertificateInvalid, fmt::format("{} ({}): {}", file.string(), validity, reason));
}

Result<void> requireDevice(X509* certificate, DeviceId device, const std::filesystem::path& file)
{
    const auto named = deviceOf(certificate);
    if (!named)
        return fail(named.error().code, fmt::format("{}: {}", file.string(), named.error().what));
    if (named.value() == device)
        return ok();
    return fail(Errc::CertificateInvalid, fmt::format("{} is for device {}, not for {}; use the certificate that was issued for {}",
                                                      file.string(), named.value().toString(), device.toString(), device.toString()));
}

} // namespace

Result<Identity> loadIdentity(const std::filesystem::path& certificate, const std::filesystem::path& key,
                              const std::filesystem::path& authority, DeviceId device, Time now)
{
    auto certificates = readCertificates(certificate);
    if (!certificates)
        return certificates.as_failure();
    auto secret = readKey(key);
    if (!secret)
        return secret.as_failure();
    auto authorities = readCertificates(authority);
    if (!authorities)
        return authorities.as_failure();
    Identity identity{std::move(certificates.value()), std::move(secret.value()), std::move(authorities.value()), Time::max()};

    X509* const own = identity.certificates.front().get();
    if (auto matching = requireMatch(own, identity.key.get(), certificate, key); !matching)
        return matching.as_failure();
    if (auto right = requireDevice(own, device, certificate); !right)
        return right.as_failure();
    const auto store = trustIn(identity.authorities, authority);
    if (!store)
        return store.as_failure();
    for (const char* purpose : {"ssl_server", "ssl_client"}) {
        const auto end = verify(identity, store.value().get(), purpose, certificate, now);
        if (!end)
            return end.as_failure();
        identity.end = std::min(identity.end, end.value());
    }
    return identity;
}

std::string explainVerification(long verifyResult)
{
    switch (verifyResult) {
    case X509_V_ERR_CERT_HAS_EXPIRED:
        return "the certificate or its authority has expired; issue a new one, or set the clock";
    case X509_V_ERR_CERT_NOT_YET_VALID:
        return "the certificate or its authority is not valid yet; compare the clocks of both devices";
    case X509_V_ERR_CERT_REVOKED:
        return "the certificate was revoked by the site's authority; if that was not meant, issue the device a new one";
    case X509_V_ERR_DEPTH_ZERO_SELF_SIGNED_CERT:
    case X509_V_ERR_SELF_SIGNED_CERT_IN_CHAIN:
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT:
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT_LOCALLY:
    case X509_V_ERR_UNABLE_TO_VERIFY_LEAF_SIGNATURE:
    case X509_V_ERR_CERT_SIGNATURE_FAILURE:
        return "the certificate is from an unknown authority; all devices need certificates of one site's authority";
    case X509_V_ERR_INVALID_PURPOSE:
        return "the certificate's usage does not allow this; it must be issued for both client and server";
    case X509_V_ERR_INVALID_CA:
    case X509_V_ERR_PATH_LENGTH_EXCEEDED:
    case X509_V_ERR_CERT_CHAIN_TOO_LONG:
        return "the certificate's chain of authorities is too long, or one of them may not sign";
    case X509_V_ERR_EE_KEY_TOO_SMALL:
    case X509_V_ERR_CA_KEY_TOO_SMALL:
    case X509_V_ERR_CA_MD_TOO_WEAK:
        return "the certificate's key or signature is too weak; at least P-256 or RSA 2048 with SHA-256 is needed";
    default:
        return fmt::format("the certificate is refused ({})", X509_verify_cert_error_string(verifyResult));
    }
}

} // namespace liena::security
