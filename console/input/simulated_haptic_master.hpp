// A haptic master without hardware: a simulated hand that feels what the robot feels.
#pragma once

#include "input/force_feedback.hpp"
#include "input/haptic_hand.hpp"
#include "input/master_device.hpp"

namespace console {

/// `intention`, the keyboard or a recording, says what the hand wants; the simulated hand moves the guidewire as it can against the force.
/// The path of the force is that of a real device; only the device is not there.
class SimulatedHapticMaster : public MasterDevice {
    Q_OBJECT
public:
    /// `intention` outlives this.
    explicit SimulatedHapticMaster(MasterDevice& intention, QObject* parent = nullptr);

    MasterKind kind() const override { return MasterKind::HapticSimulated; }
    QString name() const override { return word(kind()); }
    QString legend() const override { return m_intention.legend(); }
    MasterLife life(Instant now) const override { return m_intention.life(now); }
    bool borrowsDeadMan() const override { return true; }
    MasterReading read(Instant now) override;
    void rezero(Instant now) override;
    void requireRelease() override { m_hand.release(); }
    void feel(const RobotForce& force, Instant now) override { m_feedback.update(force, now); }
    std::optional<double> forceToHand() const override { return m_feedback.force(); }

protected:
    void listeningChanged() override { m_hand.release(); }

private:
    MasterDevice& m_intention;
    ForceFeedback m_feedback;
    HapticHand m_hand;
};

} // namespace console
