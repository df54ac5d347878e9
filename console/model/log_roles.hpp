// What every log's model says of one line, so that one view, one filter and one export do for all of them.
#pragma once

#include <Qt>

namespace console {

/// Qt::DisplayRole is the whole line.
enum LogRole : int {
    LogWallRole = Qt::UserRole + 1, ///< qint64, Unix time in milliseconds
    LogKindRole,                    ///< int, the log's own enumeration
    LogKindWordRole,                ///< QString
    LogTextRole,                    ///< QString
    LogInstantRole,                 ///< Instant; invalid for lines of earlier runs
};

} // namespace console
