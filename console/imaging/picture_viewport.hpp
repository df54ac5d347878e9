// Which part of a picture stands where in its pane: zoom and pan.
#pragma once

#include <QPointF>
#include <QRect>
#include <QRectF>
#include <QSize>

namespace console {

/// A value. At zoom 1 the whole picture is fitted into the room; above it, a part of the same shape fills the same place.
class PictureViewport {
public:
    static constexpr double largestZoom = 8;

    /// Keeps zoom and middle; a picture of another size begins anew.
    void fit(const QRect& room, QSize picture);

    double zoom() const { return m_zoom; }
    bool isWhole() const { return m_zoom <= 1; }

    /// About the point of the pane, which keeps its place in the picture.
    void zoomBy(double factor, QPointF at);

    /// By so many pixels of the pane; the picture's edge is never passed.
    void panBy(QPointF pixels);

    void reset();

    QRect target() const { return m_target; } ///< in the pane
    QRectF part() const;                      ///< in pixels of the picture

    QPointF toPicture(QPointF pane) const;
    QPointF toPane(QPointF picture) const;

private:
    void keepInside();
    double scale() const; ///< pixels of the pane for one of the picture

    QRect m_target;
    QSize m_picture;
    double m_zoom = 1;
    QPointF m_middle; ///< of the part, in pixels of the picture
};

} // namespace console
