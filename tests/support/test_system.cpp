// Files, ports and devices of a test system.
#include "test_system.hpp"

#include <QFile>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <random>
#include <stdexcept>

namespace liena::test {

namespace {

bool isFree(int kind, std::uint16_t port)
{
    const int socket = ::socket(AF_INET, kind, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const bool bound = ::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    ::close(socket);
    return bound;
}

// Below the range from which connections get their own ports.
constexpr std::uint16_t lowestPort = 12000;
constexpr std::uint16_t portsOfABlock = 100;
constexpr std::uint16_t blocks = 200;

/// From now until this process ends its ports are no other test's, also not to look whether they are free.
bool takeBlock(unsigned block)
{
    sockaddr_un address{};
    address.sun_family = AF_UNIX; // abstract, unix(7): the first byte is 0, there is no file, and only one may have it
    std::snprintf(address.sun_path + 1, sizeof address.sun_path - 1, "liena test ports %u", block);
    const int holder = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (::bind(holder, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
        return true; // and the holder stays
    ::close(holder);
    return false;
}

std::string linkElement(const std::string& link)
{
    const auto bar = link.find('|');
    const auto start = "  <link between=\"" + link.substr(0, bar);
    if (bar == std::string::npos)
        return start + "\"/>\n";
    const auto within = link.substr(bar + 1);
    return start + "\">" + (within.starts_with('<') ? within : "<timing " + within + "/>") + "</link>\n";
}

std::filesystem::path deviceSets() { return std::filesystem::path(LIENA_SOURCE_DIR) / "resources" / "devices"; }

/// A copy of them.
std::filesystem::path setsWithLateCommands(const std::filesystem::path& folder)
{
    const auto made = folder / "registry";
    std::filesystem::copy(deviceSets(), made);
    QFile file(QString::fromStdString((made / "vascular-robot.xml").string()));
    auto text = file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    file.close();
    text.replace("lifespan=\"50ms\"", "lifespan=\"60s\"").replace("max-age=\"50ms\"", "max-age=\"20s\"");
    if (!text.contains("max-age=\"20s\"") || !file.open(QIODevice::WriteOnly) || file.write(text) != text.size())
        throw std::runtime_error("cannot write " + made.string());
    return made;
}

} // namespace

std::uint16_t freePort()
{
    static std::mutex mutex;
    static std::uint16_t next = 0; // each only once, since it is free again until somebody listens
    static std::uint16_t end = 0;
    static unsigned block = std::random_device{}();
    const std::lock_guard lock(mutex);
    for (unsigned tried = 0; tried <= blocks; ++tried) {
        while (next < end) {
            const auto port = next++;
            if (isFree(SOCK_STREAM, port) && isFree(SOCK_DGRAM, port))
                return port;
        }
        block = (block + 1) % blocks;
        if (takeBlock(block)) {
            next = static_cast<std::uint16_t>(lowestPort + block * portsOfABlock);
            end = static_cast<std::uint16_t>(next + portsOfABlock);
        }
    }
    throw std::runtime_error("no port of 127.0.0.1 is free for TCP and UDP");
}

TestSystem::TestSystem(std::vector<DeviceSpec> devices, std::vector<std::string> links, Options options) : m_devices(std::move(devices))
{
    std::string xml = "<topology xmlns=\"urn:liena:topology:1\" " + options.name + " version=\"1.0\">\n  <timing " + options.timing +
                      "/>\n  <security mode=\"" + options.mode + "\"/>\n";
    for (const auto& device : m_devices) {
        m_ports.push_back(freePort());
        xml += "  <device name=\"" + device.name + "\" id=\"" + device.id + "\" message-set=\"" + device.set + "\" host=\"" + device.host +
               "\" port=\"" + std::to_string(m_ports.back()) + "\" " + device.place + "/>\n";
    }
    for (const auto& link : links)
        xml += linkElement(link);
    xml += "</topology>\n";
    QFile file(QString::fromStdString(topology().string()));
    if (!file.open(QIODevice::WriteOnly) || file.write(xml.data(), static_cast<qint64>(xml.size())) < 0)
        throw std::runtime_error("cannot write " + topology().string());
    m_registry = options.lateCommands ? setsWithLateCommands(folder()) : deviceSets();
}

Settings TestSystem::settingsOf(const std::string& name)
{
    Settings settings;
    settings.topology = topology();
    settings.device = name;
    settings.registry = {m_registry};
    settings.store = folder() / ("store-" + name);
    settings.software = "test " + name;
    settings.log = [](LogLevel, std::string_view) {};
    settings.status = folder() / "status";
    identityOf(name).applyTo(settings);
    return settings;
}

QStringList TestSystem::argumentsOf(const std::string& name)
{
    const auto text = [](const std::filesystem::path& path) { return QString::fromStdString(path.string()); };
    const auto settings = settingsOf(name);
    return {QStringLiteral("--topology"),    text(settings.topology),         QStringLiteral("--device"), QString::fromStdString(name),
            QStringLiteral("--registry"),    text(settings.registry.front()), QStringLiteral("--store"),  text(settings.store),
            QStringLiteral("--certificate"), text(settings.certificate),      QStringLiteral("--key"),    text(settings.key),
            QStringLiteral("--authority"),   text(settings.authority)};
}

std::uint16_t TestSystem::portOf(const std::string& name) const
{
    for (std::size_t i = 0; i < m_devices.size(); ++i)
        if (m_devices[i].name == name)
            return m_ports[i];
    throw std::logic_error("no device " + name);
}

DeviceId TestSystem::idOf(const std::string& name) const
{
    for (const auto& device : m_devices)
        if (device.name == name)
            return DeviceId::fromString(device.id).value();
    throw std::logic_error("no device " + name);
}

IdentityFiles TestSystem::identityOf(const std::string& name) { return m_authority.identityOf(idOf(name), name); }

void TestSystem::issueFor(const std::string& name, std::chrono::hours validity)
{
    if (const auto issued = m_authority.authority().issue(idOf(name), name, validity); !issued)
        throw std::runtime_error(issued.error().what);
}

void TestSystem::revoke(const std::vector<std::string>& names)
{
    std::vector<std::string> serials;
    for (const auto& name : names)
        serials.push_back(m_authority.authority().issuedSerial(identityOf(name).certificate).value());
    if (const auto made = m_authority.authority().revoke(serials, RevocationReason::Unspecified, std::chrono::hours(48)); !made)
        throw std::runtime_error(made.error().what);
}

TestDevice::TestDevice(Settings settings, const Setup& setup)
{
    auto created = DistributedSystem::create(std::move(settings));
    if (!created)
        throw std::runtime_error(created.error().what);
    m_system = std::move(created.value());
    m_system->subscribe([this](const SessionEvent& event) {
        const std::lock_guard lock(m_mutex);
        m_events.push_back(event);
    });
    if (setup)
        setup(*m_system);
    m_system->start();
}

TestDevice::~TestDevice() { m_system->stop(); }

std::vector<SessionEvent> TestDevice::events(SessionEvent::Kind kind, std::optional<DeviceId> peer) const
{
    const std::lock_guard lock(m_mutex);
    std::vector<SessionEvent> found;
    std::copy_if(m_events.begin(), m_events.end(), std::back_inserter(found),
                 [&](const SessionEvent& event) { return event.kind == kind && (!peer || event.peer == *peer); });
    return found;
}

SessionState TestDevice::state(DeviceId peer) const
{
    for (const auto& link : m_system->links())
        if (link.peer == peer)
            return link.state;
    throw std::logic_error("no link to " + peer.toString());
}

std::vector<Message> TestDevice::messages(const std::string& name)
{
    for (auto& message : m_system->cache().drain().messages)
        m_messages.push_back(std::move(message));
    std::vector<Message> found;
    std::copy_if(m_messages.begin(), m_messages.end(), std::back_inserter(found),
                 [&](const Message& message) { return message.name() == name; });
    return found;
}

std::string TestDevice::story() const
{
    const std::lock_guard lock(m_mutex);
    std::string text;
    for (const auto& event : m_events)
        text += std::string(toString(event.kind)) + " " + event.peer.toString() + " " + std::string(toString(event.from)) + ">" +
                std::string(toString(event.to)) + " " + event.message + " " + event.detail + "\n";
    return text;
}

} // namespace liena::test
