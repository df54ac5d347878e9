// A console's models filled with invented values, for pictures and for tests of what is shown.
#pragma once

#include "model/alarm_list.hpp"
#include "model/console_models.hpp"

#include <vector>

namespace console::test {

inline constexpr quint32 cockpitId = 0x40018208;
inline constexpr quint32 robotId = 0x00008208;
inline constexpr quint32 armId = 0x60008208;
inline constexpr quint32 xrayId = 0x20010208;
inline constexpr quint32 permitNumber = 7;

/// Each step brings the models to a state of the cerebrovascular system as it would be at `now`.
struct InventedCockpit {
    ConsoleModels models;
    Instant now = std::chrono::steady_clock::now();

    InventedCockpit();

    void openAll();
    void arm();       ///< after openAll
    void engage();    ///< after arm
    void feelForce(); ///< after engage: by the simulated haptic master
    void losePad();   ///< the game pad in use was pulled out; a 3-D mouse is there as well
    void freezePicture();
    void restWithForce(); ///< after openAll: the wire is under tension, and nothing else is missing
    void loseRobot(quint64 incident = 0x5eed);
    void loseXray(quint64 incident = 0xf1a9);
    void reopenAll(); ///< after a loss, and the account of it is unread
    void logEvents();
    void testAlarms();                ///< the self-test was done, and confirmed
    void renew();                     ///< every open link has just been heard again
    void letReportsAge(Duration age); ///< the robot's newest report was received so long ago

    GuardReadings goodReadings() const;
    RobotStatus status(RobotState state) const;

private:
    void fillHistory(quint32 peer, double roundTripMs, LinkState state);
    void fillTrends();
    void paintPictures(Duration since);
    LinkFigures figures(double roundTripMs) const;
    void feed(PermitEventKind kind, RobotState robot = RobotState::Ready);
    void lose(quint32 peer, quint64 incident, const LinkDiagnosis& diagnosis);

    void noteSystem();

    quint64 m_pictures = 0; ///< received
};

} // namespace console::test
