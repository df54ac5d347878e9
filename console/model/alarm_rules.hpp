// Which alarm conditions are present, from one moment's readings (console design, the table of alarms).
#pragma once

#include "model/alarm_list.hpp"
#include "model/injection_order.hpp"
#include "model/link_state.hpp"
#include "model/motion_permit.hpp"
#include "model/picture_state.hpp"

#include <QString>

#include <chrono>
#include <optional>
#include <vector>

namespace console {

struct AlarmLinkReading {
    quint32 peer = 0;
    QString title;
    LinkState state = LinkState::Closed;
    int suspectsInMinute = 0;
    bool jittery = false; ///< above the profile's limit, and not only for a moment
    bool lossy = false;
    bool packetsLost = false;
    bool clockUncertain = false;
    QString deadlineMissed;        ///< the message that is overdue; empty
    bool images = false;           ///< it carries the live picture
    bool closedWhileArmed = false; ///< and is not open again; whoever closed it
    bool systemDiffers = false;
    std::optional<Duration> commandRoundTrip; ///< the robot's link only: there and back, as heartbeats measure it
};

/// Two other devices whose link is lost.
struct AlarmPairReading {
    quint32 a = 0;
    quint32 b = 0;
    QString titleOfA;
    QString titleOfB;
};

/// What of a picture stream arrived and what of it was painted, over the same seconds.
struct PaintingReading {
    double deliveredPerSecond = 0;
    double paintedPerSecond = 0;
    bool alarmed = false; ///< already: then it takes more to end it than it took to raise it
};

struct AlarmReadings {
    bool armed = false; ///< Armed or Engaged, or it was when the present trouble began
    bool engaged = false;
    std::vector<AlarmLinkReading> links;
    std::vector<AlarmPairReading> pairs;  ///< lost while this console heard both devices
    std::optional<Duration> awaitingHold; ///< since the stop or the loss, while the robot has not confirmed its hold
    std::optional<Duration> stopUnheard;  ///< since the person asked, while the robot has not told of a stop
    PictureReading picture;
    bool pictureTooOld = false; ///< for a moment, which ended motion
    bool pictureSlow = false;   ///< and not only for a moment
    Duration pictureLimit{};
    LineLimits line;
    bool robotFresh = false;
    double force = 0;
    RobotLimits limits;
    quint16 limitSwitches = 0;
    quint16 faultCode = 0;
    bool drivesHealthy = true;
    bool drivesKnown = false;
    bool driveOff = false; ///< while armed
    bool armFault = false;
    quint32 arm = 0; ///< the robotic arm
    bool emergencyStop = false;
    QString roadmapRemoved;      ///< why the roadmap that a person wants is not shown any more; empty
    bool trackerOverdue = false; ///< it reported, its link is up, and there is no valid recent report
    double contrastLeft = 0;     ///< mL, meaningful while robotFresh
    bool contrastRanDry = false;
    std::optional<double> airKerma;        ///< mGy, as last repeated from the X-ray system
    std::optional<double> fluoroscopyTime; ///< s, the same
    std::optional<PaintingReading> painting;
    QStringList recorderTroubles; ///< what is not recorded, and why; empty when all is
    quint64 recorderCauses = 0;   ///< their kinds, as RecorderState has them
    QString soundTrouble;         ///< why nothing would be heard; empty when it would
    QString watchdogTrouble;
};

inline constexpr std::chrono::milliseconds holdConfirmationLimit{200};

/// So long the first pictures of a link may come without an age, while nothing is armed: its clocks are still being compared.
inline constexpr std::chrono::seconds clockComparison{2};

inline constexpr double paintedPart = 0.8;      ///< of the delivered pictures; fewer is too few
inline constexpr double paintedPartAgain = 0.9; ///< of them, until enough are painted again

// Air kerma at the reference point: from the first on and at every whole gray, and where it becomes more urgent.
inline constexpr double kermaFirst = 3000;  ///< mGy
inline constexpr double kermaUrgent = 5000; ///< mGy

/// Beam time after which, and again after which, X-ray systems have to be heard (21 CFR 1020.32); this console repeats it.
inline constexpr double fluoroscopySignal = 300; ///< s

/// Pure.
std::vector<AlarmReport> presentAlarms(const AlarmReadings& readings);

} // namespace console
