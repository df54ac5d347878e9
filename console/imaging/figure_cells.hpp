// Text whose figures stand in cells of one width, so that no value jumps when it changes.
#pragma once

#include <QFont>
#include <QRectF>
#include <QString>

class QPainter;

namespace console {

/// Inter's figures are proportional and Qt 6.4 cannot ask a face for its tabular ones; the cell is the widest figure's.
void drawFigures(QPainter& painter, const QRectF& where, Qt::Alignment alignment, const QString& text);
double figuresWidth(const QFont& font, const QString& text);

} // namespace console
