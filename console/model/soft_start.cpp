// The ramp after an engage.
#include "model/soft_start.hpp"

#include <algorithm>

namespace console {

double softStart(Duration engagedFor)
{
    const double part = std::clamp(seconds(engagedFor) / seconds(softStartTime), 0.0, 1.0);
    return softStartShare + (1.0 - softStartShare) * part;
}

HandMotion scaled(const HandMotion& motion, double factor)
{
    return {motion.guidewireVelocity * factor, motion.guidewireRotation * factor, motion.catheterVelocity * factor,
            motion.catheterRotation * factor};
}

} // namespace console
