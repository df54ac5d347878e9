// Whether the cockpit may be closed: why not, and what comes first.
#pragma once

#include "model/console_models.hpp"

#include <QString>

#include <optional>

namespace console {

struct ClosingBar {
    QString why;   ///< `the permit is ENGAGED`
    QString first; ///< what a person does, as a sentence
};

/// With the cockpit go its picture, its alarms and its links; so it stays while somebody relies on them: from ARM on until the hold is
/// over, or the alarm of a lost link acknowledged, while contrast or X-ray is given, until an emergency stop was answered or is an alarm,
/// and beside a high alarm that nobody has acknowledged. The first of these in that order; nothing when it may be closed.
std::optional<ClosingBar> closingBar(const ConsoleModels& models, Instant now);

} // namespace console
