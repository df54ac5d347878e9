// Offset and delay from four timestamps.
#include "session/clock_offset.hpp"

#include <algorithm>

namespace liena::session {

void ClockOffset::add(Timestamp t1, Timestamp t2, Timestamp t3, Timestamp t4)
{
    const auto delay = difference(t4, t1) - difference(t3, t2);
    if (delay < Nanoseconds::zero())
        return; // a clock was stepped between the stamps
    m_samples[m_next] = {(difference(t2, t1) + difference(t3, t4)) / 2, delay};
    m_next = (m_next + 1) % window;
    m_count = std::min(m_count + 1, window);
    m_lastDelay = delay;
}

const ClockOffset::Sample* ClockOffset::best() const
{
    if (m_count < needed)
        return nullptr;
    return &*std::min_element(m_samples.begin(), m_samples.begin() + static_cast<std::ptrdiff_t>(m_count),
                              [](const Sample& a, const Sample& b) { return a.delay < b.delay; });
}

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
