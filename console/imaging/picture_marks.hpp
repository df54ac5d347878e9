// The marks that every picture carries, live or not: sides, scale, how it was treated.
#pragma once

#include "imaging/display_picture.hpp"
#include "imaging/text_plates.hpp"

#include <QRect>
#include <QString>

namespace console {

/// Millimetres with which a scale bar is about a fifth of the picture, from the row 1, 2, 5, 10, 20, …
double scaleBarLength(double pictureWidthMm);

/// The wall-clock time of the pulse, to the tenth of a second.
QString clockTime(quint64 captureNs);

/// `MEAN OF 4`; empty for a picture that is no mean. With its role the words that say what it is: `LAST IMAGE HOLD · MEAN OF 4`.
QString meanWords(const DisplayPicture& picture);
QString roleWords(const DisplayPicture& picture);

/// `C 2048  W 4096  AUTO`, and what else is not as sent: calibration first, then inverse, noise reduction, edges, shutter.
QString windowLine(const DisplayPicture& picture);
QString treatmentLine(const DisplayPicture& picture);

/// Of the patient, at the left and the right edge of `area`: R and L, or A and P from the side.
void placeSides(TextPlates& plates, const QRect& area, const DisplayPicture& picture);

/// The label in the lower right corner, and the bar above it; an empty one when the scale is unknown. `shownShare`: of the picture's width.
QRect placeScale(TextPlates& plates, const QRect& area, const DisplayPicture& picture, double shownShare);
void paintScaleBar(QPainter& painter, const QRect& bar);

/// Frame, run, window and treatment in the lower left corner, above the scale's label and `bar` where there is no room beside them. The
/// window and whether the display is calibrated stand there whatever else has no room.
void placeFacts(TextPlates& plates, const QRect& area, const QRect& bar, const DisplayPicture& picture, double zoom);

} // namespace console
