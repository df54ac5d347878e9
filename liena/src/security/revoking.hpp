// New revocation lists, in memory.
#pragma once

#include "liena/certificates.hpp"
#include "liena/error.hpp"
#include "security/authority_files.hpp"
#include "security/openssl_types.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace liena::security {

/// The list that follows `previous` (null for the first one): its entries and `added`, its number + 1, signed by the authority.
Result<RevocationListPtr> makeRevocationList(const AuthorityFiles& authority, const X509_CRL* previous,
                                             const std::vector<std::string>& added, RevocationReason reason, std::chrono::hours validity);

Result<std::string> toPem(X509_CRL* list);

} // namespace liena::security
