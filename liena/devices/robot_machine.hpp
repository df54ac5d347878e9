// The vascular robot's state machine: who may move it, and when it must hold.
#pragma once

#include "drive_gate.hpp"

#include "liena/device_id.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace liena::devices {

/// The numbers are those of `RobotState` in the robot's message set.
enum class RobotState : std::uint8_t { Off = 0, Hold = 1, Ready = 2, Armed = 3, Engaged = 4, EmergencyStop = 5, Fault = 6 };

std::string_view toString(RobotState state);

/// The numbers are those of `fault_code` in RobotStatus.
enum class RobotFault : std::uint16_t { None = 0, ForceStop = 1, Drive = 2, Watchdog = 3, CommandStreamLost = 4 };

/// The numbers are those of `Clearance` in the robot's message set.
enum class Clearance : std::uint8_t { NotAsked = 0, Awaited = 1, Given = 2 };

/// Whether the robot can be armed without a word of the person beside it.
enum class ArmingRule : std::uint8_t { OnePerson, TwoPersons };

struct ArmRequested {
    DeviceId origin;
    std::uint32_t permit = 0;
};
struct ReleaseRequested {
    DeviceId origin;
    std::uint32_t permit = 0;
};
struct MotionCommanded {
    DeviceId origin;
    std::uint32_t permit = 0;
    std::uint32_t sequence = 0;
    bool engaged = false;
    AxisValues velocities{};
};
struct GripperCommanded {
    DeviceId origin;
    std::uint32_t permit = 0;
};
struct InjectionCommanded {
    DeviceId origin;
    std::uint32_t permit = 0;
};
struct EmergencyStopCommanded {
    DeviceId origin; ///< the robot itself: pressed beside it
    std::uint64_t token = 0;
};
struct ResetCommanded {
    DeviceId origin;
    std::uint64_t token = 0;
};
struct SessionOpened {
    DeviceId peer;
};
struct SessionLost { ///< left Open and Suspect for any reason, or was interrupted
    DeviceId peer;
    bool over = false; ///< it does not go on by itself
};
struct StandByBegan {};
struct StandByEnded {};
struct ProcessStalled {};
struct GateStopped {
    StopCause cause = StopCause::LeaseOver;
};
struct DrivesChecked {
    bool healthy = true;
    bool still = true;
};
struct SwitchedOn {};
struct ClearanceSaid { ///< by the person beside the robot
    bool given = false;
};
struct Ticked {};

using RobotEvent = std::variant<ArmRequested, ReleaseRequested, MotionCommanded, GripperCommanded, InjectionCommanded,
                                EmergencyStopCommanded, ResetCommanded, SessionOpened, SessionLost, StandByBegan, StandByEnded,
                                ProcessStalled, GateStopped, DrivesChecked, SwitchedOn, ClearanceSaid, Ticked>;

/// What the caller has to do after an event, in this order.
struct RobotActions {
    enum class Drives : std::uint8_t { Leave, Enable, Drive, Release, Stop, Cut };

    Drives drives = Drives::Leave;
    bool stopInjection = false;
    bool revokeControl = false;      ///< a new permit was issued
    std::optional<bool> confirmHold; ///< tell the others
    bool accepted = true;            ///< false: a command was refused and counted
    std::string_view reason;         ///< of a refusal or of a change of state, for the log
};

/// Never permits motion unless a cockpit armed under the present permit while the robot held, released its dead-man, and pressed it again;
/// never longer than its commands, its session and the system's readiness last.
///
///          SwitchedOn         still, healthy, linked, no stand-by
///    Off ─────────────► Hold ────────────────────────────────────► Ready
///                      ▲  ▲ ◄──────────────────────────────────────  │
///                      │  │    any of them ended                     │ ArmRequested, present permit, cockpit
///                      │  │ session, stand-by, stall, gate stop,     ▼
///                      │  └──────────────────────────────────────  Armed ◄────────────┐ dead-man released
///                      │    silence, release request               │ │ engaged, after  │
///                      │                                           │ │ a neutral one   │
///                      └───────────────────────────────────────────│─┴──► Engaged ─────┘
///    EmergencyStop: from every state at once; Hold when every stop in force was reset by its token. Each device has one in force at most,
///    its newest.
///    Fault: from every state but EmergencyStop and Off when a drive fails; Hold when the drives are healthy again.
///    With TwoPersons the robot is Ready only while the person beside it says that it may be armed. That word ends with a cockpit's
///    session, stand-by, an emergency stop and a fault, and must then be said again.
///
/// A permit is new at each entry into Hold. Pure: no I/O and no clock.
class RobotMachine {
public:
    /// A silence of the armed cockpit's commands for longer than this ends in Hold.
    static constexpr std::chrono::milliseconds commandSilence{50};

    /// What an armed cockpit may take until its first command; nothing moves before that.
    static constexpr std::chrono::milliseconds firstCommandWait{1000};

    /// Hold lasts at least this long, so that every listener of the status sees it.
    static constexpr std::chrono::milliseconds leastHold{200};

    explicit RobotMachine(std::uint32_t firstPermit = 1, ArmingRule rule = ArmingRule::OnePerson)
        : m_permit(firstPermit - 1), m_clearance(rule == ArmingRule::TwoPersons ? Clearance::Awaited : Clearance::NotAsked)
    {}

    RobotActions handle(const RobotEvent& event, SteadyTime now);

    RobotState state() const { return m_state; }
    std::uint32_t permit() const { return m_permit; }
    std::optional<DeviceId> owner() const { return m_owner; } ///< the cockpit that has armed it; nothing while nobody has
    bool engaged() const { return m_state == RobotState::Engaged; }
    bool holdConfirmed() const { return m_holdConfirmed; }
    RobotFault fault() const { return m_fault; }
    Clearance clearance() const { return m_clearance; }

    /// Of the stop in force that was heard last, a repeat included: who repeats a stop until it is reported learns of it beside others.
    std::uint64_t emergencyStopToken() const { return m_stops.empty() ? 0 : m_stops.back().token; }

    /// That very one: hearing it is a repeat.
    bool isInForce(const EmergencyStopCommanded& stop) const;

    std::uint32_t lastSequence() const { return m_lastSequence; }
    std::uint64_t appliedCommands() const { return m_applied; }
    std::uint64_t refusedCommands() const { return m_refused; }

    /// A command that passed here and was refused further on: by the gate, the injector or a gripper.
    void countRefusal() { ++m_refused; }

private:
    void on(const ArmRequested& event, SteadyTime now);
    void on(const ReleaseRequested& event, SteadyTime now);
    void on(const MotionCommanded& event, SteadyTime now);
    void on(const GripperCommanded& event, SteadyTime now);
    void on(const InjectionCommanded& event, SteadyTime now);
    void on(const EmergencyStopCommanded& event, SteadyTime now);
    void on(const ResetCommanded& event, SteadyTime now);
    void on(const SessionOpened& event, SteadyTime now);
    void on(const SessionLost& event, SteadyTime now);
    void on(const StandByBegan& event, SteadyTime now);
    void on(const StandByEnded& event, SteadyTime now);
    void on(const ProcessStalled& event, SteadyTime now);
    void on(const GateStopped& event, SteadyTime now);
    void on(const DrivesChecked& event, SteadyTime now);
    void on(const SwitchedOn& event, SteadyTime now);
    void on(const ClearanceSaid& event, SteadyTime now);
    void on(const Ticked& event, SteadyTime now);

    bool permitsMotion() const { return m_state == RobotState::Armed || m_state == RobotState::Engaged; }
    bool mayBeReady() const;
    bool mayArm(const ArmRequested& event);
    bool fromOwner(DeviceId origin, std::uint32_t permit);
    void applyMotion(const MotionCommanded& event);
    void refuse(std::string_view reason);
    void enterHold(std::string_view reason, SteadyTime now);
    void leaveMotion();
    void endClearance();
    void settle(SteadyTime now);

    RobotState m_state = RobotState::Off;
    std::uint32_t m_permit;
    std::optional<DeviceId> m_owner;
    std::set<DeviceId> m_cockpits;               ///< those in session
    std::vector<EmergencyStopCommanded> m_stops; ///< in force, one of each origin at most, in the order in which they were heard last
    SteadyTime m_silentSince;
    SteadyTime m_holdSince;
    bool m_heardCommand = false;
    bool m_neutralSeen = false;
    bool m_standBy = false;
    bool m_healthy = true;
    bool m_still = true;
    bool m_holdConfirmed = false;
    RobotFault m_fault = RobotFault::None;
    Clearance m_clearance;
    std::uint32_t m_lastSequence = 0;
    std::uint64_t m_applied = 0;
    std::uint64_t m_refused = 0;
    RobotActions m_actions;
};

} // namespace liena::devices
