// What happened, line by line.
#include "model/event_log.hpp"

#include "model/log_roles.hpp"

#include <QDateTime>

namespace console {

EventLog::EventLog(int limit, QObject* parent) : QAbstractListModel(parent), m_limit(limit) {}

int EventLog::rowCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : static_cast<int>(m_lines.size()); }

QVariant EventLog::data(const QModelIndex& index, int role) const
{
    if (!checkIndex(index, CheckIndexOption::IndexIsValid | CheckIndexOption::ParentIsInvalid))
        return {};
    const auto& line = m_lines.at(static_cast<std::size_t>(index.row()));
    switch (role) {
    case Qt::DisplayRole:
        return QStringLiteral("%1  %2  %3")
            .arg(QDateTime::fromMSecsSinceEpoch(line.wallMs).toString(QStringLiteral("HH:mm:ss.zzz")), word(line.kind), line.text);
    case LogWallRole:
        return line.wallMs;
    case LogKindRole:
        return static_cast<int>(line.kind);
    case LogKindWordRole:
        return word(line.kind);
    case LogTextRole:
        return line.text;
    case LogInstantRole:
        return QVariant::fromValue(line.at);
    default:
        return {};
    }
}

void EventLog::append(LogKind kind, const QString& text, qint64 wallMs, Instant at)
{
    if (rowCount() >= m_limit) {
        beginRemoveRows({}, 0, 0);
        m_lines.pop_front();
        ++m_lost;
        endRemoveRows();
    }
    beginInsertRows({}, rowCount(), rowCount());
    m_lines.push_back({wallMs, kind, text, at});
    endInsertRows();
}

} // namespace console
