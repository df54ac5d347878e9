// The line of a value over time.
#pragma once

class QPainter;
class QPainterPath;

namespace console {

/// Draws `course` in the colour of plots, about one and a half pixels wide, whatever its length: a course has hundreds of points and is
/// drawn anew several times a second.
void drawCourse(QPainter& painter, const QPainterPath& course);

} // namespace console
