// What one direction between two devices does to a frame: implementation.
#include "wire/impairment.hpp"

#include <algorithm>

namespace liena::lab {

double ImpairmentDraw::draw()
{
    // 53 bits, as a double has; the standard's distributions differ between libraries.
    return static_cast<double>(m_random() >> 11U) * 0x1.0p-53;
}

bool ImpairmentDraw::inBurst(const Impairment& impairment, double begins, double ends)
{
    m_burst = m_burst || begins < impairment.burstStart;
    const bool lost = m_burst;
    if (ends < impairment.burstEnd)
        m_burst = false;
    return lost;
}

Decision ImpairmentDraw::decide(const Impairment& impairment, Protocol protocol, std::size_t size, SteadyTime now)
{
    const double dropped = draw();
    const double begins = draw();
    const double ends = draw();
    const double doubled = draw();
    const double corrupted = draw();
    const double place = draw();
    const double held = draw();
    const double late = draw();
    const bool concerned = impairment.only == Protocol::Any || impairment.only == protocol;

    Decision decision;
    if (concerned) {
        const bool lostInBurst = inBurst(impairment, begins, ends);
        decision.drop =
            impairment.cut || dropped < impairment.drop || lostInBurst || (impairment.largest != 0 && size > impairment.largest);
        decision.duplicate = doubled < impairment.duplicate;
        if (corrupted < impairment.corrupt && size > 0)
            decision.turnedBit = static_cast<std::size_t>(place * static_cast<double>(size * 8));
        decision.overtaken = held < impairment.reorder;
    }
    decision.delay = impairment.delay;
    decision.delay += Nanoseconds(static_cast<std::int64_t>(late * static_cast<double>(impairment.jitter.count())));
    if (impairment.since && impairment.ramp.count() > 0) {
        const double seconds = std::chrono::duration<double>(now - *impairment.since).count();
        const auto grown = Nanoseconds(static_cast<std::int64_t>(seconds * static_cast<double>(impairment.ramp.count())));
        decision.delay += std::min(grown, impairment.rampEnd);
    }
    if (decision.overtaken)
        decision.delay += impairment.reorderBy;
    return decision;
}

} // namespace liena::lab
