// What somebody may have meant: the known name that is closest to a mistyped one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace liena {

/// The closest of `known` when it is close enough to be a slip of the pen; else empty. Looks at the first 256 names only.
std::string_view nearestName(std::string_view name, const std::vector<std::string_view>& known);

/// `did you mean 'x'?`, or the known names when they are few, or nothing.
std::string suggestion(std::string_view name, const std::vector<std::string_view>& known);

/// `a, b or c`.
std::string enumeration(const std::vector<std::string_view>& names);

} // namespace liena
