// The robot of a simulated system: what RobotDevice does, in virtual time.
#include "applications.hpp"

#include <algorithm>
#include <cmath>

namespace liena::simulation {

using namespace std::chrono_literals;
using namespace liena::devices;

RobotPart::RobotPart(const Scenario& scenario, std::uint32_t firstPermit)
    : m_scenario(scenario), m_gate(DriveLimits::forWay(1000)), m_machine(firstPermit)
{}

void RobotPart::start(SimulatedDevice& device)
{
    m_device = &device;
    if (m_scenario.commandPeriod > 0ns)
        device.every(2ms, [this] { control(); });
    if (m_scenario.statusPeriod <= 0ns)
        return;
    m_status.emplace(device.settings().set, "RobotStatus");
    device.every(m_scenario.statusPeriod, [this] { publishStatus(); });
}

void RobotPart::heard(const SessionEvent& event)
{
    using Kind = SessionEvent::Kind;
    const bool deaf = m_device->settings().mutant == Mutant::LeaseNotCleared;
    switch (event.kind) {
    case Kind::StateChanged:
        if (carriesMessages(event.to) && !carriesMessages(event.from))
            handle(devices::SessionOpened{event.peer});
        else if (!carriesMessages(event.to) && carriesMessages(event.from) && !deaf)
            handle(devices::SessionLost{event.peer});
        break;
    case Kind::Interrupted:
        if (!deaf)
            handle(devices::SessionLost{event.peer});
        handle(devices::SessionOpened{event.peer});
        break;
    case Kind::Lost:
    case Kind::Closed:
        if (!deaf)
            handle(devices::SessionLost{event.peer});
        break;
    case Kind::StandByBegan:
        if (!deaf)
            handle(devices::StandByBegan{});
        break;
    case Kind::StandByEnded:
        handle(devices::StandByEnded{});
        break;
    case Kind::LocalStall:
        if (!deaf)
            handle(devices::ProcessStalled{});
        break;
    default:
        break;
    }
}

bool RobotPart::handle(const RobotEvent& event, const MotionCommanded* motion)
{
    const auto actions = m_machine.handle(event, m_device->now().mono);
    actOnDrives(actions.drives, motion);
    if (actions.revokeControl)
        m_device->revokeControl();
    if (actions.confirmHold)
        m_device->confirmHold(*actions.confirmHold);
    return actions.accepted;
}

void RobotPart::actOnDrives(RobotActions::Drives drives, const MotionCommanded* motion)
{
    using Drives = RobotActions::Drives;
    switch (drives) {
    case Drives::Leave:
        break;
    case Drives::Enable:
        m_gate.enable();
        break;
    case Drives::Drive:
        if (const auto now = m_device->now().mono; motion != nullptr && !m_gate.drive(motion->velocities, std::min(m_commanded, now), now))
            m_machine.countRefusal();
        break;
    case Drives::Release:
        m_gate.release();
        break;
    case Drives::Stop:
        m_gate.stop();
        break;
    case Drives::Cut:
        m_gate.cut();
        break;
    }
}

void RobotPart::control()
{
    const auto now = m_device->now().mono;
    const auto step = m_gate.step(now, {m_positions, 0});
    observeDrives(step, m_lastControl ? now - *m_lastControl : 0ns);
    m_lastControl = now;
    for (std::size_t axis = 0; axis < axisCount; ++axis)
        m_positions[axis] += step.displacements[axis];
    handle(DrivesChecked{true, step.still});
    if (step.stop)
        handle(GateStopped{*step.stop});
    handle(Ticked{});
    handle(SwitchedOn{});
}

/// With limits of its own, not those that the gate was given.
void RobotPart::observeDrives(const DriveStep& step, Nanoseconds passed)
{
    constexpr AxisValues fastest{40, 720, 40, 360};
    constexpr double rounding = 1 + 1e-9;
    const double seconds = static_cast<double>(passed.count()) / 1e9;
    Drove drove{m_device->host()};
    for (std::size_t axis = 0; axis < axisCount; ++axis) {
        const auto speed = std::abs(step.velocities[axis]);
        const auto way = std::abs(step.displacements[axis]);
        drove.moving = drove.moving || speed > 0 || way > 0;
        drove.faster = drove.faster || speed > std::abs(m_velocities[axis]);
        drove.withinEnvelope = drove.withinEnvelope && speed <= fastest[axis] * rounding && way <= fastest[axis] * seconds * rounding;
    }
    drove.passed = passed;
    m_velocities = step.velocities;
    if (drove.moving || m_wasMoving)
        m_device->observe(drove);
    m_wasMoving = drove.moving;
}

void RobotPart::publishStatus()
{
    m_status->set("state", static_cast<unsigned>(m_machine.state())).set("permit", m_machine.permit()).set("engaged", m_machine.engaged());
    m_status->set("owner", m_machine.owner().value_or(DeviceId()).value());
    m_status->set("hold_confirmed", m_machine.holdConfirmed()).set("last_sequence", m_machine.lastSequence());
    m_status->set("emergency_stop_token", m_machine.emergencyStopToken());
    m_device->publish(m_status->message());
}

void RobotPart::onMotion(HostIndex peer, const Message& message)
{
    const MotionCommanded motion{message.origin(),
                                 message.get<std::uint32_t>(std::size_t{0}),
                                 message.get<std::uint32_t>(std::size_t{1}),
                                 message.get<bool>(std::size_t{2}),
                                 {message.get<double>(std::size_t{3}), message.get<double>(std::size_t{4}),
                                  message.get<double>(std::size_t{5}), message.get<double>(std::size_t{6})}};
    m_commanded = message.arrival();
    if (handle(motion, &motion))
        m_device->observe(Applied{m_device->host(), peer, {message.origin().value(), 0x0101, message.timestamp().ns}, motion.engaged});
}

void RobotPart::delivered(HostIndex peer, const Message& message)
{
    switch (message.definition().number) {
    case 0x0100: {
        const auto permit = message.get<std::uint32_t>(std::size_t{1});
        if (message.get<int>(std::size_t{0}) == 1)
            handle(ArmRequested{message.origin(), permit});
        else
            handle(ReleaseRequested{message.origin(), permit});
        break;
    }
    case 0x0101:
        onMotion(peer, message);
        break;
    case 0x0102:
        handle(InjectionCommanded{message.origin(), message.get<std::uint32_t>(std::size_t{0})});
        break;
    case 0x0103:
        handle(GripperCommanded{message.origin(), message.get<std::uint32_t>(std::size_t{0})});
        break;
    case 0x0104:
        handle(EmergencyStopCommanded{message.origin(), message.get<std::uint64_t>(std::size_t{0})});
        break;
    case 0x0105:
        handle(ResetCommanded{message.origin(), message.get<std::uint64_t>(std::size_t{0})});
        break;
    default:
        break;
    }
}

} // namespace liena::simulation
