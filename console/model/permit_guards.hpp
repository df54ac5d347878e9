// The conditions under which instruments may move, each with a name and a reason that a person can read.
#pragma once

#include "model/instant.hpp"
#include "model/link_state.hpp"
#include "model/operator_role.hpp"
#include "model/picture_state.hpp"
#include "model/robot_values.hpp"

#include <QString>
#include <QStringList>

#include <array>
#include <bitset>
#include <chrono>
#include <cstdint>
#include <optional>

namespace console {

enum class Guard : std::uint8_t {
    SessionOpen,
    IdentityEqual,
    HeartbeatsOnTime,
    ClockKnown,
    PictureLive,
    RobotFresh,
    RobotHolds,
    DrivesHealthy,
    QueueEmpty,
    TipTrackedOrOff,
    ForceNearZero,
    CommandsQuick,
    ClearToArm,
    Recorded,
    NoIncident,
    NoHighAlarm,
    HandAlive,
    WindowActive,
    DeadManReleased,
    AlarmsTested,
    InterruptionRead,
};
inline constexpr std::size_t guardCount = 21;

using GuardSet = std::bitset<guardCount>; ///< bit n: guard n is met

/// Those that must stay true while armed or engaged; the others are needed to arm only.
GuardSet keptWhileArmed();

struct GuardLimits {
    quint32 heartbeatsOnTime = 50;
    std::chrono::milliseconds pictureRun{1000}; ///< unbroken live pictures before arming
    quint32 keptQueue = 16;                     ///< while armed; more than this waits: the line does not keep up
};

/// One moment of everything that the guards look at.
struct GuardReadings {
    LinkState robotLink = LinkState::Closed;
    Duration inLinkState{};              ///< how long the link has been in that state
    Duration heartbeat = usualHeartbeat; ///< of the robot's link: for so long it may be suspect while armed
    bool identityEqual = false;
    bool commandsDiffer = false; ///< the robot's set has not the commands that this console gives
    quint32 heartbeatsOnTime = 0;
    std::optional<Duration> clockUncertainty; ///< nothing before 8 clean samples
    PictureReading picture;
    Duration pictureLimit{};
    bool robotFresh = false;
    RobotState robotState = RobotState::Off;
    bool robotHoldConfirmed = false;
    quint32 robotPermit = 0;
    bool anotherHasRobot = false;       ///< another console has armed it
    std::optional<quint32> spentPermit; ///< the permit of the last armed period: never again
    bool drivesHealthy = false;
    bool armFault = false; ///< of the robotic arm that is in session, as it said last
    OperatorRole role = OperatorRole::Operator;
    Clearance clearance = Clearance::NotAsked;
    quint32 queuedMessages = 0;             ///< to the robot, at the least moment of the last few
    std::optional<Duration> roundTrip;      ///< of commands; nothing: not measured
    std::optional<Duration> usualRoundTrip; ///< of the last few
    std::optional<Duration> carried;        ///< LinkNode::carried of the robot's link
    bool tipTracked = false;                ///< measured now
    bool tipShown = false;                  ///< in the scene, measured now or not
    double force = 0;                       ///< N
    bool forceAccepted = false;             ///< a person has seen it and arms all the same
    RobotLimits limits;
    bool recorded = false;  ///< the alarm log reaches the disk
    bool auditKept = false; ///< and the audit file, where one was asked for
    bool incident = false;
    bool highAlarm = false; ///< an unacknowledged one
    bool handAlive = false;
    QString handMissing; ///< which master it is, and what it lacks; empty: not known
    QString remoteInput; ///< by what way keys and mouse come from another place; empty: they are this computer's, as far as can be told
    bool windowActive = false;
    bool screenGone = false; ///< the cockpit's own, and nobody has clicked into the cockpit since
    QString unseen;          ///< why nobody sees it; empty: somebody may
    bool deadMan = false;
    bool alarmsTested = false;     ///< for this arming
    bool interruptionRead = false; ///< no account of an interruption is unread, and none is running
};

struct GuardLine {
    Guard guard = Guard::SessionOpen;
    bool met = false;
    QString text; ///< met: what holds; unmet: what is missing, with the number
};

/// The live checklist of region J, in the order of the enumeration.
using GuardChecklist = std::array<GuardLine, guardCount>;

/// `to arm`: every guard in its strict form.
GuardChecklist checkGuards(const GuardReadings& readings, const GuardLimits& limits = {});

/// The looser form of the guards that are kept while armed: a link may be suspect for one heartbeat window, the picture must be younger
/// than its limit, the force below the stop. Guards that are not kept count as met.
GuardSet checkKept(const GuardReadings& readings, const GuardLimits& limits = {});

/// What is missing of those, a line for each.
QStringList brokenGuards(const GuardReadings& readings, const GuardLimits& limits = {});

GuardSet metGuards(const GuardChecklist& checklist);

} // namespace console
