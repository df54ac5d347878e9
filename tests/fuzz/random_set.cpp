// Attributes by choice, each within what section 4 of the protocol allows.
#include "random_set.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

namespace liena::fuzz {

namespace {

/// The same choices for the same seed, with every compiler and library.
class Chance {
public:
    explicit Chance(std::uint16_t seed) : m_state(seed * 0x9E3779B97F4A7C15U + 0x2545F4914F6CDD1DU) {}

    std::size_t below(std::size_t limit)
    {
        m_state ^= m_state << 13U;
        m_state ^= m_state >> 7U;
        m_state ^= m_state << 17U;
        return (m_state >> 24U) % limit;
    }
    bool flag() { return below(2) == 1; }

private:
    std::uint64_t m_state;
};

constexpr std::array<std::string_view, 11> plainTypes{"bool",   "int8",   "int16",  "int32",   "int64",  "uint8",
                                                      "uint16", "uint32", "uint64", "float32", "float64"};

bool isUnsigned(std::string_view type) { return type.starts_with("uint"); }
bool isReal(std::string_view type) { return type.starts_with("float"); }

/// Bounds that every type can hold, and a default between them.
std::string bounds(Chance& chance, std::string_view type, bool scalar)
{
    const int low = isUnsigned(type) ? static_cast<int>(chance.below(50)) : static_cast<int>(chance.below(100)) - 70;
    const int high = low + static_cast<int>(chance.below(60));
    const std::string_view fraction = isReal(type) && chance.flag() ? ".5" : "";
    std::string text;
    const auto choice = chance.below(16);
    if ((choice & 1U) != 0)
        text += fmt::format(" min=\"{}{}\"", low, low < 0 ? "" : fraction);
    if ((choice & 2U) != 0)
        text += fmt::format(" max=\"{}{}\"", high, high < 0 ? "" : fraction);
    if (scalar && (choice & 4U) != 0)
        text += fmt::format(" default=\"{}{}\"", high, high < 0 ? "" : fraction);
    if (isReal(type) && (choice & 8U) != 0)
        text += " nonfinite=\"true\"";
    return text;
}

std::string field(Chance& chance, std::size_t index)
{
    const auto head = fmt::format("    <field name=\"f{}\" type=", index);
    const auto kind = chance.below(14);
    if (kind == 13)
        return head + fmt::format("\"string\" max-length=\"{}\"/>\n", 1 + chance.below(40));
    if (kind == 12)
        return head + fmt::format("\"bytes\" max-length=\"{}\"/>\n", 1 + chance.below(40));
    const bool isEnum = kind == 11;
    const auto type = isEnum ? std::string_view("Choice") : plainTypes[kind];
    const auto shape = chance.below(3);
    const auto suffix = shape == 0 ? std::string() : shape == 1 ? "[]" : fmt::format("[{}]", 1 + chance.below(5));
    auto text = head + fmt::format("\"{}{}\"", type, suffix);
    if (shape == 1)
        text += fmt::format(" max-count=\"{}\"", 1 + chance.below(6));
    if (!isEnum && type != "bool")
        text += bounds(chance, type, shape != 1);
    return text + "/>\n";
}

std::string message(Chance& chance, std::size_t index)
{
    constexpr std::array<std::string_view, 4> priorities{"safety", "control", "status", "bulk"};
    const bool command = chance.flag();
    const auto priority = priorities[chance.below(priorities.size())];
    auto text = fmt::format("  <message number=\"0x{:04x}\" name=\"M{}\" role=\"{}\" priority=\"{}\"", (command ? 0x0100 : 0x0200) + index,
                            index, command ? "command" : "report", priority);
    if (priority == "control")
        text += " max-age=\"50ms\"";
    text += ">\n";
    const auto count = chance.below(7);
    for (std::size_t i = 0; i < count; ++i)
        text += field(chance, i);
    return text + "  </message>\n";
}

} // namespace

std::string randomSetXml(std::uint16_t seed)
{
    Chance chance(seed);
    constexpr std::array<std::string_view, 4> bases{"uint8", "int8", "uint16", "int64"};
    const auto base = bases[chance.below(bases.size())];
    std::string xml = "<message-set xmlns=\"urn:liena:message-set:1\" name=\"random\" version=\"1\" class=\"hand\" manufacturer=\"1\" "
                      "type=\"2\" device-version=\"3\">\n";
    xml += fmt::format("  <enum name=\"Choice\" base=\"{}\"><value name=\"a\" number=\"{}\"/><value name=\"b\" number=\"100\"/></enum>\n",
                       base, base.front() == 'i' ? -3 : 3);
    const auto count = 1 + chance.below(3);
    for (std::size_t i = 0; i < count; ++i)
        xml += message(chance, i);
    return xml + "</message-set>\n";
}

} // namespace liena::fuzz
