// Moments of log lines.
#include "model/log_moments.hpp"

#include "model/log_roles.hpp"

namespace console {

std::optional<Instant> momentOf(const QModelIndex& line)
{
    const QVariant at = line.data(LogInstantRole);
    return at.isValid() ? std::optional<Instant>(at.value<Instant>()) : std::nullopt;
}

QModelIndex newestLineUntil(const QAbstractItemModel& log, Instant moment)
{
    // From the end: what is reviewed is a minute old at most.
    for (int row = log.rowCount() - 1; row >= 0; --row) {
        const QModelIndex line = log.index(row, 0);
        const auto at = momentOf(line);
        if (!at || *at <= moment)
            return line;
    }
    return {};
}

} // namespace console
