// Escaping for JSON.
#include "liena/json_line.hpp"

#include "base/characters.hpp"

#include <fmt/format.h>

#include <cmath>

namespace liena {

namespace {

/// One character, or one byte that is none.
std::string escaped(std::string_view sequence, bool valid)
{
    if (!valid)
        return fmt::format("\\\\x{:02x}", static_cast<unsigned char>(sequence.front()));
    if (sequence == "\"" || sequence == "\\")
        return "\\" + std::string(sequence);
    if (!base::isUnsafe(sequence))
        return std::string(sequence);
    char32_t code = static_cast<unsigned char>(sequence.front());
    if (sequence.size() > 1) {
        code &= sequence.size() == 2 ? 0x1FU : 0x0FU; // no character of four bytes is unsafe
        for (const char c : sequence.substr(1))
            code = code << 6U | (static_cast<unsigned char>(c) & 0x3FU);
    }
    return fmt::format("\\u{:04x}", static_cast<unsigned>(code));
}

} // namespace

std::string jsonText(std::string_view text, std::size_t limit)
{
    std::string json = "\"";
    while (!text.empty()) {
        const auto length = base::sequenceLength(text);
        const auto taken = length > 0 ? length : 1;
        const auto piece = escaped(text.substr(0, taken), length > 0);
        if (json.size() - 1 + piece.size() > limit) {
            json += "…";
            break;
        }
        json += piece;
        text.remove_prefix(taken);
    }
    return json + '"';
}

JsonLine& JsonLine::add(std::string_view name, double value)
{
    return put(name, std::isfinite(value) ? fmt::format("{:.3f}", value) : std::string("null"));
}

JsonLine& JsonLine::put(std::string_view name, std::string_view json)
{
    m_fields += fmt::format("{}\"{}\":{}", m_fields.empty() ? "" : ",", name, json);
    return *this;
}

} // namespace liena
