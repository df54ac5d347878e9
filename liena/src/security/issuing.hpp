// New keys and certificates, in memory.
#pragma once

#include "liena/device_id.hpp"
#include "liena/error.hpp"
#include "security/openssl_types.hpp"

#include <chrono>
#include <string>

namespace liena::security {

/// ECDSA on P-256.
Result<KeyPtr> makeKey();

/// A self-signed authority: may sign certificates, nothing else.
Result<CertificatePtr> makeAuthority(EVP_PKEY* key, const std::string& site, std::chrono::hours validity);

/// A certificate for the holder of `key`: the device's URI, usage client and server, signed by the authority.
Result<CertificatePtr> makeDeviceCertificate(EVP_PKEY* key, DeviceId device, const std::string& name, std::chrono::hours validity,
                                             X509* authority, EVP_PKEY* authorityKey);

} // namespace liena::security
