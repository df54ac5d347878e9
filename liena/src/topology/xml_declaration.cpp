// Version 1.0, no encoding but UTF-8; the parts in their order, each once.
#include "topology/xml_declaration.hpp"

#include "topology/xml_text.hpp"

#include <algorithm>
#include <array>

namespace liena {

namespace {

constexpr std::string_view opening = "<?xml";
constexpr std::array<std::string_view, 3> partNames{"version", "encoding", "standalone"};

bool isUtf8(std::string_view encoding)
{
    constexpr std::string_view upper = "UTF-8";
    return std::equal(encoding.begin(), encoding.end(), upper.begin(), upper.end(),
                      [](char x, char y) { return (x >= 'a' && x <= 'z' ? static_cast<char>(x - 'a' + 'A') : x) == y; });
}

struct Part {
    std::size_t index = partNames.size();
    std::string_view value;
    std::size_t valueAt = 0;
    std::size_t end = 0;
};

/// The ` name="value"` at `at`, behind white space; an index of partNames.size() when it is none.
Part partAt(std::string_view text, std::size_t at)
{
    const auto equals = text.find('=', at);
    if (equals == std::string_view::npos || equals + 1 >= text.size() || !isXmlSpace(text[at - 1]))
        return {};
    const char quote = text[equals + 1];
    const auto close = quote == '"' || quote == '\'' ? text.find(quote, equals + 2) : std::string_view::npos;
    if (close == std::string_view::npos)
        return {};
    const auto name = std::find(partNames.begin(), partNames.end(), text.substr(at, equals - at));
    return {static_cast<std::size_t>(name - partNames.begin()), text.substr(equals + 2, close - equals - 2), equals + 2, close + 1};
}

bool allowed(const Part& part, FindingList& findings)
{
    if (part.index == 0 && part.value != "1.0")
        findings.error(part.valueAt, "XML version " + inQuotes(part.value) + " is not known", "write version=\"1.0\"");
    else if (part.index == 1 && !isUtf8(part.value))
        findings.error(part.valueAt, "the encoding " + inQuotes(part.value) + " is not allowed", "save the file as UTF-8 and say so");
    else if (part.index == 2 && part.value != "yes" && part.value != "no")
        findings.error(part.valueAt, "standalone is 'yes' or 'no'", "leave it out");
    else
        return true;
    return false;
}

} // namespace

std::optional<std::size_t> endOfXmlDeclaration(std::string_view xml, FindingList& findings)
{
    constexpr auto remedy = "write <?xml version=\"1.0\" encoding=\"UTF-8\"?>";
    if (!xml.starts_with(opening) || xml.size() == opening.size() || !isXmlSpace(xml[opening.size()]))
        return 0;
    const auto close = xml.find("?>");
    if (close == std::string_view::npos) {
        findings.error(0, "the XML declaration is not closed", remedy);
        return std::nullopt;
    }
    const auto text = xml.substr(0, close);
    std::size_t next = 0;
    for (auto at = opening.size(); (at = text.find_first_not_of(" \t\r\n", at)) != std::string_view::npos;) {
        const auto part = partAt(text, at);
        const bool inOrder = part.index >= next && part.index < partNames.size() && (next > 0 || part.index == 0);
        if (!inOrder) {
            findings.error(at, "the XML declaration cannot be read", remedy);
            return std::nullopt;
        }
        if (!allowed(part, findings))
            return std::nullopt;
        next = part.index + 1;
        at = part.end;
    }
    if (next == 0) {
        findings.error(0, "the XML declaration has no version", remedy);
        return std::nullopt;
    }
    return close + 2;
}

} // namespace liena
