// One JSON object on one line, written field by field.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace liena {

/// A JSON string with its quotes. Control characters, line separators and marks that reorder text are escaped, and so is what is no UTF-8:
/// whatever the text holds, it can neither end the string nor the line. Cut to `limit` bytes of its escaped form.
std::string jsonText(std::string_view text, std::size_t limit = 4096);

/// `JsonLine().add("event", "opened").add("count", 3).text()` is `{"event":"opened","count":3}`. Names are ours: they are not escaped.
class JsonLine {
public:
    JsonLine& add(std::string_view name, std::string_view value, std::size_t limit = 4096) { return put(name, jsonText(value, limit)); }
    JsonLine& add(std::string_view name, const char* value) { return add(name, std::string_view(value)); }
    JsonLine& add(std::string_view name, const std::string& value) { return add(name, std::string_view(value)); }
    JsonLine& add(std::string_view name, bool value) { return put(name, value ? "true" : "false"); }
    template <std::integral T>
    requires(!std::same_as<T, bool>) JsonLine& add(std::string_view name, T value) { return put(name, std::to_string(value)); }

    /// At most three decimals; null for what is no number.
    JsonLine& add(std::string_view name, double value);

    /// `json` is JSON already.
    JsonLine& put(std::string_view name, std::string_view json);

    std::string text() const { return "{" + m_fields + "}"; }

private:
    std::string m_fields;
};

} // namespace liena
