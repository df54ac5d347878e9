// What sounds the alarm bursts, and whether it can.
#pragma once

#include "model/alarm_list.hpp"

#include <QObject>
#include <QString>

namespace console {

class AlarmVoice : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;

    /// From its beginning, in place of what sounds. Never waits.
    virtual void play(console::AlarmPriority priority) = 0;
    virtual void silence() = 0;

Q_SIGNALS:
    /// Why nothing would be heard; empty: it would, as far as this program can know.
    void troubleChanged(const QString& trouble);
};

} // namespace console
