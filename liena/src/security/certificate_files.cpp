// What certificate files say, and whether a device could open sessions with them.
#include "liena/certificates.hpp"

#include "security/certificate_fields.hpp"
#include "security/device_uri.hpp"
#include "security/pem.hpp"
#include "security/tls_identity.hpp"

#include <openssl/crypto.h>

#include <fmt/format.h>

#include <array>

namespace liena {

using namespace security;

namespace {

std::string serialOf(X509* certificate)
{
    const BignumPtr number(ASN1_INTEGER_to_BN(X509_get0_serialNumber(certificate), nullptr));
    char* const text = number ? BN_bn2hex(number.get()) : nullptr;
    std::string hex = text != nullptr ? text : "";
    OPENSSL_free(text);
    return hex;
}

std::string fingerprintOf(X509* certificate)
{
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    X509_digest(certificate, EVP_sha256(), digest.data(), &size);
    std::string hex;
    for (unsigned int i = 0; i < size; ++i)
        hex += fmt::format("{:02x}", digest[i]);
    return hex;
}

} // namespace

Result<CertificateInfo> describeCertificate(const std::filesystem::path& file)
{
    const auto certificates = readCertificates(file);
    if (!certificates)
        return certificates.as_failure();
    X509* const certificate = certificates.value().front().get();
    const auto uris = urisOf(certificate);
    if (!uris)
        return fail(uris.error().code, fmt::format("{}: {}", file.string(), uris.error().what));
    CertificateInfo info;
    info.subject = nameText(X509_get_subject_name(certificate));
    info.issuer = nameText(X509_get_issuer_name(certificate));
    info.serial = serialOf(certificate);
    info.fingerprint = fingerprintOf(certificate);
    info.uris = uris.value();
    for (const auto& uri : info.uris)
        if (const auto device = deviceFromUri(uri))
            info.devices.push_back(*device);
    info.notBefore = timeOf(X509_get0_notBefore(certificate));
    info.notAfter = timeOf(X509_get0_notAfter(certificate));
    info.isAuthority = X509_check_ca(certificate) == 1;
    return info;
}

Result<void> checkIdentity(const std::filesystem::path& certificate, const std::filesystem::path& key,
                           const std::filesystem::path& authority, DeviceId device, const std::filesystem::path& revocations)
{
    TlsIdentity::Site site;
    site.revocations = revocations;
    const auto identity = TlsIdentity::load(certificate, key, authority, device, std::move(site));
    if (!identity)
        return identity.as_failure();
    return identity.value()->trust().admitSession();
}

} // namespace liena
