// The vascular robot as a device: its machine, gate and simulated body on a DistributedSystem.
#pragma once

#include "contrast_injector.hpp"
#include "patient_side.hpp"
#include "robot_machine.hpp"
#include "robot_messages.hpp"
#include "robot_simulation.hpp"

#include "liena/distributed_system.hpp"

#include <memory>

namespace liena::devices {

struct RobotOptions {
    std::optional<double> start; ///< mm along the way; absent: two thirds of it
    std::uint64_t seed = 1;
    ArmingRule arming = ArmingRule::OnePerson;
};

/// Made before the system starts, outlives its run; everything but obey() runs on the network thread.
class RobotDevice {
public:
    /// An error when the device of the topology is no vascular robot, or its message set does not fit (RobotBindings).
    static Result<std::unique_ptr<RobotDevice>> create(DistributedSystem& system, const VesselTree& tree, const RobotOptions& options,
                                                       LogSink log);

    /// Any thread: a line typed by the person beside the robot.
    void obey(std::string_view line) { m_patientSide.obey(line); }

private:
    RobotDevice(DistributedSystem& system, RobotBindings bindings, const VesselTree& tree, const RobotOptions& options, LogSink log);

    Result<void> subscribe();
    void onEvent(const SessionEvent& event);
    void onPermitRequest(const Message& message);
    void onMotion(const Message& message);
    void onGripper(const Message& message);
    void onInjection(const Message& message);
    void onEmergencyStop(const Message& message);
    void onReset(const Message& message);

    /// Gives the event to the machine and does what it says; `motion` is what a Drive action applies.
    bool handle(const RobotEvent& event, const MotionCommanded* motion = nullptr);
    void sayRefusal(std::string_view reason);
    void actOnDrives(RobotActions::Drives drives, const MotionCommanded* motion, SteadyTime now);
    void control();
    void stopLocally(std::string_view reason);
    void sayClearance(bool given);
    std::string describe() const; ///< for `status`
    void publishStatus();
    void publishDrives();
    void publishTip();
    void publishTravelLimits();
    void publish(const InjectionAnswer& answer);
    std::uint16_t limitSwitches() const;

    DistributedSystem& m_system;
    RobotBindings m_bindings;
    LogSink m_log;
    DriveGate m_gate;
    RobotMachine m_machine;
    RobotSimulation m_body;
    ContrastInjector m_injector;
    PatientSide m_patientSide;
    SteadyTime m_lastControl;
    SteadyTime m_commanded; ///< arrival of the motion command in hand
    std::uint64_t m_holdSince = 0;
    std::string_view m_lastRefusal;
};

} // namespace liena::devices
