// What the logs and the pictures that are kept have in common: moments on the console's own clock, which nobody sets.
#pragma once

#include "model/instant.hpp"

#include <QAbstractItemModel>

#include <cstdint>
#include <optional>

namespace console {

/// Of a moment.
enum class MomentPicture : std::uint8_t {
    Kept,
    Gone,     ///< older than what is kept
    NotTaken, ///< none came then, nor shortly before
};

/// When a line of a log was written; nothing for lines of earlier runs.
std::optional<Instant> momentOf(const QModelIndex& line);

/// The newest line that was written at `moment` or before; invalid when there is none. Lines of earlier runs were. `log` has the roles of
/// log_roles.hpp and its lines in the order in which they were written, whatever their wall clock says.
QModelIndex newestLineUntil(const QAbstractItemModel& log, Instant moment);

} // namespace console
