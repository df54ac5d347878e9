// A strict walk over the grammar of XML 1.0 without document types, entities and processing instructions; takes memory for places only.
#include "topology/xml_scan.hpp"

#include "topology/xml_declaration.hpp"
#include "topology/xml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace liena {

namespace {

constexpr std::size_t longestName = 64;

// XML would allow more in names; no name that LiENa knows needs it.
bool startsName(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':'; }
bool continuesName(char c) { return startsName(c) || (c >= '0' && c <= '9') || c == '-' || c == '.'; }

class XmlScanner {
public:
    XmlScanner(std::string_view xml, FindingList& findings) : m_xml(xml), m_findings(findings) {}

    std::optional<XmlMap> run();

private:
    bool checkBytes();
    bool scanDeclaration();
    bool scanMarkup();
    bool scanComment();
    bool scanCharacterData();
    bool skipInstruction();
    bool scanEndTag();
    bool scanStartTag();
    bool openElement(std::string_view name, std::size_t nameAt);
    bool scanAttributes(ScannedElement& element);
    bool scanAttribute(const ScannedElement& element);
    bool scanValue();
    bool scanText();
    void scanReference(bool inAttribute);
    bool finishDocument();

    bool stop(std::size_t at, std::string text, std::string remedy = {});
    void remark(std::size_t at, std::string text, std::string remedy);
    bool ahead(std::string_view text) const { return m_xml.substr(m_at).starts_with(text); }
    bool atEnd() const { return m_at >= m_xml.size(); }
    bool skipSpace();
    std::string_view takeName();
    std::string_view nameAt(std::size_t offset) const;

    std::string_view m_xml;
    FindingList& m_findings;
    std::size_t m_at = 0;
    std::vector<std::size_t> m_open; ///< the names' offsets
    XmlMap m_map;
    bool m_refused = false;
};

std::optional<XmlMap> XmlScanner::run()
{
    if (!checkBytes() || !scanDeclaration())
        return std::nullopt;
    while (!atEnd())
        if (!(m_xml[m_at] == '<' ? scanMarkup() : scanText()))
            return std::nullopt;
    if (!finishDocument() || m_refused)
        return std::nullopt;
    return std::move(m_map);
}

bool XmlScanner::stop(std::size_t at, std::string text, std::string remedy)
{
    remark(at, std::move(text), std::move(remedy));
    return false;
}

void XmlScanner::remark(std::size_t at, std::string text, std::string remedy)
{
    m_refused = true;
    m_findings.error(at, std::move(text), std::move(remedy));
}

bool XmlScanner::checkBytes()
{
    if (m_xml.size() > XmlLimits::bytes)
        return stop(FindingList::wholeFile, fmt::format("the file has {} bytes", m_xml.size()),
                    fmt::format("a file may have at most {}", XmlLimits::bytes));
    if (m_xml.empty())
        return stop(FindingList::wholeFile, "the file is empty");
    if (m_xml.starts_with("\xEF\xBB\xBF"))
        return stop(0, "the file starts with a byte order mark", "save it as UTF-8 without BOM");
    if (m_xml.starts_with("\xFF\xFE") || m_xml.starts_with("\xFE\xFF"))
        return stop(0, "the file is UTF-16", "save it as UTF-8 without BOM");
    const auto bad = findInvalidCharacter(m_xml);
    if (bad != std::string_view::npos)
        return stop(bad,
                    fmt::format("the byte 0x{:02x} is not part of a character that XML allows", static_cast<unsigned char>(m_xml[bad])),
                    "save the file as UTF-8 and remove control characters");
    return true;
}

bool XmlScanner::scanDeclaration()
{
    const auto end = endOfXmlDeclaration(m_xml, m_findings);
    m_at = end.value_or(0);
    return end.has_value();
}

bool XmlScanner::scanMarkup()
{
    if (ahead("<!--"))
        return scanComment();
    if (ahead("<![CDATA["))
        return scanCharacterData();
    if (ahead("<!DOCTYPE"))
        return stop(m_at, "a document type declaration is not allowed", "remove it; the namespace says what the file is");
    if (ahead("<!"))
        return stop(m_at, "this declaration is not allowed", "remove it, or write &lt; for the character itself");
    if (ahead("<?"))
        return skipInstruction();
    return ahead("</") ? scanEndTag() : scanStartTag();
}

bool XmlScanner::scanComment()
{
    const auto dashes = m_xml.find("--", m_at + 4);
    if (dashes == std::string_view::npos)
        return stop(m_at, "this comment is not closed", "end it with -->");
    if (dashes + 2 >= m_xml.size() || m_xml[dashes + 2] != '>')
        return stop(dashes, "'--' inside a comment", "a comment ends at the first two dashes, as -->");
    m_at = dashes + 3;
    return true;
}

bool XmlScanner::scanCharacterData()
{
    if (m_open.empty())
        return stop(m_at, "text outside the root element", "remove it");
    const auto end = m_xml.find("]]>", m_at);
    if (end == std::string_view::npos)
        return stop(m_at, "this CDATA section is not closed", "end it with ]]>");
    m_at = end + 3;
    return true;
}

bool XmlScanner::skipInstruction()
{
    const bool late = ahead("<?xml ");
    remark(m_at, late ? "the XML declaration is not the first thing in the file" : "a processing instruction is not allowed",
           late ? "move it to the very start, before any space or comment" : "remove it");
    const auto end = m_xml.find("?>", m_at);
    if (end == std::string_view::npos)
        return false;
    m_at = end + 2;
    return true;
}

bool XmlScanner::scanEndTag()
{
    const auto tagAt = m_at;
    m_at += 2;
    const auto name = takeName();
    skipSpace();
    if (name.empty() || atEnd() || m_xml[m_at] != '>')
        return stop(tagAt, "this end tag cannot be read", "write </name>");
    ++m_at;
    if (m_open.empty())
        return stop(tagAt, fmt::format("the end of {} stands where nothing is open", inQuotes(name)), "remove it");
    const auto expected = nameAt(m_open.back());
    if (name != expected)
        return stop(tagAt, fmt::format("the end of {} stands where </{}> is due", inQuotes(name), expected),
                    fmt::format("<{}> was opened in line {}", expected, m_findings.lineOf(m_open.back())));
    m_open.pop_back();
    return true;
}

bool XmlScanner::scanStartTag()
{
    const auto tagAt = m_at++;
    const auto nameAt = m_at;
    const auto name = takeName();
    if (name.empty())
        return stop(tagAt, "'<' without an element's name", "write &lt; for the character itself");
    if (name.size() > longestName)
        return stop(nameAt, "no element has a name as long as " + inQuotes(name));
    if (!openElement(name, nameAt))
        return false;
    // The map grows while the attributes are read, so the element is put there at the end.
    ScannedElement element{static_cast<std::uint32_t>(nameAt), static_cast<std::uint32_t>(m_map.attributes.size()), 0};
    if (!scanAttributes(element))
        return false;
    m_map.elements.push_back(element);
    return true;
}

bool XmlScanner::openElement(std::string_view name, std::size_t nameAt)
{
    if (m_open.empty() && !m_map.elements.empty())
        return stop(nameAt - 1, fmt::format("<{}> is a second root element", name), "one file holds one element that holds all else");
    if (m_map.elements.size() >= XmlLimits::elements)
        return stop(nameAt - 1, fmt::format("the file has more than {} elements", XmlLimits::elements));
    if (m_open.size() >= XmlLimits::levels)
        return stop(nameAt - 1, fmt::format("<{}> is nested deeper than {} levels", name, XmlLimits::levels));
    m_open.push_back(nameAt);
    return true;
}

bool XmlScanner::scanAttributes(ScannedElement& element)
{
    for (;;) {
        const bool spaced = skipSpace();
        if (atEnd())
            return stop(element.nameAt - 1, "this tag is not closed", "end it with > or />");
        if (m_xml[m_at] == '>') {
            ++m_at;
            return true;
        }
        if (ahead("/>")) {
            m_at += 2;
            m_open.pop_back();
            return true;
        }
        if (!spaced)
            return stop(m_at, "an attribute must be separated by a space");
        if (element.attributeCount >= XmlLimits::attributes)
            return stop(m_at, fmt::format("the element has more than {} attributes", XmlLimits::attributes));
        if (!scanAttribute(element))
            return false;
        ++element.attributeCount;
    }
}

bool XmlScanner::scanAttribute(const ScannedElement& element)
{
    const auto start = m_at;
    const auto name = takeName();
    if (name.empty())
        return stop(start, fmt::format("{} is not the start of an attribute's name", inQuotes(m_xml.substr(start, 1))));
    if (name.size() > longestName)
        return stop(start, "no attribute has a name as long as " + inQuotes(name));
    for (auto i = element.firstAttribute; i < m_map.attributes.size(); ++i)
        if (nameAt(m_map.attributes[i].nameAt) == name)
            remark(start, fmt::format("the attribute '{}' stands twice in this element", name), "keep one of them");
    skipSpace();
    if (atEnd() || m_xml[m_at] != '=')
        return stop(start, fmt::format("the attribute '{}' has no value", name), fmt::format("write {}=\"…\"", name));
    ++m_at;
    skipSpace();
    if (atEnd() || (m_xml[m_at] != '"' && m_xml[m_at] != '\''))
        return stop(start, fmt::format("the value of '{}' is not in quotes", name), fmt::format("write {}=\"…\"", name));
    m_map.attributes.push_back({static_cast<std::uint32_t>(start), static_cast<std::uint32_t>(m_at + 1)});
    return scanValue();
}

bool XmlScanner::scanValue()
{
    const auto start = m_at;
    const char quote = m_xml[m_at++];
    while (!atEnd() && m_xml[m_at] != quote) {
        if (m_xml[m_at] == '<')
            return stop(m_at, "'<' inside a value", "write &lt;, or close the quotes before it");
        if (m_xml[m_at] == '&')
            scanReference(true);
        else
            ++m_at;
    }
    if (atEnd())
        return stop(start, "these quotes are not closed");
    ++m_at;
    return true;
}

bool XmlScanner::scanText()
{
    while (!atEnd() && m_xml[m_at] != '<') {
        if (m_open.empty() && !isXmlSpace(m_xml[m_at]))
            return stop(m_at, "text outside the root element", "remove it");
        if (ahead("]]>"))
            return stop(m_at, "']]>' in a text", "write ]]&gt;");
        if (m_xml[m_at] == '&')
            scanReference(false);
        else
            ++m_at;
    }
    return true;
}

void XmlScanner::scanReference(bool inAttribute)
{
    constexpr std::array<std::string_view, 5> entities{"amp", "lt", "gt", "quot", "apos"};
    constexpr std::size_t longest = 12;
    const auto start = m_at++;
    const auto end = m_xml.substr(m_at, longest).find(';');
    if (end == std::string_view::npos || end == 0)
        return remark(start, "'&' without a reference", "write &amp; for the character itself");
    const auto body = m_xml.substr(m_at, end);
    if (body[0] != '#') {
        if (std::find(entities.begin(), entities.end(), body) == entities.end())
            return remark(start, "the entity " + inQuotes(body) + " is not known", "only &amp; &lt; &gt; &quot; and &apos; exist");
    } else {
        const bool hex = body.starts_with("#x");
        const auto digits = body.substr(hex ? 2 : 1);
        std::uint32_t character = 0;
        const auto [last, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), character, hex ? 16 : 10);
        if (failure != std::errc{} || last != digits.data() + digits.size() || !isXmlCharacter(character))
            return remark(start, "the reference " + inQuotes(body) + " names no character that XML allows", "write the character itself");
        if (inAttribute && character < 0x20)
            return remark(start, "a control character inside a value", "a value is one line of text; remove the reference");
    }
    m_at += end + 1;
}

bool XmlScanner::finishDocument()
{
    if (!m_open.empty())
        return stop(m_open.back() - 1, fmt::format("<{}> is not closed", nameAt(m_open.back())),
                    fmt::format("write </{}> behind its content", nameAt(m_open.back())));
    if (m_map.elements.empty())
        return stop(FindingList::wholeFile, "the file has no element");
    return true;
}

bool XmlScanner::skipSpace()
{
    const auto start = m_at;
    while (!atEnd() && isXmlSpace(m_xml[m_at]))
        ++m_at;
    return m_at > start;
}

std::string_view XmlScanner::takeName()
{
    const auto name = nameAt(m_at);
    m_at += name.size();
    return name;
}

std::string_view XmlScanner::nameAt(std::size_t offset) const
{
    if (offset >= m_xml.size() || !startsName(m_xml[offset]))
        return {};
    auto end = offset + 1;
    while (end < m_xml.size() && continuesName(m_xml[end]))
        ++end;
    return m_xml.substr(offset, end - offset);
}

} // namespace

const ScannedElement* XmlMap::elementAt(std::size_t nameAt) const
{
    const auto found = std::lower_bound(elements.begin(), elements.end(), nameAt,
                                        [](const ScannedElement& element, std::size_t wanted) { return element.nameAt < wanted; });
    return found != elements.end() && found->nameAt == nameAt ? &*found : nullptr;
}

std::optional<XmlMap> scanXml(std::string_view xml, FindingList& findings) { return XmlScanner(xml, findings).run(); }

} // namespace liena
