// UTF-8 decoding, the Char production of XML 1.0, and harmless quoting.
#include "topology/xml_text.hpp"

namespace liena {

namespace {

struct Lead {
    std::size_t length;
    char32_t bits;
    char32_t lowest;
};

Lead leadOf(unsigned char byte)
{
    if (byte < 0x80)
        return {1, byte, 0};
    if (byte >= 0xC2 && byte <= 0xDF)
        return {2, byte & 0x1FU, 0x80};
    if (byte >= 0xE0 && byte <= 0xEF)
        return {3, byte & 0x0FU, 0x800};
    if (byte >= 0xF0 && byte <= 0xF4)
        return {4, byte & 0x07U, 0x10000};
    return {0, 0, 0};
}

bool couldForgeLine(char32_t character)
{
    return character < 0x20 || (character >= 0x7F && character <= 0x9F) || (character >= 0x200B && character <= 0x200F) ||
           (character >= 0x2028 && character <= 0x202E) || (character >= 0x2060 && character <= 0x2069) || character == 0xFEFF;
}

} // namespace

char32_t decodeUtf8(std::string_view text, std::size_t& at)
{
    const auto start = at++;
    const auto [length, bits, lowest] = leadOf(static_cast<unsigned char>(text[start]));
    if (length == 0 || text.size() - start < length)
        return invalidCodePoint;
    char32_t character = bits;
    for (std::size_t i = 1; i < length; ++i) {
        const auto byte = static_cast<unsigned char>(text[start + i]);
        if ((byte & 0xC0U) != 0x80U)
            return invalidCodePoint;
        character = character << 6U | (byte & 0x3FU);
    }
    if (character < lowest || character > 0x10FFFF || (character >= 0xD800 && character <= 0xDFFF))
        return invalidCodePoint;
    at = start + length;
    return character;
}

bool isXmlCharacter(char32_t character)
{
    if (character < 0x20)
        return character == '\t' || character == '\n' || character == '\r';
    return character <= 0x10FFFF && !(character >= 0xD800 && character <= 0xDFFF) && character != 0xFFFE && character != 0xFFFF;
}

bool isXmlSpace(char character) { return character == ' ' || character == '\t' || character == '\n' || character == '\r'; }

std::size_t findInvalidCharacter(std::string_view text)
{
    for (std::size_t at = 0; at < text.size();) {
        const auto start = at;
        if (!isXmlCharacter(decodeUtf8(text, at)))
            return start;
    }
    return std::string_view::npos;
}

std::string inQuotes(std::string_view text)
{
    constexpr std::size_t longest = 64;
    std::string result = "'";
    std::size_t at = 0;
    while (at < text.size()) {
        const auto start = at;
        const auto character = decodeUtf8(text, at);
        if (at > longest)
            return result + "…'";
        if (character == invalidCodePoint || couldForgeLine(character))
            result += '?';
        else
            result += text.substr(start, at - start);
    }
    return result + "'";
}

std::string collapsed(std::string_view text)
{
    std::string result;
    bool pending = false;
    for (const char character : text) {
        if (isXmlSpace(character)) {
            pending = !result.empty();
            continue;
        }
        if (pending)
            result += ' ';
        pending = false;
        result += character;
    }
    return result;
}

} // namespace liena
