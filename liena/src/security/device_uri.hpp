// The URI that ties a certificate to a device: `urn:liena:device:40018208` (protocol section 6).
#pragma once

#include "liena/device_id.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace liena::security {

std::string deviceUri(DeviceId device);

/// Exactly the prefix and eight lower-case hex digits; nothing else names a device.
std::optional<DeviceId> deviceFromUri(std::string_view uri);

/// Whether a URI sets out to name a device, in whatever case and however wrong the rest is.
bool claimsDevice(std::string_view uri);

} // namespace liena::security
