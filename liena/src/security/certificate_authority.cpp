// The site's authority in its folder, and the devices' files it issues there.
#include "liena/certificates.hpp"

#include "liena/log.hpp"
#include "security/authority_files.hpp"
#include "security/certificate_fields.hpp"
#include "security/issuing.hpp"
#include "security/pem.hpp"
#include "security/whole_file.hpp"

#include <openssl/crypto.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace liena {

using namespace security;

namespace {

constexpr auto longestValidity = std::chrono::hours(24) * 36500;
constexpr std::size_t longestName = 64; // of a certificate's organisation and common name

/// Key before certificate: whoever finds the certificate finds its key.
Result<void> writePair(const std::filesystem::path& folder, const std::string& name, X509* certificate, EVP_PKEY* key, bool replace)
{
    const auto publicText = toPem(certificate);
    if (!publicText)
        return publicText.as_failure();
    auto secretText = toPem(key);
    if (!secretText)
        return secretText.as_failure();
    auto secret = StagedFile::write(keyIn(folder, name), secretText.value(), 0600);
    OPENSSL_cleanse(secretText.value().data(), secretText.value().size());
    if (!secret)
        return secret.as_failure();
    auto open = StagedFile::write(certificateIn(folder, name), publicText.value(), 0644);
    if (!open)
        return open.as_failure();
    if (auto published = secret.value().publish(replace); !published)
        return published;
    auto published = open.value().publish(replace);
    if (!published && !replace) {
        std::error_code ignored;
        std::filesystem::remove(keyIn(folder, name), ignored);
    }
    return published;
}

Result<void> refuseExisting(const std::filesystem::path& folder, const std::string& name, std::string_view remedy)
{
    for (const auto& file : {certificateIn(folder, name), keyIn(folder, name)}) {
        std::error_code ignored;
        if (std::filesystem::exists(std::filesystem::symlink_status(file, ignored)))
            return fail(Errc::FileUnwritable, fmt::format("{} exists already and is left as it is; {}", file.string(), remedy));
    }
    return ok();
}

Result<void> checkValidity(std::chrono::hours validity)
{
    if (validity > std::chrono::hours(0) && validity <= longestValidity)
        return ok();
    return fail(Errc::InvalidArgument, "a certificate is valid for at least one hour and at most 36500 days");
}

Result<void> checkSite(const std::string& site)
{
    const bool fits = !site.empty() && site.size() <= longestName;
    if (fits && printable(site, longestName) == site)
        return ok();
    return fail(Errc::InvalidArgument, fmt::format("the site's name must be 1 to {} bytes of printable UTF-8", longestName));
}

Result<void> checkName(const std::string& name)
{
    const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto fits = [&](char c) { return isLetter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-'; };
    if (name.empty() || name.size() > longestName || !isLetter(name.front()) || !std::all_of(name.begin(), name.end(), fits))
        return fail(Errc::InvalidArgument,
                    fmt::format("\"{}\" is no device name: a letter, then up to 63 letters, digits, - and _", printable(name)));
    const bool authoritys = name.size() == 2 && std::tolower(name[0]) == 'c' && std::tolower(name[1]) == 'a';
    if (authoritys)
        return fail(Errc::InvalidArgument, fmt::format("\"{}\" is the name of the authority's files; give the device another", name));
    return ok();
}

Result<void> makeFolder(const std::filesystem::path& folder)
{
    std::error_code failure;
    const bool made = std::filesystem::create_directories(folder, failure);
    if (!failure && made)
        std::filesystem::permissions(folder, std::filesystem::perms::owner_all, failure);
    if (!failure)
        return ok();
    return fail(Errc::FileUnwritable, fmt::format("the folder {} cannot be made: {}", folder.string(), failure.message()));
}

Result<void> checkWithin(X509* authority, std::chrono::hours validity)
{
    const auto end = timeOf(X509_get0_notAfter(authority));
    if (std::chrono::system_clock::now() + validity <= end)
        return ok();
    return fail(Errc::InvalidArgument, fmt::format("the certificate would outlive its authority, which ends on {}; ask for fewer days, "
                                                   "or make a new authority in another folder",
                                                   dateText(end)));
}

} // namespace

Result<CertificateAuthority> CertificateAuthority::create(const std::filesystem::path& folder, const std::string& site,
                                                          std::chrono::hours validity)
{
    for (const auto& checked : {checkSite(site), checkValidity(validity)})
        if (!checked)
            return checked.as_failure();
    if (auto made = makeFolder(folder); !made)
        return made.as_failure();
    if (auto free = refuseExisting(folder, "ca", "every certificate of the site hangs on it; choose another folder"); !free)
        return free.as_failure();
    const auto key = makeKey();
    if (!key)
        return key.as_failure();
    const auto certificate = makeAuthority(key.value().get(), site, validity);
    if (!certificate)
        return certificate.as_failure();
    if (auto written = writePair(folder, "ca", certificate.value().get(), key.value().get(), false); !written)
        return written.as_failure();
    return CertificateAuthority(folder);
}

Result<CertificateAuthority> CertificateAuthority::open(const std::filesystem::path& folder)
{
    const auto files = loadAuthority(folder);
    if (!files)
        return files.as_failure();
    return CertificateAuthority(folder);
}

Result<void> CertificateAuthority::issue(DeviceId device, const std::string& name, std::chrono::hours validity, bool replace) const
{
    if (!device.isValidDevice())
        return fail(Errc::InvalidArgument,
                    fmt::format("{} cannot be a device: its class is reserved or its index is 7", device.toString()));
    for (const auto& checked : {checkName(name), checkValidity(validity)})
        if (!checked)
            return checked;
    if (auto free = replace ? Result<void>(ok()) : refuseExisting(m_folder, name, "ask to replace it if that is meant"); !free)
        return free;
    const auto authority = loadAuthority(m_folder);
    if (!authority)
        return authority.as_failure();
    if (auto within = checkWithin(authority.value().certificate.get(), validity); !within)
        return within;
    const auto key = makeKey();
    if (!key)
        return key.as_failure();
    const auto certificate =
        makeDeviceCertificate(key.value().get(), device, name, validity, authority.value().certificate.get(), authority.value().key.get());
    if (!certificate)
        return certificate.as_failure();
    return writePair(m_folder, name, certificate.value().get(), key.value().get(), replace);
}

} // namespace liena
