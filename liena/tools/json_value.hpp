// Reads JSON that may be anything: what is missing, or of another kind, reads as nothing.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace liena::tools {

/// A value of a JSON text; it keeps the whole text's values alive.
class JsonValue {
public:
    JsonValue() = default; ///< null

    /// Nothing when it is no JSON.
    static std::optional<JsonValue> parse(std::string_view text);

    /// A field of an object; null when this is none or has no such field.
    JsonValue operator[](std::string_view name) const;

    bool isNull() const;
    std::optional<double> number() const;
    double numberOr(double other) const { return number().value_or(other); }
    bool truth() const;
    std::string text() const; ///< empty when it is no string
    std::vector<JsonValue> items() const;

private:
    explicit JsonValue(std::shared_ptr<const nlohmann::json> value) : m_value(std::move(value)) {}
    JsonValue within(const nlohmann::json& part) const { return JsonValue(std::shared_ptr<const nlohmann::json>(m_value, &part)); }

    std::shared_ptr<const nlohmann::json> m_value;
};

} // namespace liena::tools
