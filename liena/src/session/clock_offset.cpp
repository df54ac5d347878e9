// Offset and delay from four timestamps.
#include "session/clock_offset.hpp"

#include <algorithm>

namespace liena::session {

namespace {

/// What two clocks may drift apart in that time: a clock that is set right slowly runs by up to 500 ppm wrong (adjtimex(2)), and there is
/// a millisecond to spare.
constexpr Nanoseconds driftWithin(Nanoseconds time) { return std::chrono::milliseconds(1) + time / 2000; }

} // namespace

std::optional<Nanoseconds> Exchange::delay() const
{
    const auto away = heard.mono - sent;
    const auto held = difference(answer, heardBy);
    return held >= Nanoseconds::zero() && held <= away ? std::optional(away - held) : std::nullopt;
}

Nanoseconds Exchange::offset() const
{
    const Timestamp sentWall{heard.wall.ns - static_cast<std::uint64_t>((heard.mono - sent).count())};
    return (difference(heardBy, sentWall) + difference(answer, heard.wall)) / 2;
}

bool ClockOffset::add(const Exchange& exchange)
{
    const auto delay = exchange.delay();
    if (!delay)
        return false;
    const Sample sample{exchange.offset(), *delay, exchange.heard.mono};
    const bool stepped = contradicts(sample);
    if (stepped)
        m_count = m_next = 0;
    m_samples[m_next] = sample;
    m_next = (m_next + 1) % window;
    m_count = std::min(m_count + 1, window);
    m_lastDelay = delay;
    const auto end = m_samples.begin() + static_cast<std::ptrdiff_t>(m_count);
    const auto least = std::min_element(m_samples.begin(), end, [](const Sample& a, const Sample& b) { return a.delay < b.delay; });
    m_best = static_cast<std::size_t>(least - m_samples.begin());
    return !stepped;
}

// The true offset lies within half the delay of every sample. Two that cannot both be true were taken before and after a step. The least
// delayed may be old, and a small step then looks like what the clocks drifted since: so the newest is asked as well.
bool ClockOffset::contradicts(const Sample& sample) const
{
    const auto disagrees = [&](const Sample& known) {
        const auto error = sample.delay / 2 + known.delay / 2 + driftWithin(sample.taken - known.taken);
        return std::chrono::abs(sample.offset - known.offset) > error;
    };
    return m_count > 0 && (disagrees(*leastDelayed()) || disagrees(newest()));
}

const ClockOffset::Sample* ClockOffset::best() const { return m_count < needed ? nullptr : leastDelayed(); }

std::optional<Nanoseconds> ClockOffset::offset() const
{
    const auto* sample = best();
    return sample != nullptr ? std::optional(sample->offset) : std::nullopt;
}

Nanoseconds ClockOffset::uncertainty() const
{
    const auto* sample = best();
    return sample != nullptr ? sample->delay / 2 : Nanoseconds::zero();
}

std::optional<Nanoseconds> ClockOffset::lastDelay() const { return m_lastDelay; }

} // namespace liena::session
