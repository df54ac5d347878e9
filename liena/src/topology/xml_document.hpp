// A scanned XML file as a tree whose elements and attributes know their places; only this room includes it.
#pragma once

#include "topology/finding_list.hpp"
#include "topology/xml_scan.hpp"

#include <pugixml.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace liena {

class XmlDocument;

/// Valid while its document lives.
class Attribute {
public:
    Attribute(const XmlDocument& document, pugi::xml_attribute attribute, ScannedAttribute place)
        : m_document(&document), m_attribute(attribute), m_place(place)
    {}

    std::string_view name() const { return m_attribute.name(); }
    std::string_view value() const { return m_attribute.value(); }
    std::size_t nameAt() const { return m_place.nameAt; }
    std::size_t valueAt() const { return m_place.valueAt; }
    FindingList& findings() const;

    /// An error at the value.
    void reject(std::string text, std::string remedy = {}) const;

    /// An error at the name: the attribute should not be here.
    void misplaced(std::string text, std::string remedy = {}) const;

private:
    const XmlDocument* m_document;
    pugi::xml_attribute m_attribute;
    ScannedAttribute m_place;
};

/// Valid while its document lives.
class Element {
public:
    Element(const XmlDocument& document, pugi::xml_node node);

    std::string_view name() const { return m_node.name(); }

    /// Offset of its '<'.
    std::size_t at() const;

    std::optional<Attribute> find(std::string_view attribute) const;

    /// As find, with an error when it is missing.
    std::optional<Attribute> require(std::string_view attribute) const;

    /// An error for each attribute that is not known here.
    void expectAttributes(const std::vector<std::string_view>& known) const;

    /// The elements inside, in order; an error for each that is not known here, and for text.
    std::vector<Element> children(const std::vector<std::string_view>& known) const;

    /// The text of an element that holds nothing else, as one paragraph.
    std::string text() const;

    void error(std::string text, std::string remedy = {}) const;
    void warning(std::string text, std::string remedy = {}) const;
    FindingList& findings() const;

private:
    std::vector<Attribute> attributes() const;

    const XmlDocument* m_document;
    pugi::xml_node m_node;
    const ScannedElement* m_place;
};

class XmlDocument {
public:
    /// Nothing when the file is not well-formed or not within its limits; `findings` then says why. `findings` must outlive the document.
    static std::unique_ptr<const XmlDocument> read(std::string_view xml, FindingList& findings);

    XmlDocument(const XmlDocument&) = delete;
    XmlDocument& operator=(const XmlDocument&) = delete;

    Element root() const { return {*this, m_tree.document_element()}; }

    /// The root if it has this name and this default namespace, else nothing and an error.
    std::optional<Element> root(std::string_view name, std::string_view xmlNamespace) const;

private:
    friend class Element;
    friend class Attribute;
    XmlDocument(std::string_view xml, XmlMap map, FindingList& findings) : m_xml(xml), m_map(std::move(map)), m_findings(findings) {}

    std::string m_xml;
    XmlMap m_map;
    pugi::xml_document m_tree;
    FindingList& m_findings;
};

} // namespace liena
