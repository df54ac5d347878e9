// The robot of the lab: the product's state machine and drive gate, and drives that go wherever they are told.
#pragma once

#include "device/device_part.hpp"

#include "drive_gate.hpp"
#include "robot_machine.hpp"

namespace liena::lab {

/// Tells the runner: `applied <permit> <sequence> <arrival ns>` for each command that the gate took, `moves` and `still <µm>` with the
/// way since `moves`, and `robot <state> <permit>`.
class RobotPart : public DevicePart {
public:
    explicit RobotPart(DistributedSystem& system);

    void handle(const SessionEvent& event) override;
    void tick(devices::SteadyTime now) override;

private:
    bool handle(const devices::RobotEvent& event, const devices::MotionCommanded* motion = nullptr);
    void actOnDrives(devices::RobotActions::Drives drives, const devices::MotionCommanded* motion, devices::SteadyTime now);
    void onPermitRequest(const Message& message);
    void onMotion(const Message& message);
    void control(devices::SteadyTime now);
    void publishStatus();

    DistributedSystem& m_system;
    devices::DriveGate m_gate;
    devices::RobotMachine m_machine;
    devices::DriveFeedback m_body;
    devices::SteadyTime m_arrival; ///< of the motion command in hand
    double m_way = 0;              ///< mm since the drives began to move
    bool m_moving = false;
    unsigned m_ticks = 0;
};

} // namespace liena::lab
