// Lines in columns of five; an empty box is missing, a tick is met. What is missing comes first, so what finds no room is met.
#include "widgets/guard_list.hpp"

#include "widgets/figures.hpp"
#include "widgets/theme.hpp"

#include <QPainter>
#include <QStringList>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

GuardList::GuardList(QWidget* parent) : QWidget(parent)
{
    theme::setTextRole(this, TextRole::Caption);
    setAccessibleName(tr("Conditions for motion"));
}

void GuardList::setChecklist(const GuardChecklist& checklist, const PermitState& permit)
{
    std::vector<GuardLine> lines(checklist.begin(), checklist.end());
    if (permit.phase == PermitPhase::Armed || permit.phase == PermitPhase::Engaged) {
        const GuardSet kept = keptWhileArmed();
        std::erase_if(lines, [&kept](const GuardLine& line) { return !kept.test(std::size_t(line.guard)); });
        for (GuardLine& line : lines)
            line.met = permit.kept.test(std::size_t(line.guard));
    }
    std::stable_partition(lines.begin(), lines.end(), [](const GuardLine& line) { return !line.met; });
    const auto same = [](const GuardLine& a, const GuardLine& b) { return a.guard == b.guard && a.met == b.met && a.text == b.text; };
    if (std::equal(lines.begin(), lines.end(), m_lines.begin(), m_lines.end(), same))
        return;
    m_lines = std::move(lines);
    QStringList missing;
    for (const GuardLine& line : m_lines)
        if (!line.met)
            missing << line.text;
    setAccessibleDescription(missing.isEmpty() ? tr("All conditions are met") : tr("Missing: %1").arg(missing.join(tr("; "))));
    setToolTip(missing.join(QLatin1Char('\n')).toHtmlEscaped());
    update();
}

QSize GuardList::sizeHint() const { return {theme::px(this, 660), rows * QFontMetrics(font()).height()}; }

// It gives way first: with less room its letters become smaller, and what is missing still comes before what is met.
QSize GuardList::minimumSizeHint() const { return {theme::px(this, 400), sizeHint().height()}; }

int GuardList::columnCount() const
{
    return std::clamp(int(width() / (QFontMetricsF(font()).averageCharWidth() * 22)), 1, int(guardCount) / rows);
}

std::vector<double> GuardList::askedWidths(int columns, const QFont& font) const
{
    const double mark = QFontMetricsF(font).height() * 1.8;
    std::vector<double> widths(std::size_t(columns), mark);
    const std::size_t room = std::size_t(columns * rows);
    for (std::size_t i = 0; i < std::min(m_lines.size(), room); ++i) {
        const bool last = i + 1 == room && room < m_lines.size();
        widths[i / rows] = std::max(widths[i / rows], figuresWidth(font, last ? overflowText(i) : m_lines[i].text) + mark);
    }
    return widths;
}

// No condition is cut short: letters become a little smaller, then fewer columns hold what is missing and the rest is counted.
GuardList::Plan GuardList::plan() const
{
    constexpr std::array shares{1.0, 0.88, 0.76};
    static constexpr int leastPixels = 10;
    const auto missing = std::size_t(std::count_if(m_lines.begin(), m_lines.end(), [](const GuardLine& line) { return !line.met; }));
    const auto smaller = [this](double share) {
        QFont face = font();
        face.setPixelSize(std::max(leastPixels, int(std::lround(face.pixelSize() * share))));
        return face;
    };
    const auto fits = [this](int columns, const QFont& face) {
        const auto asked = askedWidths(columns, face);
        return std::accumulate(asked.begin(), asked.end(), 0.0) <= width();
    };
    for (const bool all : {true, false})
        for (int columns = columnCount(); columns > 0; --columns) {
            const std::size_t room = std::size_t(columns * rows);
            if (all && missing > (room < m_lines.size() ? room - 1 : room))
                continue;
            for (const double share : shares)
                if (fits(columns, smaller(share)))
                    return {columns, smaller(share)};
        }
    return {1, smaller(shares.back())};
}

// Each column as wide as its longest line asks for; what is over goes to all alike.
std::vector<double> GuardList::columnWidths(const Plan& plan) const
{
    const QFontMetricsF metrics(plan.font);
    auto widths = askedWidths(plan.columns, plan.font);
    const double asked = std::accumulate(widths.begin(), widths.end(), 0.0);
    const double spare = (width() - asked) / plan.columns;
    for (double& wide : widths)
        wide = spare >= 0 ? wide + std::min(spare, metrics.height() * 2) : wide * width() / asked;
    return widths;
}

QString GuardList::overflowText(std::size_t from) const
{
    const auto missing =
        std::count_if(m_lines.begin() + std::ptrdiff_t(from), m_lines.end(), [](const GuardLine& line) { return !line.met; });
    const auto met = std::ptrdiff_t(m_lines.size() - from) - missing;
    if (missing == 0)
        return tr("and %1 more met").arg(met);
    return met == 0 ? tr("and %1 more missing").arg(missing) : tr("and %1 more missing, %2 met").arg(missing).arg(met);
}

void GuardList::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const Plan how = plan();
    painter.setFont(how.font);
    const QFontMetricsF metrics(how.font);
    const std::size_t room = std::size_t(how.columns * rows);
    const std::vector<double> widths = columnWidths(how);
    const double tall = double(height()) / rows;
    const double box = metrics.capHeight();
    double left = 0;
    for (std::size_t i = 0; i < std::min(room, m_lines.size()); ++i) {
        if (i > 0 && i % rows == 0)
            left += widths[i / rows - 1];
        const QRectF cell(left, double(i % rows) * tall, widths[i / rows], tall);
        const QRectF text = cell.adjusted(box + 9, 0, -6, 0);
        if (i + 1 == room && room < m_lines.size()) {
            painter.setPen(colour::secondary);
            drawFigures(painter, text, Qt::AlignLeft | Qt::AlignVCenter, overflowText(i));
            return;
        }
        const GuardLine& line = m_lines[i];
        const QRectF mark(cell.left() + 2, cell.center().y() - box / 2, box, box);
        painter.setPen(QPen(line.met ? colour::secondary : colour::bright, 1.5));
        if (line.met)
            painter.drawPolyline(QPolygonF{mark.topLeft() + QPointF(0, box * 0.55), mark.topLeft() + QPointF(box * 0.4, box * 0.95),
                                           mark.topRight() + QPointF(0, box * 0.05)});
        else
            painter.drawRect(mark);
        drawFigures(painter, text, Qt::AlignLeft | Qt::AlignVCenter, metrics.elidedText(line.text, Qt::ElideRight, text.width()));
    }
}

} // namespace console
