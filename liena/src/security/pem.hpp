// Certificates and keys from and to PEM.
#pragma once

#include "liena/error.hpp"
#include "security/openssl_types.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace liena::security {

/// Every certificate of a PEM file, in its order: at least one, at most 16.
Result<std::vector<CertificatePtr>> readCertificates(const std::filesystem::path& file);

/// An unencrypted private key from a file that only its owner may read. Never asks for a passphrase.
Result<KeyPtr> readKey(const std::filesystem::path& file);

/// Whether `key` is the private half of the certificate's key; both files are named in the error.
Result<void> requireMatch(X509* certificate, EVP_PKEY* key, const std::filesystem::path& certificateFile,
                          const std::filesystem::path& keyFile);

Result<std::string> toPem(X509* certificate);

/// The caller wipes the text with OPENSSL_cleanse.
Result<std::string> toPem(EVP_PKEY* key);

} // namespace liena::security
