// The certificates and connections that are tried on a device: a matrix of which exactly one row, the last, opens.
#pragma once

#include "liena/device_id.hpp"
#include "support/forged_certificate.hpp"

#include <openssl/ssl.h>

#include <functional>

namespace liena::test {

enum class Signer { Site, OtherSite, Itself, OneBelow, TwoBelow };

struct CertificateRow {
    const char* name;
    Recipe recipe;
    Signer signer = Signer::Site;
    bool showsCertificate = true;
    std::string alpn = "liena/1";
    int highestVersion = TLS1_3_VERSION;
    std::string groups = "X25519:P-256:P-384:P-521";
    const char* serverSays = ""; ///< part of what our server says to a client like this; empty: it lets it in
    const char* clientSays = ""; ///< part of what our client says to a server like this
};

/// What a certificate of `device` should be, for two days.
Recipe goodRecipe(DeviceId device);

using Change = std::function<void(Recipe&)>;
Recipe changed(DeviceId device, const Change& change);

/// All of them claim, rightly or not, to be `device`; `other` is another one of the site.
std::vector<CertificateRow> certificateMatrix(DeviceId device, DeviceId other);

/// Who signs the matrix: the site's authority and some that it does not know.
class MatrixSigners {
public:
    MatrixSigners(const std::filesystem::path& authority, const std::filesystem::path& key);

    Forged made(const CertificateRow& row) const;
    const Forged& site() const { return m_site; }
    const Forged& between() const { return m_between; } ///< an authority below the site's

private:
    Forged m_site;
    Forged m_other;
    Forged m_between;
    Forged m_below;
};

} // namespace liena::test
