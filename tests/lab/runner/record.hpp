// One line of a device's log as the runner keeps it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace liena::lab {

struct Record {
    std::int64_t at = 0;            ///< monotonic ns
    std::vector<std::string> words; ///< what the device said; never empty

    const std::string& kind() const { return words.front(); }
    const std::string& word(std::size_t index) const; ///< empty when the line is shorter
    std::uint64_t number(std::size_t index) const;    ///< 0 when it is none
};

/// `<ns> word word …`. A line that is none becomes a record of the kind `unreadable`.
Record parseRecord(std::string_view line);

/// Monotonic ns, as in the records.
std::int64_t nowNs();

} // namespace liena::lab
