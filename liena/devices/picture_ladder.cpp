// Which rate and encoding the way to the viewers carries: implementation.
#include "picture_ladder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace liena::devices {

namespace {

// Behind a longer pause between two pulses nothing is known of the time between.
constexpr std::chrono::milliseconds longestGap{2500};

// A rate so far above the one that was not kept is another situation.
constexpr double farAbove = 1.5;

// Sizes differ from picture to picture: a heavier one counts at once, lighter ones by and by.
constexpr double fading = 0.1;

// A picture of the heavier rung may still be under way, and hold up lighter ones that the path carries.
constexpr std::chrono::milliseconds settling{500};

// What makes a difference to a path that is full.
constexpr double lighterShare = 0.9;

// Until measured; rather too much.
constexpr double assumedLossless = 0.6;
constexpr struct {
    unsigned quality;
    double share;
} lossySteps[] = {{90, 0.25}, {75, 0.15}, {50, 0.10}};

std::string number(double value)
{
    const auto tenths = std::lround(value * 10);
    const std::string whole = std::to_string(tenths / 10);
    return tenths % 10 == 0 ? whole : whole + '.' + std::to_string(tenths % 10);
}

std::string words(Encoding encoding, unsigned quality)
{
    if (encoding == Encoding::Raw)
        return "raw";
    if (encoding == Encoding::Jpeg)
        return "lossy " + std::to_string(quality);
    return quality == 0 ? "lossless" : "lossy by at most " + std::to_string(quality);
}

} // namespace

std::string describe(const PictureRung& rung, double askedRate)
{
    return number(askedRate / rung.divisor) + " of " + number(askedRate) + " /s, " + words(rung.encoding, rung.quality);
}

PictureLadder::PictureLadder(Encoding asked, unsigned quality, Reduction permitted)
{
    m_costs.push_back({asked, asked == Encoding::Raw ? 0 : quality, asked == Encoding::Raw ? 1 : assumedLossless, {}});
    if (permitted != Reduction::None && asked == Encoding::Raw)
        m_costs.push_back({Encoding::JpegLs, 0, assumedLossless, {}});
    for (const auto& step : lossySteps)
        if (permitted == Reduction::Lossy && (asked != Encoding::Jpeg || step.quality < quality))
            m_costs.push_back({Encoding::Jpeg, step.quality, step.share, {}});
    declare(permitted);
}

void PictureLadder::declare(Reduction permitted)
{
    for (const Cost& cost : m_costs) {
        const unsigned last = permitted == Reduction::None ? 1 : &cost == &m_costs.back() ? 4 : 2;
        for (unsigned divisor = 1; divisor <= last; ++divisor)
            m_rungs.push_back({divisor, cost.encoding, cost.quality});
    }
}

std::size_t PictureLadder::costOf(const PictureRung& rung) const
{
    const auto found = std::find_if(m_costs.begin(), m_costs.end(),
                                    [&rung](const Cost& cost) { return cost.encoding == rung.encoding && cost.quality == rung.quality; });
    return static_cast<std::size_t>(found - m_costs.begin());
}

double PictureLadder::load(std::size_t step) const
{
    return m_costs[costOf(m_rungs[step])].share * m_unencoded * m_askedRate / m_rungs[step].divisor;
}

bool PictureLadder::isPermitted(std::size_t step) const
{
    const unsigned divisor = m_rungs[step].divisor;
    if (fails(step) || takesTooLong(step))
        return false;
    return divisor == 1 || m_askedRate / divisor >= leastRate;
}

/// Of the present encoding only when four of it were made: the first one may take longer. Raw pixels take no time to encode.
bool PictureLadder::takesTooLong(std::size_t step) const
{
    const Cost& cost = m_costs[costOf(m_rungs[step])];
    const bool isRaw = cost.encoding == Encoding::Raw;
    const bool isOwn = costOf(m_rungs[step]) == costOf(rung());
    if (!m_taking.isFull() || (isOwn && !isRaw && !cost.times.isFull()))
        return false;
    const auto takes = m_taking.least() + (isRaw ? std::chrono::nanoseconds::zero() : cost.times.least());
    const double period = m_rungs[step].divisor / m_askedRate;
    return std::chrono::duration<double>(takes).count() > (step < m_step ? period * (1 - spare) : period);
}

void PictureLadder::measured(SteadyTime now, const PictureRung& rung, std::size_t encoded, std::size_t unencoded,
                             std::chrono::nanoseconds encoding)
{
    if (unencoded == 0)
        return;
    m_unencoded = static_cast<double>(unencoded);
    Cost& cost = m_costs[costOf(rung)];
    const double share = static_cast<double>(encoded) / m_unencoded;
    const bool fades = cost.measured && share < cost.share && costOf(rung) == costOf(this->rung());
    cost.share += (share - cost.share) * (fades ? fading : 1);
    cost.times.note(encoding);
    cost.measured = now;
    cost.fails = false;
}

void PictureLadder::failed(SteadyTime now, const PictureRung& rung)
{
    Cost& cost = m_costs[costOf(rung)];
    cost.measured = now;
    cost.fails = true;
}

bool PictureLadder::works() const
{
    return std::any_of(m_costs.begin(), m_costs.end(), [](const Cost& cost) { return !cost.fails; });
}

std::optional<PictureRung> PictureLadder::toMeasure(SteadyTime now) const
{
    const std::size_t own = costOf(rung());
    for (std::size_t at = 0; at < m_costs.size(); ++at) {
        const Cost& cost = m_costs[at];
        const bool old = !cost.measured || ((at < own || cost.fails) && now - *cost.measured > measureAgain);
        if (at != own && old && (cost.fails || cost.encoding != Encoding::Raw)) // whose size is known
            return PictureRung{1, cost.encoding, cost.quality};
    }
    return std::nullopt;
}

bool PictureLadder::update(SteadyTime now, double askedRate, std::span<const PathReading> viewers)
{
    const std::size_t before = m_step;
    m_tookTooLong = false;
    if (std::exchange(m_askedRate, askedRate) != askedRate)
        m_climbed.reset(); // to another rate than now
    if (!isPermitted(m_step))
        leave(now);
    hear(now, viewers);
    if (isTooHeavy(now) || m_withheld >= 2)
        stepDown(now);
    else if (isSteady(now) && mayClimb(now))
        climbTo(above(), now);
    else if (now - m_watchBegan >= patience)
        endWatch(now);
    return m_step != before;
}

void PictureLadder::leave(SteadyTime now)
{
    m_tookTooLong = !fails(m_step) && takesTooLong(m_step);
    if (!fails(m_step) && !m_tookTooLong) { // at the lower rate that is asked for now the next better one is the same, or less
        m_step = above();
        return;
    }
    const auto last = m_rungs.size();
    std::size_t next = m_step + 1;
    while (next < last && !isPermitted(next))
        ++next;
    m_step = next < last ? next : m_tookTooLong ? m_step : above();
    if (m_tookTooLong && m_climbed) {
        m_broken.reset(); // no wider way helps
        breakPromise(now);
    }
    m_climbed.reset(); // which says nothing of the way
    m_trialEnds = now;
    beginWatch(now);
}

void PictureLadder::hear(SteadyTime now, std::span<const PathReading> viewers)
{
    std::uint64_t withheld = 0;
    m_rate.reset();
    for (const PathReading& viewer : viewers) {
        withheld = std::max(withheld, viewer.withheld);
        if (viewer.bulkRate)
            m_rate = std::min(*viewer.bulkRate, m_rate.value_or(*viewer.bulkRate));
    }
    const bool paused = !m_updated || now - *m_updated > longestGap;
    m_updated = now;
    if (paused) {
        m_withheld = 0;
        m_heavySince.reset();
        m_climbed = m_climbed ? std::optional(now) : std::nullopt;
        beginWatch(now);
        return;
    }
    if (m_climbed && now - *m_climbed > proven) {
        m_climbed.reset();
        m_broken.reset();
        m_wait = firstWait;
    }
    m_wasUnknown = m_wasUnknown || !m_rate;
    if (m_rate)
        m_carriedRate = std::min(*m_rate, m_carriedRate.value_or(*m_rate));
    noteWithheld(now, withheld);
}

void PictureLadder::noteWithheld(SteadyTime now, std::uint64_t count)
{
    if (now - m_lastWithheld > withheldWindow)
        m_withheld = 0;
    if (count == 0)
        return;
    const bool settles = now < m_settled && m_rate && load(m_step) <= *m_rate * fill;
    m_withheld += settles ? 0 : count;
    m_lastWithheld = now;
    m_steadySince.reset();
    beginWatch(now);
}

bool PictureLadder::isTooHeavy(SteadyTime now)
{
    if (!m_rate || *m_rate >= load(m_step))
        m_heavySince.reset();
    else if (!m_heavySince)
        m_heavySince = now;
    return m_heavySince && now - *m_heavySince >= patience && now >= m_trialEnds;
}

std::size_t PictureLadder::lighter() const
{
    std::size_t lightest = m_step;
    for (std::size_t step = m_step + 1; step < m_rungs.size(); ++step) {
        if (!isPermitted(step) || load(step) > load(m_step) * lighterShare)
            continue;
        if (!m_rate || load(step) <= *m_rate * fill)
            return step;
        if (load(step) <= load(lightest))
            lightest = step;
    }
    return lightest;
}

std::size_t PictureLadder::above() const
{
    for (std::size_t step = m_step; step-- > 0;)
        if (isPermitted(step))
            return step;
    return m_step;
}

bool PictureLadder::isSteady(SteadyTime now)
{
    if (above() == m_step || !m_rate || *m_rate < load(above()) * leastHeadroom)
        m_steadySince.reset();
    else if (!m_steadySince)
        m_steadySince = now;
    return m_steadySince && now - *m_steadySince >= longPatience;
}

std::size_t PictureLadder::better() const
{
    for (std::size_t step = m_wasUnknown ? above() : 0; step < m_step; ++step)
        if (isPermitted(step) && (!m_carriedRate || load(step) * headroom <= *m_carriedRate))
            return step;
    return m_step;
}

void PictureLadder::stepDown(SteadyTime now)
{
    m_step = lighter();
    m_heavySince.reset();
    m_trialEnds = now;
    m_settled = now + settling;
    m_withheld = 0;
    m_steadySince.reset();
    beginWatch(now);
    if (!m_climbed)
        return;
    m_climbed.reset();
    m_broken = m_promise;
    breakPromise(now);
}

/// The next climb waits.
void PictureLadder::breakPromise(SteadyTime now)
{
    m_notBefore = now + m_wait;
    m_wait = std::min<std::chrono::nanoseconds>(2 * m_wait, longestWait);
}

bool PictureLadder::mayClimb(SteadyTime now) const
{
    return now >= m_notBefore || (m_broken && m_carriedRate && *m_carriedRate >= *m_broken * farAbove);
}

void PictureLadder::endWatch(SteadyTime now)
{
    const std::size_t step = mayClimb(now) ? better() : m_step;
    if (step < m_step)
        return climbTo(step, now);
    if (!mayClimb(now) || !tellsNothing())
        return beginWatch(now);
    climbTo(above(), now);
    m_trialEnds = now + trial;
}

bool PictureLadder::tellsNothing() const { return above() < m_step && m_carriedRate && load(m_step) < *m_carriedRate * telling; }

void PictureLadder::climbTo(std::size_t step, SteadyTime now)
{
    m_step = step;
    m_climbed = now;
    m_promise = m_carriedRate;
    m_steadySince.reset();
    beginWatch(now);
}

void PictureLadder::beginWatch(SteadyTime now)
{
    m_watchBegan = now;
    m_carriedRate = m_rate;
    m_wasUnknown = !m_rate;
}

} // namespace liena::devices
