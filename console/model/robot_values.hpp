// What the vascular robot reports, in the units of its message set.
#pragma once

#include "model/instant.hpp"

#include <QString>
#include <QtGlobal>

#include <array>
#include <cstdint>

namespace console {

enum class RobotState : std::uint8_t { Off, Hold, Ready, Armed, Engaged, EmergencyStop, Fault };

/// off, hold, ready, armed, engaged, emergency stop, fault.
QString word(RobotState state);

/// Whether the person beside the robot has said that it may be armed, where the site asks for two persons.
enum class Clearance : std::uint8_t { NotAsked, Awaited, Given };

/// Bits of RobotStatus::limitSwitches.
enum LimitSwitch : quint16 {
    GuidewireSoftLow = 1U << 0U,
    GuidewireSoftHigh = 1U << 1U,
    GuidewireHardLow = 1U << 2U,
    GuidewireHardHigh = 1U << 3U,
    CatheterSoftLow = 1U << 4U,
    CatheterSoftHigh = 1U << 5U,
    CatheterHardLow = 1U << 6U,
    CatheterHardHigh = 1U << 7U,
};
inline constexpr quint16 softLimits = GuidewireSoftLow | GuidewireSoftHigh | CatheterSoftLow | CatheterSoftHigh;
inline constexpr quint16 hardLimits = GuidewireHardLow | GuidewireHardHigh | CatheterHardLow | CatheterHardHigh;

/// Codes of RobotStatus::faultCode that are no fault: a force stop is an alarm of its own, and lost commands are a hold. Whatever else a
/// robot has a code for is one.
inline constexpr quint16 noFault = 0, forceStopped = 1, commandsLost = 4;

/// Of RobotStatus::faultCode; what has no name here is shown by number.
QString faultText(quint16 code);

struct RobotStatus {
    RobotState state = RobotState::Off;
    quint32 permit = 0;
    quint32 owner = 0;    ///< the device that has armed it; 0 while nobody has
    bool engaged = false; ///< the dead-man as the robot received it
    bool holdConfirmed = false;
    quint64 holdSinceNs = 0;
    quint32 lastSequence = 0;
    quint64 appliedCommands = 0;
    quint64 refusedCommands = 0;
    double guidewirePosition = 0; ///< mm
    double guidewireAngle = 0;    ///< deg
    double catheterPosition = 0;
    double catheterAngle = 0;
    double guidewireVelocity = 0; ///< mm/s, advance positive
    double guidewireRotation = 0; ///< deg/s
    double catheterVelocity = 0;
    double catheterRotation = 0;
    double guidewireForce = 0;  ///< N, resistance positive
    double guidewireTorque = 0; ///< mN·m
    bool guidewireGripperClosed = false;
    bool catheterGripperClosed = false;
    quint16 limitSwitches = 0;
    double contrastRemaining = 0; ///< ml
    quint64 emergencyStopToken = 0;
    quint16 faultCode = 0;
    Clearance clearance = Clearance::NotAsked;
};

/// Whether the robot may move for somebody. For whom, its owner says.
inline bool isArmed(RobotState state) { return state == RobotState::Armed || state == RobotState::Engaged; }

/// In this order in DriveStatus.
enum class Drive : std::uint8_t { GuidewireAdvance, GuidewireTurn, CatheterAdvance, CatheterTurn };
inline constexpr std::size_t driveCount = 4;

struct DriveStatus {
    std::array<bool, driveCount> enabled{};
    std::array<double, driveCount> current{};        ///< A
    std::array<double, driveCount> temperature{};    ///< °C
    std::array<double, driveCount> followingError{}; ///< mm or deg
    std::array<double, driveCount> busVoltage{};     ///< V

    bool allEnabled() const { return enabled[0] && enabled[1] && enabled[2] && enabled[3]; }
};

struct TipPose {
    bool valid = false;
    std::array<double, 3> position{};   ///< mm, patient frame
    std::array<double, 4> quaternion{}; ///< w x y z
    double error = 0;                   ///< mm, root mean square
};

enum class InjectionProgress : std::uint8_t { Accepted, Running, Done, Stopped, Refused };
QString word(InjectionProgress progress);

struct InjectionStatus {
    quint32 injection = 0;
    double delivered = 0; ///< ml
    InjectionProgress progress = InjectionProgress::Accepted;
    QString reason;
};

/// Along an instrument's way from the sheath, mm.
struct TravelRange {
    double low = 0;
    double high = 0;

    double length() const { return high - low; }
};

struct InstrumentTravel {
    TravelRange soft; ///< the robot ends motion here, with deceleration
    TravelRange hard; ///< it cuts the drive beyond
};

/// Where the robot ends motion by itself, as it reports it: it depends on the vessel and on the instruments.
struct TravelLimits {
    InstrumentTravel guidewire;
    InstrumentTravel catheter;
};

/// What the robot does by itself; drawn as marks on the gauges.
struct RobotLimits {
    double forceWarn = 1.0; ///< N
    double forceStop = 2.0;
    double forceNearZero = 0.2;     ///< N, below it nobody has to look before arming
    double driveTemperature = 80.0; ///< °C, above it a drive is not healthy
};

} // namespace console
