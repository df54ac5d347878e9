// The audit file: who did what to a device's sessions, one JSON line per entry, each tied to all that came before it.
#pragma once

#include "liena/error.hpp"
#include "liena/hash.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace liena {

/// What can be noticed: a line that was changed, removed, inserted or moved, and a file that was cut in the middle of a line. Entries cut
/// off at the end are noticed by the file `.head` beside it, which keeps the number of entries and the newest hash. Whoever can write both
/// can write a whole new history: that is noticed only by a hash kept elsewhere. Devices log theirs when they stop, and
/// `liena monitor` shows it; give it as `expected`.
struct AuditVerdict {
    std::uint64_t entries = 0;           ///< sound ones, from the beginning
    Sha256 head;                         ///< of the newest of them
    std::uint64_t line = 0;              ///< the first line that is wrong, from 1; 0 when none is
    std::string fault;                   ///< what is wrong with it, for a person
    std::optional<std::uint64_t> anchor; ///< the number of the entry whose hash was expected
    std::vector<std::string> remarks;    ///< what is no fault: a crash that was recovered from, a missing `.head`

    bool sound() const { return fault.empty(); }
};

/// Reads the whole file, which may be in use. An error when it cannot be read; a bad one is a verdict.
Result<AuditVerdict> verifyAudit(const std::filesystem::path& file, const std::optional<Sha256>& expected = std::nullopt);

} // namespace liena
