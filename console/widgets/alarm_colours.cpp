// The colours of alarms, all from the theme.
#include "widgets/alarm_colours.hpp"

#include "widgets/theme.hpp"

#include <QPainter>

namespace console {

namespace colour = theme::colour;

AlarmColours alarmColours(AlarmPriority priority, bool acknowledged)
{
    switch (priority) {
    case AlarmPriority::High:
        return {acknowledged ? colour::highSurfaceDim : colour::highSurface,
                Qt::white,
                Qt::white,
                colour::highSurface,
                colour::highSurfaceDim,
                Qt::white};
    case AlarmPriority::Medium:
        return {acknowledged ? colour::mediumSurfaceDim : colour::medium,
                acknowledged ? QColor(Qt::white) : colour::onAlarm,
                colour::onAlarm,
                colour::medium,
                colour::mediumSurfaceDim,
                Qt::white};
    case AlarmPriority::Low:
        break;
    }
    return {acknowledged ? colour::raised : colour::low,
            acknowledged ? colour::low : colour::onAlarm,
            colour::onAlarm,
            colour::low,
            colour::onAlarm,
            colour::low};
}

void drawPriorityBars(QPainter& painter, const QRectF& where, AlarmPriority priority)
{
    const int bars = priority == AlarmPriority::High ? 3 : priority == AlarmPriority::Medium ? 2 : 1;
    const double step = where.width() / 3;
    for (int i = 0; i < bars; ++i) {
        const double tall = where.height() * (0.45 + 0.275 * i);
        painter.fillRect(QRectF(where.left() + i * step, where.bottom() - tall, step * 0.6, tall), painter.pen().color());
    }
}

} // namespace console
