// Certificates put together field by field.
#include "security/issuing.hpp"

#include "security/certificate_fields.hpp"
#include "security/device_uri.hpp"

#include <openssl/ec.h>

#include <fmt/format.h>

#include <initializer_list>
#include <utility>

namespace liena::security {

namespace {

constexpr int serialBits = 128;

using Extensions = std::initializer_list<std::pair<int, std::string>>;

bool setSerial(X509* certificate)
{
    const BignumPtr number(BN_new());
    return number && BN_rand(number.get(), serialBits, BN_RAND_TOP_ANY, BN_RAND_BOTTOM_ANY) == 1 &&
           BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(certificate)) != nullptr;
}

bool addName(X509_NAME* name, const char* field, const std::string& text)
{
    const auto* bytes = reinterpret_cast<const unsigned char*>(text.data());
    return X509_NAME_add_entry_by_txt(name, field, MBSTRING_UTF8, bytes, static_cast<int>(text.size()), -1, 0) == 1;
}

bool setValidity(X509* certificate, std::chrono::hours validity)
{
    const auto days = static_cast<int>(validity.count() / 24);
    const auto seconds = static_cast<long>(validity.count() % 24) * 3600;
    const auto early = -static_cast<long>(std::chrono::seconds(clockTolerance).count());
    return X509_gmtime_adj(X509_getm_notBefore(certificate), early) != nullptr &&
           X509_time_adj_ex(X509_getm_notAfter(certificate), days, seconds, nullptr) != nullptr;
}

bool addExtensions(X509* certificate, X509* issuer, const Extensions& extensions)
{
    X509V3_CTX context;
    X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
    for (const auto& [kind, value] : extensions) {
        const ExtensionPtr extension(X509V3_EXT_nconf_nid(nullptr, &context, kind, value.c_str()));
        if (!extension || X509_add_ext(certificate, extension.get(), -1) != 1)
            return false;
    }
    return true;
}

} // namespace

Result<KeyPtr> makeKey()
{
    KeyPtr key(EVP_EC_gen("P-256"));
    if (!key)
        return cannotMake("a P-256 key");
    return key;
}

Result<CertificatePtr> makeAuthority(EVP_PKEY* key, const std::string& site, std::chrono::hours validity)
{
    CertificatePtr made(X509_new());
    X509* const certificate = made.get();
    const bool complete = certificate != nullptr && X509_set_version(certificate, X509_VERSION_3) == 1 && setSerial(certificate) &&
                          setValidity(certificate, validity) && addName(X509_get_subject_name(certificate), "O", site) &&
                          addName(X509_get_subject_name(certificate), "CN", "LiENa certificate authority") &&
                          X509_set_issuer_name(certificate, X509_get_subject_name(certificate)) == 1 &&
                          X509_set_pubkey(certificate, key) == 1 &&
                          addExtensions(certificate, certificate,
                                        {{NID_basic_constraints, "critical,CA:TRUE"},
                                         {NID_key_usage, "critical,keyCertSign,cRLSign"},
                                         {NID_subject_key_identifier, "hash"},
                                         {NID_authority_key_identifier, "keyid:always"}}) &&
                          X509_sign(certificate, key, EVP_sha256()) > 0;
    if (!complete)
        return cannotMake("the authority's certificate");
    return made;
}

Result<CertificatePtr> makeDeviceCertificate(EVP_PKEY* key, DeviceId device, const std::string& name, std::chrono::hours validity,
                                             X509* authority, EVP_PKEY* authorityKey)
{
    CertificatePtr made(X509_new());
    X509* const certificate = made.get();
    const bool complete = certificate != nullptr && X509_set_version(certificate, X509_VERSION_3) == 1 && setSerial(certificate) &&
                          setValidity(certificate, validity) && addName(X509_get_subject_name(certificate), "CN", name) &&
                          X509_set_issuer_name(certificate, X509_get_subject_name(authority)) == 1 &&
                          X509_set_pubkey(certificate, key) == 1 &&
                          addExtensions(certificate, authority,
                                        {{NID_basic_constraints, "critical,CA:FALSE"},
                                         {NID_key_usage, "critical,digitalSignature"},
                                         {NID_ext_key_usage, "serverAuth,clientAuth"},
                                         {NID_subject_key_identifier, "hash"},
                                         {NID_authority_key_identifier, "keyid:always"},
                                         {NID_subject_alt_name, "URI:" + deviceUri(device)}}) &&
                          X509_sign(certificate, authorityKey, EVP_sha256()) > 0;
    if (!complete)
        return cannotMake(fmt::format("the certificate of {}", name));
    return made;
}

} // namespace liena::security
