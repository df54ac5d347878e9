// Certificates that no authority of ours would issue, to try what is let in.
#pragma once

#include "security/openssl_types.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace liena::test {

enum class KeyKind { P256, P224, Rsa1024, Rsa2048 };

struct Recipe {
    std::vector<std::string> uris{}; ///< byte for byte, also with NULs
    std::vector<std::string> dnsNames{};
    std::string commonName = "forged";
    std::string usage = "serverAuth,clientAuth"; ///< empty: no extended key usage at all
    int startHours = -1;                         ///< from now
    int endHours = 24;
    bool authority = false;
    KeyKind key = KeyKind::P256;
    bool sha1 = false;
};

struct Forged {
    security::CertificatePtr certificate;
    security::KeyPtr key;

    void writeTo(const std::filesystem::path& certificateFile, const std::filesystem::path& keyFile) const;
};

/// Signed by `issuer`, or by itself when that is null. Throws when OpenSSL cannot make it.
Forged forge(const Recipe& recipe, const Forged* issuer = nullptr);

/// An authority from its files, to sign forged certificates with.
Forged loadForged(const std::filesystem::path& certificateFile, const std::filesystem::path& keyFile);

} // namespace liena::test
