// Two lines of one pixel each.
#include "widgets/course_line.hpp"

#include "widgets/theme.hpp"

#include <QPainter>
#include <QPainterPath>

namespace console {

// Qt draws a pen of one pixel directly; of a wider one it first computes the outline, which takes fifty times as long.
void drawCourse(QPainter& painter, const QPainterPath& course)
{
    painter.setPen(QPen(theme::colour::plot, 1));
    painter.setBrush(Qt::NoBrush);
    for (const double below : {-0.25, 0.25})
        painter.drawPath(course.translated(0, below));
}

} // namespace console
