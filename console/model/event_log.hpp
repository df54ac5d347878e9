// What happened, line by line, oldest first; bounded.
#pragma once

#include "model/instant.hpp"

#include <QAbstractListModel>
#include <QString>

#include <cstdint>
#include <deque>

namespace console {

enum class LogKind : std::uint8_t { Note, Link, Permit, Alarm, Operator, Trouble };
QString word(LogKind kind);

struct LogLine {
    qint64 wallMs = 0; ///< Unix time, milliseconds
    LogKind kind = LogKind::Note;
    QString text;
    Instant at; ///< for comparing: a wall clock may be set
};

/// GUI thread only. One column, with the roles of log_roles.hpp.
class EventLog : public QAbstractListModel {
    Q_OBJECT
public:
    static constexpr int usualLimit = 5000;

    explicit EventLog(int limit = usualLimit, QObject* parent = nullptr);

    int rowCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;

    const std::deque<LogLine>& lines() const { return m_lines; }
    quint64 lost() const { return m_lost; } ///< lines that had to go

    /// Both clocks at the moment of which the line tells; as it happens the second is the present.
    void append(LogKind kind, const QString& text, qint64 wallMs, Instant at = std::chrono::steady_clock::now());

private:
    int m_limit;
    std::deque<LogLine> m_lines;
    quint64 m_lost = 0;
};

} // namespace console
