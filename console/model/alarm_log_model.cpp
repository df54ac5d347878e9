// The alarm log, row by row.
#include "model/alarm_log_model.hpp"

#include "model/log_roles.hpp"

#include <QDateTime>

namespace console {

AlarmLogModel::AlarmLogModel(const AlarmList& alarms, QObject* parent)
    : QAbstractListModel(parent), m_alarms(alarms), m_entries(alarms.log())
{
    connect(&alarms, &AlarmList::logged, this, &AlarmLogModel::append);
    connect(&alarms, &AlarmList::logRestored, this, &AlarmLogModel::takeAll);
}

int AlarmLogModel::rowCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : static_cast<int>(m_entries.size()); }

QVariant AlarmLogModel::data(const QModelIndex& index, int role) const
{
    if (!checkIndex(index, CheckIndexOption::IndexIsValid | CheckIndexOption::ParentIsInvalid))
        return {};
    const auto& entry = m_entries.at(static_cast<std::size_t>(index.row()));
    switch (role) {
    case Qt::DisplayRole:
        return QStringLiteral("%1  %2  %3")
            .arg(QDateTime::fromMSecsSinceEpoch(entry.wallMs).toString(QStringLiteral("yyyy-MM-dd HH:mm:ss.zzz")), word(entry.priority),
                 entry.text);
    case LogWallRole:
        return entry.wallMs;
    case LogKindRole:
        return static_cast<int>(entry.priority);
    case LogKindWordRole:
        return word(entry.priority);
    case LogTextRole:
        return entry.text;
    case LogInstantRole:
        return entry.at ? QVariant::fromValue(*entry.at) : QVariant();
    default:
        return {};
    }
}

void AlarmLogModel::append(const AlarmLogEntry& entry)
{
    if (m_entries.size() >= AlarmList::logLimit) {
        beginRemoveRows({}, 0, 0);
        m_entries.pop_front();
        endRemoveRows();
    }
    beginInsertRows({}, rowCount(), rowCount());
    m_entries.push_back(entry);
    endInsertRows();
}

void AlarmLogModel::takeAll()
{
    beginResetModel();
    m_entries = m_alarms.log();
    endResetModel();
}

} // namespace console
