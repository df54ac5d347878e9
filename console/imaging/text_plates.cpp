// Texts on dark plates over a picture.
#include "imaging/text_plates.hpp"

#include "imaging/figure_cells.hpp"
#include "imaging/pane_colours.hpp"

#include <QFontMetrics>
#include <QPainter>
#include <QTextOption>
#include <QWidget>

#include <algorithm>
#include <cmath>

namespace console {

namespace {

constexpr int usualSize = 16;
constexpr int plateAlpha = 225; // the secondary grey can be read over white, too

QColor plateColour()
{
    QColor dark = pane_colours::background;
    dark.setAlpha(plateAlpha);
    return dark;
}

int widthOf(const QFont& font, const QString& text) { return static_cast<int>(std::ceil(figuresWidth(font, text))); }

} // namespace

QFont larger(QFont font, double factor)
{
    font.setPixelSize(static_cast<int>(std::lround(font.pixelSize() * factor)));
    font.setWeight(QFont::DemiBold);
    return font;
}

QFont paneFont(const QWidget& pane)
{
    QFont font = pane.font();
    if (font.pixelSize() <= 0)
        font.setPixelSize(usualSize);
    return font;
}

QFont fitted(QFont font, const QStringList& lines, int room)
{
    const auto fits = [&](const QString& line) { return figuresWidth(font, line) <= room; };
    while (font.pixelSize() > 1 && !std::all_of(lines.begin(), lines.end(), fits))
        font.setPixelSize(font.pixelSize() - 1);
    return font;
}

QRect paintWrapped(QPainter& painter, const QFont& font, const QString& text, const QRect& room, Qt::Alignment alignment)
{
    QTextOption option(alignment);
    option.setWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere); // the path of a file has no spaces
    painter.setFont(font);
    const int gap = font.pixelSize() / 2;
    const QRect plate = painter.boundingRect(room, text, option).toAlignedRect().adjusted(-gap, -gap / 2, gap, gap / 2);
    painter.fillRect(plate, plateColour());
    painter.setPen(pane_colours::text);
    painter.drawText(room, text, option);
    return plate;
}

QRect TextPlates::add(const QString& text, const QFont& font, QPoint corner, Qt::Alignment alignment, const QString& widest)
{
    const int width = std::max(widthOf(font, widest), widthOf(font, text)) + 2 * m_gap;
    QRect rect(0, 0, width, QFontMetrics(font).height() + m_gap);
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

QRect TextPlates::addAbove(const QString& text, const QFont& font, QPoint corner, const QRect& avoid, int top)
{
    QRect placed = add(text, font, corner, Qt::AlignLeft | Qt::AlignBottom);
    const OverlayPlate plate = m_plates.back();
    m_plates.pop_back();
    const QRegion taken = region() + avoid;
    while (taken.intersects(placed.adjusted(-m_gap, 0, m_gap, 0)) && placed.top() >= top)
        placed.translate(0, -1);
    if (placed.top() < top)
        return {};
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
    const QColor dark = plateColour();
    for (const OverlayPlate& plate : m_plates) {
        painter.fillRect(plate.rect, dark);
        painter.setFont(plate.font);
        painter.setPen(plate.ink);
        drawFigures(painter, plate.rect.adjusted(m_gap, 0, -m_gap, 0), plate.alignment, plate.text);
    }
}

} // namespace console
