// One direction of a link as an arrow: whole, doubtful, broken, or not there.
#pragma once

#include "model/link_state.hpp"

#include <QLineF>

class QPainter;

namespace console {

/// Shape before colour: a dashed arrow doubts, a broken one has a gap with a cross, a dotted line without a head is closed.
enum class ArrowLook { Closed, Changing, Whole, Doubtful, Broken, NotKnown };

ArrowLook arrowLook(LinkState state, bool connected);

void drawLinkArrow(QPainter& painter, const QLineF& way, ArrowLook look, double thickness = 2.0);

} // namespace console
