// A whole small file as bytes.
#pragma once

#include "liena/error.hpp"

#include <cstddef>
#include <filesystem>
#include <string>

namespace liena {

/// Reads a regular file; refuses anything else and anything longer than `limit` bytes without reading it whole.
Result<std::string> readFile(const std::filesystem::path& file, std::size_t limit);

/// As readFile, from a descriptor that is open for reading; `name` is for the error.
Result<std::string> readDescriptor(int descriptor, const std::string& name, std::size_t limit);

} // namespace liena
