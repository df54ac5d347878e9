// What is painted over the live picture: age, source, sides, scale, frame number, liveness, and the look of a picture that is not live.
#pragma once

#include "imaging/display_picture.hpp"
#include "imaging/picture_marks.hpp"
#include "imaging/text_plates.hpp"
#include "model/picture_state.hpp"

#include <QFont>
#include <QRect>
#include <QRegion>
#include <QString>
#include <QStringList>

class QPainter;

namespace console {

inline constexpr int hatchWidth = 12; ///< of the frame round the pane, pixels
inline constexpr int livenessCells = 12;

/// AGE with the uncertainty of the clocks, NET, PROC and rate in one line; "unknown" where a number is not known.
QString ageLine(const PictureReading& reading);

/// Lays the overlay out in `area`, the picture's rectangle on the screen.
class PictureOverlay {
public:
    PictureOverlay(QRect area, const DisplayPicture& picture, const PictureReading& reading, quint64 paintedPictures, const QFont& font,
                   double zoom = 1);

    void paint(QPainter& painter) const;

    /// Every pixel that is not the picture itself.
    QRegion region() const;

    QRect livenessRect() const { return m_liveness; }

    /// The highest row of what stands at the foot.
    int footTop() const { return m_footTop; }

private:
    void placeHead(const DisplayPicture& picture, const PictureReading& reading);
    QRect placeAge(const PictureReading& reading, const QRect& source);
    QRect placeRow(const QStringList& parts, const QStringList& widest, const QFont& font, QPoint corner);
    void placeReduction(const PictureReduction& reduction, bool isExpected);
    void placeCondition(const PictureReading& reading);
    void placeFoot(const DisplayPicture& picture, double zoom);

    QRect m_area;
    TextPlates m_plates;
    int m_gap;
    int m_headEnd = 0; ///< the lowest row of what stands at the top
    int m_footTop = 0;
    quint64 m_paintedPictures;
    QRect m_liveness;
    QRect m_scaleBar;
};

/// Over `area`: the picture at 60 %, mixed with the grey of stale things.
void paintStaleVeil(QPainter& painter, const QRect& area);

/// The frame of the pane, hatchWidth wide: a solid line, or hatched all over.
void paintSolidFrame(QPainter& painter, const QRect& pane);
void paintHatchedFrame(QPainter& painter, const QRect& pane);

/// Of a pane that never shows the live picture.
void paintDashedFrame(QPainter& painter, const QRect& pane);

/// Round a pane that has the keys.
void paintFocusFrame(QPainter& painter, const QRect& pane);

} // namespace console
