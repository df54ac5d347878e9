// A device's certificate, its key and its authority, loaded and held against each other.
#pragma once

#include "liena/device_id.hpp"
#include "liena/error.hpp"
#include "security/openssl_types.hpp"

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace liena::security {

struct Identity {
    std::vector<CertificatePtr> certificates; ///< the device's own first, then intermediate ones
    KeyPtr key;
    std::vector<CertificatePtr> authorities;
    std::chrono::system_clock::time_point end; ///< the earliest of the own certificate and of those it hangs on
};

/// Everything that can be known to be wrong before the first connection is refused here, as of `now`.
Result<Identity> loadIdentity(const std::filesystem::path& certificate, const std::filesystem::path& key,
                              const std::filesystem::path& authority, DeviceId device,
                              std::chrono::system_clock::time_point now = std::chrono::system_clock::now());

/// What a failed verification of a certificate chain means, in words for a person.
std::string explainVerification(long verifyResult);

/// The strength and the length of chain that are asked of every certificate, our own and a peer's.
inline constexpr int securityLevel = 2; // RSA from 2048 bits, elliptic curves from 224, SHA-256
inline constexpr int longestChain = 1;  // intermediate authorities

} // namespace liena::security
