// Asking a value for what it may not be.
#include "json_value.hpp"

#include <nlohmann/json.hpp>

namespace liena::tools {

std::optional<JsonValue> JsonValue::parse(std::string_view text)
{
    auto parsed = nlohmann::json::parse(text, nullptr, false);
    if (parsed.is_discarded())
        return std::nullopt;
    return JsonValue(std::make_shared<const nlohmann::json>(std::move(parsed)));
}

JsonValue JsonValue::operator[](std::string_view name) const
{
    if (m_value == nullptr || !m_value->is_object())
        return {};
    const auto field = m_value->find(std::string(name));
    return field != m_value->end() ? within(*field) : JsonValue();
}

bool JsonValue::isNull() const { return m_value == nullptr || m_value->is_null(); }

std::optional<double> JsonValue::number() const
{
    return m_value != nullptr && m_value->is_number() ? std::optional(m_value->get<double>()) : std::nullopt;
}

bool JsonValue::truth() const { return m_value != nullptr && m_value->is_boolean() && m_value->get<bool>(); }

std::string JsonValue::text() const { return m_value != nullptr && m_value->is_string() ? m_value->get<std::string>() : std::string(); }

std::vector<JsonValue> JsonValue::items() const
{
    std::vector<JsonValue> items;
    if (m_value != nullptr && m_value->is_array())
        for (const auto& item : *m_value)
            items.push_back(within(item));
    return items;
}

} // namespace liena::tools
