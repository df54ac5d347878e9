// A robot's state machine with the clock of a test, and the events that happen to it by their names.
#pragma once

#include "robot_machine.hpp"

#include <QByteArray>
#include <QMetaType>
#include <QString>

#include <chrono>

namespace liena::test {

using namespace liena::devices;

inline const DeviceId cockpit(0x40018208);
inline const DeviceId otherCockpit(0x40018209);
inline const DeviceId arm(0x60008208);
inline constexpr SteadyTime start{std::chrono::hours(1)};
inline constexpr std::uint64_t stopToken = 77;

struct DrivenRobot {
    RobotMachine machine{100};
    SteadyTime now = start;
    std::uint32_t sequence = 0;

    RobotActions give(const RobotEvent& event) { return machine.handle(event, now); }
    RobotActions motion(bool engaged, double velocity = 0, DeviceId origin = cockpit)
    {
        return give(MotionCommanded{origin, machine.permit(), ++sequence, engaged, {velocity, 0, 0, 0}});
    }
    RobotActions arm(DeviceId origin = cockpit) { return give(ArmRequested{origin, machine.permit()}); }

    void wait(std::chrono::nanoseconds duration)
    {
        now += duration;
        give(Ticked{});
    }

    void bring(RobotState state)
    {
        if (state == RobotState::Off)
            return;
        give(SwitchedOn{});
        if (state == RobotState::Hold)
            return;
        give(SessionOpened{cockpit});
        wait(RobotMachine::leastHold);
        if (state == RobotState::EmergencyStop)
            give(EmergencyStopCommanded{cockpit, stopToken});
        if (state == RobotState::Fault)
            give(DrivesChecked{false, true});
        if (state == RobotState::Armed || state == RobotState::Engaged) {
            arm();
            motion(false);
        }
        if (state == RobotState::Engaged)
            motion(true, 5);
    }
};

inline QByteArray name(RobotState state)
{
    const auto text = toString(state);
    return QByteArray(text.data(), static_cast<qsizetype>(text.size()));
}

/// For a robot that stands in some state.
inline RobotEvent eventNamed(const QString& name, const DrivenRobot& robot)
{
    const std::uint32_t permit = robot.machine.permit();
    if (name == "arm")
        return ArmRequested{cockpit, permit};
    if (name == "arm by another")
        return ArmRequested{otherCockpit, permit};
    if (name == "arm, old permit")
        return ArmRequested{cockpit, permit - 1};
    if (name == "release")
        return ReleaseRequested{cockpit, permit};
    if (name == "neutral")
        return MotionCommanded{cockpit, permit, 1000, false, {}};
    if (name == "engaged")
        return MotionCommanded{cockpit, permit, 1000, true, {5, 0, 0, 0}};
    if (name == "engaged, old permit")
        return MotionCommanded{cockpit, permit - 1, 1000, true, {5, 0, 0, 0}};
    if (name == "engaged by another")
        return MotionCommanded{otherCockpit, permit, 1000, true, {5, 0, 0, 0}};
    if (name == "emergency stop")
        return EmergencyStopCommanded{cockpit, stopToken};
    if (name == "reset")
        return ResetCommanded{cockpit, stopToken};
    if (name == "reset, wrong token")
        return ResetCommanded{cockpit, stopToken + 1};
    if (name == "cockpit lost")
        return SessionLost{cockpit};
    if (name == "cockpit's session over")
        return SessionLost{cockpit, true};
    if (name == "arm's session over")
        return SessionLost{arm, true};
    if (name == "arm lost")
        return SessionLost{arm};
    if (name == "stand-by")
        return StandByBegan{};
    if (name == "stall")
        return ProcessStalled{};
    if (name == "force stop")
        return GateStopped{StopCause::ForceStop};
    if (name == "drive fault")
        return DrivesChecked{false, true};
    if (name == "drives well")
        return DrivesChecked{true, true};
    qFatal("no event");
}

} // namespace liena::test

Q_DECLARE_METATYPE(liena::devices::RobotState)
