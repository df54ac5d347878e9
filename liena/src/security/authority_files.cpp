// Loading a site's authority.
#include "security/authority_files.hpp"

#include "security/pem.hpp"

#include <fmt/format.h>

namespace liena::security {

Result<AuthorityFiles> loadAuthority(const std::filesystem::path& folder)
{
    const auto certificateFile = certificateIn(folder, "ca");
    const auto keyFile = keyIn(folder, "ca");
    auto certificates = readCertificates(certificateFile);
    if (!certificates)
        return certificates.as_failure();
    auto key = readKey(keyFile);
    if (!key)
        return key.as_failure();
    X509* const certificate = certificates.value().front().get();
    if (auto matching = requireMatch(certificate, key.value().get(), certificateFile, keyFile); !matching)
        return matching.as_failure();
    if (X509_check_ca(certificate) != 1)
        return fail(Errc::CertificateInvalid, fmt::format("{} is not an authority's certificate", certificateFile.string()));
    return AuthorityFiles{std::move(certificates.value().front()), std::move(key.value())};
}

} // namespace liena::security
