// Scale, limits, and no catch-up.
#include "input/hand_scale.hpp"

#include "model/soft_start.hpp"

#include <algorithm>
#include <cmath>

namespace console {

namespace {

/// A number that is none moves nothing.
double within(double value, double limit) { return std::isfinite(value) ? std::clamp(value, -limit, limit) : 0.0; }

} // namespace

HandMotion limited(const HandMotion& motion, const MotionLimits& limits)
{
    return {within(motion.guidewireVelocity, limits.velocity), within(motion.guidewireRotation, limits.guidewireRotation),
            within(motion.catheterVelocity, limits.velocity), within(motion.catheterRotation, limits.catheterRotation)};
}

double nextScale(double current, double wanted, bool engaged)
{
    if (!std::isfinite(wanted))
        return current;
    const double bounded = std::clamp(wanted, smallestScale, largestScale);
    return engaged ? std::min(current, bounded) : bounded;
}

HandMotion askedMotion(const HandMotion& hand, double scale, bool deadMan, bool clutch)
{
    if (!deadMan || clutch)
        return {};
    return limited(scaled(hand, scale));
}

PositionTracker::Position PositionTracker::velocity(const Position& position, Instant now)
{
    Position result{};
    if (m_last && now > m_last->at)
        for (std::size_t axis = 0; axis < result.size(); ++axis)
            result[axis] = (position[axis] - m_last->position[axis]) / seconds(now - m_last->at);
    m_last = Sample{position, now};
    return result;
}

} // namespace console
