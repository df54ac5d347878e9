// The robot of the lab: implementation.
#include "device/robot_part.hpp"

#include "device/line_log.hpp"

#include <cmath>
#include <random>
#include <stdexcept>

namespace liena::lab {

using namespace devices;

namespace {

constexpr double wayLength = 1e7;   // mm: no limit is near, even after days of 20 mm/s
constexpr unsigned statusEvery = 5; // ticks

std::uint32_t randomPermit()
{
    std::random_device entropy;
    return (entropy() & 0x7FFFFFFFU) | 1U;
}

} // namespace

RobotPart::RobotPart(DistributedSystem& system) : m_system(system), m_gate(DriveLimits::forWay(wayLength)), m_machine(randomPermit())
{
    m_body.positions[0] = m_body.positions[2] = wayLength / 2;
    const auto subscribed = system.subscribe("PermitRequest", [this](const Message& message) { onPermitRequest(message); });
    const auto moved = system.subscribe("MotionCommand", [this](const Message& message) { onMotion(message); });
    if (!subscribed || !moved)
        throw std::runtime_error("the robot's message set lacks a command");
}

void RobotPart::handle(const SessionEvent& event)
{
    using Kind = SessionEvent::Kind;
    switch (event.kind) {
    case Kind::StateChanged:
        if (carriesMessages(event.to) && !carriesMessages(event.from))
            handle(SessionOpened{event.peer});
        else if (!carriesMessages(event.to) && carriesMessages(event.from))
            handle(SessionLost{event.peer});
        break;
    case Kind::Interrupted:
        handle(SessionLost{event.peer});
        handle(SessionOpened{event.peer});
        break;
    case Kind::Lost:
    case Kind::Closed:
        handle(SessionLost{event.peer});
        break;
    case Kind::StandByBegan:
        handle(StandByBegan{});
        break;
    case Kind::StandByEnded:
        handle(StandByEnded{});
        break;
    case Kind::LocalStall:
        handle(ProcessStalled{});
        break;
    default:
        break;
    }
}

bool RobotPart::handle(const RobotEvent& event, const MotionCommanded* motion)
{
    const auto now = std::chrono::steady_clock::now();
    const auto before = m_machine.state();
    const auto actions = m_machine.handle(event, now);
    actOnDrives(actions.drives, motion, now);
    if (actions.revokeControl)
        m_system.revokeControl();
    if (actions.confirmHold)
        m_system.confirmHold(*actions.confirmHold);
    if (m_machine.state() != before)
        tell({"robot", toString(m_machine.state()), m_machine.permit()});
    return actions.accepted;
}

void RobotPart::actOnDrives(RobotActions::Drives drives, const MotionCommanded* motion, SteadyTime now)
{
    using Drives = RobotActions::Drives;
    switch (drives) {
    case Drives::Leave:
        break;
    case Drives::Enable:
        m_gate.enable();
        break;
    case Drives::Drive:
        if (motion == nullptr || !m_gate.drive(motion->velocities, std::min(m_arrival, now), now))
            m_machine.countRefusal();
        else
            tell(now, {"applied", motion->permit, motion->sequence, m_arrival.time_since_epoch().count()});
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

void RobotPart::onPermitRequest(const Message& message)
{
    const auto permit = message.get<std::uint32_t>("permit");
    if (message.get<int>("request") == 1)
        handle(ArmRequested{message.origin(), permit});
    else
        handle(ReleaseRequested{message.origin(), permit});
}

void RobotPart::onMotion(const Message& message)
{
    const MotionCommanded motion{message.origin(),
                                 message.get<std::uint32_t>("permit"),
                                 message.get<std::uint32_t>("sequence"),
                                 message.get<bool>("engaged"),
                                 {message.get<double>("guidewire_velocity"), message.get<double>("guidewire_rotation"),
                                  message.get<double>("catheter_velocity"), message.get<double>("catheter_rotation")}};
    m_arrival = message.arrival();
    handle(motion, &motion);
}

void RobotPart::tick(SteadyTime now)
{
    control(now);
    if (++m_ticks % statusEvery == 0)
        publishStatus();
}

void RobotPart::control(SteadyTime now)
{
    const auto step = m_gate.step(now, m_body);
    for (std::size_t axis = 0; axis < axisCount; ++axis)
        m_body.positions[axis] += step.displacements[axis];
    const bool moving = !step.still || step.displacements[0] != 0;
    if (moving && !m_moving) {
        m_way = 0;
        tell(now, {"moves"});
    }
    m_way += step.displacements[0];
    if (!moving && m_moving)
        tell(now, {"still", std::llround(m_way * 1000)});
    m_moving = moving;
    handle(DrivesChecked{true, step.still});
    if (step.stop)
        handle(GateStopped{*step.stop});
    handle(Ticked{});
    handle(SwitchedOn{});
}

void RobotPart::publishStatus()
{
    auto status = m_system.report("RobotStatus").value();
    status.set("state", m_machine.state()).set("permit", m_machine.permit()).set("engaged", m_machine.engaged());
    status.set("owner", m_machine.owner().value_or(DeviceId()).value());
    status.set("hold_confirmed", m_machine.holdConfirmed()).set("last_sequence", m_machine.lastSequence());
    status.set("applied_commands", m_machine.appliedCommands()).set("refused_commands", m_machine.refusedCommands());
    m_system.publish(status);
}

} // namespace liena::lab
