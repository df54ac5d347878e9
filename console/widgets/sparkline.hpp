// Sixty seconds of one figure of a link, with gaps where it was not known.
#pragma once

#include "model/link_figures.hpp"

#include <QRectF>

#include <deque>

class QPainter;

namespace console {

/// Round trip over time; a stretch without an open session is hatched, so that silence is not read as calm.
void drawSparkline(QPainter& painter, const QRectF& where, const std::deque<LinkSample>& history, Instant now);

} // namespace console
