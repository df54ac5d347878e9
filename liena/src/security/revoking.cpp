// Revocation lists put together field by field.
#include "security/revoking.hpp"

#include <openssl/asn1.h>
#include <openssl/pem.h>

#include <fmt/format.h>

#include <algorithm>

namespace liena::security {

namespace {

using RevokedPtr = std::unique_ptr<X509_REVOKED, Released<X509_REVOKED_free>>;
using NumberPtr = std::unique_ptr<ASN1_INTEGER, Released<ASN1_INTEGER_free>>;
using TimePtr = std::unique_ptr<ASN1_TIME, Released<ASN1_TIME_free>>;
using EnumeratedPtr = std::unique_ptr<ASN1_ENUMERATED, Released<ASN1_ENUMERATED_free>>;

long codeOf(RevocationReason reason)
{
    switch (reason) {
    case RevocationReason::KeyCompromise:
        return CRL_REASON_KEY_COMPROMISE;
    case RevocationReason::Superseded:
        return CRL_REASON_SUPERSEDED;
    case RevocationReason::OutOfService:
        return CRL_REASON_CESSATION_OF_OPERATION;
    case RevocationReason::Unspecified:
        break;
    }
    return CRL_REASON_UNSPECIFIED;
}

/// 1 to 20 bytes as RFC 5280 allows them.
NumberPtr serialFrom(const std::string& hex)
{
    constexpr std::size_t longestSerial = 40;
    const bool digits = !hex.empty() && hex.size() <= longestSerial &&
                        std::all_of(hex.begin(), hex.end(), [](unsigned char c) { return std::isxdigit(c) != 0; });
    BIGNUM* value = nullptr;
    if (!digits || BN_hex2bn(&value, hex.c_str()) == 0)
        return nullptr;
    const BignumPtr owned(value);
    return NumberPtr(BN_to_ASN1_INTEGER(value, nullptr));
}

bool isListed(X509_CRL* list, const ASN1_INTEGER* serial)
{
    X509_REVOKED* found = nullptr;
    return X509_CRL_get0_by_serial(list, &found, serial) != 0;
}

bool addEntry(X509_CRL* list, ASN1_INTEGER* serial, const ASN1_TIME* when, RevocationReason reason)
{
    RevokedPtr entry(X509_REVOKED_new());
    if (!entry || X509_REVOKED_set_serialNumber(entry.get(), serial) != 1 ||
        X509_REVOKED_set_revocationDate(entry.get(), const_cast<ASN1_TIME*>(when)) != 1)
        return false;
    if (reason != RevocationReason::Unspecified) {
        const EnumeratedPtr code(ASN1_ENUMERATED_new());
        if (!code || ASN1_ENUMERATED_set(code.get(), codeOf(reason)) != 1 ||
            X509_REVOKED_add1_ext_i2d(entry.get(), NID_crl_reason, code.get(), 0, 0) != 1)
            return false;
    }
    if (X509_CRL_add0_revoked(list, entry.get()) != 1)
        return false;
    static_cast<void>(entry.release()); // the list's now
    return true;
}

bool copyEntries(X509_CRL* list, const X509_CRL* previous)
{
    const auto* entries = X509_CRL_get_REVOKED(const_cast<X509_CRL*>(previous));
    for (int i = 0; i < sk_X509_REVOKED_num(entries); ++i) {
        RevokedPtr entry(X509_REVOKED_dup(sk_X509_REVOKED_value(entries, i)));
        if (!entry || X509_CRL_add0_revoked(list, entry.get()) != 1)
            return false;
        static_cast<void>(entry.release());
    }
    return true;
}

bool setNumber(X509_CRL* list, const X509_CRL* previous)
{
    const BignumPtr number(BN_new());
    if (!number || BN_one(number.get()) != 1)
        return false;
    if (previous != nullptr) {
        const NumberPtr last(static_cast<ASN1_INTEGER*>(X509_CRL_get_ext_d2i(previous, NID_crl_number, nullptr, nullptr)));
        const BignumPtr value(last ? ASN1_INTEGER_to_BN(last.get(), nullptr) : nullptr);
        if (!value || BN_add(number.get(), number.get(), value.get()) != 1)
            return false;
    }
    const NumberPtr text(BN_to_ASN1_INTEGER(number.get(), nullptr));
    return text && X509_CRL_add1_ext_i2d(list, NID_crl_number, text.get(), 0, 0) == 1;
}

bool setTimes(X509_CRL* list, const ASN1_TIME* now, std::chrono::hours validity)
{
    const auto days = static_cast<int>(validity.count() / 24);
    const auto seconds = static_cast<long>(validity.count() % 24) * 3600;
    const TimePtr end(X509_time_adj_ex(nullptr, days, seconds, nullptr));
    return end && X509_CRL_set1_lastUpdate(list, now) == 1 && X509_CRL_set1_nextUpdate(list, end.get()) == 1;
}

bool addAuthorityKey(X509_CRL* list, X509* authority)
{
    X509V3_CTX context;
    X509V3_set_ctx(&context, authority, nullptr, nullptr, list, 0);
    const ExtensionPtr extension(X509V3_EXT_nconf_nid(nullptr, &context, NID_authority_key_identifier, "keyid:always"));
    return extension && X509_CRL_add_ext(list, extension.get(), -1) == 1;
}

} // namespace

Result<RevocationListPtr> makeRevocationList(const AuthorityFiles& authority, const X509_CRL* previous,
                                             const std::vector<std::string>& added, RevocationReason reason, std::chrono::hours validity)
{
    RevocationListPtr made(X509_CRL_new());
    auto* const list = made.get();
    X509* const signer = authority.certificate.get();
    const TimePtr now(X509_gmtime_adj(nullptr, 0));
    const bool begun = list != nullptr && now && X509_CRL_set_version(list, X509_CRL_VERSION_2) == 1 &&
                       X509_CRL_set_issuer_name(list, X509_get_subject_name(signer)) == 1 && setTimes(list, now.get(), validity) &&
                       addAuthorityKey(list, signer) && setNumber(list, previous) && (previous == nullptr || copyEntries(list, previous));
    if (!begun)
        return cannotMake("the revocation list");
    for (const auto& hex : added) {
        const auto serial = serialFrom(hex);
        if (!serial)
            return fail(Errc::InvalidArgument,
                        fmt::format("\"{}\" is no serial number; `liena pki show` prints it: up to 40 hex digits", hex.substr(0, 64)));
        if (!isListed(list, serial.get()) && !addEntry(list, serial.get(), now.get(), reason))
            return cannotMake("an entry of the revocation list");
    }
    if (X509_CRL_sort(list) != 1 || X509_CRL_sign(list, authority.key.get(), EVP_sha256()) <= 0)
        return cannotMake("the revocation list's signature");
    return made;
}

Result<std::string> toPem(X509_CRL* list)
{
    const BioPtr bio(BIO_new(BIO_s_mem()));
    char* data = nullptr;
    if (PEM_write_bio_X509_CRL(bio.get(), list) != 1)
        return cannotMake("PEM of the revocation list");
    const auto size = BIO_get_mem_data(bio.get(), &data);
    return std::string(data, static_cast<std::size_t>(size));
}

} // namespace liena::security
