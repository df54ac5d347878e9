// Device ids as URIs, strict when reading.
#include "security/device_uri.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace liena::security {

namespace {

constexpr std::string_view prefix = "urn:liena:device:";

char lowered(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

} // namespace

std::string deviceUri(DeviceId device) { return fmt::format("{}{:08x}", prefix, device.value()); }

std::optional<DeviceId> deviceFromUri(std::string_view uri)
{
    if (uri.size() != prefix.size() + 8 || !uri.starts_with(prefix))
        return std::nullopt;
    const auto digits = uri.substr(prefix.size());
    const auto isDigit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
    if (!std::all_of(digits.begin(), digits.end(), isDigit))
        return std::nullopt;
    std::uint32_t value = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    return DeviceId(value);
}

bool claimsDevice(std::string_view uri)
{
    return uri.size() >= prefix.size() &&
           std::equal(prefix.begin(), prefix.end(), uri.begin(), [](char a, char b) { return a == lowered(b); });
}

} // namespace liena::security
