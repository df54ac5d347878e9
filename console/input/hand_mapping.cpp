// Dead zone, scale, hysteresis.
#include "input/hand_mapping.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace console {

std::optional<double> deflection(double raw, const AxisShape& shape)
{
    const bool sound = std::isfinite(shape.fullScale) && shape.fullScale > 0 && shape.deadZone >= 0 && shape.deadZone < 1;
    if (!sound || !std::isfinite(raw))
        return std::nullopt;
    const double part = std::clamp(raw / shape.fullScale, -1.0, 1.0);
    const double beyond = std::abs(part) - shape.deadZone;
    return beyond > 0 ? std::copysign(beyond / (1 - shape.deadZone), part) : 0.0;
}

MappedMotion mapped(const HandAxes& axes, const AxisShape& shape, const HandSpeeds& speeds, Coupling coupling)
{
    std::array<double, 4> part{};
    const std::array raw{axes.guidewireAdvance, axes.guidewireTurn, axes.catheterAdvance, axes.catheterTurn};
    for (std::size_t axis = 0; axis < raw.size(); ++axis) {
        const auto value = deflection(raw[axis], shape);
        if (!value)
            return {};
        part[axis] = *value;
    }
    MappedMotion result;
    result.atRest = std::all_of(part.begin(), part.end(), [](double value) { return value == 0; });
    if (coupling == Coupling::Larger) {
        const bool guidewire = std::hypot(part[0], part[1]) >= std::hypot(part[2], part[3]);
        part[guidewire ? 2 : 0] = 0;
        part[guidewire ? 3 : 1] = 0;
    }
    result.motion = {part[0] * speeds.guidewireVelocity, part[1] * speeds.guidewireRotation, part[2] * speeds.catheterVelocity,
                     part[3] * speeds.catheterRotation};
    return result;
}

bool TriggerButton::update(double value)
{
    if (!std::isfinite(value) || value < releasedBelow)
        m_pressed = false;
    else if (value > pressedAbove)
        m_pressed = true;
    return m_pressed;
}

} // namespace console
