// The cockpit's own line drawings, in any size and colour.
#pragma once

#include "model/device_node.hpp"

#include <QColor>
#include <QPixmap>
#include <QString>

class QPainter;

namespace console::icons {

enum class Icon { Hand, Eye, Brain, Arm, Special, Xray, DeadMan, Clutch, Hold, Guidewire, Catheter };

Icon forKind(DeviceKind kind);

void draw(QPainter& painter, const QRectF& where, Icon icon, const QColor& colour);
QPixmap pixmap(Icon icon, int size, const QColor& colour, double devicePixelRatio = 1.0);

} // namespace console::icons
