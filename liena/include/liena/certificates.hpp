// A site's own certificate authority, and the certificates that tie a key to a device id (protocol section 6).
#pragma once

#include "liena/device_id.hpp"
#include "liena/error.hpp"
#include "liena/timestamp.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace liena {

// What reads or writes files here blocks on them, and may be called from any thread. Errors name the file: FileUnreadable (a key that
// others may read, too), FileUnwritable (what is there already, too), CertificateInvalid.

/// No session begins, and none is re-opened, with a certificate of either end that has not more than this left: a certificate does not end
/// in the middle of a procedure.
inline constexpr std::chrono::hours leastRemaining{24};

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

enum class RevocationReason : std::uint8_t { Unspecified, KeyCompromise, Superseded, OutOfService };

/// `key-compromise`, as on the command line.
std::string_view toString(RevocationReason reason);

struct RevokedCertificate {
    std::string serial; ///< hex
    std::chrono::system_clock::time_point since;
    RevocationReason reason = RevocationReason::Unspecified;
};

struct RevocationListInfo {
    std::string issuer;
    std::string number; ///< hex; every new list of an authority has a higher one
    std::chrono::system_clock::time_point made;
    std::chrono::system_clock::time_point ends; ///< from then on no new session relies on it
    std::vector<RevokedCertificate> revoked;
};

/// A folder with `ca.crt`, `ca.key` (mode 0600), per device `<name>.crt`, `<name>.key`, and once something was revoked `ca.crl`.
class CertificateAuthority {
public:
    /// Makes a new authority (ECDSA P-256) in `folder`, which must not hold one yet. InvalidArgument for a
    /// site that is not 1 to 64 printable bytes, and for a validity that is not an hour to 36 500 days.
    static Result<CertificateAuthority> create(const std::filesystem::path& folder, const std::string& site, std::chrono::hours validity);

    static Result<CertificateAuthority> open(const std::filesystem::path& folder);

    /// Issues a key and a certificate for one device: SAN `urn:liena:device:<id>`, usage client and server. Files are written whole or not
    /// at all; existing ones are refused unless `replace`. InvalidArgument for an id that no device may have, a name that is none of a file
    /// or is `ca`, and a validity as above or beyond the authority's own end.
    Result<void> issue(DeviceId device, const std::string& name, std::chrono::hours validity, bool replace = false) const;

    /// Adds serial numbers to the list `ca.crl` and signs it anew; none only renews it. A damaged list is an error: one that was begun anew
    /// would forget who was revoked. Devices learn of it when the file is copied to them. Of two calls at once for one folder one may be
    /// lost. InvalidArgument for what is no serial number, and for a validity that is not a day to 36 500 days.
    Result<RevocationListInfo> revoke(const std::vector<std::string>& serials, RevocationReason reason, std::chrono::hours validity) const;

    /// The serial number of a device's certificate that this authority issued; an error for any other certificate.
    Result<std::string> issuedSerial(const std::filesystem::path& certificate) const;

    const std::filesystem::path& folder() const { return m_folder; }

private:
    explicit CertificateAuthority(std::filesystem::path folder) : m_folder(std::move(folder)) {}
    std::filesystem::path m_folder;
};

/// What a PEM file says.
Result<CertificateInfo> describeCertificate(const std::filesystem::path& file);

/// What a revocation list says; nobody asks here who signed it.
Result<RevocationListInfo> describeRevocations(const std::filesystem::path& file);

/// Where a device looks for the list unless it is told another place: beside the authority's certificate, `ca.crl` for `ca.crt`.
std::filesystem::path revocationsBeside(const std::filesystem::path& authority);

/// Whether a device could open sessions with these files now: readable, matching, in date with more than leastRemaining left, signed by the
/// authority, not revoked, naming just `device`. `revocations` empty: revocationsBeside() the authority.
Result<void> checkIdentity(const std::filesystem::path& certificate, const std::filesystem::path& key,
                           const std::filesystem::path& authority, DeviceId device, const std::filesystem::path& revocations = {});

/// Lets a crash of this process leave no keys behind: no core file, and none of its memory in one that another program writes. For main().
void keepKeysOutOfCoreDumps();

} // namespace liena
