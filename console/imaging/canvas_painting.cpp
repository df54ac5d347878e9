// A pane with an X-ray picture in it: the part that is shown, and what is measured on it.
#include "imaging/measurement_marks.hpp"
#include "imaging/picture_canvas.hpp"
#include "imaging/text_plates.hpp"

#include <QPainter>

#include <algorithm>
#include <optional>
#include <vector>

namespace console {

void PictureCanvas::paintShown(QPainter& painter) const
{
    const DisplayPicture* picture = shown();
    const PictureViewport view = viewport();
    const QRect target = view.target();
    const bool scaled = !view.isWhole() || target.size() * devicePixelRatioF() != picture->image.size();
    painter.setRenderHint(QPainter::SmoothPixmapTransform, scaled);
    if (view.isWhole())
        painter.drawImage(target, picture->image);
    else
        painter.drawImage(QRectF(target), picture->image, view.part());
}

void PictureCanvas::paintOver(QPainter& painter, const QImage& layer, double opacity) const
{
    const DisplayPicture* picture = shown();
    if (layer.isNull() || !picture || picture->image.isNull())
        return;
    const PictureViewport view = viewport();
    const QRectF part = view.isWhole() ? QRectF(picture->image.rect()) : view.part();
    const double across = static_cast<double>(layer.width()) / picture->image.width();
    const double down = static_cast<double>(layer.height()) / picture->image.height();
    painter.save();
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.setOpacity(opacity);
    painter.drawImage(QRectF(view.target()), layer,
                      QRectF(part.x() * across, part.y() * down, part.width() * across, part.height() * down));
    painter.restore();
}

// Above the facts and what was refused, so that it covers neither, nor what stands in the middle of the picture.
QRegion PictureCanvas::paintTold(QPainter& painter, const QRect& below) const
{
    if (m_told.isEmpty())
        return {};
    const QFont font = overlayFont();
    const QRect area = shown() ? viewport().target() : rect();
    const int gap = font.pixelSize() / 2;
    QRect room = area.adjusted(4 * gap, 0, -4 * gap, -17 * gap);
    if (!below.isEmpty())
        room.setBottom(std::min(room.bottom(), below.top() - gap));
    return paintWrapped(painter, font, m_told, room, Qt::AlignHCenter | Qt::AlignBottom);
}

QRegion PictureCanvas::paintToldAt(QPainter& painter, QPoint corner) const
{
    if (m_told.isEmpty())
        return {};
    const QFont font = overlayFont();
    const int gap = font.pixelSize() / 2; // of the plate round the words
    const QRect room(corner + QPoint(gap, gap / 2), viewport().target().bottomRight() - QPoint(2 * gap, gap));
    return paintWrapped(painter, font, m_told, room, Qt::AlignLeft | Qt::AlignTop);
}

/// The result, or what is to be done for one, and below it what it is worth and what else can be done.
QStringList PictureCanvas::measuredWords() const
{
    const QString result = m_measurement.text();
    const QString request = tr("Measuring %1: set %2 points").arg(word(m_measurement.mode())).arg(m_measurement.wanted());
    QStringList words{result.isEmpty() ? request : result};
    if (const QString depth = m_measurement.depthText(); !depth.isEmpty())
        words << depth;
    if (result.isEmpty() && m_measurement.mode() == MeasureMode::Distance)
        words << tr("Plane or O: isocentre or table plane");
    if (m_measurement.pixels() && !m_measurement.isCatheter())
        words << tr("Catheter, right button or B: it is the width of a catheter of 4 F to 8 F");
    return words;
}

QRegion PictureCanvas::paintMeasurement(QPainter& painter, const QRegion& taken) const
{
    if (m_measurement.mode() == MeasureMode::Off)
        return {};
    const PictureViewport view = viewport();
    painter.save();
    painter.setClipRect(view.target());
    std::vector<QPointF> points;
    for (const QPointF& point : m_measurement.points())
        points.push_back(view.toPane(point));
    paintMeasured(painter, points, m_cursor ? std::optional<QPointF>(view.toPane(*m_cursor)) : std::nullopt);
    QRegion region;
    for (const QPointF& point : points)
        region += QRectF(point - QPointF(10, 10), QSizeF(20, 20)).toAlignedRect();
    TextPlates plates(overlayFont());
    plates.addStack(measuredWords(), view.target(), measuredFoot(view.target()), taken);
    plates.paint(painter);
    painter.restore();
    return region + plates.region();
}

} // namespace console
