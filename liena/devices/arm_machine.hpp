// The robotic arm: six joints that move only while the vascular robot reports that it holds.
#pragma once

#include "drive_gate.hpp"

#include "liena/device_id.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <string_view>

namespace liena::devices {

/// The numbers are those of `ArmState` in the arm's message set.
enum class ArmState : std::uint8_t { Off = 0, Hold = 1, Moving = 2, Fault = 3 };

inline constexpr std::size_t jointCount = 6;
using Joints = std::array<double, jointCount>;

struct ArmRequest {
    DeviceId origin;
    bool move = false; ///< false: hold
    Joints targets{};
    double speedScale = 0;
};

/// Never moves unless a cockpit's move command is at most 200 ms old, the robot's hold was reported at most 100 ms ago, and no stand-by is
/// heard.
///
///            move, robot holds, not locked
///   Hold ───────────────────────────────────► Moving
///    ▲  locked: only its own `hold` unlocks       │
///    │◄──────────────────────────────────────────┤ robot moves or is silent, session lost, stand-by, lease over: stop and lock
///    └◄──────────────────────────────────────────┘ hold, or the targets are reached
///
/// After a stop that nobody asked for, after one pressed at the arm or in force at the robot, after a stand-by and in a new session the
/// stream of old commands must not set it going: the arm then wants a `hold` of that cockpit first. So it does of a cockpit whose move was
/// refused because the robot did not hold, the system stood by or another cockpit moved the arm, whatever ended that, and of one whose
/// movement another cockpit's `hold` has ended. Joints slow down within their deceleration; the brakes close when they stand. Pure: time
/// comes from the caller.
class ArmMachine {
public:
    static constexpr std::chrono::milliseconds lease{200};
    static constexpr std::chrono::milliseconds robotFresh{100};

    ArmMachine();

    /// False: refused and counted.
    bool command(const ArmRequest& request, SteadyTime now);

    void robotReported(bool holds, SteadyTime arrived);

    /// The emergency stop that the robot's report names; 0: none. One that was not named before locks. To be called before robotReported(),
    /// since a stopped robot holds.
    void robotNamesStop(std::uint64_t token);

    /// The session of a device left Open, or was interrupted.
    void sessionLost(DeviceId peer);

    void setStandBy(bool standsBy);

    /// Stops, and locks also where it was not moving: a stop beside the patient, a stall of this process.
    void lock(std::string_view reason);

    void step(SteadyTime now);

    ArmState state() const { return m_state; }
    bool holding() const { return m_state == ArmState::Hold && still(); }
    bool brake() const { return holding(); }
    bool still() const;
    const Joints& positions() const { return m_positions; }
    const Joints& velocities() const { return m_velocities; }
    Joints torques() const;
    std::uint64_t refusedCommands() const { return m_refused; }

    /// Why it refused or stopped last, for the log.
    std::string_view reason() const { return m_reason; }

private:
    bool robotHolds(SteadyTime now) const;
    bool refuse(std::string_view reason);
    bool bar(DeviceId origin, std::string_view reason); ///< refuses, and locks that cockpit
    void interrupt(std::string_view reason);
    void stop();
    void moveJoints(double seconds);

    ArmState m_state = ArmState::Hold;
    Joints m_positions;
    Joints m_velocities{};
    Joints m_targets;
    double m_speedScale = 0;
    std::optional<DeviceId> m_owner; ///< while moving
    std::set<DeviceId> m_unlocked;   ///< the cockpits whose `hold` was heard since they were locked
    SteadyTime m_leaseEnd;
    std::optional<SteadyTime> m_robotHeld; ///< arrival of the newest report, if it said that the robot holds
    std::uint64_t m_robotStop = 0;         ///< named last
    std::optional<SteadyTime> m_lastStep;
    bool m_standBy = false;
    std::uint64_t m_refused = 0;
    std::string_view m_reason;
};

} // namespace liena::devices
