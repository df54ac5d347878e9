// From a device's axes and triggers to the motion of a hand: dead zone, scale, hysteresis. Pure.
#pragma once

#include "model/hand_state.hpp"

#include <optional>

namespace console {

/// The speeds of a hand at full deflection, or of a key, at scale 1.
struct HandSpeeds {
    double guidewireVelocity = 10;  ///< mm/s
    double guidewireRotation = 180; ///< deg/s
    double catheterVelocity = 5;
    double catheterRotation = 90;
};

/// The four deflections that move something, in the device's units; advance and clockwise positive.
struct HandAxes {
    double guidewireAdvance = 0;
    double guidewireTurn = 0;
    double catheterAdvance = 0;
    double catheterTurn = 0;
};

struct AxisShape {
    double fullScale = 1;  ///< in the device's units; what is beyond counts as full
    double deadZone = 0.1; ///< part of the full scale around zero that is rest
};

/// 0 in the dead zone, growing evenly from its edge to ±1 at full scale. Nothing for what is no number, or for a shape that is none.
std::optional<double> deflection(double raw, const AxisShape& shape);

/// Which instruments may move at once.
enum class Coupling {
    Both,
    Larger, ///< the one that is deflected further alone: for a hand that cannot push without tilting
};

struct MappedMotion {
    HandMotion motion;
    bool atRest = false; ///< every axis is in its dead zone

    bool operator==(const MappedMotion&) const = default;
};

/// One axis that is no number spoils them all: no motion, and not at rest.
MappedMotion mapped(const HandAxes& axes, const AxisShape& shape, const HandSpeeds& speeds, Coupling coupling);

/// A trigger as a button: pressed above one value, let go below a smaller one, so that it does not chatter between them.
class TriggerButton {
public:
    static constexpr double pressedAbove = 0.6;
    static constexpr double releasedBelow = 0.4;

    /// `value` from 0, let go, to 1. What is no number counts as let go.
    bool update(double value);
    bool pressed() const { return m_pressed; }

private:
    bool m_pressed = false;
};

} // namespace console
