// Devices of a small robotic system on loopback, for tests: topology, certificates, ports and what the devices hear.
#pragma once

#include "liena/distributed_system.hpp"
#include "test_authority.hpp"

#include <QByteArray>
#include <QStringList>
#include <QTemporaryDir>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace liena::test {

/// The word for an enumerator: what QCOMPARE can show.
template <typename T>
QByteArray words(T value)
{
    const auto text = toString(value);
    return {text.data(), static_cast<qsizetype>(text.size())};
}

/// A port of 127.0.0.1, for TCP and UDP, that was free a moment ago, and that no other test that runs meanwhile gets or tries.
std::uint16_t freePort();

struct DeviceSpec {
    std::string name;
    std::string id;
    std::string set;
    std::string place = {}; ///< attributes of the topology that say what and where it is
    std::string host = "127.0.0.1";
};

namespace reference {
inline const DeviceSpec cockpit{"cockpit", "0x40018208", "siat-cockpit"};
inline const DeviceSpec robot{"robot", "0x00008208", "vascular-robot"};
inline const DeviceSpec arm{"arm", "0x60008208", "arm-grasper"};
inline const DeviceSpec xray{"xray", "0x20010208", "cbct-xray"};
} // namespace reference

/// The files of one system. They go with the object.
class TestSystem {
public:
    struct Options {
        std::string mode = "tls";
        /// Slower to lose a peer than a real system: sanitizers and a busy machine must not look like one. The heartbeat is a real one's:
        /// a command's age is judged by it, and a motion command may be no older than 50 ms.
        std::string timing = R"(heartbeat="20ms" suspect="500ms" lost="800ms" reconnect="2s")";
        std::string name = R"(name="test")"; ///< of the topology, and what else its first element says
        /// The robot takes motion commands that are up to 20 s old, as no real one does: for slow lines and loaded machines.
        bool lateCommands = false;
    };

    /// `links` are as in the topology: "cockpit robot", or with a timing of their own: R"(cockpit robot|heartbeat="20ms")", or with
    /// any elements: R"(xray robot|<flow message="EmergencyStop" from="xray"/>)".
    TestSystem(std::vector<DeviceSpec> devices, std::vector<std::string> links)
        : TestSystem(std::move(devices), std::move(links), Options())
    {}
    TestSystem(std::vector<DeviceSpec> devices, std::vector<std::string> links, Options options);

    Settings settingsOf(const std::string& name);

    /// The same as options for one of our programs.
    QStringList argumentsOf(const std::string& name);
    std::filesystem::path topology() const { return folder() / "topology.xml"; }
    std::filesystem::path registry() const { return m_registry; } ///< where the devices find their sets
    std::filesystem::path folder() const { return m_folder.path().toStdString(); }
    std::uint16_t portOf(const std::string& name) const;
    DeviceId idOf(const std::string& name) const;
    IdentityFiles identityOf(const std::string& name);
    TestAuthority& authority() { return m_authority; }

    /// Issues a device's certificate with another end than usual; before anything else asks for it.
    void issueFor(const std::string& name, std::chrono::hours validity);

    /// Adds the devices' certificates to the site's list, which every device reads.
    void revoke(const std::vector<std::string>& names);
    std::filesystem::path revocations() const { return m_authority.folder() / "ca.crl"; }

private:
    QTemporaryDir m_folder;
    std::vector<DeviceSpec> m_devices;
    std::vector<std::uint16_t> m_ports;
    std::filesystem::path m_registry;
    TestAuthority m_authority;
};

/// A device in this process that remembers what it hears. Throws when it cannot start.
class TestDevice {
public:
    using Setup = std::function<void(DistributedSystem&)>;

    TestDevice(Settings settings, const Setup& setup = {});
    ~TestDevice();

    DistributedSystem& operator*() { return *m_system; }
    DistributedSystem* operator->() { return m_system.get(); }

    /// Events of a kind heard so far, from `peer` or from anybody.
    std::vector<SessionEvent> events(SessionEvent::Kind kind, std::optional<DeviceId> peer = std::nullopt) const;
    bool heard(SessionEvent::Kind kind, std::optional<DeviceId> peer = std::nullopt) const { return !events(kind, peer).empty(); }
    SessionState state(DeviceId peer) const;

    /// Drains the cache and gives all messages of that name so far.
    std::vector<Message> messages(const std::string& name);

    /// All events in order, for a failing test's output.
    std::string story() const;

private:
    mutable std::mutex m_mutex;
    std::vector<SessionEvent> m_events;
    std::vector<Message> m_messages;
    std::unique_ptr<DistributedSystem> m_system;
};

} // namespace liena::test
