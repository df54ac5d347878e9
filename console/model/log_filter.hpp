// Those lines of a log that a person wants to see, and how they are written into a file.
#pragma once

#include <QByteArray>
#include <QSet>
#include <QSortFilterProxyModel>
#include <QString>

namespace console {

/// Over a model with the roles of log_roles.hpp. Without a choice every line passes.
class LogFilter : public QSortFilterProxyModel {
    Q_OBJECT
public:
    explicit LogFilter(QObject* parent = nullptr);

    /// Empty: every kind.
    void setKinds(const QSet<int>& kinds);
    const QSet<int>& kinds() const { return m_kinds; }

    /// Any part of a line's text, whatever its case; empty: every text.
    void setWords(const QString& words);
    const QString& words() const { return m_words; }

protected:
    bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

private:
    QSet<int> m_kinds;
    QString m_words;
};

/// What the filter lets through as UTF-8 text: a head that says what it is and what was left out, then a line each, `time TAB kind TAB
/// text` with the time in UTC. Control characters become spaces: a name from a peer cannot make a line of its own. `name`: of the log.
QByteArray logText(const LogFilter& filter, const QString& name, qint64 writtenWallMs);

} // namespace console
