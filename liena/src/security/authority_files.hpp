// The files of a site's authority, in its folder.
#pragma once

#include "liena/error.hpp"
#include "security/openssl_types.hpp"

#include <filesystem>
#include <string>

namespace liena::security {

struct AuthorityFiles {
    CertificatePtr certificate;
    KeyPtr key;
};

inline std::filesystem::path certificateIn(const std::filesystem::path& folder, const std::string& name)
{
    return folder / (name + ".crt");
}
inline std::filesystem::path keyIn(const std::filesystem::path& folder, const std::string& name) { return folder / (name + ".key"); }
inline std::filesystem::path revocationsIn(const std::filesystem::path& folder) { return folder / "ca.crl"; }

/// `ca.crt` and `ca.key`, held against each other.
Result<AuthorityFiles> loadAuthority(const std::filesystem::path& folder);

} // namespace liena::security
