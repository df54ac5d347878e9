// What a certificate says: its names, its dates and the device it stands for.
#pragma once

#include "liena/device_id.hpp"
#include "liena/error.hpp"
#include "security/openssl_types.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace liena::security {

/// Clocks of one site differ a little; what is issued now must hold on all of them.
inline constexpr std::chrono::minutes clockTolerance{5};

std::string nameText(const X509_NAME* name);
/// Cut to 1970 to 2262, which the clock can hold: certificates may say any year from 0 to 9999.
std::chrono::system_clock::time_point timeOf(const ASN1_TIME* time);
std::string dateText(std::chrono::system_clock::time_point time);

/// The subject alternative names of type URI, byte for byte; an error when the extension is damaged or there twice.
Result<std::vector<std::string>> urisOf(X509* certificate);

/// The one device a certificate stands for: no authority, usage client and server, exactly one well-formed device URI.
Result<DeviceId> deviceOf(X509* certificate);

} // namespace liena::security
