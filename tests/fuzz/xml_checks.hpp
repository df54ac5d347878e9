// What holds for the findings of every XML file.
#pragma once

#include "fuzz_target.hpp"
#include "liena/finding.hpp"

#include <algorithm>
#include <string_view>

namespace liena::fuzz {

inline void checkFindings(const Findings& findings, bool read, std::string_view xml)
{
    expect(read == !hasErrors(findings), "a file is read when it has no error, and only then");
    expect(findings.size() <= 102, "a hostile file does not fill the memory with remarks about itself");
    const auto lines = std::count(xml.begin(), xml.end(), '\n') + 1;
    for (const auto& finding : findings) {
        expect(!finding.text.empty(), "a finding says what is wrong");
        expect(finding.line >= 0 && finding.line <= lines && finding.column >= 0, "a finding stands in the file");
        expect(finding.toString().size() < 4096, "a finding is a sentence");
    }
}

} // namespace liena::fuzz
