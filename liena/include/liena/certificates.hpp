// A site's own certificate authority, and the certificates that tie a key to a device id (protocol section 6).
#pragma once

#include "liena/device_id.hpp"
#include "liena/error.hpp"
#include "liena/timestamp.hpp"

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace liena {

struct CertificateInfo {
    std::string subject;
    std::string issuer;
    std::string serial;            ///< hex
    std::string fingerprint;       ///< SHA-256 of the DER form, hex
    std::vector<std::string> uris; ///< subject alternative names of type URI
    std::vector<DeviceId> devices; ///< those of them that name a device
    std::chrono::system_clock::time_point notBefore;
    std::chrono::system_clock::time_point notAfter;
    bool isAuthority = false;
};

/// A folder with `ca.crt`, `ca.key` (mode 0600) and per device `<name>.crt`, `<name>.key`.
class CertificateAuthority {
public:
    /// Makes a new authority (ECDSA P-256) in `folder`, which must not hold one yet.
    static Result<CertificateAuthority> create(const std::filesystem::path& folder, const std::string& site, std::chrono::hours validity);

    static Result<CertificateAuthority> open(const std::filesystem::path& folder);

    /// Issues a key and a certificate for one device: SAN `urn:liena:device:<id>`, usage client and server. Files are written whole or not
    /// at all; existing ones are refused unless `replace`.
    Result<void> issue(DeviceId device, const std::string& name, std::chrono::hours validity, bool replace = false) const;

    const std::filesystem::path& folder() const { return m_folder; }

private:
    explicit CertificateAuthority(std::filesystem::path folder) : m_folder(std::move(folder)) {}
    std::filesystem::path m_folder;
};

/// What a PEM file says.
Result<CertificateInfo> describeCertificate(const std::filesystem::path& file);

/// Whether a device could open sessions with these files now: readable, matching, in date, signed by the authority, naming just `device`.
Result<void> checkIdentity(const std::filesystem::path& certificate, const std::filesystem::path& key,
                           const std::filesystem::path& authority, DeviceId device);

} // namespace liena
