// Bounds and rates of the offered force.
#include "input/force_feedback.hpp"

#include <algorithm>
#include <cmath>

namespace console {

namespace {

/// After a gap the force rises no further than in one run of the loop.
constexpr double longestRise = 0.02; // s

} // namespace

double ForceFeedback::update(const RobotForce& robot, Instant now)
{
    const double past = m_last && now > *m_last ? seconds(now - *m_last) : 0;
    m_last = now;
    const bool given = robot.given && std::isfinite(robot.force);
    const double wanted = given ? std::clamp(robot.force, -most, most) : 0;
    const double step = given ? rate * std::min(past, longestRise) : fade * past;
    m_force += std::clamp(wanted - m_force, -step, step);
    return m_force;
}

} // namespace console
