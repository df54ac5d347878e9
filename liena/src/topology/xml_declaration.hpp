// The line `<?xml version="1.0" encoding="UTF-8"?>` at the start of a file.
#pragma once

#include "topology/finding_list.hpp"

#include <cstddef>
#include <optional>
#include <string_view>

namespace liena {

/// The offset behind the declaration, 0 when there is none; nothing, and an error in `findings`, when it says what is not allowed.
std::optional<std::size_t> endOfXmlDeclaration(std::string_view xml, FindingList& findings);

} // namespace liena
