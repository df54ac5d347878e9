// Test inputs that carry the place where a finding is expected, as `@@` in front of it.
#pragma once

#include "liena/finding.hpp"

#include <QByteArray>
#include <QFile>
#include <QTest>

#include <algorithm>
#include <string>
#include <string_view>

namespace liena::test {

struct MarkedText {
    std::string text;
    int line = 0;
    int column = 0;
};

/// Without a mark the finding is expected for the whole file, at 0:0.
inline MarkedText unmarked(std::string_view marked)
{
    MarkedText result;
    result.text = marked;
    const auto at = result.text.find("@@");
    if (at == std::string::npos)
        return result;
    result.text.erase(at, 2);
    const auto before = std::string_view(result.text).substr(0, at);
    result.line = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
    const auto lineStart = before.rfind('\n');
    result.column = static_cast<int>(lineStart == std::string_view::npos ? at : at - lineStart - 1) + 1;
    return result;
}

inline std::string listed(const Findings& findings)
{
    std::string text = "the findings are:\n";
    for (const auto& finding : findings)
        text += finding.toString() + "\n";
    return text;
}

/// One finding at the marked place whose sentence holds the fragment.
inline bool holds(const Findings& findings, Severity severity, const MarkedText& place, std::string_view fragment)
{
    return std::any_of(findings.begin(), findings.end(), [&](const Finding& f) {
        return f.severity == severity && f.line == place.line && f.column == place.column &&
               f.toString().find(fragment) != std::string::npos;
    });
}

inline std::string sourceFile(const std::string& relative) { return LIENA_SOURCE_DIR "/" + relative; }

inline QByteArray bytesOf(const std::string& path)
{
    QFile file(QString::fromStdString(path));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

} // namespace liena::test
