// One device's status as a page for a terminal.
#pragma once

#include "json_value.hpp"

#include <chrono>
#include <string>

namespace liena::tools {

/// Lines of text without colours or control characters.
std::string monitorPage(const JsonValue& status);

/// In its place when the device has said nothing for so long: what it said before would look like what is now. `id` is known from the
/// socket's name; the status is null when it never spoke.
std::string silentPage(const JsonValue& status, const std::string& id, std::chrono::seconds silence);

/// In its place when the device has ended the connection.
std::string gonePage(const JsonValue& status, const std::string& id);

} // namespace liena::tools
