// Where a command finds the register of message sets that nobody named.
#pragma once

#include <filesystem>

namespace liena::tools {

/// `resources/devices` of the `working` folder, as in the project's own; else what an installation beside `program` has; else the first of
/// them, so that whoever reads it says what is missing.
std::filesystem::path registerFolder(const std::filesystem::path& working, const std::filesystem::path& program);

/// The same for this program where it was started: what `--registry` is by default. The first kind is relative, as a person would write it.
std::filesystem::path registerFolder();

} // namespace liena::tools
