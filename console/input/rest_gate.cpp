// When a hand begins to count.
#include "input/rest_gate.hpp"

namespace console {

void RestGate::close()
{
    m_open = false;
    m_rested = false;
}

HandControls RestGate::pass(const HandControls& controls)
{
    m_rested = m_rested || controls.axesAtRest;
    m_open = m_open || controls.letGo();
    if (!m_open)
        return {};
    HandControls counted = controls;
    if (!m_rested)
        counted.motion = {};
    return counted;
}

} // namespace console
