// The text of OpenSSL's last error.
#include "security/openssl_types.hpp"

#include <openssl/err.h>

namespace liena::security {

std::string takeOpensslReason()
{
    const auto code = ERR_peek_last_error();
    const char* reason = ERR_reason_error_string(code);
    ERR_clear_error();
    return reason != nullptr ? reason : "no reason given";
}

} // namespace liena::security
