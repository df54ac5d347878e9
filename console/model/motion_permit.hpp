// The console's side of the permission to move: a pure function from (state, event, now) to (state, actions).
#pragma once

#include "model/permit_guards.hpp"

#include <QString>

#include <chrono>
#include <cstdint>
#include <optional>

namespace console {

enum class PermitPhase : std::uint8_t { Off, Standby, Ready, Arming, Armed, Engaged, Hold, Incident, Verifying };
inline constexpr int permitPhaseCount = 9;

/// OFF, STANDBY, READY, ARMING, ARMED, ENGAGED, HOLD, INCIDENT, VERIFYING.
QString word(PermitPhase phase);

enum class PermitEventKind : std::uint8_t {
    SessionClosed,      ///< no session with the robot, and no incident
    SessionOpen,        ///< session with the robot, and no incident
    SessionInterrupted, ///< a link was interrupted, or another one than the robot's closed, and no incident
    SystemStandsBy,     ///< an incident is held, of whatever pair
    GuardsChecked,      ///< armable, kept
    ArmPressed,
    ArmReleased,
    DeadManPressed,
    DeadManReleased,
    RobotReported, ///< robot, permit, own
    PanicHold,     ///< F12, focus lost, the window hidden, the hand gone
    Stalled,       ///< this program did not run for longer than 100 ms
    GateClosed,    ///< permit: the last check before the wire refuses motion under it from now on
    Tick,
};
inline constexpr int permitEventCount = 14;

struct PermitEvent {
    PermitEventKind kind = PermitEventKind::Tick;
    GuardSet armable;                   ///< GuardsChecked: metGuards(checkGuards())
    GuardSet kept;                      ///< GuardsChecked: checkKept()
    RobotState robot = RobotState::Off; ///< RobotReported
    bool holdConfirmed = false;         ///< RobotReported
    quint32 permit = 0;                 ///< RobotReported, GateClosed
    bool own = false;                   ///< RobotReported: this console has armed it
};

/// What motion commands leave for the robot.
enum class MotionStream : std::uint8_t {
    None,
    Zero,   ///< engaged false, no velocity: keeps the robot's lease while armed
    Motion, ///< the hand's motion
};

/// Why motion ended, for the motion bar and the log.
enum class HoldCause : std::uint8_t { None, GuardFailed, Interrupted, Panic, Stalled, GateClosed, RobotWithdrew, ArmTimedOut };
/// `link`: the title of whose link was interrupted or closed; empty: of one of them.
QString word(HoldCause cause, const QString& link = {});

/// What the caller must do; several at once are possible.
struct PermitActions {
    bool requestArm = false; ///< PermitRequest arm, with `permit`
    bool release = false;    ///< PermitRequest release, with `permit`
    quint32 permit = 0;
    bool rezero = false; ///< the hand's offset becomes zero, and the soft start begins

    bool operator==(const PermitActions&) const = default;
};

struct PermitState {
    PermitPhase phase = PermitPhase::Off;
    Instant since;                          ///< phase entered
    bool deadMan = false;                   ///< as last told
    bool deadManReleasedSeen = false;       ///< since Armed or Hold was entered
    bool awaitingRobot = false;             ///< Arming: the request is out
    bool robotHolds = false;                ///< Hold: the robot reported since Hold was entered that it does, or is another console's
    quint32 robotPermit = 0;                ///< as last reported
    quint32 permit = 0;                     ///< Arming (awaiting), Armed, Engaged: the one we move under
    quint32 engagement = 0;                 ///< counts entries into Engaged
    std::optional<quint32> spentPermit;     ///< of the last armed period of this session
    std::optional<Instant> guardsTrueSince; ///< Verifying
    GuardSet armable;
    GuardSet kept;
    HoldCause cause = HoldCause::None;

    MotionStream stream() const;

    /// Entered so far, of the ARM hold; 0 … 1. Zero outside Arming.
    double armProgress(Instant now) const;
};

struct PermitTiming {
    std::chrono::milliseconds armHold{1500};
    std::chrono::milliseconds armAnswer{1000}; ///< the robot's answer to the request
    std::chrono::milliseconds verifying{1000}; ///< guards true without a gap
    std::chrono::seconds unused{120};          ///< Armed without the dead-man
};

struct PermitStep {
    PermitState state;
    PermitActions actions;
};

/// ```
///        session open          guards true          ARM pressed           held 1.5 s, asked, robot armed
///   Off ─────────────► Standby ──────────► Ready ───────────► Arming ──────────────────────────► Armed
///    ▲                  ▲   ▲ ◄─────────── │ ▲ ◄───────────── │  │                               │  ▲ │
///    │ session closed   │   │  guard false │ │  let go early   │  │ no answer, panic, guard       │  │ │ dead-man
///    │ (from any)       │   │              │ │                 │  ▼                               │  │ │ released,
///    │                  │   │              │ └── unused 120 s ─┼──┼───────────────────────────────┘  │ ▼ then pressed
///    │                  │   └──────────────┼─────────────────┼─ Hold ◄───────────────────────────── Engaged
///    │                  │    robot holds   │                 │        kept guard false, interrupted,
///    │                  │    and dead-man  │                 │        panic, stalled, robot withdrew
///    │   guards true    │    released      ▼                 ▼
///    │   for 1 s        │         system stands by (from any)
///  Verifying ───────────┘                Incident ───── session open, no incident left ─────► Verifying
/// ```
/// Of several consoles that ask for one permit the robot takes one; Arming ends in Standby for those that it does not name as its owner.
/// Hold ends also when another console has armed the robot, which need not hold then.
/// There is no way from Hold, Incident or Verifying to Armed but through Ready and a new ARM: a lost link that heals gives nothing back.
PermitStep step(const PermitState& state, const PermitEvent& event, Instant now, const PermitTiming& timing = {});

} // namespace console
