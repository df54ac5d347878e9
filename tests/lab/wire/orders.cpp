// The lines by which the runner tells the wire what to do: implementation.
#include "wire/orders.hpp"

#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>

namespace liena::lab {

namespace {

std::optional<double> numberOf(const std::string& text)
{
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    return !text.empty() && *end == '\0' ? std::optional(value) : std::nullopt;
}

/// Milliseconds, with or without `ms` behind them.
std::optional<Nanoseconds> durationOf(std::string text)
{
    if (text.size() > 2 && text.ends_with("ms"))
        text.resize(text.size() - 2);
    const auto value = numberOf(text);
    return value ? std::optional(Nanoseconds(static_cast<std::int64_t>(*value * 1e6))) : std::nullopt;
}

std::optional<std::size_t> portOf(const std::string& text, std::size_t ports)
{
    const auto value = numberOf(text);
    if (!value || *value < 1 || *value > static_cast<double>(ports))
        return std::nullopt;
    return static_cast<std::size_t>(*value) - 1;
}

bool setProtocol(Impairment& impairment, const std::string& value)
{
    const std::map<std::string, Protocol> protocols{{"any", Protocol::Any}, {"tcp", Protocol::Tcp}, {"udp", Protocol::Udp}};
    const auto found = protocols.find(value);
    if (found != protocols.end())
        impairment.only = found->second;
    return found != protocols.end();
}

bool setField(Impairment& impairment, const std::string& name, const std::string& value)
{
    const std::map<std::string, double Impairment::*> numbers{
        {"drop", &Impairment::drop},           {"burst-start", &Impairment::burstStart}, {"burst-end", &Impairment::burstEnd},
        {"duplicate", &Impairment::duplicate}, {"corrupt", &Impairment::corrupt},        {"reorder", &Impairment::reorder}};
    const std::map<std::string, Nanoseconds Impairment::*> durations{{"reorder-by", &Impairment::reorderBy},
                                                                     {"delay", &Impairment::delay},
                                                                     {"jitter", &Impairment::jitter},
                                                                     {"ramp", &Impairment::ramp},
                                                                     {"ramp-end", &Impairment::rampEnd}};
    if (const auto found = numbers.find(name); found != numbers.end()) {
        const auto number = numberOf(value);
        impairment.*found->second = number.value_or(0);
        return number.has_value();
    }
    if (const auto found = durations.find(name); found != durations.end()) {
        const auto duration = durationOf(value);
        impairment.*found->second = duration.value_or(Nanoseconds::zero());
        return duration.has_value();
    }
    if (name == "largest") {
        impairment.largest = static_cast<std::size_t>(numberOf(value).value_or(0));
        return impairment.largest != 0;
    }
    return name == "only" && setProtocol(impairment, value);
}

WireOrder parseLink(std::istringstream& words, std::size_t ports)
{
    std::string pair;
    words >> pair;
    const auto arrow = pair.find('>');
    if (arrow == std::string::npos)
        return BadOrder{"a link is written 1>2"};
    LinkOrder order;
    const auto ends = {std::pair{pair.substr(0, arrow), &order.from}, std::pair{pair.substr(arrow + 1), &order.to}};
    for (const auto& [text, target] : ends) {
        if (text == "*")
            continue;
        const auto port = portOf(text, ports);
        if (!port)
            return BadOrder{"no port " + text};
        target->push_back(*port);
    }
    for (std::string word; words >> word;) {
        const auto equals = word.find('=');
        if (word == "cut")
            order.impairment.cut = true;
        else if (equals == std::string::npos || !setField(order.impairment, word.substr(0, equals), word.substr(equals + 1)))
            return BadOrder{"not understood: " + word};
    }
    return order;
}

WireOrder parsePort(std::istringstream& words, std::size_t ports)
{
    std::string number;
    words >> number;
    const auto port = portOf(number, ports);
    if (!port)
        return BadOrder{"no port " + number};
    PortOrder order;
    order.port = *port;
    for (std::string word; words >> word;) {
        const auto equals = word.find('=');
        const auto value = equals == std::string::npos ? std::nullopt : numberOf(word.substr(equals + 1));
        if (value && word.starts_with("rate="))
            order.rate = static_cast<std::uint64_t>(*value);
        else if (value && word.starts_with("queue="))
            order.queue = static_cast<std::size_t>(*value);
        else
            return BadOrder{"not understood: " + word};
    }
    return order;
}

WireOrder parseCarrier(std::istringstream& words, std::size_t ports)
{
    std::string number, state;
    words >> number >> state;
    const auto port = portOf(number, ports);
    if (!port || (state != "on" && state != "off"))
        return BadOrder{"carrier PORT on|off"};
    return CarrierOrder{*port, state == "on"};
}

} // namespace

WireOrder parseWireOrder(std::string_view line, std::size_t ports)
{
    std::istringstream words{std::string(line)};
    std::string verb;
    words >> verb;
    if (verb == "link")
        return parseLink(words, ports);
    if (verb == "port")
        return parsePort(words, ports);
    if (verb == "carrier")
        return parseCarrier(words, ports);
    if (verb == "counts")
        return CountsOrder{};
    if (verb == "late")
        return LateOrder{};
    return BadOrder{"unknown order '" + verb + "'"};
}

} // namespace liena::lab
