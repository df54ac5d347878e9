// The alarm log for those who show it: of earlier runs as far as it was kept, and of this one.
#pragma once

#include "model/alarm_list.hpp"

#include <QAbstractListModel>

#include <deque>

namespace console {

/// GUI thread only. Follows `alarms`, which must outlive it; oldest first, bounded as the list's own log. The kind is the priority.
class AlarmLogModel : public QAbstractListModel {
    Q_OBJECT
public:
    explicit AlarmLogModel(const AlarmList& alarms, QObject* parent = nullptr);

    int rowCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;

private:
    void append(const AlarmLogEntry& entry);
    void takeAll();

    const AlarmList& m_alarms;
    std::deque<AlarmLogEntry> m_entries;
};

} // namespace console
