// Tables of figures, and the same as JSON.
#include "bench_report.hpp"

#include "json_value.hpp"

#include <liena/json_line.hpp>
#include <liena/log.hpp>

#include <fmt/format.h>

#include <cmath>

namespace liena::tools {

namespace {

std::string latency(std::uint64_t ns)
{
    const auto us = static_cast<double>(ns) / 1e3;
    return us < 1000      ? fmt::format("{:.0f} µs", us)
           : us < 100'000 ? fmt::format("{:.2f} ms", us / 1e3)
                          : fmt::format("{:.0f} ms", us / 1e3);
}

/// A column is counted in characters: `µ` is one.
std::string right(const std::string& text, std::size_t width)
{
    std::size_t characters = 0;
    for (const char c : text)
        characters += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
    return std::string(characters < width ? width - characters : 1, ' ') + text;
}

std::string latencyRow(std::string_view name, const ProbeFigures& figures)
{
    if (figures.echoed == 0)
        return figures.sent + figures.withheld == 0 ? std::string() : fmt::format("  {:<26}no echo came back\n", name);
    const auto& all = figures.roundTrip;
    auto line = fmt::format("  {:<26}", name);
    for (const double fraction : {0.5, 0.9, 0.99, 0.999, 0.9999})
        line += right(all.tells(fraction) ? latency(all.quantile(fraction)) : "-", 9);
    return line + right(latency(all.max()), 9) + right(std::to_string(figures.echoed), 9) + "\n";
}

std::string verdictLine(const JudgedFigure& judged)
{
    const auto& kind = kindOf(judged.figure);
    const auto limit = judged.limits && judged.verdict == Verdict::NoGo ? std::optional(judged.limits->caution)
                       : judged.limits                                  ? std::optional(judged.limits->go)
                                                                        : std::nullopt;
    const auto value = judged.value ? fmt::format("{} {}", numberText(*judged.value, limit), kind.unit) : std::string("-");
    const auto limits = judged.limits ? fmt::format("{} {:g} / {:g} {}", kind.leastWanted ? "from" : "up to", judged.limits->go,
                                                    judged.limits->caution, kind.unit)
                                      : std::string("no limit");
    auto line = fmt::format("  {:<9}{:<45}{:>12}   {}\n", judged.limits ? wordOf(judged.verdict) : "-", kind.words, value, limits);
    if (!judged.reason.empty())
        line += fmt::format("           -> {}\n", judged.reason);
    return line;
}

struct MostCommands {
    double perSecond = 0;
    std::uint32_t atOnce = 0; ///< under way
    bool byWindow = false;    ///< with more under way more would have come back
};

/// All that may be were under way, and yet a round trip took little longer than on the idle line: it is long and not full.
bool isHeldByWindow(const ProbeFigures& most, double perSecond, const Measurement& measurement)
{
    constexpr double nearlyAll = 0.8; // at its begin and end a phase has fewer
    constexpr double muchLonger = 2;
    const auto* idle = phaseOf(measurement, phases::paced);
    if (idle == nullptr || idle->prompt.echoed == 0)
        return false;
    const auto median = static_cast<double>(most.roundTrip.quantile(0.5));
    return perSecond * median / 1e9 >= nearlyAll * most.asked.atOnce &&
           median < muchLonger * static_cast<double>(idle->prompt.roundTrip.quantile(0.5));
}

std::optional<MostCommands> mostCommands(const Measurement& measurement)
{
    const auto* phase = phaseOf(measurement, phases::messages);
    if (phase == nullptr || phase->prompt.limited || phase->prompt.spent.count() <= 0)
        return std::nullopt; // the budget's rate is none of the line
    const auto& most = phase->prompt;
    const double perSecond = static_cast<double>(most.echoed) / std::chrono::duration<double>(most.spent).count();
    return MostCommands{perSecond, most.asked.atOnce, isHeldByWindow(most, perSecond, measurement)};
}

std::string throughputJson(const Measurement& measurement)
{
    std::string why;
    const auto images = valueOf(Figure::ImageRate, measurement, why);
    JsonLine json;
    const auto commands = mostCommands(measurement);
    json.add("commands_per_second", commands ? commands->perSecond : std::nan(""));
    json.add("commands_limited_by_window", commands && commands->byWindow);
    return json.add("images_mb_per_second", images.value_or(std::nan(""))).text();
}

std::string throughputLines(const Measurement& measurement)
{
    std::string text;
    if (const auto most = mostCommands(measurement))
        text += fmt::format("  {:<26}{:.0f} a second, there and back{}\n", most->byWindow ? "commands, at least" : "commands at most",
                            most->perSecond, most->byWindow ? fmt::format("; limited by {} under way", most->atOnce) : std::string());
    std::string why;
    if (const auto rate = valueOf(Figure::ImageRate, measurement, why))
        text += fmt::format("  {:<26}{:.1f} MB/s\n", "images at most", *rate);
    if (const auto* phase = phaseOf(measurement, phases::besideImages); phase != nullptr && phase->images.asked.isUsed())
        text += fmt::format("  {:<26}{} of {} that were due, {:.2g} MB each\n", "images beside commands", phase->images.echoed,
                            phase->images.sent + phase->images.withheld, phase->images.asked.bytes / 1e6);
    if (const auto* phase = phaseOf(measurement, phases::paced); phase != nullptr && phase->packets.sent > 0)
        text += fmt::format("  {:<26}{} sent, {} heard there, {} echoes heard here\n", "packets by UDP", phase->packets.sent,
                            phase->packets.heard, phase->packets.echoed);
    return text;
}

std::string limitsLine(const Measurement& measurement)
{
    const auto& limits = measurement.limits;
    if (limits.probesPerSecond == 0 && limits.bulkBytesPerSecond == 0)
        return {};
    const auto probes =
        limits.probesPerSecond > 0 ? fmt::format("{} probes a second", limits.probesPerSecond) : std::string("probes without limit");
    const auto bulk = limits.bulkBytesPerSecond > 0
                          ? fmt::format("{:.1f} MB/s of images", static_cast<double>(limits.bulkBytesPerSecond) / 1e6)
                          : std::string("images without limit");
    return fmt::format("  budget: {}, {}{}\n", probes, bulk,
                       measurement.inUse ? "; a device is in use, so nothing beyond it was sent" : "");
}

} // namespace

std::string benchText(const BenchSubject& subject, const LineProfile& profile, const LineVerdict& verdict, const Measurement& measurement)
{
    auto text = fmt::format("{}: the line from {} to {} ({}), for: {}\n\n", wordOf(verdict.verdict), subject.from, subject.to, subject.way,
                            profile.title.empty() ? profile.name : profile.title);
    for (const auto& judged : verdict.figures)
        text += verdictLine(judged);
    text += fmt::format("\n  {:<26}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n", "ROUND TRIPS", "50 %", "90 %", "99 %", "99.9 %", "99.99 %",
                        "most", "echoes");
    for (const auto& [phase, words] : {std::pair(phases::paced, "commands, paced"), std::pair(phases::backToBack, "commands, back to back"),
                                       std::pair(phases::besideImages, "commands beside images")})
        if (const auto* found = phaseOf(measurement, phase))
            text += latencyRow(words, found->prompt);
    if (const auto* found = phaseOf(measurement, phases::paced))
        text += latencyRow("packets by UDP, paced", found->packets);
    if (const auto* found = phaseOf(measurement, phases::besideImages))
        text += latencyRow("packets beside images", found->packets) + latencyRow("images, until heard", found->images);
    return text + "\n  CARRIED\n" + throughputLines(measurement) + limitsLine(measurement);
}

std::string benchJson(const BenchSubject& subject, const LineProfile& profile, const LineVerdict& verdict, const Measurement& measurement)
{
    std::string figures;
    for (const auto& judged : verdict.figures) {
        const auto& kind = kindOf(judged.figure);
        JsonLine json;
        json.add("figure", kind.name).add("unit", kind.unit);
        json.add("value", judged.value.value_or(std::nan("")));
        json.add("go", judged.limits ? judged.limits->go : std::nan(""));
        json.add("caution", judged.limits ? judged.limits->caution : std::nan(""));
        json.put("verdict", judged.limits ? jsonText(wordOf(judged.verdict)) : "null").add("reason", judged.reason);
        figures += (figures.empty() ? "" : ",") + json.text();
    }
    JsonLine json;
    json.add("verdict", wordOf(verdict.verdict)).add("topology", subject.topology).add("from", subject.from).add("to", subject.to);
    json.add("way", subject.way).add("profile", profile.name).put("figures", "[" + figures + "]");
    return json.put("throughput", throughputJson(measurement)).put("measurement", toJson(measurement)).text();
}

} // namespace liena::tools
