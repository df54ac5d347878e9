// What is measured, drawn on a picture.
#pragma once

#include <QPoint>
#include <QPointF>
#include <QRect>

#include <optional>
#include <vector>

class QPainter;

namespace console {

/// A cross at each point and the lines between them, light on a dark edge: to be seen on every grey. `cursor`: of the next point.
void paintMeasured(QPainter& painter, const std::vector<QPointF>& points, const std::optional<QPointF>& cursor = {});

/// The lowest row of the result's plate; what else is said of it stands below.
int measuredFoot(const QRect& area);

} // namespace console
