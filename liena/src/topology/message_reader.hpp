// One <enum> and one <message> of a message set.
#pragma once

#include "liena/message_set.hpp"
#include "topology/field_reader.hpp"
#include "topology/xml_document.hpp"

#include <memory>

namespace liena {

/// Without a name when it has none; errors are reported.
std::shared_ptr<const EnumDefinition> readEnum(const Element& element);

/// As far as it can be read; errors are reported.
MessageDefinition readMessage(const Element& element, const EnumTable& enums);

} // namespace liena
