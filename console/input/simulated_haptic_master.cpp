// From what the hand wants to what it can.
#include "input/simulated_haptic_master.hpp"

namespace console {

SimulatedHapticMaster::SimulatedHapticMaster(MasterDevice& intention, QObject* parent) : MasterDevice(parent), m_intention(intention) {}

MasterReading SimulatedHapticMaster::read(Instant now)
{
    auto reading = m_intention.read(now);
    if (!reading.alive || !reading.deadMan) {
        m_hand.release();
        reading.motion = {};
        return reading;
    }
    reading.motion.guidewireVelocity = m_hand.move(reading.motion.guidewireVelocity, m_feedback.force(), now);
    return reading;
}

void SimulatedHapticMaster::rezero(Instant) { m_hand.release(); }

} // namespace console
