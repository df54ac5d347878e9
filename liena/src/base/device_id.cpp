// Text forms of device ids, classes and message ids.
#include "liena/device_id.hpp"

#include "liena/message_id.hpp"

#include <fmt/format.h>

#include <charconv>

namespace liena {

std::string_view toString(DeviceClass deviceClass)
{
    switch (deviceClass) {
    case DeviceClass::Hand:
        return "hand";
    case DeviceClass::Eye:
        return "eye";
    case DeviceClass::Brain:
        return "brain";
    case DeviceClass::Arm:
        return "arm";
    case DeviceClass::Special:
        return "special";
    }
    return "reserved";
}

std::optional<DeviceClass> deviceClassFrom(std::string_view name)
{
    for (const auto candidate : {DeviceClass::Hand, DeviceClass::Eye, DeviceClass::Brain, DeviceClass::Arm, DeviceClass::Special})
        if (toString(candidate) == name)
            return candidate;
    return std::nullopt;
}

std::optional<DeviceId> DeviceId::fromString(std::string_view text)
{
    if (text.size() != 10 || !text.starts_with("0x"))
        return std::nullopt;
    std::uint32_t value = 0;
    const auto [end, failure] = std::from_chars(text.data() + 2, text.data() + text.size(), value, 16);
    if (failure != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return DeviceId(value);
}

std::string DeviceId::toString() const { return fmt::format("0x{:08x}", m_value); }

std::string MessageId::toString() const { return fmt::format("{}/0x{:04x}", origin.toString(), number); }

} // namespace liena
