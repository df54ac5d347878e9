// How an alarm of each priority looks: its colours, and the bars that tell it without colour.
#pragma once

#include "model/alarm_list.hpp"

#include <QColor>
#include <QRectF>

class QPainter;

namespace console {

struct AlarmColours {
    QColor surface, ink;
    QColor badgeLit, badgeInkLit; ///< the badge flashes between these …
    QColor badgeDim, badgeInkDim; ///< … and these
};

AlarmColours alarmColours(AlarmPriority priority, bool acknowledged);

/// One bar for low, two for medium, three for high, in the pen's colour.
void drawPriorityBars(QPainter& painter, const QRectF& where, AlarmPriority priority);

} // namespace console
