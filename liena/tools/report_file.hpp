// A report that is there whole or not at all.
#pragma once

#include <liena/error.hpp>

#include <filesystem>
#include <string_view>

namespace liena::tools {

/// Writes beside the file and takes its name when all is on the disk. Where something stands that is no file (a terminal, a pipe), it is
/// written to as it is.
Result<void> writeReport(const std::filesystem::path& file, std::string_view content);

/// Whether writeReport() could begin now: to be asked before what takes long. Leaves nothing behind.
Result<void> tryReport(const std::filesystem::path& file);

/// On standard output; an error when it did not get there.
Result<void> printReport(std::string_view content);

/// Whether all that was printed before got to standard output; what did not is told once.
Result<void> flushOutput();

} // namespace liena::tools
