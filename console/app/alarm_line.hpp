// One line of the alarm log's file.
#pragma once

#include "model/alarm_list.hpp"

#include <QByteArray>

namespace console {

inline constexpr qint64 alarmLineLimit = 2048; ///< bytes; a longer text is cut

struct AlarmLine {
    QByteArray bytes; ///< with its line end
    QByteArray chain; ///< for the next line
};

/// `{"at":"…","ms":…,"priority":"high","text":"…","chain":"…"}`; the chain is the hash of the chain before and of all that stands before
/// it.
AlarmLine alarmLine(const AlarmLogEntry& entry, const QByteArray& chain);

struct ReadLine {
    bool readable = false;
    bool fits = false; ///< its chain is the one that follows from `chain`
    AlarmLogEntry entry;
    QByteArray chain; ///< as the line has it
};

ReadLine readAlarmLine(const QByteArray& line, const QByteArray& chain);

} // namespace console
