// Rhythms, windows and bookkeeping of probes.
#include "session/line_probing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace liena::session {

using namespace std::chrono_literals;
using protocol::ProbeWay;

namespace {

constexpr auto patience = 1s; // for the last echoes of a phase
constexpr std::uint32_t fewestImagesUnderWay = 4;
constexpr auto latest = 1s; // behind its rhythm: what is later is withheld

std::uint64_t stampOf(Instant when)
{
    return static_cast<std::uint64_t>(std::chrono::duration_cast<Nanoseconds>(when.time_since_epoch()).count());
}

Nanoseconds periodOf(double perSecond)
{
    constexpr double longest = 3600;
    return std::chrono::duration_cast<Nanoseconds>(std::chrono::duration<double>(std::min(1 / perSecond, longest)));
}

/// A second of them, so that a long line is not taken for a narrow one. Where a limit slows what goes at once, no more than that either: a
/// path that stood still is not flooded afterwards.
std::uint32_t mostImages(const ProbeStream& asked, double perSecond)
{
    if (asked.atOnce > 0 && perSecond <= 0)
        return asked.atOnce;
    const double due = std::ceil(perSecond * std::chrono::duration<double>(patience).count()) + 1;
    const auto most = static_cast<std::uint32_t>(std::clamp<double>(due, fewestImagesUnderWay, LineProbing::mostUnderWay));
    return asked.atOnce > 0 ? std::min(asked.atOnce, most) : most;
}

} // namespace

LineProbing::LineProbing(MeasurementPlan plan, MeasuringLimits limits, Instant now) : m_plan(std::move(plan)), m_limits(limits)
{
    if (!isOver())
        begin(now);
}

Nanoseconds LineProbing::longest(const MeasurementPlan& plan)
{
    Nanoseconds sum{};
    for (const auto& phase : plan)
        sum += phase.duration + patience;
    return sum;
}

void LineProbing::begin(Instant now)
{
    const auto& phase = m_plan[m_phase];
    m_phaseEnds = now + phase.duration;
    // Probes of both kinds share what is allowed, in equal parts where both are sent.
    const double share = phase.prompt.isUsed() && phase.packets.isUsed() ? 0.5 : 1;
    const double probes = m_limits.probesPerSecond * share;
    beginWay(wayOf(ProbeWay::Prompt), phase.prompt, probes, mostUnderWay, now);
    beginWay(wayOf(ProbeWay::Packet), phase.packets, probes, ~std::uint32_t{0}, now);
    auto& images = wayOf(ProbeWay::Image);
    beginWay(images, phase.images, mostImagesPerSecond(phase.images), mostUnderWay, now);
    images.most = mostImages(phase.images, images.figures.perSecond);
}

void LineProbing::beginWay(Way& way, const ProbeStream& asked, double mostPerSecond, std::uint32_t most, Instant now)
{
    way.figures = {};
    way.figures.asked = asked;
    way.first = way.next;
    way.heardBefore = way.heardNow;
    way.echoed.clear();
    way.due = asked.isUsed() ? now : Instant::max();
    way.firstSent = {};
    way.most = asked.atOnce > 0 ? asked.atOnce : most;
    auto& rate = way.figures.perSecond;
    rate = asked.atOnce > 0 ? 0 : asked.perSecond;
    way.figures.limited = asked.isUsed() && mostPerSecond > 0 && (rate <= 0 || rate > mostPerSecond * 1.001);
    if (way.figures.limited)
        rate = mostPerSecond;
    way.period = rate > 0 ? periodOf(rate) : 0ns;
}

double LineProbing::mostImagesPerSecond(const ProbeStream& asked) const
{
    return static_cast<double>(m_limits.bulkBytesPerSecond) / std::max<double>(1, asked.bytes);
}

void LineProbing::limitImages(std::uint64_t bytesPerSecond, Instant now)
{
    m_limits.bulkBytesPerSecond = bytesPerSecond;
    auto& way = wayOf(ProbeWay::Image);
    if (isOver() || !way.figures.asked.isUsed())
        return;
    const double asked = way.figures.asked.atOnce > 0 ? 0 : way.figures.asked.perSecond;
    const double most = mostImagesPerSecond(way.figures.asked);
    const double rate = most > 0 && (asked <= 0 || asked > most) ? most : asked;
    const auto period = rate > 0 ? periodOf(rate) : 0ns;
    if (period != way.period)
        way.due = std::max(now, way.due + (period - way.period));
    way.period = period;
    way.most = mostImages(way.figures.asked, rate);
    if (rate == asked)
        return;
    way.figures.limited = true;
    way.figures.perSecond = way.figures.perSecond > 0 ? std::min(way.figures.perSecond, rate) : rate; // the least of this phase
}

void LineProbing::advance(Instant now)
{
    if (isOver() || now < m_phaseEnds)
        return;
    const bool waits = std::any_of(m_ways.begin(), m_ways.end(), [this](const Way& way) { return way.underWay() > 0 || isOwed(way); });
    if (waits && now < m_phaseEnds + patience)
        return;
    endPhase();
    ++m_phase;
    if (!isOver())
        begin(now);
}

/// What was due before `until` and was not sent: it counts, or a device that stands still would find its line better than it is.
void LineProbing::leaveOut(Way& way, Instant until)
{
    const auto left = (until - way.due + way.period - 1ns) / way.period;
    way.figures.withheld += static_cast<std::uint64_t>(left);
    way.due += left * way.period;
}

void LineProbing::endPhase()
{
    for (auto& way : m_ways) {
        if (isOwed(way))
            leaveOut(way, m_phaseEnds);
        way.figures.heard = std::min<std::uint64_t>(way.heardNow - way.heardBefore, way.figures.sent);
    }
    m_figures.push_back({m_plan[m_phase].name, std::move(m_ways[0].figures), std::move(m_ways[1].figures), std::move(m_ways[2].figures)});
}

std::optional<LineProbing::Order> LineProbing::next(Instant now)
{
    advance(now);
    if (isOver())
        return std::nullopt;
    for (const auto kind : {ProbeWay::Prompt, ProbeWay::Packet, ProbeWay::Image})
        if (auto order = nextOf(kind, now))
            return order;
    return std::nullopt;
}

std::optional<LineProbing::Order> LineProbing::nextOf(ProbeWay kind, Instant now)
{
    auto& way = wayOf(kind);
    const bool rhythm = way.isRhythm();
    if (way.due > now)
        return std::nullopt;
    if (isOwed(way) && way.due < now - latest)
        leaveOut(way, std::min(now, m_phaseEnds));
    const bool over = now >= m_phaseEnds && !isOwed(way);
    if (over)
        way.due = std::max(way.due, m_phaseEnds); // nobody wakes for it
    if (over || way.due > now)
        return std::nullopt;
    if (way.underWay() >= way.most) {
        if (rhythm) {
            ++way.figures.withheld;
            way.due += way.period;
        }
        return std::nullopt;
    }
    const auto stamp = rhythm ? way.due : now;
    way.due = rhythm ? way.due + way.period : now + way.period;
    if (way.figures.sent++ == 0)
        way.firstSent = now;
    way.echoed.push_back(false);
    return Order{kind, way.next++, stampOf(stamp), way.figures.asked.bytes, m_phaseEnds + patience};
}

Instant LineProbing::wakeAt() const
{
    if (isOver())
        return Instant::max();
    auto wake = m_phaseEnds;
    for (const auto& way : m_ways)
        if (way.underWay() < way.most || way.isRhythm())
            wake = std::min(wake, way.due);
    const bool waits = std::any_of(m_ways.begin(), m_ways.end(), [](const Way& way) { return way.underWay() > 0; });
    // After its end a phase waits for echoes; heard() looks after those.
    return wake < m_phaseEnds ? wake : waits ? m_phaseEnds + patience : m_phaseEnds;
}

void LineProbing::heard(const protocol::ProbeEcho& echo, Instant now)
{
    if (isOver())
        return;
    auto& way = wayOf(echo.way);
    const std::uint32_t place = echo.sequence - way.first;
    if (place >= way.echoed.size() || way.echoed[place])
        return; // of an earlier phase, or a packet's double
    way.echoed[place] = true;
    ++way.figures.echoed;
    way.heardNow = std::max(way.heardNow, echo.heard);
    way.figures.spent = now - way.firstSent;
    way.figures.roundTrip.record(static_cast<std::int64_t>(stampOf(now) - echo.sentNs));
    advance(now);
}

} // namespace liena::session
