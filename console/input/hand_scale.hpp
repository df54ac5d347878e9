// From the hand to the robot: scale, limits, and no catch-up.
#pragma once

#include "model/hand_state.hpp"
#include "model/instant.hpp"

#include <array>
#include <optional>

namespace console {

/// The bounds of the robot's MotionCommand.
struct MotionLimits {
    double velocity = 40;           ///< mm/s, guidewire and catheter
    double guidewireRotation = 720; ///< deg/s
    double catheterRotation = 360;
};

HandMotion limited(const HandMotion& motion, const MotionLimits& limits = {});

inline constexpr double smallestScale = 0.1;
inline constexpr double largestScale = 2.0;

/// The scale after a wish: within its bounds, and never raised while engaged.
double nextScale(double current, double wanted, bool engaged);

/// What the robot is asked for: nothing while the clutch is pressed or the dead-man is not.
HandMotion askedMotion(const HandMotion& hand, double scale, bool deadMan, bool clutch);

/// Turns a hand's positions into velocities by their differences, so that where the hand was while it did not count never matters.
class PositionTracker {
public:
    using Position = std::array<double, 3>;

    /// Forgets where the hand was: the next velocity is zero.
    void rezero() { m_last.reset(); }

    /// Units of the position per second since the last call.
    Position velocity(const Position& position, Instant now);

private:
    struct Sample {
        Position position{};
        Instant at;
    };
    std::optional<Sample> m_last;
};

} // namespace console
