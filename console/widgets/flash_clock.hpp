// The one flash clock of the screen.
#pragma once

#include "model/alarm_list.hpp"
#include "model/instant.hpp"

#include <QObject>
#include <QTimer>

namespace console {

/// 2 Hz for high, 0.6 Hz for medium, half on and half off; low does not flash. Whoever flashes asks this clock, so that all do it together.
class FlashClock : public QObject {
    Q_OBJECT
public:
    explicit FlashClock(QObject* parent = nullptr);

    bool isLit(AlarmPriority priority) const { return litAt(priority, m_phase); }

    /// From now on it shows that moment and keeps no time of its own.
    void drive(Duration phase);

    static bool litAt(AlarmPriority priority, Duration phase);

Q_SIGNALS:
    /// Something went on or off.
    void ticked();

private:
    void proceed();

    Instant m_begun;
    Duration m_phase{};
    QTimer m_timer;
};

} // namespace console
