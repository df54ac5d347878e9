// The last check before the actuators: lease, watchdog, envelope, limits and force stop of the robot's four drives.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace liena::devices {

using SteadyTime = std::chrono::steady_clock::time_point;

/// In the order of DriveStatus.
enum class Axis : std::uint8_t { GuidewireAdvance, GuidewireTurn, CatheterAdvance, CatheterTurn };

inline constexpr std::size_t axisCount = 4;

/// One number per axis: mm or deg, mm/s or deg/s.
using AxisValues = std::array<double, axisCount>;

struct AxisRange {
    double low = 0;
    double high = 0;
};

struct AxisEnvelope {
    double maxVelocity = 0;
    double acceleration = 0;       ///< when a person asks for more speed
    double deceleration = 0;       ///< when a stop asks for less
    std::optional<AxisRange> soft; ///< motion ends here, with deceleration
    std::optional<AxisRange> hard; ///< beyond it the drive is cut; nothing but the way back is open
};

struct DriveLimits {
    std::array<AxisEnvelope, axisCount> axes;
    std::chrono::nanoseconds lease = std::chrono::milliseconds(50);    ///< since the last accepted command with `engaged`
    std::chrono::nanoseconds watchdog = std::chrono::milliseconds(60); ///< between two runs of the control loop
    double forceStop = 2.0;                                            ///< N on the guidewire, either direction

    /// 40 mm/s and 720 or 360 deg/s, full speed to standstill in 20 ms, the way from the sheath to `wayLength` mm.
    static DriveLimits forWay(double wayLength);
};

enum class StopCause : std::uint8_t { LeaseOver, SoftLimit, HardLimit, ForceStop, Watchdog };

std::string_view toString(StopCause cause);

/// What the sensors say at the start of a step.
struct DriveFeedback {
    AxisValues positions{};
    double guidewireForce = 0; ///< N; positive against advance
};

struct DriveStep {
    AxisValues velocities{};       ///< at the end of the step
    AxisValues displacements{};    ///< what the drives moved in it
    bool still = true;             ///< no axis moves and none is asked to
    std::optional<StopCause> stop; ///< the gate locked itself in this step
};

/// Never moves unless it was enabled since its last stop, and a command within the envelope was accepted less than `lease` ago.
///
///            enable(), still              drive(v)                 drive(v): lease renewed
///   Locked ───────────────────► Enabled ───────────► Driving ◄──┐
///     ▲                           ▲                   │  │ └────┘
///     │ still                     │ still, released   │  │
///     │                           └──── Releasing ◄───┘  │ lease over, limit, force, stop()
///     └──────────────── Stopping ◄───────────────────────┘
///
///   cut() and the watchdog: from anywhere to Locked, standing still at once.
///
/// Every stop locks: no command moves the drives again before enable(), which is refused while anything moves. Time comes from the caller
/// and never runs back; a step is cut into parts of 1 ms, so the lease ends in time however late the control loop runs. Not for two threads
/// at once.
class DriveGate {
public:
    explicit DriveGate(DriveLimits limits);

    /// Opens the gate for commands; false, without effect, while a drive moves.
    bool enable();

    /// Renews the lease from `commanded`, the moment the command arrived. False, and the lease stays as it is, when the gate is locked, the
    /// command is older than a lease at the last step or at `now`, or a value is outside the envelope or no number. A process that was
    /// frozen between arrival and this call has made no step in between: it needs `now`, the moment of the call.
    bool drive(const AxisValues& velocities, SteadyTime commanded, SteadyTime now);

    /// The dead-man was released: decelerate, stay enabled.
    void release();

    /// Decelerate and lock.
    void stop();

    /// Stand still at once and lock.
    void cut();

    /// Runs the drives until `now`.
    DriveStep step(SteadyTime now, const DriveFeedback& feedback);

    bool enabled() const { return m_enabled; }
    bool still() const;
    const AxisValues& velocities() const { return m_velocities; }
    const DriveLimits& limits() const { return m_limits; }

private:
    void lock(StopCause cause, DriveStep& step);
    void runPart(SteadyTime partEnd, double seconds, DriveStep& step);
    void checkForce(double force, DriveStep& step);
    void checkHardLimits(DriveStep& step);
    bool runAxis(std::size_t axis, double seconds, DriveStep& step);
    double distanceAhead(std::size_t axis, double direction) const;

    DriveLimits m_limits;
    AxisValues m_positions{};
    AxisValues m_velocities{};
    AxisValues m_targets{};
    std::optional<SteadyTime> m_leaseEnd; ///< present while driving
    std::optional<SteadyTime> m_lastStep;
    bool m_enabled = false;
};

} // namespace liena::devices
