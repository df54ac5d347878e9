// Texts on dark plates over a picture.
#include "imaging/text_plates.hpp"

#include "imaging/figure_cells.hpp"
#include "imaging/pane_colours.hpp"

#include <QFontMetrics>
#include <QPainter>
#include <QRegularExpression>
#include <QTextBoundaryFinder>
#include <QTextOption>
#include <QWidget>

#include <algorithm>
#include <cmath>
#include <optional>

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

/// No row ends between a figure and its unit, nor before it.
QString withFiguresKept(QString text)
{
    static const QRegularExpression besideFigure(QStringLiteral("(?<=[\\d+@\\x{2248}\\x{B1}]) |(?<=[^,;:.]) (?=\\d)"));
    return text.replace(besideFigure, QString(QChar::Nbsp));
}

/// Texts one below the other.
struct Stack {
    QFont font;
    QStringList rows;
    int first = 0; ///< rows of the first text
    int width = 0; ///< of the widest row
};

Stack stackOf(const QStringList& texts, const QFont& font, int room)
{
    Stack stack;
    for (const QString& text : texts) {
        stack.rows << rowsOf(text, font, room);
        if (stack.first == 0)
            stack.first = static_cast<int>(stack.rows.size());
    }
    stack.font = fitted(font, stack.rows, room);
    for (const QString& row : stack.rows)
        stack.width = std::max(stack.width, widthOf(stack.font, row));
    return stack;
}

/// As near to where it lies, up or down, as it lies in the area and on nothing that is taken.
std::optional<QRect> nearestFree(const QRect& rect, const QRect& area, const QRegion& taken)
{
    for (int by = 0; by < area.height(); ++by)
        for (const int way : {-by, by})
            if (const QRect moved = rect.translated(0, way); area.contains(moved) && !taken.intersects(moved))
                return moved;
    return std::nullopt;
}

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

QStringList rowsOf(const QString& text, const QFont& font, int room)
{
    const QString whole = withFiguresKept(text);
    QStringList rows;
    qsizetype start = 0;
    qsizetype end = 0;
    QTextBoundaryFinder breaks(QTextBoundaryFinder::Line, whole);
    for (qsizetype next = breaks.toNextBoundary(); next >= 0; next = breaks.toNextBoundary()) {
        if (end > start && figuresWidth(font, whole.mid(start, next - start).trimmed()) > room) {
            rows << whole.mid(start, end - start).trimmed();
            start = end;
        }
        end = next;
    }
    rows << whole.mid(start).trimmed();
    return rows.replaceInStrings(QString(QChar::Nbsp), QStringLiteral(" "));
}

QRect paintWrapped(QPainter& painter, const QFont& font, const QString& text, const QRect& room, Qt::Alignment alignment)
{
    QTextOption option(alignment);
    option.setWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere); // the path of a file has no spaces
    const QString kept = withFiguresKept(text);
    painter.setFont(font);
    const int gap = font.pixelSize() / 2;
    const QRect plate = painter.boundingRect(room, kept, option).toAlignedRect().adjusted(-gap, -gap / 2, gap, gap / 2);
    painter.fillRect(plate, plateColour());
    painter.setPen(pane_colours::text);
    painter.drawText(room, kept, option);
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

void TextPlates::addStack(QStringList texts, const QRect& area, int foot, const QRegion& taken)
{
    const int room = area.width() - 4 * m_gap;
    const QRegion others = region() + taken;
    Stack stack;
    QRect place;
    const auto isFreeFor = [&](int width) {
        stack = stackOf(texts, m_font, width);
        const int row = QFontMetrics(stack.font).height() + m_gap;
        place = QRect(0, 0, stack.width + 2 * m_gap, row * static_cast<int>(stack.rows.size()));
        place.moveTopLeft({area.center().x() - place.width() / 2, foot + 1 - row * stack.first});
        const auto free = nearestFree(place, area, others);
        place = free.value_or(place.translated(0, std::max(0, area.top() - place.top())));
        return free.has_value();
    };
    while (!isFreeFor(room) && !isFreeFor(room * 2 / 3)) {
        if (texts.size() == 1) {
            isFreeFor(room);
            break;
        }
        texts.removeLast();
    }
    QPoint middle(area.center().x(), place.top());
    for (const QString& row : stack.rows)
        middle.setY(add(row, stack.font, middle, Qt::AlignHCenter | Qt::AlignTop).bottom() + 1);
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
