// What is painted over the live picture: age, source, sides, scale, frame number, liveness, and the look of a picture that is not live.
#pragma once

#include "imaging/display_picture.hpp"
#include "model/picture_state.hpp"

#include <QColor>
#include <QFont>
#include <QRect>
#include <QRegion>
#include <QString>

#include <vector>

class QPainter;

namespace console {

inline constexpr int hatchWidth = 12; ///< of the frame round the pane, pixels
inline constexpr int livenessCells = 12;

/// A text on a dark plate.
struct OverlayPlate {
    QRect rect;
    QString text;
    QFont font;
    Qt::Alignment alignment = Qt::AlignCenter;
    QColor ink;
};

/// AGE, NET, PROC and rate in one line; "unknown" where a number is not known.
QString ageLine(const PictureReading& reading);

/// The wall-clock time of the pulse, to the tenth of a second.
QString clockTime(quint64 captureNs);

/// Millimetres with which a scale bar is about a fifth of the picture, from the row 1, 2, 5, 10, 20, …
double scaleBarLength(double pictureWidthMm);

/// Lays the overlay out in `area`, the picture's rectangle on the screen.
class PictureOverlay {
public:
    PictureOverlay(QRect area, const DisplayPicture& picture, const PictureReading& reading, quint64 paintedPictures,
                   const QString& refusal, const QFont& font);

    void paint(QPainter& painter) const;

    /// Every pixel that is not the picture itself.
    QRegion region() const;

    QRect livenessRect() const { return m_liveness; }

private:
    void placeCorners(const DisplayPicture& picture, const PictureReading& reading);
    void placeReduction(const PictureReduction& reduction, bool isExpected);
    void placeSides(const DisplayPicture& picture);
    void placeCondition(const PictureReading& reading);
    void placeScale(const DisplayPicture& picture);
    void placeRefusal(const QString& refusal);
    QRect plate(const QString& text, const QFont& font, QPoint corner, Qt::Alignment alignment, const QString& widest = {});

    QRect m_area;
    QFont m_font;
    int m_gap;
    int m_headEnd = 0; ///< the lowest row of what stands at the top
    quint64 m_paintedPictures;
    std::vector<OverlayPlate> m_plates;
    QRect m_liveness;
    QRect m_scaleBar;
};

/// Over `area`: the picture at 60 %, mixed with the grey of stale things.
void paintStaleVeil(QPainter& painter, const QRect& area);

/// The frame of the pane, hatchWidth wide: a solid line, or hatched all over.
void paintSolidFrame(QPainter& painter, const QRect& pane);
void paintHatchedFrame(QPainter& painter, const QRect& pane);

} // namespace console
