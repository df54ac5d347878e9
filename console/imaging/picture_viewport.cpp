// Which part of a picture stands where in its pane.
#include "imaging/picture_viewport.hpp"

#include <algorithm>
#include <cmath>

namespace console {

void PictureViewport::fit(const QRect& room, QSize picture)
{
    if (picture != m_picture) {
        m_picture = picture;
        reset();
    }
    m_target = QRect(QPoint(0, 0), picture.scaled(room.size(), Qt::KeepAspectRatio));
    m_target.moveCenter(room.center());
}

void PictureViewport::reset()
{
    m_zoom = 1;
    m_middle = QPointF(m_picture.width() / 2.0, m_picture.height() / 2.0);
}

QRectF PictureViewport::part() const
{
    QRectF part(0, 0, m_picture.width() / m_zoom, m_picture.height() / m_zoom);
    part.moveCenter(m_middle);
    return part;
}

double PictureViewport::scale() const { return m_picture.width() > 0 ? m_target.width() * m_zoom / m_picture.width() : 1; }

QPointF PictureViewport::toPicture(QPointF pane) const
{
    return m_middle + (pane - QPointF(m_target.left() + m_target.width() / 2.0, m_target.top() + m_target.height() / 2.0)) / scale();
}

QPointF PictureViewport::toPane(QPointF picture) const
{
    return QPointF(m_target.left() + m_target.width() / 2.0, m_target.top() + m_target.height() / 2.0) + (picture - m_middle) * scale();
}

void PictureViewport::zoomBy(double factor, QPointF at)
{
    if (!(factor > 0) || !std::isfinite(factor) || m_target.isEmpty())
        return;
    const QPointF fixed = toPicture(at);
    m_zoom = std::clamp(m_zoom * factor, 1.0, largestZoom);
    m_middle += fixed - toPicture(at);
    keepInside();
}

void PictureViewport::panBy(QPointF pixels)
{
    m_middle -= pixels / scale();
    keepInside();
}

void PictureViewport::keepInside()
{
    const double halfWidth = m_picture.width() / m_zoom / 2;
    const double halfHeight = m_picture.height() / m_zoom / 2;
    m_middle.setX(std::clamp(m_middle.x(), halfWidth, std::max(halfWidth, m_picture.width() - halfWidth)));
    m_middle.setY(std::clamp(m_middle.y(), halfHeight, std::max(halfHeight, m_picture.height() - halfHeight)));
}

} // namespace console
