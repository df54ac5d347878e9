// Laying a status out.
#include "monitor_page.hpp"

#include <liena/log.hpp>

#include <fmt/format.h>

namespace liena::tools {

namespace {

std::string milliseconds(const JsonValue& value) { return value.number() ? fmt::format("{:.1f} ms", *value.number()) : std::string("-"); }

std::string latencyOf(const JsonValue& link)
{
    const auto latency = link["latency_ms"].number();
    if (!latency)
        return "-";
    const auto uncertainty = link["latency_uncertainty_ms"].number();
    return uncertainty ? fmt::format("{:.1f} ± {:.1f} ms", *latency, *uncertainty) : fmt::format("{:.1f} ms", *latency);
}

std::string bytesPerSecond(double bytes)
{
    return bytes >= 1e6 ? fmt::format("{:.1f} MB/s", bytes / 1e6) : fmt::format("{:.1f} kB/s", bytes / 1e3);
}

std::string rateOf(const JsonValue& link, const char* messages, const char* bytes)
{
    const auto rates = link["rates"];
    if (rates.isNull())
        return "-";
    return fmt::format("{:.0f}/s {}", rates[messages].numberOr(0), bytesPerSecond(rates[bytes].numberOr(0)));
}

/// A column is counted in characters: `±` is one.
std::string padded(const std::string& text, std::size_t columns)
{
    std::size_t characters = 0;
    for (const char c : text)
        characters += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
    return text + std::string(characters < columns ? columns - characters : 1, ' ');
}

std::string row(const std::vector<std::string>& cells)
{
    constexpr std::size_t widths[] = {14, 13, 18, 11, 10, 22, 22, 7};
    std::string line = "  ";
    for (std::size_t i = 0; i < cells.size(); ++i)
        line += i < std::size(widths) ? padded(cells[i], widths[i]) : cells[i];
    while (line.ends_with(' '))
        line.pop_back();
    return line + '\n';
}

/// Empty where it is not known; what was seen long ago need not be so any more.
std::string pathRateOf(const JsonValue& link)
{
    constexpr double longAgo = 60;
    const auto rate = link["bulk_rate"].number();
    if (!rate)
        return {};
    const auto age = link["bulk_rate_age_s"].numberOr(0);
    if (age <= longAgo)
        return fmt::format("the path carries {}, ", bytesPerSecond(*rate));
    return fmt::format("the path carried {} {:.0f} min ago, ", bytesPerSecond(*rate), age / 60);
}

/// Empty while there is no lane for it and nothing is known of the path.
std::string bulkLine(const JsonValue& link)
{
    const auto out = link["bulk_lanes"].numberOr(0);
    const auto in = link["bulk_lanes_in"].numberOr(0);
    if (out + in == 0 && link["bulk_rate"].isNull())
        return {};
    return fmt::format(
        "    bulk: {:.0f} lanes out, {:.0f} in, {:.0f} worker threads, {}{:.1f} MB wait, {:.0f} messages gave way to newer ones\n", out, in,
        link["bulk_workers"].numberOr(0), pathRateOf(link), link["bulk_queued_bytes"].numberOr(0) / 1e6, link["superseded"].numberOr(0));
}

std::string linkLines(const JsonValue& link)
{
    const auto missed = link["heartbeats_missed"].numberOr(0);
    auto text = row({printable(link["peer"].text()), link["state"].text(), latencyOf(link), milliseconds(link["round_trip_ms"]),
                     fmt::format("{:.0f}", missed), rateOf(link, "messages_in", "bytes_in"), rateOf(link, "messages_out", "bytes_out"),
                     fmt::format("{:.0f}", link["queued"].numberOr(0)), link["datagrams"].truth() ? "yes" : "no"});
    text += bulkLine(link);
    if (const auto interruptions = link["interruptions"].numberOr(0); interruptions > 0)
        text += fmt::format("    interruptions since the start: {:.0f}\n", interruptions);
    for (const auto& drop : link["drops"].items())
        text += fmt::format("    dropped {:.0f}{}{}: {}\n", drop["count"].numberOr(0), drop["message"].text().empty() ? "" : " ",
                            printable(drop["message"].text()), printable(drop["cause"].text(), 128));
    return text;
}

std::string incidentLine(const JsonValue& incident)
{
    std::string holds;
    for (const auto& hold : incident["holds"].items())
        holds += fmt::format("{}{} {}", holds.empty() ? "" : ", ", printable(hold["device"].text()),
                             hold["holding"].truth() ? "holds" : "DOES NOT HOLD");
    return fmt::format("  INCIDENT {} - {}: {}, since {}; {}\n", printable(incident["a"].text()), printable(incident["b"].text()),
                       printable(incident["cause"].text()), printable(incident["since"].text()),
                       holds.empty() ? std::string("nobody has confirmed that it holds") : holds);
}

std::string auditLine(const JsonValue& audit)
{
    if (audit.isNull())
        return "  no audit file\n";
    if (audit["lost"].truth())
        return fmt::format("  NO AUDIT FILE IS WRITTEN, no new session opens: {}\n", printable(audit["detail"].text(), 512));
    return fmt::format("  audit {}: {:.0f} entries, head {}\n", printable(audit["file"].text(), 256), audit["entries"].numberOr(0),
                       printable(audit["head"].text()));
}

std::string nameOf(const JsonValue& status, const std::string& id)
{
    const auto name = printable(status["device"].text());
    return name.empty() ? printable(id) : fmt::format("{} ({})", name, printable(id));
}

} // namespace

std::string monitorPage(const JsonValue& status)
{
    auto page =
        fmt::format("{} ({})  {}  process {:.0f}, running {:.0f} s  {}{}\n", printable(status["device"].text()),
                    printable(status["id"].text()), printable(status["software"].text()), status["pid"].numberOr(0),
                    status["uptime_s"].numberOr(0), printable(status["time"].text()), status["stands_by"].truth() ? "  STANDS BY" : "");
    page += row({"LINK", "STATE", "LATENCY", "ROUND TRIP", "MISSED", "IN", "OUT", "QUEUE", "UDP"});
    for (const auto& link : status["links"].items())
        page += linkLines(link);
    for (const auto& incident : status["incidents"].items())
        page += incidentLine(incident);
    return page + auditLine(status["audit"]);
}

std::string silentPage(const JsonValue& status, const std::string& id, std::chrono::seconds silence)
{
    return fmt::format("{}  SAYS NOTHING for {} s: its program is stopped or hangs, and its links are not known\n", nameOf(status, id),
                       silence.count());
}

std::string gonePage(const JsonValue& status, const std::string& id)
{
    return fmt::format("{}  HAS GONE: its program has ended, or lets nobody else watch; it is watched again when it is back\n",
                       nameOf(status, id));
}

} // namespace liena::tools
