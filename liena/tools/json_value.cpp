// The parser.
#include "json_value.hpp"

#include <charconv>
#include <cstdint>

namespace liena::tools {

namespace {

constexpr std::size_t longestText = 1024UL * 1024UL;
constexpr int mostLevels = 16;

void appendUtf8(std::string& text, std::uint32_t code)
{
    const auto byte = [&](std::uint32_t value) { text += static_cast<char>(value); };
    if (code < 0x80)
        return byte(code);
    if (code < 0x800)
        return byte(0xC0U | code >> 6U), byte(0x80U | (code & 0x3FU));
    byte(0xE0U | code >> 12U), byte(0x80U | (code >> 6U & 0x3FU)), byte(0x80U | (code & 0x3FU));
}

} // namespace

class JsonParser {
public:
    explicit JsonParser(std::string_view text) : m_rest(text) {}

    std::optional<JsonValue> whole()
    {
        JsonValue value;
        if (!read(value, 0))
            return std::nullopt;
        skipBlanks();
        return m_rest.empty() ? std::optional(std::move(value)) : std::nullopt;
    }

private:
    void skipBlanks()
    {
        while (!m_rest.empty() && (m_rest.front() == ' ' || m_rest.front() == '\t' || m_rest.front() == '\n' || m_rest.front() == '\r'))
            m_rest.remove_prefix(1);
    }

    bool take(std::string_view token)
    {
        if (!m_rest.starts_with(token))
            return false;
        m_rest.remove_prefix(token.size());
        return true;
    }

    bool read(JsonValue& value, int level)
    {
        skipBlanks();
        if (level > mostLevels || m_rest.empty())
            return false;
        switch (m_rest.front()) {
        case '{':
            return readObject(value, level);
        case '[':
            return readArray(value, level);
        case '"':
            return readString(value.m_value.emplace<std::string>());
        case 't':
            value.m_value = true;
            return take("true");
        case 'f':
            value.m_value = false;
            return take("false");
        case 'n':
            return take("null");
        default:
            return readNumber(value);
        }
    }

    bool readObject(JsonValue& value, int level)
    {
        auto& object = value.m_value.emplace<JsonValue::Object>();
        take("{");
        skipBlanks();
        if (take("}"))
            return true;
        do {
            std::string name;
            skipBlanks();
            if (!readString(name))
                return false;
            skipBlanks();
            if (!take(":") || !read(object[name], level + 1))
                return false;
            skipBlanks();
        } while (take(","));
        return take("}");
    }

    bool readArray(JsonValue& value, int level)
    {
        auto& array = value.m_value.emplace<JsonValue::Array>();
        take("[");
        skipBlanks();
        if (take("]"))
            return true;
        do {
            if (!read(array.emplace_back(), level + 1))
                return false;
            skipBlanks();
        } while (take(","));
        return take("]");
    }

    bool readNumber(JsonValue& value)
    {
        double number = 0;
        const auto [end, error] = std::from_chars(m_rest.data(), m_rest.data() + m_rest.size(), number);
        if (error != std::errc() || end == m_rest.data())
            return false;
        m_rest.remove_prefix(static_cast<std::size_t>(end - m_rest.data()));
        value.m_value = number;
        return true;
    }

    bool readString(std::string& text)
    {
        if (!take("\""))
            return false;
        while (!m_rest.empty() && m_rest.front() != '"') {
            const char c = m_rest.front();
            m_rest.remove_prefix(1);
            if (static_cast<unsigned char>(c) < 0x20)
                return false;
            if (c != '\\')
                text += c;
            else if (!readEscape(text))
                return false;
        }
        return take("\"");
    }

    bool readEscape(std::string& text)
    {
        constexpr std::string_view marks = "\"\\/bfnrt";
        constexpr std::string_view meanings = "\"\\/\b\f\n\r\t";
        if (m_rest.empty())
            return false;
        const char mark = m_rest.front();
        m_rest.remove_prefix(1);
        if (const auto at = marks.find(mark); at != std::string_view::npos) {
            text += meanings[at];
            return true;
        }
        std::uint32_t code = 0;
        const auto digits = m_rest.substr(0, 4);
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
        if (mark != 'u' || digits.size() != 4 || error != std::errc() || end != digits.data() + 4)
            return false;
        m_rest.remove_prefix(4);
        appendUtf8(text, code);
        return true;
    }

    std::string_view m_rest;
};

std::optional<JsonValue> JsonValue::parse(std::string_view text)
{
    return text.size() <= longestText ? JsonParser(text).whole() : std::nullopt;
}

const JsonValue& JsonValue::operator[](std::string_view name) const
{
    static const JsonValue null;
    const auto* object = std::get_if<Object>(&m_value);
    const auto found = object != nullptr ? object->find(name) : Object::const_iterator();
    return object != nullptr && found != object->end() ? found->second : null;
}

std::optional<double> JsonValue::number() const
{
    const auto* number = std::get_if<double>(&m_value);
    return number != nullptr ? std::optional(*number) : std::nullopt;
}

bool JsonValue::truth() const
{
    const auto* truth = std::get_if<bool>(&m_value);
    return truth != nullptr && *truth;
}

std::string JsonValue::text() const
{
    const auto* text = std::get_if<std::string>(&m_value);
    return text != nullptr ? *text : std::string();
}

const JsonValue::Array& JsonValue::items() const
{
    static const Array none;
    const auto* array = std::get_if<Array>(&m_value);
    return array != nullptr ? *array : none;
}

} // namespace liena::tools
