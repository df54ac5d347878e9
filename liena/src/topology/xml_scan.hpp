// The bounded walk over an XML file's bytes that comes before any tree: well-formed, within its limits, and where everything stands.
#pragma once

#include "topology/finding_list.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace liena {

/// Protocol section 4: what a file may have at most.
struct XmlLimits {
    static constexpr std::size_t bytes = 262'144;
    static constexpr std::size_t levels = 8;
    static constexpr std::size_t elements = 20'000;
    static constexpr std::size_t attributes = 16;
};

struct ScannedAttribute {
    std::uint32_t nameAt = 0;
    std::uint32_t valueAt = 0; ///< behind the opening quote
};

struct ScannedElement {
    std::uint32_t nameAt = 0; ///< behind the '<'
    std::uint32_t firstAttribute = 0;
    std::uint32_t attributeCount = 0;
};

/// Places as offsets in bytes, in the order of the file.
struct XmlMap {
    std::vector<ScannedElement> elements;
    std::vector<ScannedAttribute> attributes;

    const ScannedElement* elementAt(std::size_t nameAt) const;
};

/// Nothing when the file is refused; `findings` then says why, with all that could be seen at once.
std::optional<XmlMap> scanXml(std::string_view xml, FindingList& findings);

} // namespace liena
