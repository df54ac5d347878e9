// Writing and taking apart the lines of the chain.
#include "audit/audit_chain.hpp"

#include "liena/json_line.hpp"
#include "liena/log.hpp"

#include <fmt/format.h>

#include <charconv>

namespace liena::audit {

namespace {

constexpr std::size_t longestName = 64;
constexpr std::size_t longestText = 512;
constexpr std::string_view hashMark = ",\"hash\":\"";
constexpr std::size_t hashDigits = 64;

void addName(JsonLine& json, std::string_view name, const std::string& value)
{
    if (!value.empty())
        json.add(name, std::string_view(value), longestName);
}

/// The text between `before` and the next quote. Values of ours have no escapes where this is asked.
std::string_view valueOf(std::string_view body, std::string_view before)
{
    const auto at = body.find(before);
    if (at == std::string_view::npos)
        return {};
    const auto rest = body.substr(at + before.size());
    return rest.substr(0, rest.find('"'));
}

std::optional<std::uint64_t> numberIn(std::string_view text)
{
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end != text.data() ? std::optional(number) : std::nullopt;
}

} // namespace

std::string AuditChain::line(const Entry& entry, std::string_view device) const
{
    // The fixed fields come first: what a peer may have written stands behind them and cannot pass for them.
    JsonLine json;
    json.add("n", m_entries + 1).add("time", timeText(entry.when)).add("event", std::string_view(entry.event), longestName);
    if (!entry.damaged.empty())
        json.add("damaged", entry.damaged).add("bytes", entry.bytes);
    json.add("device", device, longestName);
    addName(json, "peer", entry.peer);
    addName(json, "who", entry.who);
    if (entry.incident != 0)
        json.add("incident", fmt::format("{:016x}", entry.incident));
    if (entry.byApplication)
        json.add("by", "application");
    if (!entry.text.empty())
        json.add("text", std::string_view(entry.text), longestText);
    auto body = json.text();
    body.pop_back();
    return fmt::format("{}{}{}\"}}", body, hashMark, hashOf(m_head, body).toHex());
}

void AuditChain::accept(std::string_view line)
{
    ++m_entries;
    m_head = parseLine(line)->hash;
}

Sha256 AuditChain::hashOf(const Sha256& previous, std::string_view body) { return Sha256::of(previous.toHex() + std::string(body)); }

std::optional<ParsedLine> parseLine(std::string_view line)
{
    constexpr std::string_view beginning = "{\"n\":";
    constexpr auto tail = hashMark.size() + hashDigits + 2; // and `"}`
    if (line.size() > longestLine || line.size() < beginning.size() + tail || !line.starts_with(beginning) || !line.ends_with("\"}"))
        return std::nullopt;
    ParsedLine parsed;
    parsed.body = line.substr(0, line.size() - tail);
    const auto rest = line.substr(parsed.body.size());
    const auto hash = Sha256::fromHex(rest.substr(hashMark.size(), hashDigits));
    const auto number = numberIn(line.substr(beginning.size()));
    if (!rest.starts_with(hashMark) || !hash || !number)
        return std::nullopt;
    parsed.number = *number;
    parsed.hash = *hash;
    const auto fixed = parsed.body.substr(0, parsed.body.find("\"device\":"));
    parsed.event = valueOf(fixed, "\"event\":\"");
    parsed.damaged = valueOf(fixed, "\"damaged\":\"");
    if (const auto at = fixed.find("\"bytes\":"); at != std::string_view::npos)
        parsed.bytes = numberIn(fixed.substr(at + 8)).value_or(0);
    return parsed;
}

} // namespace liena::audit
