// A certificate authority in a temporary folder, for tests that need devices with certificates.
#pragma once

#include "liena/certificates.hpp"
#include "liena/settings.hpp"

#include <QTemporaryDir>

#include <filesystem>
#include <optional>
#include <string>

namespace liena::test {

/// The three files a device needs.
struct IdentityFiles {
    std::filesystem::path certificate;
    std::filesystem::path key;
    std::filesystem::path authority;

    void applyTo(Settings& settings) const
    {
        settings.certificate = certificate;
        settings.key = key;
        settings.authority = authority;
    }
};

/// The files go with the object.
class TestAuthority {
public:
    TestAuthority();

    /// Issues on the first call for a name; throws when that fails, since no test can go on then.
    IdentityFiles identityOf(DeviceId device, const std::string& name);

    const CertificateAuthority& authority() const { return *m_authority; }
    std::filesystem::path folder() const { return m_folder.path().toStdString(); }
    std::filesystem::path certificate() const { return folder() / "ca.crt"; }
    std::filesystem::path key() const { return folder() / "ca.key"; }

private:
    QTemporaryDir m_folder;
    std::optional<CertificateAuthority> m_authority;
};

} // namespace liena::test
