// Whether what happens is written down.
#pragma once

#include <QString>
#include <QStringList>
#include <QtGlobal>

namespace console {

/// A value, GUI thread only; those who show it look at it on their own clock.
struct RecorderState {
    bool logKept = false; ///< entries of the alarm log reach the disk
    QString logTrouble;   ///< in words; may be a warning while they still do
    QString auditTrouble; ///< the audit file of the sessions is not written; empty: it is, or none was asked for

    bool keeps() const { return logKept && auditTrouble.isEmpty(); }

    /// One bit for each loss: what the log does not keep any more is more than what it warned of, and less than that is no news.
    quint64 causes() const
    {
        constexpr quint64 warned = 1, logLost = 2, auditLost = 4;
        const quint64 log = logTrouble.isEmpty() ? 0 : logKept ? warned : warned | logLost;
        return auditTrouble.isEmpty() ? log : log | auditLost;
    }

    QStringList troubles() const
    {
        QStringList all{logTrouble, auditTrouble};
        all.removeAll(QString());
        return all;
    }
};

} // namespace console
