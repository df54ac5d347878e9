// Places and order of the findings of one file.
#include "topology/finding_list.hpp"

#include "topology/xml_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace liena {

FindingList::FindingList(std::string file, std::string_view text) : m_file(std::move(file))
{
    // A longer file is refused as a whole, so its further lines need no numbers.
    const auto read = text.substr(0, XmlLimits::bytes);
    for (auto at = read.find('\n'); at != std::string_view::npos; at = read.find('\n', at + 1))
        m_lineStarts.push_back(at + 1);
}

void FindingList::error(std::size_t offset, std::string text, std::string remedy)
{
    ++m_errors;
    add(Severity::Error, offset, std::move(text), std::move(remedy));
}

void FindingList::warning(std::size_t offset, std::string text, std::string remedy)
{
    add(Severity::Warning, offset, std::move(text), std::move(remedy));
}

int FindingList::lineOf(std::size_t offset) const
{
    if (offset == wholeFile)
        return 0;
    return static_cast<int>(std::upper_bound(m_lineStarts.begin(), m_lineStarts.end(), offset) - m_lineStarts.begin());
}

void FindingList::add(Severity severity, std::size_t offset, std::string text, std::string remedy)
{
    if (m_findings.size() >= most) {
        ++m_notKept;
        return;
    }
    const int line = lineOf(offset);
    const int column = line == 0 ? 0 : static_cast<int>(offset - m_lineStarts[static_cast<std::size_t>(line - 1)]) + 1;
    m_findings.push_back({severity, m_file, line, column, std::move(text), std::move(remedy)});
}

Findings FindingList::sorted() const
{
    auto findings = m_findings;
    std::stable_sort(findings.begin(), findings.end(),
                     [](const Finding& a, const Finding& b) { return std::tie(a.line, a.column) < std::tie(b.line, b.column); });
    if (m_notKept > 0)
        findings.push_back({m_errors > 0 ? Severity::Error : Severity::Warning, m_file, 0, 0,
                            fmt::format("{} more findings are not shown", m_notKept), "correct these first"});
    return findings;
}

Error FindingList::summary(Errc code) const
{
    const auto findings = sorted();
    const auto first = std::find_if(findings.begin(), findings.end(), [](const Finding& f) { return f.severity == Severity::Error; });
    if (first == findings.end())
        return {code, m_file + " cannot be read"};
    auto sentence = first->toString();
    if (m_errors > 1)
        sentence += fmt::format(" (and {} more errors)", m_errors - 1);
    return {code, std::move(sentence)};
}

} // namespace liena
