// The text form of findings.
#include "liena/finding.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace liena {

std::string Finding::toString() const
{
    std::string place = file;
    if (line > 0)
        place += fmt::format(":{}:{}", line, column);
    auto sentence = fmt::format("{}: {}: {}", place, severity == Severity::Error ? "error" : "warning", text);
    if (!remedy.empty())
        sentence += "; " + remedy;
    return sentence;
}

bool hasErrors(const Findings& findings)
{
    return std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return f.severity == Severity::Error; });
}

} // namespace liena
