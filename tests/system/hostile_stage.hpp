// The stage of the hostile-peer tests: a robot in an honest session with a cockpit, and a scripted peer that plays the X-ray system.
#pragma once

#include "support/scripted_peer.hpp"
#include "test_system.hpp"

#include <QTest>

namespace liena::test {

/// The fields of MotionCommand as resources/devices/vascular-robot.xml defines them.
wire::Bytes motionFields(std::uint32_t permit, std::uint32_t sequence, float velocity);

/// What the scripted peer is when it plays `name` against `device`.
PeerRole roleOf(TestSystem& system, const std::string& name, const std::string& device);

/// Memory of this process that is resident now, in bytes.
std::size_t residentBytes();

/// Within a time that only a broken program needs.
template <typename Holds>
bool eventually(Holds holds)
{
    return QTest::qWaitFor(holds, 20000);
}

class HostileStage {
public:
    struct Options {
        /// Wide enough that only an attack can disturb the honest session, on a loaded machine and under sanitizers.
        std::string timing = R"(heartbeat="50ms" suspect="2s" lost="3s" reconnect="6s")";
        std::string unknownSet{}; ///< the robot's register lacks this one
        std::string xrayHost = "127.0.0.1";
    };

    HostileStage() : HostileStage(Options()) {}
    explicit HostileStage(const Options& options);

    /// Motion commands delivered to the robot's application so far, from anybody.
    std::vector<Message> motions() const;
    LinkStatus linkOf(DeviceId peer); ///< the robot's

    /// The robot's session with the cockpit has been Open all the time, on both ends, and no heartbeat of it was lost.
    bool honestSessionUntouched();
    /// As many heartbeats have passed on it since the last call as make a difference; then as above. False when they do not come.
    bool honestSessionLives();

    /// What the robot's application was told it dropped of the peer's, by cause.
    std::size_t dropped();
    bool toldOf(const std::string& cause) const;
    std::vector<SessionEvent> refusals() const { return robot.events(SessionEvent::Kind::IdentityRefused); }
    std::string story();

    /// Where the devices find their sets: the register's, with motion commands that a loaded machine cannot make too old.
    std::filesystem::path registry() const { return system.registry(); }
    /// A copy of it without one set.
    std::filesystem::path registryWithout(const std::string& set) const;
    std::vector<std::string> log() const; ///< the robot's

    /// Opens the scripted session, or re-opens it after a loss, and waits until both ends have it.
    void openPeer();

    TestSystem system;
    const DeviceId robotId;
    const DeviceId cockpitId;
    const DeviceId xrayId;
    const DeviceId armId;

private:
    mutable std::mutex m_mutex;
    std::vector<Message> m_motions;
    std::vector<std::string> m_log;

public:
    ScriptedPeer peer; ///< outlives the devices, so that it answers when they close
    TestDevice robot;
    TestDevice cockpit;

private:
    Settings robotSettings(const Options& options);
};

} // namespace liena::test
