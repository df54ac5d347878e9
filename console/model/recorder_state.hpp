// Whether what happens is written down.
#pragma once

#include <QString>
#include <QStringList>

namespace console {

/// A value, GUI thread only; those who show it look at it on their own clock.
struct RecorderState {
    bool logKept = false; ///< entries of the alarm log reach the disk
    QString logTrouble;   ///< in words; may be a warning while they still do
    QString auditTrouble; ///< the audit file of the sessions is not written; empty: it is, or none was asked for

    bool keeps() const { return logKept && auditTrouble.isEmpty(); }

    QStringList troubles() const
    {
        QStringList all{logTrouble, auditTrouble};
        all.removeAll(QString());
        return all;
    }
};

} // namespace console
