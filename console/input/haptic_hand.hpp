// A simulated hand on a haptic master: a spring, a damper and a mass that the force to the hand pushes back. Pure.
#pragma once

#include "model/instant.hpp"

#include <optional>

namespace console {

/// The hand wants to move at some speed; its arm follows like a mass on a spring and a damper, and yields to the force. The handle's speed
/// is what is asked of the robot. That lies between rest and what the hand wants, always: the force can slow a hand down, and never moves
/// one, so that the loop through robot and hand gives energy to nobody.
class HapticHand {
public:
    static constexpr double mass = 0.2;        ///< kg
    static constexpr double stiffness = 300.0; ///< N/m
    static constexpr double damping = 16.0;    ///< N·s/m, about critical

    /// At rest, without tension.
    void release();

    /// mm/s of the handle, advance positive. `wanted` is in mm/s, `force` in N, against advance positive; what is no number is zero.
    double move(double wanted, double force, Instant now);

private:
    double m_stretch = 0; ///< m, of the spring: the wanted place ahead of the handle
    double m_speed = 0;   ///< m/s, of the handle
    std::optional<Instant> m_last;
};

} // namespace console
