// A <message-set> as a MessageSet.
#pragma once

#include "liena/message_set.hpp"
#include "topology/attribute_values.hpp"
#include "topology/field_reader.hpp"
#include "topology/xml_document.hpp"

#include <memory>
#include <string>
#include <vector>

namespace liena {

inline constexpr std::string_view messageSetElement = "message-set";
inline constexpr std::string_view messageSetNamespace = "urn:liena:message-set:1";

class MessageSetReader {
public:
    /// `document` of the bytes `xml`. Null when there was an error; the document's findings then say which.
    static std::shared_ptr<const MessageSet> read(const XmlDocument& document, std::string_view xml);

private:
    explicit MessageSetReader(const Element& root) : m_root(root), m_set(new MessageSet) {}

    void readRoot();
    void readEnums();
    void readMessages();

    Element m_root;
    std::vector<Element> m_children;
    EnumTable m_enums;
    std::shared_ptr<MessageSet> m_set;
};

} // namespace liena
