// libxml2 as a second opinion: an independent tree and an independent validator.
#pragma once

#include <libxml/parser.h>
#include <libxml/tree.h>
#include <libxml/xmlschemas.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace liena::test {

struct OracleNode {
    std::string name;
    std::map<std::string, std::string> attributes; ///< without xmlns
    std::vector<OracleNode> children;
};

struct DocumentDeleter {
    void operator()(xmlDoc* document) const { xmlFreeDoc(document); }
};
using DocumentPointer = std::unique_ptr<xmlDoc, DocumentDeleter>;

inline DocumentPointer readDocument(const std::string& xml)
{
    return DocumentPointer(xmlReadMemory(xml.data(), static_cast<int>(xml.size()), "oracle.xml", nullptr,
                                         XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING));
}

inline std::string textOf(const xmlChar* text) { return reinterpret_cast<const char*>(text); }

inline OracleNode treeOf(xmlNode* node)
{
    OracleNode result{textOf(node->name), {}, {}};
    for (auto* attribute = node->properties; attribute; attribute = attribute->next) {
        auto* value = xmlGetNoNsProp(node, attribute->name);
        result.attributes[textOf(attribute->name)] = textOf(value);
        xmlFree(value);
    }
    for (auto* child = node->children; child; child = child->next)
        if (child->type == XML_ELEMENT_NODE)
            result.children.push_back(treeOf(child));
    return result;
}

inline OracleNode treeOf(const std::string& xml)
{
    const auto document = readDocument(xml);
    return document ? treeOf(xmlDocGetRootElement(document.get())) : OracleNode{};
}

/// One schema, read from its file.
class Schema {
public:
    explicit Schema(const std::string& file)
    {
        auto* parser = xmlSchemaNewParserCtxt(file.c_str());
        m_schema = xmlSchemaParse(parser);
        xmlSchemaFreeParserCtxt(parser);
    }
    Schema(const Schema&) = delete;
    Schema& operator=(const Schema&) = delete;
    ~Schema() { xmlSchemaFree(m_schema); }

    bool isUsable() const { return m_schema != nullptr; }

    bool accepts(const std::string& xml) const
    {
        const auto document = readDocument(xml);
        if (!document)
            return false;
        auto* context = xmlSchemaNewValidCtxt(m_schema);
        xmlSchemaSetValidStructuredErrors(
            context, [](void*, xmlErrorPtr) {}, nullptr);
        const bool valid = xmlSchemaValidateDoc(context, document.get()) == 0;
        xmlSchemaFreeValidCtxt(context);
        return valid;
    }

private:
    xmlSchema* m_schema = nullptr;
};

} // namespace liena::test
