// Axes, curves and limits of the plot.
#include "latency_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

namespace liena::tools {

namespace {

constexpr double left = 90;
constexpr double top = 70;
constexpr double width = 620;
constexpr double height = 360;
constexpr double mostNines = 5; // 99.999 %

struct Curve {
    std::string_view name;
    std::string_view colour; // told apart also by those who do not see all colours (Okabe and Ito 2008)
    const LatencyHistogram* latencies;
};

std::string escaped(std::string_view text)
{
    std::string safe;
    for (const char c : text)
        safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
    return safe;
}

std::vector<Curve> curvesOf(const Measurement& measurement)
{
    std::vector<Curve> curves;
    const auto add = [&](std::string_view name, std::string_view colour, const ProbeFigures& figures) {
        if (figures.roundTrip.count() > 0)
            curves.push_back({name, colour, &figures.roundTrip});
    };
    if (const auto* phase = phaseOf(measurement, phases::paced)) {
        add("commands, idle", "#0072b2", phase->prompt);
        add("packets by UDP, idle", "#56b4e9", phase->packets);
    }
    if (const auto* phase = phaseOf(measurement, phases::backToBack))
        add("commands, back to back", "#009e73", phase->prompt);
    if (const auto* phase = phaseOf(measurement, phases::besideImages)) {
        add("commands beside images", "#d55e00", phase->prompt);
        add("images, until heard", "#cc79a7", phase->images);
    }
    return curves;
}

/// Decades of milliseconds that hold everything.
struct Range {
    double lowest = -2;
    double highest = 1;

    double y(double ms) const
    {
        return top + height * (highest - std::clamp(std::log10(std::max(ms, 1e-9)), lowest, highest)) / (highest - lowest);
    }
};

Range rangeOf(const std::vector<Curve>& curves, const LineProfile& profile)
{
    double least = 1;
    double most = 1;
    for (const auto& curve : curves) {
        least = std::min(least, static_cast<double>(std::max<std::uint64_t>(curve.latencies->least(), 1000)) / 1e6);
        most = std::max(most, static_cast<double>(curve.latencies->max()) / 1e6);
    }
    for (const auto figure : {Figure::RoundTripBesideImages, Figure::TailBesideImages})
        if (const auto limits = profile.limits.find(figure); limits != profile.limits.end())
            most = std::max(most, limits->second.caution);
    return {std::floor(std::log10(least)), std::ceil(std::log10(most) + 0.1)};
}

/// 0 % on the left, then a step of equal width for each nine.
double x(double fraction) { return left + width * std::min(-std::log10(std::max(1 - fraction, 1e-9)), mostNines) / mostNines; }

std::string axes(const Range& range)
{
    std::string svg;
    for (double decade = range.lowest; decade <= range.highest; ++decade) {
        const auto y = range.y(std::pow(10, decade));
        svg += fmt::format("<line x1=\"{}\" y1=\"{:.1f}\" x2=\"{}\" y2=\"{:.1f}\" stroke=\"#ddd\"/>\n", left, y, left + width, y);
        svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{:g} ms</text>\n", left - 8, y + 4, std::pow(10, decade));
    }
    for (const auto& [fraction, name] : {std::pair(0.0, "0 %"), std::pair(0.9, "90 %"), std::pair(0.99, "99 %"), std::pair(0.999, "99.9 %"),
                                         std::pair(0.9999, "99.99 %"), std::pair(0.99999, "all")}) {
        svg += fmt::format("<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\" stroke=\"#ddd\"/>\n", x(fraction), top, top + height);
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", x(fraction), top + height + 18, name);
    }
    return svg + fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">of the round trips took at most</text>\n", left + width / 2,
                             top + height + 38);
}

/// From one fraction to that which must be within the limits: a curve that stays below such steps keeps them.
std::string limitStep(const Range& range, const LineProfile& profile, Figure figure, double from, double to)
{
    const auto limits = profile.limits.find(figure);
    if (limits == profile.limits.end())
        return {};
    std::string svg;
    constexpr double above = -4;
    constexpr double below = 14;
    for (const auto& [limit, name, colour, beside] :
         {std::tuple(limits->second.go, "go", "#555555", below), std::tuple(limits->second.caution, "caution", "#a00000", above)}) {
        const auto y = range.y(limit);
        svg += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-dasharray=\"6 4\"/>\n",
                           x(from), y, x(to), y, colour);
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\">{}: {:g} % within {:g} ms</text>\n", x(from) + 6, y + beside,
                           colour, name, 100 * to, limit);
    }
    return svg;
}

std::string limitLines(const Range& range, const LineProfile& profile)
{
    return limitStep(range, profile, Figure::RoundTripBesideImages, 0, 0.99) +
           limitStep(range, profile, Figure::TailBesideImages, 0.99, 0.999);
}

/// Empty where there are too few.
std::string within(const LatencyHistogram& latencies)
{
    constexpr double fraction = 0.99;
    if (!latencies.tells(fraction))
        return {};
    return fmt::format("99 % within {} ms, ", numberText(static_cast<double>(latencies.quantile(fraction)) / 1e6));
}

std::string curveLine(const Curve& curve, const Range& range)
{
    std::string points;
    std::uint64_t before = 0;
    curve.latencies->forEach([&](std::uint64_t value, std::uint64_t count) {
        const auto all = static_cast<double>(curve.latencies->count());
        const auto y = range.y(static_cast<double>(value) / 1e6);
        points += fmt::format("{:.1f},{:.1f} ", x(static_cast<double>(before) / all), y);
        before += count;
        points += fmt::format("{:.1f},{:.1f} ", x(static_cast<double>(before) / all), y);
    });
    return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", points, curve.colour);
}

} // namespace

std::string latencyPlot(const BenchSubject& subject, const LineProfile& profile, const LineVerdict& verdict, const Measurement& measurement)
{
    const auto curves = curvesOf(measurement);
    const auto range = rangeOf(curves, profile);
    const auto legendTop = top + height + 62;
    auto svg = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
                           "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                           left + width + 40, legendTop + 20 * static_cast<double>(curves.size()));
    svg += fmt::format("<text x=\"{}\" y=\"28\" font-size=\"16\">{}: the line from {} to {}</text>\n", left, wordOf(verdict.verdict),
                       escaped(subject.from), escaped(subject.to));
    svg += fmt::format("<text x=\"{}\" y=\"48\">{}; round trips</text>\n", left,
                       escaped(profile.title.empty() ? profile.name : profile.title));
    svg += axes(range) + limitLines(range, profile);
    auto y = legendTop;
    for (const auto& curve : curves) {
        svg += curveLine(curve, range);
        svg += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"{}\" stroke-width=\"3\"/>", left, y - 4, left + 24,
                           y - 4, curve.colour);
        svg += fmt::format("<text x=\"{}\" y=\"{}\">{}: {}most {} ms</text>\n", left + 32, y, curve.name, within(*curve.latencies),
                           numberText(static_cast<double>(curve.latencies->max()) / 1e6));
        y += 20;
    }
    return svg + "</svg>\n";
}

} // namespace liena::tools
