// Texts on dark plates over a picture.
#include "imaging/text_plates.hpp"

#include "imaging/pane_colours.hpp"

#include <QFontMetrics>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace console {

QFont larger(QFont font, double factor)
{
    font.setPixelSize(static_cast<int>(std::lround(font.pixelSize() * factor)));
    font.setWeight(QFont::DemiBold);
    return font;
}

QRect TextPlates::add(const QString& text, const QFont& font, QPoint corner, Qt::Alignment alignment, const QString& widest)
{
    const QFontMetrics metrics(font);
    const int width = metrics.horizontalAdvance(widest.isEmpty() ? text : widest) + 2 * m_gap;
    QRect rect(0, 0, std::max(width, metrics.horizontalAdvance(text) + 2 * m_gap), metrics.height() + m_gap);
    if (alignment & Qt::AlignRight)
        rect.moveRight(corner.x());
    else if (alignment & Qt::AlignHCenter)
        rect.moveLeft(corner.x() - rect.width() / 2);
    else
        rect.moveLeft(corner.x());
    if (alignment & Qt::AlignBottom)
        rect.moveBottom(corner.y());
    else if (alignment & Qt::AlignVCenter)
        rect.moveTop(corner.y() - rect.height() / 2);
    else
        rect.moveTop(corner.y());
    m_plates.push_back({rect, text, font, widest.isEmpty() ? Qt::AlignCenter : Qt::AlignLeft | Qt::AlignVCenter, pane_colours::text});
    return rect;
}

QRect TextPlates::addAbove(const QString& text, QPoint corner, const QRect& avoid)
{
    QRect placed = add(text, corner, Qt::AlignLeft | Qt::AlignBottom);
    const OverlayPlate plate = m_plates.back();
    m_plates.pop_back();
    const QRegion taken = region() + avoid;
    while (taken.intersects(placed) && placed.top() > 0)
        placed.translate(0, -1);
    m_plates.push_back(plate);
    m_plates.back().rect = placed;
    return placed;
}

QRegion TextPlates::region() const
{
    QRegion region;
    for (const OverlayPlate& plate : m_plates)
        region += plate.rect;
    return region;
}

void TextPlates::paint(QPainter& painter) const
{
    QColor dark = pane_colours::background;
    dark.setAlpha(200);
    for (const OverlayPlate& plate : m_plates) {
        painter.fillRect(plate.rect, dark);
        painter.setFont(plate.font);
        painter.setPen(plate.ink);
        painter.drawText(plate.rect.adjusted(m_gap, 0, -m_gap, 0), static_cast<int>(plate.alignment) | Qt::TextDontClip, plate.text);
    }
}

} // namespace console
