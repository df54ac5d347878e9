// The robotic arm as a device: its machine on a DistributedSystem, linked to the robot it carries.
#pragma once

#include "arm_machine.hpp"
#include "patient_side.hpp"

#include "liena/distributed_system.hpp"

#include <memory>

namespace liena::devices {

/// Made before the system starts, outlives its run; everything but obey() runs on the network thread.
class ArmDevice {
public:
    /// An error when the device of the topology is no arm, or carries no robot.
    static Result<std::unique_ptr<ArmDevice>> create(DistributedSystem& system, LogSink log);

    /// Any thread: a line typed by the person beside the arm.
    void obey(std::string_view line) { m_patientSide.obey(line); }

private:
    ArmDevice(DistributedSystem& system, std::vector<DeviceId> robots, LogSink log);

    Result<void> subscribe();
    void onCommand(const Message& message);
    void onRobotStatus(const Message& message);
    void onEvent(const SessionEvent& event);
    void step();
    void publishStatus();

    DistributedSystem& m_system;
    LogSink m_log;
    std::vector<DeviceId> m_robots;
    ArmMachine m_machine;
    PatientSide m_patientSide;
    ArmState m_loggedState = ArmState::Hold;
    std::string_view m_lastRefusal;
    std::optional<bool> m_confirmed;
};

} // namespace liena::devices
