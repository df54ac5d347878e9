// The grammar of ruling B13 for values; numbers are read in full or not at all.
#include "topology/attribute_values.hpp"

#include "topology/ascii.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace liena {

namespace {

template <typename T>
std::optional<T> wholeNumber(std::string_view text, int base = 10)
{
    T value{};
    const auto* end = text.data() + text.size();
    const auto [last, failure] = std::from_chars(text.data(), end, value, base);
    if (text.empty() || failure != std::errc{} || last != end)
        return std::nullopt;
    return value;
}

std::size_t digitsFrom(std::string_view text, std::size_t at)
{
    const auto start = at;
    while (at < text.size() && isDigit(text[at]))
        ++at;
    return at - start;
}

bool looksReal(std::string_view text)
{
    std::size_t at = text.starts_with('-') ? 1 : 0;
    auto digits = digitsFrom(text, at);
    if (digits == 0)
        return false;
    at += digits;
    if (at < text.size() && text[at] == '.') {
        digits = digitsFrom(text, ++at);
        if (digits == 0)
            return false;
        at += digits;
    }
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        ++at;
        if (at < text.size() && (text[at] == '+' || text[at] == '-'))
            ++at;
        digits = digitsFrom(text, at);
        if (digits == 0)
            return false;
        at += digits;
    }
    return at == text.size();
}

} // namespace

bool isName(std::string_view text)
{
    constexpr std::size_t longest = 64;
    return !text.empty() && text.size() <= longest && isLetter(text.front()) &&
           std::all_of(text.begin(), text.end(), [](char c) { return isLetter(c) || isDigit(c) || c == '_' || c == '-'; });
}

std::optional<std::int64_t> signedFrom(std::string_view text) { return wholeNumber<std::int64_t>(text); }
std::optional<std::uint64_t> unsignedFrom(std::string_view text) { return wholeNumber<std::uint64_t>(text); }

std::optional<double> realFrom(std::string_view text)
{
    double value = 0;
    if (!looksReal(text))
        return std::nullopt;
    const auto [last, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc{} || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::optional<std::string> nameFrom(const std::optional<Attribute>& attribute)
{
    if (!attribute)
        return std::nullopt;
    if (!isName(attribute->value())) {
        attribute->reject(inQuotes(attribute->value()) + " is no name",
                          "a name starts with a letter and has at most 64 letters, digits, '_' and '-'");
        return std::nullopt;
    }
    return std::string(attribute->value());
}

std::optional<std::int64_t> integerFrom(const std::optional<Attribute>& attribute, std::int64_t lowest, std::int64_t highest)
{
    if (!attribute)
        return std::nullopt;
    const auto value = signedFrom(attribute->value());
    if (!value || *value < lowest || *value > highest) {
        attribute->reject(fmt::format("{} is no {}", inQuotes(attribute->value()), attribute->name()),
                          fmt::format("write a whole number from {} to {}", lowest, highest));
        return std::nullopt;
    }
    return value;
}

std::optional<std::uint16_t> messageNumberFrom(const std::optional<Attribute>& attribute)
{
    constexpr std::size_t length = 6;
    if (!attribute)
        return std::nullopt;
    const auto text = attribute->value();
    const auto number = text.size() == length && text.starts_with("0x") ? wholeNumber<std::uint16_t>(text.substr(2), 16) : std::nullopt;
    if (!number)
        attribute->reject(inQuotes(text) + " is no message number", "write 0x and four hex digits, as 0x0101");
    return number;
}

std::optional<std::chrono::nanoseconds> durationFrom(const std::optional<Attribute>& attribute)
{
    constexpr std::size_t mostDigits = 9;
    if (!attribute)
        return std::nullopt;
    const auto text = attribute->value();
    const auto digits = digitsFrom(text, 0);
    const auto unit = text.substr(digits);
    const auto count = digits <= mostDigits ? signedFrom(text.substr(0, digits)) : std::nullopt;
    if (count && *count > 0 && text.front() != '0') {
        if (unit == "us")
            return std::chrono::microseconds(*count);
        if (unit == "ms")
            return std::chrono::milliseconds(*count);
        if (unit == "s")
            return std::chrono::seconds(*count);
    }
    attribute->reject(inQuotes(text) + " is no duration", "write a whole number above 0, of at most nine digits, and us, ms or s, as 20ms");
    return std::nullopt;
}

std::string textFrom(const std::optional<Attribute>& attribute) { return attribute ? std::string(attribute->value()) : std::string(); }

std::string filledTextFrom(const std::optional<Attribute>& attribute)
{
    auto text = textFrom(attribute);
    if (attribute && text.empty())
        attribute->reject(fmt::format("'{}' is empty", attribute->name()), "fill it in");
    return text;
}

std::string descriptionAmong(const std::vector<Element>& children)
{
    allowOnce(children, "description");
    std::string text;
    for (const auto& child : children)
        if (child.name() == "description") {
            child.expectAttributes({});
            const auto own = child.text();
            if (text.empty())
                text = own;
        }
    return text;
}

void allowOnce(const std::vector<Element>& children, std::string_view name)
{
    int count = 0;
    for (const auto& child : children)
        if (child.name() == name && ++count > 1)
            child.error(fmt::format("a second <{}>", name), "keep one");
}

} // namespace liena
