// One <field> of a message definition.
#pragma once

#include "liena/message_set.hpp"
#include "topology/xml_document.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace liena {

/// The enumerations of the set by name; null for one that is declared but could not be read.
using EnumTable = std::map<std::string, std::shared_ptr<const EnumDefinition>, std::less<>>;

/// Nothing when the name or the type cannot be read; other errors are reported and leave that part out.
std::optional<FieldDefinition> readField(const Element& element, const EnumTable& enums);

} // namespace liena
