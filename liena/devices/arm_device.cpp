// The robotic arm as a device: implementation.
#include "arm_device.hpp"

#include <boost/outcome/try.hpp>

#include <algorithm>

namespace liena::devices {

ArmDevice::ArmDevice(DistributedSystem& system, std::vector<DeviceId> robots, LogSink log)
    : m_system(system), m_log(log), m_robots(robots), m_patientSide(system, log, robots, [this](std::string_view reason) {
          m_machine.lock("stop at the patient's side");
          m_patientSide.stopRobots(reason);
      })
{}

Result<std::unique_ptr<ArmDevice>> ArmDevice::create(DistributedSystem& system, LogSink log)
{
    if (!system.report("ArmStatus"))
        return fail(Errc::InvalidArgument, "device '" + system.self().name + "' is no robotic arm (message set '" +
                                               system.self().messageSet + "'); name one with --device");
    auto robots = PatientSide::linked(system, DeviceClass::Hand);
    if (robots.size() != 1)
        return fail(Errc::TopologyInvalid,
                    "the arm '" + system.self().name +
                        "' moves only while the robot it carries holds: link it to exactly one device of class hand");
    std::unique_ptr<ArmDevice> device(new ArmDevice(system, std::move(robots), std::move(log)));
    BOOST_OUTCOME_TRYV(device->subscribe());
    return device;
}

Result<void> ArmDevice::subscribe()
{
    BOOST_OUTCOME_TRYV(m_system.subscribe("ArmCommand", [this](const Message& message) { onCommand(message); }));
    BOOST_OUTCOME_TRYV(m_system.subscribe("RobotStatus", [this](const Message& message) { onRobotStatus(message); }));
    m_system.subscribe([this](const SessionEvent& event) { onEvent(event); });
    m_system.every(std::chrono::milliseconds(5), [this] { step(); });
    m_system.every(std::chrono::milliseconds(20), [this] { publishStatus(); });
    return ok();
}

void ArmDevice::onCommand(const Message& message)
{
    ArmRequest request{message.origin(), message.get<int>("request") == 1, {}, message.get<double>("speed_scale")};
    const auto targets = message.get<std::vector<double>>("targets");
    std::copy_n(targets.begin(), std::min(targets.size(), jointCount), request.targets.begin());
    const bool accepted = m_machine.command(request, message.arrival());
    // A stream of refused commands is one cause, and one line.
    if (!accepted && std::exchange(m_lastRefusal, m_machine.reason()) != m_machine.reason()) {
        m_log(LogLevel::Warning, "command refused: " + std::string(m_machine.reason()));
        m_system.audit("command-refused", {}, m_machine.reason());
    }
    if (accepted)
        m_lastRefusal = {};
}

void ArmDevice::onRobotStatus(const Message& message)
{
    if (std::find(m_robots.begin(), m_robots.end(), message.origin()) == m_robots.end())
        return;
    m_machine.robotNamesStop(message.get<std::uint64_t>("emergency_stop_token"));
    m_machine.robotReported(message.get<bool>("hold_confirmed"), message.arrival());
}

void ArmDevice::onEvent(const SessionEvent& event)
{
    using Kind = SessionEvent::Kind;
    switch (event.kind) {
    case Kind::StateChanged:
        if (carriesMessages(event.to))
            break;
        [[fallthrough]];
    case Kind::Interrupted:
    case Kind::Lost:
    case Kind::Closed:
        m_machine.sessionLost(event.peer);
        break;
    case Kind::StandByBegan:
        m_machine.setStandBy(true);
        break;
    case Kind::StandByEnded:
        m_machine.setStandBy(false);
        break;
    case Kind::LocalStall:
        m_machine.lock("this process did not run in time");
        break;
    default:
        break;
    }
}

void ArmDevice::step()
{
    m_machine.step(std::chrono::steady_clock::now());
    if (m_confirmed != m_machine.holding()) {
        m_confirmed = m_machine.holding();
        m_system.confirmHold(*m_confirmed);
    }
    if (std::exchange(m_loggedState, m_machine.state()) != m_machine.state())
        m_log(LogLevel::Info, m_machine.state() == ArmState::Moving ? std::string("moving") : "hold: " + std::string(m_machine.reason()));
}

void ArmDevice::publishStatus()
{
    const auto list = [](const Joints& joints, double most) {
        std::vector<double> values(joints.begin(), joints.end());
        for (double& value : values)
            value = std::clamp(value, -most, most);
        return values;
    };
    Message status = m_system.report("ArmStatus").value();
    status.set("positions", list(m_machine.positions(), 3.2)).set("velocities", list(m_machine.velocities(), 5));
    status.set("torques", list(m_machine.torques(), 500)).set("brake", m_machine.brake()).set("state", m_machine.state());
    status.set("holding", m_machine.holding()).set("refused_commands", m_machine.refusedCommands());
    m_system.publish(status);
}

} // namespace liena::devices
