// The findings of one file while it is read: remarks by byte offset, turned into line and column.
#pragma once

#include "liena/error.hpp"
#include "liena/finding.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace liena {

class FindingList {
public:
    /// An offset that means the whole file.
    static constexpr std::size_t wholeFile = static_cast<std::size_t>(-1);

    /// More findings than this are counted, not kept: a hostile file must not fill the memory with remarks about itself.
    static constexpr std::size_t most = 100;

    /// `text` is only read here.
    FindingList(std::string file, std::string_view text);

    void error(std::size_t offset, std::string text, std::string remedy = {});
    void warning(std::size_t offset, std::string text, std::string remedy = {});

    const std::string& file() const { return m_file; }
    bool hasErrors() const { return m_errors > 0; }

    /// From 1; 0 for the whole file.
    int lineOf(std::size_t offset) const;

    /// In the order of their places, and last how many were not kept.
    Findings sorted() const;

    /// The first error, and how many follow, as one Error.
    Error summary(Errc code) const;

private:
    void add(Severity severity, std::size_t offset, std::string text, std::string remedy);

    std::string m_file;
    std::vector<std::size_t> m_lineStarts{0};
    Findings m_findings;
    std::size_t m_errors = 0;
    std::size_t m_notKept = 0;
};

} // namespace liena
