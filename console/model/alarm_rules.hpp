// Which alarm conditions are present, from one moment's readings (console design, the table of alarms).
#pragma once

#include "model/alarm_list.hpp"
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
    bool clockUncertain = false;
    QString deadlineMissed; ///< the message that is overdue; empty
};

struct AlarmReadings {
    bool armed = false; ///< Armed or Engaged, or it was when the present trouble began
    bool engaged = false;
    std::vector<AlarmLinkReading> links;
    std::optional<Duration> awaitingHold; ///< since the stop or the loss, while the robot has not confirmed its hold
    PictureReading picture;
    Duration pictureLimit{};
    bool robotFresh = false;
    double force = 0;
    RobotLimits limits;
    quint16 limitSwitches = 0;
    quint16 faultCode = 0;
    bool drivesHealthy = true;
    bool drivesKnown = false;
    bool emergencyStop = false;
};

inline constexpr std::chrono::milliseconds holdConfirmationLimit{200};

/// Pure.
std::vector<AlarmReport> presentAlarms(const AlarmReadings& readings);

} // namespace console
