// Puts certificates together without asking whether they make sense.
#include "support/forged_certificate.hpp"

#include "security/pem.hpp"

#include <openssl/ec.h>
#include <openssl/rsa.h>

#include <fstream>
#include <stdexcept>

namespace liena::test {

using namespace security;

namespace {

void need(bool done, const char* what)
{
    if (!done)
        throw std::runtime_error(std::string("cannot forge ") + what + ": " + takeOpensslReason());
}

KeyPtr keyOf(KeyKind kind)
{
    switch (kind) {
    case KeyKind::P224:
        return KeyPtr(EVP_EC_gen("P-224"));
    case KeyKind::Rsa1024:
        return KeyPtr(EVP_RSA_gen(1024));
    case KeyKind::Rsa2048:
        return KeyPtr(EVP_RSA_gen(2048));
    case KeyKind::P256:
        break;
    }
    return KeyPtr(EVP_EC_gen("P-256"));
}

void addName(GENERAL_NAMES* names, int type, const std::string& text)
{
    auto* name = GENERAL_NAME_new();
    auto* value = ASN1_IA5STRING_new();
    need(ASN1_STRING_set(value, text.data(), static_cast<int>(text.size())) == 1, "a name");
    GENERAL_NAME_set0_value(name, type, value);
    sk_GENERAL_NAME_push(names, name);
}

void addNames(X509* certificate, const Recipe& recipe)
{
    const GeneralNamesPtr names(sk_GENERAL_NAME_new_null());
    for (const auto& uri : recipe.uris)
        addName(names.get(), GEN_URI, uri);
    for (const auto& dns : recipe.dnsNames)
        addName(names.get(), GEN_DNS, dns);
    if (sk_GENERAL_NAME_num(names.get()) > 0)
        need(X509_add1_ext_i2d(certificate, NID_subject_alt_name, names.get(), 0, X509V3_ADD_DEFAULT) == 1, "alternative names");
}

void addExtension(X509* certificate, X509* issuer, int kind, const std::string& value)
{
    X509V3_CTX context;
    X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
    const ExtensionPtr extension(X509V3_EXT_nconf_nid(nullptr, &context, kind, value.c_str()));
    need(extension && X509_add_ext(certificate, extension.get(), -1) == 1, "an extension");
}

} // namespace

Forged forge(const Recipe& recipe, const Forged* issuer)
{
    Forged made{CertificatePtr(X509_new()), keyOf(recipe.key)};
    need(made.certificate && made.key, "a key");
    X509* const certificate = made.certificate.get();
    X509* const signer = issuer != nullptr ? issuer->certificate.get() : certificate;
    X509_set_version(certificate, X509_VERSION_3);
    ASN1_INTEGER_set_uint64(X509_get_serialNumber(certificate), 4711);
    X509_gmtime_adj(X509_getm_notBefore(certificate), recipe.startHours * 3600L);
    X509_gmtime_adj(X509_getm_notAfter(certificate), recipe.endHours * 3600L);
    const auto* name = reinterpret_cast<const unsigned char*>(recipe.commonName.data());
    if (!recipe.commonName.empty())
        X509_NAME_add_entry_by_txt(X509_get_subject_name(certificate), "CN", MBSTRING_UTF8, name,
                                   static_cast<int>(recipe.commonName.size()), -1, 0);
    X509_set_issuer_name(certificate, X509_get_subject_name(signer));
    X509_set_pubkey(certificate, made.key.get());
    addExtension(certificate, signer, NID_basic_constraints, recipe.authority ? "critical,CA:TRUE" : "critical,CA:FALSE");
    addExtension(certificate, signer, NID_key_usage,
                 recipe.authority ? "critical,keyCertSign,digitalSignature" : "critical,digitalSignature");
    if (!recipe.usage.empty())
        addExtension(certificate, signer, NID_ext_key_usage, recipe.usage);
    addNames(certificate, recipe);
    EVP_PKEY* const key = issuer != nullptr ? issuer->key.get() : made.key.get();
    need(X509_sign(certificate, key, recipe.sha1 ? EVP_sha1() : EVP_sha256()) > 0, "a signature");
    return made;
}

void Forged::writeTo(const std::filesystem::path& certificateFile, const std::filesystem::path& keyFile) const
{
    std::ofstream(certificateFile, std::ios::binary) << toPem(certificate.get()).value();
    std::ofstream(keyFile, std::ios::binary) << toPem(key.get()).value();
    std::filesystem::permissions(keyFile, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

Forged loadForged(const std::filesystem::path& certificateFile, const std::filesystem::path& keyFile)
{
    return {std::move(readCertificates(certificateFile).value().front()), std::move(readKey(keyFile).value())};
}

} // namespace liena::test
