// Text whose figures stand in cells of one width, so that no value jumps when it changes.
#pragma once

#include <QFont>
#include <QRectF>
#include <QString>

class QPainter;

namespace console {

/// The cell is the widest figure's. The console's own typeface has figures of one width; what stands in for it may not.
void drawFigures(QPainter& painter, const QRectF& where, Qt::Alignment alignment, const QString& text);
double figuresWidth(const QFont& font, const QString& text);

} // namespace console
