// Reads the JSON lines that devices write: small, bounded, strict.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace liena::tools {

class JsonValue {
public:
    using Array = std::vector<JsonValue>;
    using Object = std::map<std::string, JsonValue, std::less<>>;

    /// A whole text of at most 1 MiB and 16 levels; nothing when it is no JSON.
    static std::optional<JsonValue> parse(std::string_view text);

    /// A field of an object; null when this is none or has no such field.
    const JsonValue& operator[](std::string_view name) const;

    bool isNull() const { return std::holds_alternative<std::monostate>(m_value); }
    std::optional<double> number() const;
    double numberOr(double other) const { return number().value_or(other); }
    bool truth() const;
    std::string text() const; ///< empty when it is no string
    const Array& items() const;

private:
    friend class JsonParser;
    std::variant<std::monostate, bool, double, std::string, Array, Object> m_value;
};

} // namespace liena::tools
