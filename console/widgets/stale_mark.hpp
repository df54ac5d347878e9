// How an old value looks: grey, with a clock mark and its age in words. Never like a live one.
#pragma once

#include "model/aged.hpp"

#include <QColor>
#include <QString>

class QPainter;
class QRectF;

namespace console {

/// Ink of a value: bright when fresh, grey when stale or unknown.
QColor valueInk(Freshness freshness);

/// `age 9 ms`, `stale 0.4 s`, `never received`.
QString ageText(Freshness freshness, Duration age);

/// A small clock face; nothing when fresh.
void drawStaleMark(QPainter& painter, const QRectF& where, Freshness freshness);

} // namespace console
