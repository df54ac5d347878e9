// The tree by pugixml, joined with the places from the scan.
#include "topology/xml_document.hpp"

#include "topology/nearest_name.hpp"
#include "topology/xml_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace liena {

FindingList& Attribute::findings() const { return m_document->m_findings; }

void Attribute::reject(std::string text, std::string remedy) const { findings().error(valueAt(), std::move(text), std::move(remedy)); }
void Attribute::misplaced(std::string text, std::string remedy) const { findings().error(nameAt(), std::move(text), std::move(remedy)); }

Element::Element(const XmlDocument& document, pugi::xml_node node)
    : m_document(&document), m_node(node), m_place(document.m_map.elementAt(static_cast<std::size_t>(node.offset_debug())))
{}

FindingList& Element::findings() const { return m_document->m_findings; }
std::size_t Element::at() const { return m_place ? m_place->nameAt - 1 : FindingList::wholeFile; }
void Element::error(std::string text, std::string remedy) const { findings().error(at(), std::move(text), std::move(remedy)); }
void Element::warning(std::string text, std::string remedy) const { findings().warning(at(), std::move(text), std::move(remedy)); }

std::vector<Attribute> Element::attributes() const
{
    std::vector<Attribute> result;
    if (!m_place)
        return result;
    std::uint32_t index = 0;
    for (const auto attribute : m_node.attributes()) {
        if (index == m_place->attributeCount)
            break;
        result.emplace_back(*m_document, attribute, m_document->m_map.attributes[m_place->firstAttribute + index++]);
    }
    return result;
}

std::optional<Attribute> Element::find(std::string_view attribute) const
{
    for (const auto& candidate : attributes())
        if (candidate.name() == attribute)
            return candidate;
    return std::nullopt;
}

std::optional<Attribute> Element::require(std::string_view attribute) const
{
    auto found = find(attribute);
    if (!found)
        error(fmt::format("<{}> has no attribute '{}'", name(), attribute), fmt::format("add {}=\"…\"", attribute));
    return found;
}

void Element::expectAttributes(const std::vector<std::string_view>& known) const
{
    for (const auto& attribute : attributes()) {
        if (std::find(known.begin(), known.end(), attribute.name()) != known.end())
            continue;
        const bool prefixed = attribute.name().find(':') != std::string_view::npos;
        attribute.misplaced(fmt::format("<{}> knows no attribute {}", name(), inQuotes(attribute.name())),
                            prefixed ? "remove it: prefixes and references to other files are not allowed"
                                     : suggestion(attribute.name(), known));
    }
}

std::vector<Element> Element::children(const std::vector<std::string_view>& known) const
{
    std::vector<Element> result;
    for (const auto child : m_node.children()) {
        if (child.type() == pugi::node_element) {
            const Element element(*m_document, child);
            if (std::find(known.begin(), known.end(), element.name()) != known.end())
                result.push_back(element);
            else
                element.error(fmt::format("<{}> knows no element {}", name(), inQuotes(element.name())), suggestion(element.name(), known));
        } else if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) {
            const std::string_view source = m_document->m_xml;
            const auto start = source.find_first_not_of(" \t\r\n", static_cast<std::size_t>(child.offset_debug()));
            findings().error(start, fmt::format("text inside <{}>", name()), "texts stand in attributes and in <description>");
        }
    }
    return result;
}

std::string Element::text() const
{
    std::string text;
    for (const auto child : m_node.children()) {
        if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
            text += child.value();
        else
            Element(*m_document, child).error(fmt::format("<{}> holds text only", name()), "remove this element");
    }
    return collapsed(text);
}

std::unique_ptr<const XmlDocument> XmlDocument::read(std::string_view xml, FindingList& findings)
{
    auto map = scanXml(xml, findings);
    if (!map)
        return nullptr;
    std::unique_ptr<XmlDocument> document(new XmlDocument(xml, std::move(*map), findings));
    constexpr unsigned int options = pugi::parse_cdata | pugi::parse_escapes | pugi::parse_wconv_attribute | pugi::parse_eol;
    const auto parsed = document->m_tree.load_buffer(xml.data(), xml.size(), options, pugi::encoding_utf8);
    if (!parsed) {
        findings.error(static_cast<std::size_t>(parsed.offset), std::string("the XML cannot be read: ") + parsed.description());
        return nullptr;
    }
    return document;
}

std::optional<Element> XmlDocument::root(std::string_view name, std::string_view xmlNamespace) const
{
    const auto element = root();
    if (element.name() != name) {
        element.error("the root element is " + inQuotes(element.name()), fmt::format("it must be <{} xmlns=\"{}\">", name, xmlNamespace));
        return std::nullopt;
    }
    const auto declared = element.find("xmlns");
    if (!declared) {
        element.error(fmt::format("<{}> has no namespace", name), fmt::format("add xmlns=\"{}\"", xmlNamespace));
        return std::nullopt;
    }
    if (declared->value() != xmlNamespace) {
        declared->reject(fmt::format("the namespace {} is not known", inQuotes(declared->value())), fmt::format("write {}", xmlNamespace));
        return std::nullopt;
    }
    return element;
}

} // namespace liena
