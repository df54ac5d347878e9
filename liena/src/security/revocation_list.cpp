// Reading revocation lists, with nothing taken for granted.
#include "security/revocation_list.hpp"

#include "liena/log.hpp"
#include "security/certificate_fields.hpp"

#include <openssl/err.h>
#include <openssl/objects.h>
#include <openssl/pem.h>

#include <fmt/format.h>

#include <algorithm>

namespace liena::security {

namespace {

using Time = std::chrono::system_clock::time_point;

constexpr std::size_t mostLists = 16;
constexpr int weakestDigest = 32; // bytes: SHA-256

using NumberPtr = std::unique_ptr<ASN1_INTEGER, Released<ASN1_INTEGER_free>>;

auto invalidList(const std::filesystem::path& file, std::string_view reason)
{
    return fail(Errc::CertificateInvalid, fmt::format("the revocation list {} {}", file.string(), reason));
}

NumberPtr numberOf(X509_CRL* list)
{
    return NumberPtr(static_cast<ASN1_INTEGER*>(X509_CRL_get_ext_d2i(list, NID_crl_number, nullptr, nullptr)));
}

std::string hexOf(const ASN1_INTEGER* number)
{
    const BignumPtr value(ASN1_INTEGER_to_BN(number, nullptr));
    char* const text = value ? BN_bn2hex(value.get()) : nullptr;
    std::string hex = text != nullptr ? text : "";
    OPENSSL_free(text);
    return hex;
}

bool isStrong(X509_CRL* list)
{
    int digest = NID_undef;
    const bool known = OBJ_find_sigid_algs(X509_CRL_get_signature_nid(list), &digest, nullptr) == 1;
    const auto* kind = known ? EVP_get_digestbynid(digest) : nullptr;
    return kind != nullptr && EVP_MD_get_size(kind) >= weakestDigest;
}

/// A critical extension says that the list does not mean what it seems to: a part of a whole, or entries of other authorities.
bool isRestricted(X509_CRL* list)
{
    if (X509_CRL_get_ext_by_critical(list, 1, -1) >= 0)
        return true;
    const auto* entries = X509_CRL_get_REVOKED(list);
    for (int i = 0; i < sk_X509_REVOKED_num(entries); ++i)
        if (X509_REVOKED_get_ext_by_critical(sk_X509_REVOKED_value(entries, i), 1, -1) >= 0)
            return true;
    return false;
}

bool isSignedBy(X509_CRL* list, X509* authority)
{
    const bool named = X509_NAME_cmp(X509_CRL_get_issuer(list), X509_get_subject_name(authority)) == 0;
    const bool mayDoSo = X509_check_ca(authority) == 1 && (X509_get_key_usage(authority) & KU_CRL_SIGN) != 0;
    const bool sound = named && mayDoSo && X509_CRL_verify(list, X509_get0_pubkey(authority)) == 1;
    ERR_clear_error();
    return sound;
}

Result<void> requireSound(X509_CRL* list, const std::filesystem::path& file, const std::vector<CertificatePtr>& authorities)
{
    const auto signer =
        std::find_if(authorities.begin(), authorities.end(), [&](const CertificatePtr& one) { return isSignedBy(list, one.get()); });
    if (signer == authorities.end())
        return invalidList(file,
                           fmt::format("is not signed by the site's authority (it says \"{}\"); copy ca.crl from where certificates are "
                                       "issued",
                                       printable(nameText(X509_CRL_get_issuer(list)))));
    if (!isStrong(list))
        return invalidList(file, "is signed with a weak digest; make it again with `liena pki revoke --renew`");
    if (X509_CRL_get0_nextUpdate(list) == nullptr || !numberOf(list))
        return invalidList(file, "has no number or no end; make it again with `liena pki revoke --renew`");
    if (isRestricted(list))
        return invalidList(file, "is only a part of a list, or restricted in a way that is not understood; a whole one is needed");
    return ok();
}

bool sameIssuer(X509_CRL* one, X509_CRL* other) { return X509_NAME_cmp(X509_CRL_get_issuer(one), X509_CRL_get_issuer(other)) == 0; }

RevocationReason reasonOf(const X509_REVOKED* entry)
{
    using EnumeratedPtr = std::unique_ptr<ASN1_ENUMERATED, Released<ASN1_ENUMERATED_free>>;
    const EnumeratedPtr code(static_cast<ASN1_ENUMERATED*>(X509_REVOKED_get_ext_d2i(entry, NID_crl_reason, nullptr, nullptr)));
    switch (code ? ASN1_ENUMERATED_get(code.get()) : 0) {
    case CRL_REASON_KEY_COMPROMISE:
        return RevocationReason::KeyCompromise;
    case CRL_REASON_SUPERSEDED:
        return RevocationReason::Superseded;
    case CRL_REASON_CESSATION_OF_OPERATION:
        return RevocationReason::OutOfService;
    default:
        return RevocationReason::Unspecified;
    }
}

} // namespace

Result<std::vector<RevocationListPtr>> readLists(const std::string& pem, const std::filesystem::path& file)
{
    const BioPtr bio(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
    std::vector<RevocationListPtr> lists;
    ERR_clear_error();
    while (RevocationListPtr list{PEM_read_bio_X509_CRL(bio.get(), nullptr, nullptr, nullptr)}) {
        if (lists.size() == mostLists)
            return invalidList(file, "holds more than 16 lists; keep only those of this site");
        lists.push_back(std::move(list));
    }
    const bool ended = ERR_GET_REASON(ERR_peek_last_error()) == PEM_R_NO_START_LINE;
    const auto reason = takeOpensslReason();
    if (!ended)
        return invalidList(file, fmt::format("is damaged ({}); copy it again from where certificates are issued", reason));
    if (lists.empty())
        return invalidList(file, "holds no list; expected is PEM text with a line -----BEGIN X509 CRL-----. Copy ca.crl again from where "
                                 "certificates are issued");
    return lists;
}

RevocationListInfo describeLists(const std::vector<RevocationListPtr>& lists)
{
    RevocationListInfo info;
    auto* const first = lists.front().get();
    info.issuer = nameText(X509_CRL_get_issuer(first));
    if (const auto number = numberOf(first))
        info.number = hexOf(number.get());
    info.made = timeOf(X509_CRL_get0_lastUpdate(first));
    if (const auto* end = X509_CRL_get0_nextUpdate(first))
        info.ends = timeOf(end);
    for (const auto& list : lists) {
        const auto* entries = X509_CRL_get_REVOKED(list.get());
        for (int i = 0; i < sk_X509_REVOKED_num(entries); ++i) {
            const auto* entry = sk_X509_REVOKED_value(entries, i);
            info.revoked.push_back(
                {hexOf(X509_REVOKED_get0_serialNumber(entry)), timeOf(X509_REVOKED_get0_revocationDate(entry)), reasonOf(entry)});
        }
    }
    return info;
}

Result<RevocationList> RevocationList::parse(const std::string& pem, const std::filesystem::path& file,
                                             const std::vector<CertificatePtr>& authorities)
{
    auto read = readLists(pem, file);
    if (!read)
        return read.as_failure();
    RevocationList all(file);
    for (auto& list : read.value()) {
        if (auto sound = requireSound(list.get(), file, authorities); !sound)
            return sound.as_failure();
        const auto twice = [&](const RevocationListPtr& other) { return sameIssuer(list.get(), other.get()); };
        if (std::any_of(all.m_lists.begin(), all.m_lists.end(), twice))
            return invalidList(file, "holds two lists of the same authority; keep the newer one");
        all.m_lists.push_back(std::move(list));
    }
    return all;
}

bool RevocationList::revokes(X509* certificate) const
{
    return std::any_of(m_lists.begin(), m_lists.end(), [&](const RevocationListPtr& list) {
        X509_REVOKED* entry = nullptr;
        return X509_NAME_cmp(X509_CRL_get_issuer(list.get()), X509_get_issuer_name(certificate)) == 0 &&
               X509_CRL_get0_by_cert(list.get(), &entry, certificate) != 0;
    });
}

Result<void> RevocationList::requireCurrent(Time now) const
{
    for (const auto& list : m_lists) {
        const auto ends = timeOf(X509_CRL_get0_nextUpdate(list.get()));
        if (now >= ends)
            return invalidList(m_file,
                               fmt::format("ended on {}; run `liena pki revoke --dir PKI --renew` where certificates are issued, and copy "
                                           "ca.crl to every device",
                                           dateText(ends)));
        const auto begins = timeOf(X509_CRL_get0_lastUpdate(list.get()));
        if (now + clockTolerance < begins)
            return invalidList(
                m_file, fmt::format("begins on {}, and this computer's clock says {}; set the clock", dateText(begins), dateText(now)));
    }
    return ok();
}

bool RevocationList::isNewerThan(const RevocationList& other) const
{
    return std::any_of(m_lists.begin(), m_lists.end(), [&](const RevocationListPtr& mine) {
        const auto theirs = std::find_if(other.m_lists.begin(), other.m_lists.end(),
                                         [&](const RevocationListPtr& list) { return sameIssuer(mine.get(), list.get()); });
        return theirs == other.m_lists.end() || ASN1_INTEGER_cmp(numberOf(mine.get()).get(), numberOf(theirs->get()).get()) > 0;
    });
}

RevocationListInfo RevocationList::info() const { return describeLists(m_lists); }

} // namespace liena::security
