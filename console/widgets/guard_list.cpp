// Lines in columns; what is missing comes first, so what finds no room is met wherever the room allows it.
#include "widgets/guard_list.hpp"

#include "widgets/enter_key.hpp"
#include "widgets/figures.hpp"
#include "widgets/theme.hpp"

#include <QPainter>
#include <QStringList>

#include <algorithm>
#include <numeric>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

std::vector<ShownGuard> shownGuards(const GuardChecklist& checklist, const PermitState& permit)
{
    const bool armed = permit.phase == PermitPhase::Armed || permit.phase == PermitPhase::Engaged;
    const GuardSet kept = keptWhileArmed();
    std::vector<ShownGuard> shown;
    for (const GuardLine& line : checklist) {
        const auto place = std::size_t(line.guard);
        const bool met = armed ? permit.kept.test(place) : line.met;
        shown.push_back({armed && !kept.test(place) ? GuardMark::NotAsked : met ? GuardMark::Met : GuardMark::Missing, line.text});
    }
    return shown;
}

void drawGuardMark(QPainter& painter, const QRectF& where, GuardMark mark)
{
    painter.setPen(QPen(mark == GuardMark::Missing ? colour::bright : colour::secondary, 1.5));
    painter.setBrush(Qt::NoBrush);
    const double side = where.height();
    if (mark == GuardMark::Met)
        painter.drawPolyline(QPolygonF{where.topLeft() + QPointF(0, side * 0.55), where.topLeft() + QPointF(side * 0.4, side * 0.95),
                                       where.topRight() + QPointF(0, side * 0.05)});
    else if (mark == GuardMark::Missing)
        painter.drawRect(where);
    else
        painter.drawLine(QPointF(where.left(), where.center().y()), QPointF(where.right(), where.center().y()));
}

GuardList::GuardList(QWidget* parent) : QAbstractButton(parent)
{
    theme::setTextRole(this, TextRole::Caption);
    setAccessibleName(tr("Conditions for motion; F6 shows all of them"));
    setFocusPolicy(Qt::TabFocus); // a press leaves the keys to the hand until the view has them
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void GuardList::setChecklist(const GuardChecklist& checklist, const PermitState& permit)
{
    auto lines = shownGuards(checklist, permit);
    std::erase_if(lines, [](const ShownGuard& line) { return line.mark == GuardMark::NotAsked; });
    std::stable_partition(lines.begin(), lines.end(), [](const ShownGuard& line) { return line.mark == GuardMark::Missing; });
    if (lines == m_lines)
        return;
    m_lines = std::move(lines);
    QStringList missing;
    for (const ShownGuard& line : m_lines)
        if (line.mark == GuardMark::Missing)
            missing << line.text;
    setAccessibleDescription(missing.isEmpty() ? tr("All conditions are met") : tr("Missing: %1").arg(missing.join(tr("; "))));
    update();
}

void GuardList::keyPressEvent(QKeyEvent* event)
{
    if (!isEnter(*event))
        return QAbstractButton::keyPressEvent(event);
    event->accept();
    if (!event->isAutoRepeat())
        click();
}

// It takes what its neighbours leave.
QSize GuardList::sizeHint() const { return {theme::px(this, 400), 3 * QFontMetrics(font()).height()}; }

int GuardList::rows() const
{
    constexpr double slack = 2; // px, in all: descenders have it between themselves
    return std::max(1, int((height() + slack) / QFontMetricsF(font()).height()));
}

int GuardList::mostColumns() const
{
    const int needed = (int(m_lines.size()) + rows() - 1) / rows();
    return std::clamp(int(width() / (QFontMetricsF(font()).averageCharWidth() * 20)), 1, std::max(1, needed));
}

std::size_t GuardList::missingCount() const
{
    return std::size_t(
        std::count_if(m_lines.begin(), m_lines.end(), [](const ShownGuard& line) { return line.mark == GuardMark::Missing; }));
}

std::size_t GuardList::writtenOut() const
{
    const auto room = std::size_t(columns() * rows());
    return room < m_lines.size() ? room - 1 : m_lines.size();
}

std::vector<double> GuardList::askedWidths(int columns) const
{
    const double mark = QFontMetricsF(font()).height() * 1.5;
    const auto tall = std::size_t(rows());
    std::vector<double> widths(std::size_t(columns), mark);
    const std::size_t room = std::size_t(columns) * tall;
    for (std::size_t i = 0; i < std::min(m_lines.size(), room); ++i) {
        const bool last = i + 1 == room && room < m_lines.size();
        widths[i / tall] = std::max(widths[i / tall], figuresWidth(font(), last ? overflowText(i) : m_lines[i].text) + mark);
    }
    return widths;
}

// No condition is cut short and none is written smaller: what finds no room is counted, and a press shows it.
int GuardList::columns() const
{
    for (int columns = mostColumns(); columns > 1; --columns) {
        const auto asked = askedWidths(columns);
        if (std::accumulate(asked.begin(), asked.end(), 0.0) <= width())
            return columns;
    }
    return 1;
}

// Each column as wide as its longest line asks for; what is over goes to all alike.
std::vector<double> GuardList::columnWidths(int columns) const
{
    auto widths = askedWidths(columns);
    const double asked = std::accumulate(widths.begin(), widths.end(), 0.0);
    const double spare = (width() - asked) / columns;
    for (double& wide : widths)
        wide = spare >= 0 ? wide + std::min(spare, QFontMetricsF(font()).height() * 2) : wide * width() / asked;
    return widths;
}

QString GuardList::overflowText(std::size_t from) const
{
    const std::size_t missing = missingCount() > from ? missingCount() - from : 0;
    const std::size_t met = m_lines.size() - from - missing;
    if (missing == 0)
        return tr("and %1 more met").arg(met);
    return met == 0 ? tr("and %1 more missing").arg(missing) : tr("and %1 more missing, %2 met").arg(missing).arg(met);
}

void GuardList::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    if (hasFocus() || underMouse()) {
        painter.setPen(QPen(hasFocus() ? colour::focus : colour::line, hasFocus() ? 2 : 1));
        painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 4, 4);
    }
    const QFontMetricsF metrics(font());
    const int across = columns();
    const auto down = std::size_t(rows());
    const std::vector<double> widths = columnWidths(across);
    const double tall = double(height()) / double(down);
    const double box = metrics.capHeight();
    double left = theme::px(this, 4);
    for (std::size_t i = 0; i < std::min(std::size_t(across) * down, m_lines.size()); ++i) {
        if (i > 0 && i % down == 0)
            left += widths[i / down - 1];
        const QRectF cell(left, double(i % down) * tall, widths[i / down], tall);
        const QRectF text = cell.adjusted(box + 9, 0, -2, 0);
        const bool counted = i >= writtenOut();
        const GuardMark mark = m_lines[i].mark;
        if (!counted)
            drawGuardMark(painter, QRectF(cell.left() + 2, cell.center().y() - box / 2, box, box), mark);
        painter.setPen(mark == GuardMark::Missing ? colour::bright : colour::secondary);
        drawFigures(painter, text, Qt::AlignLeft | Qt::AlignVCenter, counted ? overflowText(i) : m_lines[i].text);
    }
}

} // namespace console
