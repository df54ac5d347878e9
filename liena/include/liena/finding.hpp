// A remark about a file that a person wrote: where it is, what is wrong and what to do.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace liena {

enum class Severity : std::uint8_t { Error, Warning };

struct Finding {
    Severity severity = Severity::Error;
    std::string file;
    int line = 0;   ///< from 1; 0 when the remark is about the whole file
    int column = 0; ///< from 1, in bytes
    std::string text;
    std::string remedy;

    /// `file:line:column: error: text; remedy`, the form that editors can jump to.
    std::string toString() const;

    friend bool operator==(const Finding&, const Finding&) = default;
};

using Findings = std::vector<Finding>;

bool hasErrors(const Findings& findings);

} // namespace liena
