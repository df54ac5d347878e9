// The vascular robot's frequent messages as structures of C++, bound to its message set once: when the device is made.
#pragma once

#include "robot_machine.hpp"

#include "liena/message_binding.hpp"

#include <cstdint>
#include <memory>
#include <utility>

namespace liena::devices {

/// MotionCommand.
struct MotionFields {
    std::uint32_t permit = 0;
    std::uint32_t sequence = 0;
    bool engaged = false;
    float guidewireVelocity = 0; ///< mm/s
    float guidewireRotation = 0; ///< deg/s
    float catheterVelocity = 0;
    float catheterRotation = 0;
};

using MotionBinding =
    MessageBinding<MotionFields, Bind<"permit", &MotionFields::permit>, Bind<"sequence", &MotionFields::sequence>,
                   Bind<"engaged", &MotionFields::engaged>, Bind<"guidewire_velocity", &MotionFields::guidewireVelocity>,
                   Bind<"guidewire_rotation", &MotionFields::guidewireRotation>, Bind<"catheter_velocity", &MotionFields::catheterVelocity>,
                   Bind<"catheter_rotation", &MotionFields::catheterRotation>>;

/// RobotStatus.
struct StatusFields {
    RobotState state = RobotState::Off;
    std::uint32_t permit = 0;
    std::uint32_t owner = 0; ///< 0: nobody
    bool engaged = false;
    bool holdConfirmed = false;
    std::uint64_t holdSince = 0; ///< ns, Unix time
    std::uint32_t lastSequence = 0;
    std::uint64_t appliedCommands = 0;
    std::uint64_t refusedCommands = 0;
    float guidewirePosition = 0; ///< mm
    double guidewireAngle = 0;   ///< deg
    float catheterPosition = 0;
    double catheterAngle = 0;
    float guidewireVelocity = 0; ///< mm/s
    float guidewireRotation = 0; ///< deg/s
    float catheterVelocity = 0;
    float catheterRotation = 0;
    float guidewireForce = 0;  ///< N
    float guidewireTorque = 0; ///< mN·m
    bool guidewireGripperClosed = false;
    bool catheterGripperClosed = false;
    std::uint16_t limitSwitches = 0;
    float contrastRemaining = 0; ///< mL
    std::uint64_t emergencyStopToken = 0;
    RobotFault fault = RobotFault::None;
    Clearance clearance = Clearance::NotAsked;
};

using StatusBinding = MessageBinding<
    StatusFields, Bind<"state", &StatusFields::state>, Bind<"permit", &StatusFields::permit>, Bind<"owner", &StatusFields::owner>,
    Bind<"engaged", &StatusFields::engaged>, Bind<"hold_confirmed", &StatusFields::holdConfirmed>,
    Bind<"hold_since_ns", &StatusFields::holdSince>, Bind<"last_sequence", &StatusFields::lastSequence>,
    Bind<"applied_commands", &StatusFields::appliedCommands>, Bind<"refused_commands", &StatusFields::refusedCommands>,
    Bind<"guidewire_position", &StatusFields::guidewirePosition>, Bind<"guidewire_angle", &StatusFields::guidewireAngle>,
    Bind<"catheter_position", &StatusFields::catheterPosition>, Bind<"catheter_angle", &StatusFields::catheterAngle>,
    Bind<"guidewire_velocity", &StatusFields::guidewireVelocity>, Bind<"guidewire_rotation", &StatusFields::guidewireRotation>,
    Bind<"catheter_velocity", &StatusFields::catheterVelocity>, Bind<"catheter_rotation", &StatusFields::catheterRotation>,
    Bind<"guidewire_force", &StatusFields::guidewireForce>, Bind<"guidewire_torque", &StatusFields::guidewireTorque>,
    Bind<"guidewire_gripper_closed", &StatusFields::guidewireGripperClosed>,
    Bind<"catheter_gripper_closed", &StatusFields::catheterGripperClosed>, Bind<"limit_switches", &StatusFields::limitSwitches>,
    Bind<"contrast_remaining", &StatusFields::contrastRemaining>, Bind<"emergency_stop_token", &StatusFields::emergencyStopToken>,
    Bind<"fault_code", &StatusFields::fault>, Bind<"clear_to_arm", &StatusFields::clearance>>;

struct RobotBindings {
    MotionBinding motion;
    StatusBinding status;

    /// Of the robot's own set; an error names the message, the field and the remedy.
    static Result<RobotBindings> to(const std::shared_ptr<const MessageSet>& set)
    {
        auto motion = MotionBinding::to(set, "MotionCommand");
        if (!motion)
            return motion.as_failure();
        auto status = StatusBinding::to(set, "RobotStatus");
        if (!status)
            return status.as_failure();
        return RobotBindings{std::move(motion).value(), std::move(status).value()};
    }
};

} // namespace liena::devices
