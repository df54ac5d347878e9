// Mass, spring, damper, and the rule of passivity.
#include "input/haptic_hand.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace console {

namespace {

constexpr double part = 0.001;   // s, small against the period of mass and spring
constexpr double longest = 0.05; // s

double number(double value) { return std::isfinite(value) ? value : 0.0; }

} // namespace

void HapticHand::release() { *this = {}; }

double HapticHand::move(double wanted, double force, Instant now)
{
    const double past = m_last && now > *m_last ? std::min(seconds(now - *m_last), longest) : 0;
    m_last = now;
    const double aim = number(wanted) / 1000;
    const auto passive = [aim](double speed) { return std::clamp(speed, std::min(aim, 0.0), std::max(aim, 0.0)); };
    m_speed = passive(m_speed); // what was wanted before counts no more, though no time has passed
    for (double done = 0; done < past; done += part) {
        const double pull = stiffness * m_stretch + damping * (aim - m_speed) - number(force);
        m_speed = passive(m_speed + pull / mass * part);
        m_stretch += (aim - m_speed) * part;
    }
    return m_speed * 1000;
}

} // namespace console
