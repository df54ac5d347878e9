// The robot's motion command as the console fills it in.
#pragma once

#include "model/motion_order.hpp"

#include <liena/message_binding.hpp>

namespace console {

/// MotionCommand.
struct MotionFields {
    quint32 permit = 0;
    quint32 sequence = 0;
    bool engaged = false;
    float guidewireVelocity = 0; ///< mm/s
    float guidewireRotation = 0; ///< deg/s
    float catheterVelocity = 0;
    float catheterRotation = 0;
};

/// To a robot's set; an error says how that set is another than this console knows. Fields that it has beside these keep their defaults.
using MotionBinding = liena::MessageBinding<
    MotionFields, liena::Bind<"permit", &MotionFields::permit>, liena::Bind<"sequence", &MotionFields::sequence>,
    liena::Bind<"engaged", &MotionFields::engaged>, liena::Bind<"guidewire_velocity", &MotionFields::guidewireVelocity>,
    liena::Bind<"guidewire_rotation", &MotionFields::guidewireRotation>, liena::Bind<"catheter_velocity", &MotionFields::catheterVelocity>,
    liena::Bind<"catheter_rotation", &MotionFields::catheterRotation>>;

inline MotionFields motionFields(const MotionOrder& order)
{
    return {.permit = order.permit,
            .sequence = order.sequence,
            .engaged = order.engaged,
            .guidewireVelocity = static_cast<float>(order.motion.guidewireVelocity),
            .guidewireRotation = static_cast<float>(order.motion.guidewireRotation),
            .catheterVelocity = static_cast<float>(order.motion.catheterVelocity),
            .catheterRotation = static_cast<float>(order.motion.catheterRotation)};
}

} // namespace console
