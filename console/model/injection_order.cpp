// When a held button asks the robot for contrast.
#include "model/injection_order.hpp"

#include <algorithm>

namespace console {

namespace {

InjectionBar barOf(const InjectionReadings& readings)
{
    if (!readings.armed)
        return InjectionBar::NotArmed;
    if (!readings.robotFresh)
        return InjectionBar::RobotUnheard;
    if (readings.running)
        return InjectionBar::Running;
    return readings.contrastLeft < plannedInjection ? InjectionBar::NotEnough : InjectionBar::None;
}

} // namespace

bool InjectionOrder::advance(const InjectionReadings& readings, Instant now)
{
    m_bar = barOf(readings);
    if (m_bar == InjectionBar::None && m_asked && now - m_asked->at <= answerLimit)
        m_bar = InjectionBar::Running; // on its way there
    if (!readings.held) {
        m_stage = Stage::Released;
        return false;
    }
    if (m_stage == Stage::Released) {
        m_stage = Stage::Holding;
        m_since = now;
    }
    if (m_bar != InjectionBar::None)
        m_stage = Stage::Spent;
    if (m_stage != Stage::Holding || now - m_since < hold)
        return false;
    m_stage = Stage::Spent;
    return true;
}

double InjectionOrder::progress(Instant now) const
{
    return m_stage == Stage::Holding ? std::clamp(milliseconds(now - m_since) / milliseconds(hold), 0.0, 1.0) : 0;
}

void InjectionOrder::note(quint32 number, Instant now) { m_asked = Asked{number, now}; }

void InjectionOrder::hear(const InjectionStatus& status)
{
    if (m_asked && m_asked->number == status.injection)
        m_asked.reset();
}

} // namespace console
