// What is measured, drawn on a picture.
#include "imaging/measurement_marks.hpp"

#include "imaging/pane_colours.hpp"

#include <QPainter>

namespace console {

namespace {

constexpr double crossArm = 7;

void paintCross(QPainter& painter, QPointF at)
{
    painter.drawLine(at - QPointF(crossArm, 0), at + QPointF(crossArm, 0));
    painter.drawLine(at - QPointF(0, crossArm), at + QPointF(0, crossArm));
}

} // namespace

void paintMeasured(QPainter& painter, const std::vector<QPointF>& points, const std::optional<QPointF>& cursor)
{
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    for (const QPen& pen : {QPen(pane_colours::background, 4), QPen(pane_colours::wire, 1.5)}) {
        painter.setPen(pen);
        for (std::size_t i = 0; i < points.size(); ++i) {
            paintCross(painter, points[i]);
            if (i > 0)
                painter.drawLine(points[i - 1], points[i]);
        }
        if (cursor)
            paintCross(painter, *cursor);
    }
    painter.restore();
}

int measuredFoot(const QRect& area) { return area.top() + area.height() * 5 / 8; }

} // namespace console
