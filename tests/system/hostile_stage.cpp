// Sets the stage of the hostile-peer tests and looks whether the honest session noticed anything.
#include "hostile_stage.hpp"

#include <unistd.h>

#include <fstream>

#ifndef __has_feature // GCC
#define __has_feature(feature) 0
#endif

namespace liena::test {

using Kind = SessionEvent::Kind;

wire::Bytes motionFields(std::uint32_t permit, std::uint32_t sequence, float velocity)
{
    return wire::Words().u32(permit).u32(sequence).u8(1).f32(velocity).f32(0).f32(0).f32(0);
}

PeerRole roleOf(TestSystem& system, const std::string& name, const std::string& device)
{
    const auto setOf = [&](const std::string& of) {
        for (const auto& one : {reference::cockpit, reference::robot, reference::arm, reference::xray})
            if (one.name == of)
                return wire::fileText(std::filesystem::path(LIENA_SOURCE_DIR) / "resources" / "devices" / (one.set + ".xml"));
        throw std::logic_error("no set of " + of);
    };
    const auto files = system.identityOf(name);
    return {.id = system.idOf(name).value(),
            .port = system.portOf(name),
            .device = system.idOf(device).value(),
            .devicePort = system.portOf(device),
            .topology = wire::fileText(system.topology()),
            .set = setOf(name),
            .sentSet = {},
            .deviceSet = setOf(device),
            .face = {.certificate = files.certificate, .key = files.key, .authority = files.authority, .between = {}}};
}

std::size_t residentBytes()
{
    // ThreadSanitizer keeps shadows of several times what it watches, also when that is freed: then only a tenth is ours.
    constexpr std::size_t shadows = __has_feature(thread_sanitizer) ? 10 : 1;
    std::ifstream file("/proc/self/statm");
    std::size_t size = 0;
    std::size_t resident = 0;
    file >> size >> resident;
    return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) / shadows;
}

namespace {

DeviceSpec at(const std::string& host, DeviceSpec device)
{
    device.host = host;
    return device;
}

} // namespace

HostileStage::HostileStage(const Options& options)
    : system({reference::cockpit, reference::robot, reference::arm, at(options.xrayHost, reference::xray)},
             {"cockpit robot", "robot arm", "robot xray"}, {.timing = options.timing, .lateCommands = true}),
      robotId(system.idOf("robot")),
      cockpitId(system.idOf("cockpit")),
      xrayId(system.idOf("xray")),
      armId(system.idOf("arm")),
      peer(roleOf(system, "xray", "robot")),
      robot(robotSettings(options),
            [this](DistributedSystem& device) {
                (void)device.subscribe("MotionCommand", [this](const Message& message) {
                    const std::lock_guard lock(m_mutex);
                    m_motions.push_back(message);
                });
            }),
      cockpit(system.settingsOf("cockpit"))
{
    if (!cockpit->openChannel(robotId) ||
        !eventually([this] { return robot.heard(Kind::Opened, cockpitId) && cockpit.heard(Kind::Opened, robotId); }))
        throw std::runtime_error("the honest session did not open: " + story());
}

Settings HostileStage::robotSettings(const Options& options)
{
    auto settings = system.settingsOf("robot");
    if (!options.unknownSet.empty())
        settings.registry = {registryWithout(options.unknownSet)};
    settings.log = [this](LogLevel, std::string_view line) {
        const std::lock_guard lock(m_mutex);
        m_log.emplace_back(line);
    };
    return settings;
}

std::filesystem::path HostileStage::registryWithout(const std::string& set) const
{
    const auto folder = system.folder() / ("registry-without-" + set);
    std::filesystem::copy(registry(), folder);
    std::filesystem::remove(folder / (set + ".xml"));
    return folder;
}

std::vector<std::string> HostileStage::log() const
{
    const std::lock_guard lock(m_mutex);
    return m_log;
}

std::vector<Message> HostileStage::motions() const
{
    const std::lock_guard lock(m_mutex);
    return m_motions;
}

LinkStatus HostileStage::linkOf(DeviceId peerId)
{
    for (const auto& link : robot->links())
        if (link.peer == peerId)
            return link;
    throw std::logic_error("no link to " + peerId.toString());
}

bool HostileStage::honestSessionUntouched()
{
    const auto calm = [](TestDevice& device, DeviceId other) {
        const auto changes = device.events(Kind::StateChanged, other);
        const auto opened = [](const SessionEvent& event) { return event.to == SessionState::Opening || event.to == SessionState::Open; };
        const auto link = device->links();
        const auto missed = [&](const LinkStatus& status) { return status.peer == other && status.heartbeatsMissed > 0; };
        return std::all_of(changes.begin(), changes.end(), opened) && device.state(other) == SessionState::Open &&
               std::none_of(link.begin(), link.end(), missed) && !device.heard(Kind::LocalStall) &&
               !device.heard(Kind::MessagesDropped, other);
    };
    return calm(robot, cockpitId) && calm(cockpit, robotId);
}

bool HostileStage::honestSessionLives()
{
    const auto before = linkOf(cockpitId).heartbeatsReceived;
    return eventually([&] { return linkOf(cockpitId).heartbeatsReceived > before + 2; }) && honestSessionUntouched();
}

std::size_t HostileStage::dropped() { return linkOf(xrayId).messagesDropped; }

bool HostileStage::toldOf(const std::string& cause) const
{
    for (const auto& event : robot.events(Kind::MessagesDropped))
        if (event.detail.find(cause) != std::string::npos)
            return true;
    return false;
}

std::string HostileStage::story()
{
    std::string text = "robot:\n" + robot.story() + "cockpit:\n" + cockpit.story() + "robot's log:\n";
    const std::lock_guard lock(m_mutex);
    for (const auto& line : m_log)
        text += line + "\n";
    return text;
}

void HostileStage::openPeer()
{
    const bool again = robot.state(xrayId) == SessionState::StandBy;
    const auto kind = again ? Kind::ReOpened : Kind::Opened;
    const auto before = robot.events(kind, xrayId).size();
    peer.open(again);
    if (!eventually([&] { return robot.events(kind, xrayId).size() > before; }))
        throw std::runtime_error("the scripted session did not open: " + story());
}

} // namespace liena::test
