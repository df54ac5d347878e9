// How injected contrast travels with the blood.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>

namespace liena::devices {

/// Plug flow with dispersion: what left the catheter some time ago is now so much farther, and smeared. Pure.
class ContrastFlow {
public:
    /// The flow out of the catheter from `time` on, in ml/s. Times never run back.
    void observe(std::chrono::nanoseconds time, double flow);

    /// The same after a time in which nobody looked: what flowed meanwhile is not known, and taken for no more than before it and now.
    void observeAfterPause(std::chrono::nanoseconds time, double flow);

    /// The part of contrast in the blood, 0 to 1, `distance` mm behind the catheter's tip at the last observed time.
    double concentration(double distance) const;

    /// Some contrast may still be in the vessels.
    bool present() const;

private:
    struct Step {
        double time = 0;   ///< s
        double flow = 0;   ///< ml/s from here on
        double amount = 0; ///< ml until here
    };

    double amountAt(double time) const;

    std::deque<Step> m_steps; ///< the last `memory` seconds
};

} // namespace liena::devices
