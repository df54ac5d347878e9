// Revoking: the authority's list in its folder, and what a list says.
#include "liena/certificates.hpp"

#include "security/authority_files.hpp"
#include "security/pem.hpp"
#include "security/revocation_list.hpp"
#include "security/revoking.hpp"
#include "security/whole_file.hpp"

#include <openssl/err.h>

#include <fmt/format.h>

namespace liena {

using namespace security;

namespace {

/// The list that is to be continued; null when this is the first one.
Result<RevocationListPtr> previousList(const std::filesystem::path& folder, const AuthorityFiles& authority)
{
    const auto file = revocationsIn(folder);
    std::error_code ignored;
    if (!std::filesystem::exists(std::filesystem::symlink_status(file, ignored)))
        return RevocationListPtr();
    const auto text = readFile(file);
    if (!text)
        return text.as_failure();
    std::vector<CertificatePtr> signers;
    signers.push_back(sharedCertificate(authority.certificate));
    // A list that was begun anew would forget who was revoked, so a damaged one is not overwritten.
    if (const auto sound = RevocationList::parse(text.value(), file, signers); !sound)
        return sound.as_failure();
    return std::move(readLists(text.value(), file).value().front());
}

} // namespace

std::filesystem::path revocationsBeside(const std::filesystem::path& authority)
{
    auto file = authority;
    return file.empty() ? file : file.replace_extension(".crl");
}

Result<RevocationListInfo> CertificateAuthority::revoke(const std::vector<std::string>& serials, RevocationReason reason,
                                                        std::chrono::hours validity) const
{
    if (validity < leastRemaining || validity > std::chrono::hours(24) * 36500)
        return fail(Errc::InvalidArgument, "a revocation list is valid for at least one day and at most 36500 days");
    const auto authority = loadAuthority(m_folder);
    if (!authority)
        return authority.as_failure();
    const auto previous = previousList(m_folder, authority.value());
    if (!previous)
        return previous.as_failure();
    auto made = makeRevocationList(authority.value(), previous.value().get(), serials, reason, validity);
    if (!made)
        return made.as_failure();
    const auto text = toPem(made.value().get());
    if (!text)
        return text.as_failure();
    auto staged = StagedFile::write(revocationsIn(m_folder), text.value(), 0644);
    if (!staged)
        return staged.as_failure();
    if (auto published = staged.value().publish(true); !published)
        return published.as_failure();
    std::vector<RevocationListPtr> lists;
    lists.push_back(std::move(made.value()));
    return describeLists(lists);
}

Result<std::string> CertificateAuthority::issuedSerial(const std::filesystem::path& certificate) const
{
    const auto authority = loadAuthority(m_folder);
    if (!authority)
        return authority.as_failure();
    const auto certificates = readCertificates(certificate);
    if (!certificates)
        return certificates.as_failure();
    X509* const named = certificates.value().front().get();
    const bool issued = X509_verify(named, X509_get0_pubkey(authority.value().certificate.get())) == 1;
    ERR_clear_error();
    if (!issued || X509_check_ca(named) != 0)
        return fail(Errc::CertificateInvalid,
                    fmt::format("{} is not a device's certificate that the authority in {} issued, and only such ones can be revoked here",
                                certificate.string(), m_folder.string()));
    const auto described = describeCertificate(certificate);
    if (!described)
        return described.as_failure();
    return described.value().serial;
}

Result<RevocationListInfo> describeRevocations(const std::filesystem::path& file)
{
    const auto text = readFile(file);
    if (!text)
        return text.as_failure();
    const auto lists = readLists(text.value(), file);
    if (!lists)
        return lists.as_failure();
    return describeLists(lists.value());
}

std::string_view toString(RevocationReason reason)
{
    switch (reason) {
    case RevocationReason::Unspecified:
        return "unspecified";
    case RevocationReason::KeyCompromise:
        return "key-compromise";
    case RevocationReason::Superseded:
        return "superseded";
    case RevocationReason::OutOfService:
        return "out-of-service";
    }
    return "unspecified";
}

} // namespace liena
