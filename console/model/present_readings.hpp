// One moment of the console's models, as the guards, the alarms, the trends, the prompt and the account of an interruption ask for it.
#pragma once

#include "model/console_models.hpp"

#include <optional>

namespace console {

/// The robot names this console as the one that has armed it.
bool ownsRobot(const ConsoleModels& models);

/// The device that the robot, as it last reported, names instead; nothing while nobody has armed it, or this console.
std::optional<quint32> anotherOwner(const ConsoleModels& models);

/// The robotic arm reported a fault, however long ago: what it said last stands until it says otherwise, or until its link is closed.
bool armFault(const ConsoleModels& models);

/// How long no pause of the alarms' sound may begin; nothing when one may, or runs.
std::optional<Duration> soundStaysFor(const ConsoleModels& models, Instant now);

/// The tip as the scene shows it: as it is measured, or where it was last while no session with `robot` carries messages. In stand-by the
/// last known place helps; while the robot can move, one that is no longer measured must not be steered by.
std::optional<TipPose> shownTip(const ConsoleModels& models, std::optional<quint32> robot, Instant now);

/// `robot`: the device that is moved; nothing when the topology has none. `windowActive`: the hand may use the keyboard.
GuardReadings guardReadings(const ConsoleModels& models, std::optional<quint32> robot, bool windowActive, Instant now);

/// Of what is fresh only: a course must end where the knowledge ends.
TrendReading trendReading(const ConsoleModels& models, std::optional<quint32> robot, Instant now);

/// `picturesReceived`: by this console since its start, when it had the newest report of the X-ray system.
SystemSnapshot systemSnapshot(const ConsoleModels& models, quint64 picturesReceived, Instant now);

PromptSurroundings promptSurroundings(const ConsoleModels& models, Instant now);

} // namespace console
