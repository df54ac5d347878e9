// A pane with an X-ray picture in it: the part that is shown, and what is measured on it.
#include "imaging/pane_colours.hpp"
#include "imaging/picture_canvas.hpp"
#include "imaging/text_plates.hpp"

#include <QPainter>

#include <functional>
#include <vector>

namespace console {

namespace {

constexpr double crossArm = 7;

// Light on a dark edge: to be seen on every grey.
void paintTwice(QPainter& painter, const std::function<void()>& stroke)
{
    painter.setPen(QPen(pane_colours::background, 4));
    stroke();
    painter.setPen(QPen(pane_colours::wire, 1.5));
    stroke();
}

void paintCross(QPainter& painter, QPointF at)
{
    painter.drawLine(at - QPointF(crossArm, 0), at + QPointF(crossArm, 0));
    painter.drawLine(at - QPointF(0, crossArm), at + QPointF(0, crossArm));
}

} // namespace

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
QRegion PictureCanvas::paintTold(QPainter& painter) const
{
    if (m_told.isEmpty())
        return {};
    const QFont font = overlayFont();
    const QRect area = shown() ? viewport().target() : rect();
    const int gap = font.pixelSize() / 2;
    return paintWrapped(painter, font, m_told, area.adjusted(4 * gap, 0, -4 * gap, -17 * gap), Qt::AlignHCenter | Qt::AlignBottom);
}

QRegion PictureCanvas::paintMeasurement(QPainter& painter) const
{
    if (m_measurement.mode() == MeasureMode::Off)
        return {};
    const PictureViewport view = viewport();
    painter.save();
    painter.setClipRect(view.target());
    painter.setRenderHint(QPainter::Antialiasing);
    std::vector<QPointF> points;
    for (const QPointF& point : m_measurement.points())
        points.push_back(view.toPane(point));
    paintTwice(painter, [&] {
        for (std::size_t i = 0; i < points.size(); ++i) {
            paintCross(painter, points[i]);
            if (i > 0)
                painter.drawLine(points[i - 1], points[i]);
        }
        if (m_cursor)
            paintCross(painter, view.toPane(*m_cursor));
    });
    QRegion region;
    for (const QPointF& point : points)
        region += QRectF(point - QPointF(10, 10), QSizeF(20, 20)).toAlignedRect();
    TextPlates plates(overlayFont());
    const QPoint place(view.target().center().x(), view.target().top() + view.target().height() * 3 / 4);
    const QString result = m_measurement.text();
    const QString request = tr("Measuring %1: set %2 points").arg(word(m_measurement.mode())).arg(m_measurement.wanted());
    const QRect first = plates.add(result.isEmpty() ? request : result, place, Qt::AlignHCenter | Qt::AlignTop);
    if (m_measurement.pixels() && m_measurement.calibration().kind != CalibrationKind::Catheter)
        plates.add(tr("Right button or B: it is the width of a catheter of 4 F, 5 F, \u2026"), {place.x(), first.bottom() + 1},
                   Qt::AlignHCenter | Qt::AlignTop);
    plates.paint(painter);
    painter.restore();
    return region + plates.region();
}

} // namespace console
