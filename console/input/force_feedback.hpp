// The force that a hand is offered: the robot's, bounded and without a jump; none when the robot's is not to be felt. Pure.
#pragma once

#include "input/master_device.hpp"

#include <chrono>
#include <optional>

namespace console {

/// The first of two rules that keep a hand safe from its master: what is offered is small and never jumps. The second is HapticHand's.
class ForceFeedback {
public:
    static constexpr double most = 3.0;  ///< N
    static constexpr double rate = 20.0; ///< N/s, towards what the robot feels

    /// N/s, to nothing: the largest is gone in 75 ms. At once would be a jump, which a hand answers with a push.
    static constexpr double fade = 40.0;

    /// What is offered from now on. A force that is no number is none.
    double update(const RobotForce& robot, Instant now);

    double force() const { return m_force; } ///< N, against advance positive

private:
    double m_force = 0;
    std::optional<Instant> m_last;
};

} // namespace console
