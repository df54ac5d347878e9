// Figures out of phases, and each against its limits.
#include "line_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace liena::tools {

namespace {

double milliseconds(std::uint64_t ns) { return static_cast<double>(ns) / 1e6; }

double secondsOf(const ProbeFigures& figures) { return std::chrono::duration<double>(figures.spent).count(); }

void add(std::string& why, const std::string& more)
{
    if (!more.empty())
        why += (why.empty() ? "" : "; ") + more;
}

std::string tooFew(double percent, std::uint64_t count, std::string_view what)
{
    const double needed = neededFor(percent);
    if (static_cast<double>(count) >= needed)
        return {};
    return fmt::format("{:g} % needs {:.0f} {}, not {}: measure for longer", percent, needed, what, count);
}

std::optional<double> roundTrip(const ProbeFigures& figures, std::string_view what, std::string& why, double fraction = 0.99)
{
    if (figures.echoed == 0) {
        why = "no echo came back";
        return std::nullopt;
    }
    add(why, tooFew(100 * fraction, figures.roundTrip.count(), what));
    return milliseconds(figures.roundTrip.quantile(fraction));
}

struct PacketCount {
    std::uint64_t sent = 0;
    std::uint64_t echoed = 0;
};

PacketCount packetsOf(const Measurement& measurement)
{
    PacketCount count;
    for (const auto name : {phases::paced, phases::besideImages})
        if (const auto* phase = phaseOf(measurement, name)) {
            count.sent += phase->packets.sent;
            count.echoed += phase->packets.echoed;
        }
    return count;
}

/// Without a way by UDP nothing can be said of packets: a firewall is no loss.
std::optional<double> lossOf(const Measurement& measurement, std::string& why)
{
    const auto [sent, echoed] = packetsOf(measurement);
    if (echoed > 0)
        return 100.0 * (1.0 - static_cast<double>(echoed) / static_cast<double>(sent));
    add(why,
        sent == 0 ? "packets were not measured" : "no packet came back: UDP does not pass (a firewall?), so commands travel by TCP alone");
    return std::nullopt;
}

std::string tooFewPackets(const Measurement& measurement, double limit)
{
    const auto sent = packetsOf(measurement).sent;
    if (static_cast<double>(sent) >= neededForLoss(limit))
        return {};
    return fmt::format("{} packets are too few to tell {:g} % from none: measure for longer", sent, limit);
}

/// ITU-T Y.1541 calls it IPDV: the 99.9th percentile less the least; here of the way there and back.
std::optional<double> jitterOf(const PhaseFigures* phase, const Measurement& measurement, std::string& why)
{
    if (phase == nullptr || phase->packets.echoed == 0) {
        if (lossOf(measurement, why)) // those of the other phase came back
            add(why, phase == nullptr || phase->packets.sent == 0 ? "packets were not measured" : "no packet came back");
        return std::nullopt;
    }
    const auto& times = phase->packets.roundTrip;
    add(why, tooFew(99.9, times.count(), "packets"));
    return milliseconds(times.quantile(0.999) - times.least());
}

/// A line may carry another rate by now.
std::string tooLongAgo(std::chrono::nanoseconds age)
{
    using namespace std::chrono_literals;
    if (age <= 1min)
        return {};
    return fmt::format("images showed it {} min ago: let them flow again, or measure while the devices are at rest", age / 1min);
}

std::optional<double> imageRateOf(const Measurement& measurement, std::string& why)
{
    const auto* phase = phaseOf(measurement, phases::images);
    const auto* most = phase != nullptr ? &phase->images : nullptr;
    if (most == nullptr && measurement.bulkRate) {
        why = tooLongAgo(measurement.bulkRateAge);
        return *measurement.bulkRate / 1e6;
    }
    if (most == nullptr || most->limited) {
        why = most == nullptr ? "was not measured, since that fills the line, and no images have shown it yet"
                              : "the budget for measuring is less than the line may carry";
        return std::nullopt;
    }
    if (most->echoed == 0 || secondsOf(*most) <= 0) {
        why = "no image arrived in time";
        return 0.0;
    }
    return static_cast<double>(most->echoed) * most->asked.bytes / secondsOf(*most) / 1e6;
}

/// Percent that came back of what was due.
std::optional<double> carried(const ProbeFigures& figures)
{
    const auto due = figures.sent + figures.withheld;
    return due > 0 ? std::optional(100.0 * static_cast<double>(figures.echoed) / static_cast<double>(due)) : std::nullopt;
}

/// A round trip is one at any rate; that the line carries commands is told only of the rate at which they were sent.
std::string slowedCommands(const ProbeFigures& figures)
{
    if (!figures.limited)
        return {};
    return fmt::format(
        "measured with {} commands a second, which is what the budget allows, not {}: measure while the devices are at rest, "
        "or say with --commands that fewer are enough",
        numberText(figures.perSecond, figures.asked.perSecond), numberText(figures.asked.perSecond));
}

std::optional<double> commandsCarried(const Measurement& measurement, std::string& why)
{
    std::optional<double> least;
    for (const auto name : {phases::paced, phases::besideImages})
        if (const auto* phase = phaseOf(measurement, name))
            if (const auto share = carried(phase->prompt)) {
                least = std::min(least.value_or(*share), *share);
                if (why.empty())
                    why = slowedCommands(phase->prompt);
            }
    if (!least)
        why = "commands were not measured";
    return least;
}

std::optional<double> besideImages(Figure figure, const Measurement& measurement, std::string& why)
{
    const auto* phase = phaseOf(measurement, phases::besideImages);
    if (phase == nullptr || phase->images.sent == 0) {
        why = "images were not measured";
        return std::nullopt;
    }
    if (phase->images.limited)
        why = fmt::format("measured with {:.1f} images a second, which is what the budget allows, not {:.1f}", phase->images.perSecond,
                          phase->images.asked.perSecond);
    if (figure == Figure::RoundTripBesideImages)
        return roundTrip(phase->prompt, "commands", why);
    if (figure == Figure::TailBesideImages)
        return roundTrip(phase->prompt, "commands", why, 0.999);
    if (figure == Figure::JitterBesideImages)
        return jitterOf(phase, measurement, why);
    const auto share = carried(phase->images);
    // What waits behind other images is late by those, and may be withheld for them.
    if (measurement.imagesFlowed && (figure == Figure::ImageDelivery || (share && *share < 100))) {
        why = "the session's own images flowed, and those that measure waited behind them: measure while none flow";
        return std::nullopt;
    }
    if (figure == Figure::ImagesCarried)
        return share;
    return roundTrip(phase->images, "images", why);
}

/// The rule of three is not for these: what TCP carries is not lost now and then, it is withheld where the line is too narrow, and goes on
/// being so.
std::string tooFewDue(Figure figure, const Measurement& measurement, double limit)
{
    const auto due = [](const ProbeFigures& figures) { return figures.sent + figures.withheld; };
    const double percent = std::min(limit, 99.9); // no number tells 100 %
    if (figure == Figure::ImagesCarried) {
        const auto* phase = phaseOf(measurement, phases::besideImages);
        return phase != nullptr ? tooFew(percent, due(phase->images), "images") : std::string();
    }
    std::optional<std::uint64_t> least;
    for (const auto name : {phases::paced, phases::besideImages})
        if (const auto* phase = phaseOf(measurement, name); phase != nullptr && due(phase->prompt) > 0)
            least = std::min(least.value_or(due(phase->prompt)), due(phase->prompt));
    return least ? tooFew(percent, *least, "commands") : std::string();
}

JudgedFigure judgeFigure(const FigureKind& kind, const Measurement& measurement, const LineProfile& profile)
{
    JudgedFigure judged;
    judged.figure = kind.figure;
    std::string why;
    judged.value = valueOf(kind.figure, measurement, why);
    if (const auto limits = profile.limits.find(kind.figure); limits != profile.limits.end())
        judged.limits = limits->second;
    if (kind.figure == Figure::Loss && judged.value == 0.0 && judged.limits)
        why = tooFewPackets(measurement, judged.limits->go);
    const bool isShare = kind.figure == Figure::CommandsCarried || kind.figure == Figure::ImagesCarried;
    if (isShare && judged.limits && judged.value && *judged.value >= judged.limits->go)
        add(why, tooFewDue(kind.figure, measurement, judged.limits->go));
    judged.reason = why;
    if (!judged.limits)
        return judged;
    if (!judged.value || !why.empty())
        judged.verdict = Verdict::Caution;
    if (!judged.value)
        return judged;
    const auto within = [&](double limit) { return kind.leastWanted ? *judged.value >= limit : *judged.value <= limit; };
    const auto found = within(judged.limits->go) ? Verdict::Go : within(judged.limits->caution) ? Verdict::Caution : Verdict::NoGo;
    judged.verdict = std::max(judged.verdict, found);
    if (found == Verdict::Go)
        return judged;
    const double limit = found == Verdict::NoGo ? judged.limits->caution : judged.limits->go;
    judged.reason = fmt::format("{} {} is {} {:g} {}{}{}", numberText(*judged.value, limit), kind.unit,
                                kind.leastWanted ? "less than" : "more than", limit, kind.unit, why.empty() ? "" : "; ", why);
    return judged;
}

} // namespace

double neededFor(double percent)
{
    constexpr double most = 99.9;
    return std::ceil(100 / (100 - std::min(percent, most)) - 1e-6);
}

double neededForLoss(double percent) { return 3 / (percent / 100); }

std::string_view wordOf(Verdict verdict)
{
    switch (verdict) {
    case Verdict::Go:
        return "GO";
    case Verdict::Caution:
        return "CAUTION";
    case Verdict::NoGo:
        break;
    }
    return "NO-GO";
}

std::string numberText(double value, std::optional<double> limit)
{
    const auto other = limit ? fmt::format("{:g}", *limit) : std::string();
    constexpr int mostDigits = 15; // what a double keeps
    auto text = fmt::format("{:.3g}", value);
    for (int digits = 4; digits <= mostDigits && (text == other || text.find("e+") != std::string::npos); ++digits)
        text = fmt::format("{:.{}g}", value, digits);
    return text;
}

const PhaseFigures* phaseOf(const Measurement& measurement, std::string_view name)
{
    const auto& all = measurement.phases;
    const auto found = std::find_if(all.begin(), all.end(), [&](const PhaseFigures& phase) { return phase.name == name; });
    return found != all.end() ? &*found : nullptr;
}

std::optional<double> valueOf(Figure figure, const Measurement& measurement, std::string& why)
{
    switch (figure) {
    case Figure::RoundTrip: {
        const auto* phase = phaseOf(measurement, phases::paced);
        why = phase != nullptr ? "" : "commands were not measured";
        return phase != nullptr ? roundTrip(phase->prompt, "commands", why) : std::nullopt;
    }
    case Figure::Jitter:
        return jitterOf(phaseOf(measurement, phases::paced), measurement, why);
    case Figure::Loss:
        return lossOf(measurement, why);
    case Figure::CommandsCarried:
        return commandsCarried(measurement, why);
    case Figure::ImageRate:
        return imageRateOf(measurement, why);
    case Figure::RoundTripBesideImages:
    case Figure::TailBesideImages:
    case Figure::JitterBesideImages:
    case Figure::ImagesCarried:
    case Figure::ImageDelivery:
        break;
    }
    return besideImages(figure, measurement, why);
}

LineVerdict judge(const Measurement& measurement, const LineProfile& profile)
{
    LineVerdict judged;
    for (const auto& kind : figureKinds) {
        judged.figures.push_back(judgeFigure(kind, measurement, profile));
        judged.verdict = std::max(judged.verdict, judged.figures.back().verdict);
    }
    return judged;
}

} // namespace liena::tools
