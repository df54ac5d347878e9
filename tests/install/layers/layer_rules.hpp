// Who may know whom: the rooms of liena/ and console/, and the libraries, held against the includes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace liena::test {

/// One line `file:line: what knows too much, and what it may know`.
using Violations = std::vector<std::string>;

/// `file` is relative to the source tree, with slashes. `qtCore` is the folder of Qt Core's headers.
Violations checkIncludes(const std::string& file, std::string_view text, const std::filesystem::path& qtCore);

/// Every C++ file below liena/ and console/.
std::vector<std::filesystem::path> sourcesOf(const std::filesystem::path& tree);
Violations checkTree(const std::filesystem::path& tree, const std::filesystem::path& qtCore);

} // namespace liena::test
