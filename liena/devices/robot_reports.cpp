// The vascular robot as a device: its reports.
#include "robot_device.hpp"

#include <algorithm>

namespace liena::devices {

namespace {

// A measured value at the edge of its field's bounds must not silence the whole report.
double within(double value, double low, double high) { return std::clamp(value, low, high); }
float floatWithin(double value, double low, double high) { return static_cast<float>(within(value, low, high)); }

} // namespace

std::uint16_t RobotDevice::limitSwitches() const
{
    constexpr double near = 0.01;
    unsigned bits = 0;
    const AxisValues positions = m_body.feedback().positions;
    for (const std::size_t axis : {std::size_t{0}, std::size_t{2}}) {
        const AxisEnvelope& envelope = m_gate.limits().axes[axis];
        const unsigned first = axis == 0 ? 0 : 4;
        const double position = positions[axis];
        bits |= (envelope.soft && position <= envelope.soft->low + near ? 1U : 0U) << first;
        bits |= (envelope.soft && position >= envelope.soft->high - near ? 1U : 0U) << (first + 1);
        bits |= (envelope.hard && position <= envelope.hard->low + near ? 1U : 0U) << (first + 2);
        bits |= (envelope.hard && position >= envelope.hard->high - near ? 1U : 0U) << (first + 3);
    }
    return static_cast<std::uint16_t>(bits);
}

void RobotDevice::publishStatus()
{
    const DriveFeedback body = m_body.feedback();
    const AxisValues& speed = m_body.velocities();
    const StatusFields fields{
        .state = m_machine.state(),
        .permit = m_machine.permit(),
        .owner = m_machine.owner().value_or(DeviceId()).value(),
        .engaged = m_machine.engaged(),
        .holdConfirmed = m_machine.holdConfirmed(),
        .holdSince = m_holdSince,
        .lastSequence = m_machine.lastSequence(),
        .appliedCommands = m_machine.appliedCommands(),
        .refusedCommands = m_machine.refusedCommands(),
        .guidewirePosition = floatWithin(body.positions[0], -10, 1600),
        .guidewireAngle = within(body.positions[1], -1e6, 1e6),
        .catheterPosition = floatWithin(body.positions[2], -10, 1600),
        .catheterAngle = within(body.positions[3], -1e6, 1e6),
        .guidewireVelocity = floatWithin(speed[0], -60, 60),
        .guidewireRotation = floatWithin(speed[1], -1000, 1000),
        .catheterVelocity = floatWithin(speed[2], -60, 60),
        .catheterRotation = floatWithin(speed[3], -1000, 1000),
        .guidewireForce = floatWithin(m_body.force(), -5, 5),
        .guidewireTorque = floatWithin(m_body.torque(), -50, 50),
        .guidewireGripperClosed = m_body.gripperClosed(Gripper::Guidewire),
        .catheterGripperClosed = m_body.gripperClosed(Gripper::Catheter),
        .limitSwitches = limitSwitches(),
        .contrastRemaining = floatWithin(m_injector.remaining(), 0, 500),
        .emergencyStopToken = m_machine.emergencyStopToken(),
        .fault = m_machine.fault(),
        .clearance = m_machine.clearance(),
    };
    Message status = m_system.report("RobotStatus").value();
    m_bindings.status.write(fields, status); // one with a value that is refused is not published
    m_system.publish(std::move(status));
}

void RobotDevice::publishDrives()
{
    Message status = m_system.report("DriveStatus").value();
    std::vector<double> enabled(axisCount), current(axisCount), temperature(axisCount), error(axisCount), voltage(axisCount);
    for (std::size_t axis = 0; axis < axisCount; ++axis) {
        const DriveReading reading = m_body.drive(static_cast<Axis>(axis));
        enabled[axis] = m_gate.enabled() ? 1 : 0;
        current[axis] = within(reading.current, -10, 10);
        temperature[axis] = within(reading.temperature, -20, 150);
        error[axis] = within(reading.followingError, -1000, 1000);
        voltage[axis] = within(reading.busVoltage, 0, 60);
    }
    status.set("enabled", enabled).set("current", current).set("temperature", temperature);
    status.set("following_error", error).set("bus_voltage", voltage);
    m_system.publish(status);
}

void RobotDevice::publishTip()
{
    const TipReading reading = m_body.tip();
    Message pose = m_system.report("TipPose").value();
    const std::vector<double> quaternion(reading.quaternion.begin(), reading.quaternion.end());
    pose.set("valid", reading.valid).set("quaternion", quaternion).set("error", reading.error);
    pose.set("position", std::vector<double>{reading.position.x, reading.position.y, reading.position.z});
    m_system.publish(pose);
}

void RobotDevice::publishTravelLimits()
{
    Message limits = m_system.report("TravelLimits").value();
    const auto set = [&limits](std::string_view field, const AxisRange& range) {
        limits.set(field, std::vector<double>{within(range.low, -10, 1600), within(range.high, -10, 1600)});
    };
    const auto& axes = m_gate.limits().axes;
    set("guidewire_soft", axes[0].soft.value());
    set("guidewire_hard", axes[0].hard.value());
    set("catheter_soft", axes[2].soft.value());
    set("catheter_hard", axes[2].hard.value());
    m_system.publish(limits);
}

void RobotDevice::publish(const InjectionAnswer& answer)
{
    Message report = m_system.report("InjectionReport").value();
    report.set("injection", answer.number).set("delivered", within(answer.delivered, 0, 30)).set("state", answer.state);
    report.set("reason", std::string_view(answer.reason).substr(0, 128));
    m_system.publish(report);
    if (answer.state == InjectionState::Refused || answer.state == InjectionState::Stopped)
        m_log(LogLevel::Warning, "injection " + std::to_string(answer.number) + ": " + answer.reason);
}

} // namespace liena::devices
