// The cockpit of the lab: implementation.
#include "device/cockpit_part.hpp"

#include "device/line_log.hpp"
#include "device/picture.hpp"

#include <stdexcept>
#include <utility>

namespace liena::lab {

namespace {

constexpr int armedState = 3;
constexpr unsigned neutralCommands = 25;
constexpr double speed = 20; // mm/s

} // namespace

CockpitPart::CockpitPart(DistributedSystem& system, Options options) : m_system(system)
{
    if (!system.subscribe("RobotStatus", [this](const Message& message) { onRobotStatus(message); }))
        throw std::runtime_error("a cockpit needs a link to a robot");
    if (!options.hoardsPictures) // without an X-ray system in the topology there is nothing to subscribe to
        (void)system.subscribe("XrayFrame", [this](const Message& message) { onPicture(message); });
}

void CockpitPart::onRobotStatus(const Message& message)
{
    Robot& robot = m_robots[message.origin()];
    const Robot now{message.get<int>("state"), message.get<std::uint32_t>("permit")};
    if (now.state != robot.state || now.permit != robot.permit)
        tell({"heard", m_system.topology().find(message.origin())->name, message.get<std::string_view>("state"), now.permit});
    robot = now;
    const bool mine = message.get<std::uint32_t>("owner") == m_system.self().id.value();
    if (m_asked != 0 && message.origin() == m_target && now.permit == m_asked && now.state == armedState && mine) {
        m_permit = m_asked;
        m_asked = 0;
        m_sequence = 0;
        m_neutral = neutralCommands;
    }
}

void CockpitPart::onPicture(const Message& message)
{
    const auto frame = message.get<std::uint32_t>("frame");
    const auto pixels = message.get<std::span<const std::byte>>("pixels");
    const bool whole = m_press > 0 || isPictureOf(frame, pixels);
    tell({"picture", frame, whole ? "whole" : "torn", message.get<unsigned>("rung"), pixels.size()});
}

bool CockpitPart::obey(const std::string& verb, std::istringstream& rest)
{
    if (verb == "lift")
        m_permit = m_asked = 0;
    std::string name;
    return verb == "lift" || (verb == "arm" && rest >> name && arm(name)) || (verb == "pedal" && rest >> name && press(name));
}

bool CockpitPart::press(const std::string& name)
{
    const auto* xray = m_system.topology().find(name);
    if (xray == nullptr && name != "up")
        return false;
    m_xray = xray != nullptr ? std::optional(xray->id) : std::nullopt;
    m_press += m_xray ? 1 : 0;
    m_begins = m_xray.has_value();
    return true;
}

void CockpitPart::repeatPedal(std::chrono::steady_clock::time_point now)
{
    constexpr std::chrono::milliseconds period{50};
    if (!m_xray || now < m_nextPedal)
        return;
    m_nextPedal = now + period;
    auto message = m_system.command(*m_xray, "AcquisitionCommand");
    if (!message)
        return;
    const bool down = !std::exchange(m_begins, false);
    message.value().set("mode", down ? 1 : 0).set("pulse_rate", 15.0).set("pedal", down).set("press", down ? m_press : m_press - 1);
    (void)m_system.send(*m_xray, std::move(message.value()));
}

bool CockpitPart::arm(const std::string& name)
{
    const auto* robot = m_system.topology().find(name);
    if (robot == nullptr)
        return false;
    m_target = robot->id;
    m_permit = 0;
    m_asked = m_robots[m_target].permit;
    auto request = m_system.command(m_target, "PermitRequest");
    if (!request)
        return true; // its set is not known yet
    request.value().set("request", 1).set("permit", m_asked);
    if (const auto sent = m_system.send(m_target, std::move(request.value())); !sent)
        tell({"refused", toString(sent.error().code)});
    return true;
}

void CockpitPart::command(bool engaged)
{
    auto message = m_system.command(m_target, "MotionCommand");
    if (!message)
        return;
    message.value().set("permit", m_permit).set("sequence", m_sequence).set("engaged", engaged);
    message.value().set("guidewire_velocity", engaged ? speed : 0.0);
    // Told before it is sent: what the robot applies must stand in this log even if this process is killed between the two.
    tell({"sent", m_permit, m_sequence++});
    (void)m_system.send(m_target, std::move(message.value())); // refused while the session is not open: the hand stays on the pedal
}

void CockpitPart::tick(std::chrono::steady_clock::time_point now)
{
    repeatPedal(now);
    if (m_permit == 0)
        return;
    command(m_neutral == 0);
    if (m_neutral > 0)
        --m_neutral;
}

} // namespace liena::lab
