// One device's status as a page for a terminal.
#pragma once

#include "json_value.hpp"

#include <string>

namespace liena::tools {

/// Lines of text without colours or control characters.
std::string monitorPage(const JsonValue& status);

} // namespace liena::tools
