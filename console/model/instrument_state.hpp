// The robot as it last reported itself, every report with its age.
#pragma once

#include "model/aged.hpp"
#include "model/robot_values.hpp"

#include <QObject>

#include <chrono>
#include <cmath>
#include <deque>
#include <optional>
#include <vector>

namespace console {

/// GUI thread only. Arrives up to a hundred times a second: widgets repaint on their own clock, not on these signals.
class InstrumentState : public QObject {
    Q_OBJECT
public:
    // Older than this, a value is shown as stale and counts for nothing.
    static constexpr std::chrono::milliseconds statusLimit{100};
    static constexpr std::chrono::milliseconds driveLimit{1000};
    static constexpr std::chrono::milliseconds tipLimit{200};

    struct ForceSample {
        Instant at;
        double force = 0;
    };
    static constexpr std::chrono::seconds forceTrail{10};
    static constexpr std::chrono::seconds acceptedFor{30};

    static constexpr double emptyContrast = 0.05;                    ///< mL; less is shown as none
    static constexpr std::chrono::milliseconds contrastSettles{100}; ///< from the end of an injection to the report of what is left

    explicit InstrumentState(QObject* parent = nullptr);

    const Aged<RobotStatus>& robot() const { return m_robot; }
    const Aged<DriveStatus>& drives() const { return m_drives; }
    const Aged<TipPose>& tip() const { return m_tip; }
    const std::deque<InjectionStatus>& injections() const { return m_injections; } ///< the last 16, oldest first
    bool injecting() const;                                                    ///< the last one has not ended, as far as the robot has told
    std::optional<Instant> injectionHeard() const { return m_injectionHeard; } ///< of the last one, when its newest report arrived
    /// Nothing was left while an injection ran, or when it was stopped: there may be air. Until contrast is left again.
    bool ranDry() const { return m_ranDry; }

    const std::deque<ForceSample>& forceHistory() const { return m_forces; }
    const RobotLimits& limits() const { return m_limits; }
    const std::optional<TravelLimits>& travel() const { return m_travel; } ///< nothing before the robot has reported it

    bool robotFresh(Instant now) const { return m_robot.freshness(now, statusLimit) == Freshness::Fresh; }
    bool tipFresh(Instant now) const { return m_tip.freshness(now, tipLimit) == Freshness::Fresh && m_tip.value.valid; }

    /// Known, recent, none too warm, and the robot reports no fault. Whether they are enabled is the robot's affair: it enables them when
    /// armed.
    bool drivesHealthy(Instant now) const;

    double peakForce() const { return m_peakForce; } ///< largest magnitude since resetPeakForce()
    void resetPeakForce() { m_peakForce = m_robot.known() ? std::abs(m_robot.value.guidewireForce) : 0; } ///< from the present force on
    double mostContrast() const { return m_mostContrast; } ///< mL, the most that was ever left
    quint64 statusCount() const { return m_statusCount; }

    /// Since when a person has been asking for an emergency stop that the robot has not named; nothing when there is none. One of another
    /// token that is in force says nothing of it: that one may be reset.
    std::optional<Instant> stopUnheard() const { return m_unheard.empty() ? std::nullopt : std::optional(m_unheard.front().at); }

    /// A force stands that keeps the robot from being armed, and is small enough for a person to arm all the same: known, not near zero,
    /// below the warning, and not accepted yet.
    bool mayAcceptForce(Instant now) const;

    /// A person has looked at a force of `shown` N. It holds for that and a little more, for `acceptedFor`, until dropForce(), or until the
    /// force has gone; false when it may not be, or when the force is another by now.
    bool acceptForce(double shown, Instant now);
    void dropForce() { m_acceptedForce.reset(); }
    bool forceAccepted(Instant now) const;

    /// The robot is not heard any more: an accepted force is dropped, and an injection that ran counts as stopped, which it is at the
    /// robot.
    void endWatch(Instant now);

    // For the link room.
    void noteStopAsked(quint64 token, Instant at);
    void receiveRobot(const RobotStatus& status, Instant at);
    void receiveDrives(const DriveStatus& status, Instant at);
    void receiveTip(const TipPose& pose, Instant at);
    void receiveTravel(const TravelLimits& limits) { m_travel = limits; }
    void receiveInjection(const InjectionStatus& status, Instant at);

Q_SIGNALS:
    void robotChanged();
    void drivesChanged();
    void tipChanged();
    void injectionChanged(quint32 injection);
    void robotStateChanged(console::RobotState state);

private:
    struct AskedStop {
        quint64 token = 0;
        Instant at;
    };

    void hearStop(quint64 token);
    void noteContrast(Instant at);

    Aged<RobotStatus> m_robot;
    Aged<DriveStatus> m_drives;
    Aged<TipPose> m_tip;
    std::deque<InjectionStatus> m_injections;
    std::deque<ForceSample> m_forces;
    RobotLimits m_limits;
    std::optional<TravelLimits> m_travel;
    std::optional<Instant> m_injectionHeard;
    std::vector<AskedStop> m_unheard;          ///< stops that the robot has not named, oldest first
    std::optional<Instant> m_injectionStopped; ///< of the last one, when that was told first
    bool m_ranDry = false;
    std::optional<double> m_acceptedForce; ///< N, magnitude
    Instant m_acceptedAt;
    double m_peakForce = 0;
    double m_mostContrast = 0;
    quint64 m_statusCount = 0;
};

} // namespace console
