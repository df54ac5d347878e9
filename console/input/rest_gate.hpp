// Lets a hand count only after it was seen let go and at rest. Pure.
#pragma once

#include "model/hand_state.hpp"

namespace console {

/// What the buttons and axes of a device say at one moment.
struct HandControls {
    bool deadMan = false;
    bool clutch = false;
    bool arm = false;
    HandMotion motion;
    bool axesAtRest = true;

    bool letGo() const { return !deadMan && !arm && axesAtRest; }
};

/// A button that is held or an axis that is stuck when a device comes must not move anything.
class RestGate {
public:
    /// Nothing counts until the hand was seen let go.
    void close();

    /// Motion alone does not count until the axes were seen at rest; on each engage.
    void stillMotion() { m_rested = false; }

    bool open() const { return m_open; }

    /// What of it counts.
    HandControls pass(const HandControls& controls);

private:
    bool m_open = false;
    bool m_rested = false;
};

} // namespace console
