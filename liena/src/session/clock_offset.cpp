// Offset and delay from four timestamps.
#include "session/clock_offset.hpp"

#include <algorithm>

namespace liena::session {

namespace {

/// What two clocks may drift apart within one window, with room to spare.
constexpr Nanoseconds drift = std::chrono::milliseconds(1);

} // namespace

void ClockOffset::add(Timestamp t1, Timestamp t2, Timestamp t3, Timestamp t4)
{
    const auto delay = difference(t4, t1) - difference(t3, t2);
    if (delay < Nanoseconds::zero())
        return; // a clock was stepped between the stamps
    const Sample sample{(difference(t2, t1) + difference(t3, t4)) / 2, delay};
    if (contradicts(sample))
        m_count = m_next = 0;
    m_samples[m_next] = sample;
    m_next = (m_next + 1) % window;
    m_count = std::min(m_count + 1, window);
    m_lastDelay = delay;
    const auto end = m_samples.begin() + static_cast<std::ptrdiff_t>(m_count);
    const auto least = std::min_element(m_samples.begin(), end, [](const Sample& a, const Sample& b) { return a.delay < b.delay; });
    m_best = static_cast<std::size_t>(least - m_samples.begin());
}

// The true offset lies within half the delay of every sample. Two that cannot both be true were taken before and after a step.
bool ClockOffset::contradicts(const Sample& sample) const
{
    if (m_count == 0)
        return false;
    const auto* known = leastDelayed();
    return std::chrono::abs(sample.offset - known->offset) > sample.delay / 2 + known->delay / 2 + drift;
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
