// The cockpit's own line drawings, in any size and colour.
#pragma once

#include "model/device_node.hpp"

#include <QColor>
#include <QRectF>

class QPainter;

namespace console::icons {

enum class Icon { Hand, Eye, Brain, Arm, Special, Xray, DeadMan, Clutch, Hold, Guidewire, Catheter };

Icon forKind(DeviceKind kind);

void draw(QPainter& painter, const QRectF& where, Icon icon, const QColor& colour);

} // namespace console::icons
