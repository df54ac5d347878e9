// The cockpit and the reporting devices of a simulated system.
#include "applications.hpp"

namespace liena::simulation {

using namespace std::chrono_literals;
using devices::RobotState;

Form::Form(std::shared_ptr<const MessageSet> set, std::string_view name) : m_message(set, *set->find(name)) {}

void CockpitPart::start(SimulatedDevice& device)
{
    m_device = &device;
    for (const auto& [peer, one] : device.modules()) {
        const auto kind = m_scenario.devices[peer].kind;
        const auto set = device.surroundings().setOf(peer);
        if (kind == DeviceKind::Robot) {
            m_robots.emplace(peer, Robot());
            m_motion.emplace(set, "MotionCommand");
            m_permit.emplace(set, "PermitRequest");
        } else if (kind == DeviceKind::Arm) {
            m_others.emplace(peer, Form(set, "ArmCommand"));
        } else if (kind == DeviceKind::Xray) {
            m_others.emplace(peer, Form(set, "AcquisitionCommand"));
        }
    }
    if (m_scenario.commandPeriod > 0ns)
        device.every(m_scenario.commandPeriod, [this] { command(); });
    if (m_scenario.statusPeriod <= 0ns)
        return;
    m_status.emplace(device.settings().set, "CockpitStatus");
    device.every(100ms, [this] {
        m_device->publish(m_status->message());
        for (auto& [peer, form] : m_others)
            m_device->module(peer)->send(form.message());
    });
}

void CockpitPart::heard(const SessionEvent& event)
{
    // The permission to move ends with the session; the surgeon lets go.
    if (event.kind == SessionEvent::Kind::StateChanged && !carriesMessages(event.to) && m_random.below(4) != 0)
        m_pressed = false;
}

void CockpitPart::delivered(HostIndex peer, const Message& message)
{
    const auto robot = m_robots.find(peer);
    if (robot == m_robots.end() || message.definition().number != 0x0200)
        return;
    robot->second.state = message.get<RobotState>(std::size_t{0});
    robot->second.permit = message.get<std::uint32_t>(std::size_t{1});
    robot->second.stop = message.get<std::uint64_t>("emergency_stop_token");
}

void CockpitPart::command()
{
    const auto now = m_device->now().mono;
    if (now >= m_nextPress) {
        m_pressed = m_random.below(3) != 0;
        m_nextPress = now + m_random.between(Nanoseconds(50ms), Nanoseconds(1500ms));
    }
    for (auto& [peer, robot] : m_robots)
        commandRobot(peer, robot);
}

void CockpitPart::commandRobot(HostIndex peer, Robot& robot)
{
    auto& module = *m_device->module(peer);
    if (!carriesMessages(module.state()))
        return;
    const bool armed = robot.state == RobotState::Armed || robot.state == RobotState::Engaged;
    if (!armed && m_device->now().mono >= robot.nextRequest)
        request(peer, robot);
    // A surgeon in haste presses before the robot has armed; it has to refuse that by itself.
    const bool engaged = m_pressed && (robot.neutralUnder == robot.permit || m_random.below(50) == 0);
    const double speed = engaged ? static_cast<double>(m_random.below(81)) - 40 : 0;
    m_motion->set("permit", robot.permit).set("sequence", ++robot.sequence).set("engaged", engaged);
    m_motion->set("guidewire_velocity", speed).set("guidewire_rotation", speed * 18);
    if (module.send(m_motion->message()) && !engaged)
        robot.neutralUnder = robot.permit;
}

void CockpitPart::request(HostIndex peer, Robot& robot)
{
    robot.nextRequest = m_device->now().mono + 100ms;
    auto& module = *m_device->module(peer);
    if (robot.stop != 0) {
        Form reset(m_device->surroundings().setOf(peer), "ResetEmergencyStop");
        module.send(reset.set("token", robot.stop).message());
    } else if (robot.state == RobotState::Ready) {
        module.send(m_permit->set("request", 1).set("permit", robot.permit).message());
        robot.sequence = 0;
    }
}

void ReportingPart::start(SimulatedDevice& device)
{
    const auto& set = device.settings().set;
    if (m_scenario.statusPeriod <= 0ns)
        return;
    m_status.emplace(set, set->find("ArmStatus") != nullptr ? "ArmStatus" : "AcquisitionStatus");
    device.every(100ms, [this, &device] { device.publish(m_status->message()); });
    if (set->find("XrayFrame") == nullptr || !m_scenario.pictures)
        return;
    m_picture.emplace(set, "XrayFrame");
    device.every(70ms, [this, &device] {
        const std::vector<std::byte> pixels(m_random.between(1, m_random.below(4) == 0 ? 120'000 : 20'000));
        device.publish(m_picture->set("pixels", std::span<const std::byte>(pixels)).message());
    });
}

std::unique_ptr<Application> applicationFor(const Scenario& scenario, HostIndex host, SeededRandom random)
{
    switch (scenario.devices[host].kind) {
    case DeviceKind::Robot:
        return std::make_unique<RobotPart>(scenario, static_cast<std::uint32_t>(random.between(1, 0x7FFFFFFF)));
    case DeviceKind::Cockpit:
        return std::make_unique<CockpitPart>(scenario, random);
    default:
        return std::make_unique<ReportingPart>(scenario, random);
    }
}

} // namespace liena::simulation
