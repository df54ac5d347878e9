// Attribute values as typed values: names, integers, durations, choices; what does not fit is reported where it stands.
#pragma once

#include "topology/nearest_name.hpp"
#include "topology/xml_document.hpp"
#include "topology/xml_text.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace liena {

/// `[A-Za-z][A-Za-z0-9_-]{0,63}` (ruling B13).
bool isName(std::string_view text);

/// `-?[0-9]+`, within the type's range; nothing else.
std::optional<std::int64_t> signedFrom(std::string_view text);
std::optional<std::uint64_t> unsignedFrom(std::string_view text);

/// `-?[0-9]+(.[0-9]+)?` with an optional exponent; finite.
std::optional<double> realFrom(std::string_view text);

// An absent attribute gives nothing and no error: what must be there is asked for with Element::require.
std::optional<std::string> nameFrom(const std::optional<Attribute>& attribute);
std::optional<std::int64_t> integerFrom(const std::optional<Attribute>& attribute, std::int64_t lowest, std::int64_t highest);
std::optional<std::uint16_t> messageNumberFrom(const std::optional<Attribute>& attribute);
std::optional<std::chrono::nanoseconds> durationFrom(const std::optional<Attribute>& attribute);
std::string textFrom(const std::optional<Attribute>& attribute);

/// As textFrom, with an error when it is empty.
std::string filledTextFrom(const std::optional<Attribute>& attribute);

template <typename T>
std::optional<T> choiceFrom(const std::optional<Attribute>& attribute, const std::vector<std::pair<std::string_view, T>>& choices)
{
    if (!attribute)
        return std::nullopt;
    std::vector<std::string_view> names;
    for (const auto& [name, value] : choices) {
        if (name == attribute->value())
            return value;
        names.push_back(name);
    }
    attribute->reject(inQuotes(attribute->value()) + " is no " + std::string(attribute->name()), "write " + enumeration(names));
    return std::nullopt;
}

/// What must not occur twice: the first place of each key.
template <typename Key>
class Once {
public:
    /// False, with an error at `attribute` that names `what` and the line of the first, when the key is taken.
    bool take(const Key& key, const Attribute& attribute, const std::string& what)
    {
        const auto [first, isNew] = m_places.try_emplace(key, attribute.valueAt());
        if (!isNew)
            attribute.reject(what + " is used already in line " + std::to_string(attribute.findings().lineOf(first->second)),
                             "give each its own");
        return isNew;
    }

private:
    std::map<Key, std::size_t> m_places;
};

/// The one `<description>` among `children`, or an empty text.
std::string descriptionAmong(const std::vector<Element>& children);

/// An error for every element of this name after the first.
void allowOnce(const std::vector<Element>& children, std::string_view name);

} // namespace liena
