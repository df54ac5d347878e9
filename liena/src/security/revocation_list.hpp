// A list of revoked certificates (RFC 5280 section 5) as far as LiENa takes it: whole, and signed by the site's authority.
#pragma once

#include "liena/certificates.hpp"
#include "liena/error.hpp"
#include "security/openssl_types.hpp"

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace liena::security {

class RevocationList {
public:
    /// A PEM file with one list, or one of each authority. An error when one is damaged, not signed by one of `authorities`, without number
    /// or end, or restricted in a way that is not understood. Whether its time has come or is over is requireCurrent()'s.
    static Result<RevocationList> parse(const std::string& pem, const std::filesystem::path& file,
                                        const std::vector<CertificatePtr>& authorities);

    bool revokes(X509* certificate) const;

    /// An error when a list's time is over, or has not come yet by more than the clocks of a site may differ.
    Result<void> requireCurrent(std::chrono::system_clock::time_point now) const;

    /// A list of the same authority has a lower number than here or is gone: `other` may forget who was revoked.
    bool isNewerThan(const RevocationList& other) const;

    /// What it says, of the first list; the revoked of all.
    RevocationListInfo info() const;

private:
    explicit RevocationList(std::filesystem::path file) : m_file(std::move(file)) {}

    std::filesystem::path m_file;
    std::vector<RevocationListPtr> m_lists;
};

/// Every list of a PEM text, unverified: at least one, at most 16.
Result<std::vector<RevocationListPtr>> readLists(const std::string& pem, const std::filesystem::path& file);

/// What lists say, without asking who signed them.
RevocationListInfo describeLists(const std::vector<RevocationListPtr>& lists);

} // namespace liena::security
