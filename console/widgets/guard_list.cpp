// Fifteen lines in three columns; an empty box is missing, a tick is met.
#include "widgets/guard_list.hpp"

#include "widgets/figures.hpp"
#include "widgets/theme.hpp"

#include <QPainter>
#include <QStringList>

#include <algorithm>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

GuardList::GuardList(QWidget* parent) : QWidget(parent)
{
    theme::setTextRole(this, TextRole::Caption);
    setAccessibleName(tr("Conditions for motion"));
}

void GuardList::setChecklist(const GuardChecklist& checklist)
{
    m_lines = checklist;
    std::stable_partition(m_lines.begin(), m_lines.end(), [](const GuardLine& line) { return !line.met; });
    QStringList missing;
    for (const GuardLine& line : m_lines)
        if (!line.met)
            missing << line.text;
    setAccessibleDescription(missing.isEmpty() ? tr("All conditions are met") : tr("Missing: %1").arg(missing.join(QStringLiteral("; "))));
    setToolTip(missing.join(QLatin1Char('\n')).toHtmlEscaped());
    update();
}

QSize GuardList::sizeHint() const { return {theme::px(this, 660), rows * QFontMetrics(font()).height()}; }

void GuardList::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setFont(font());
    const QFontMetricsF metrics(font());
    const double wide = double(width()) / columns;
    const double tall = double(height()) / rows;
    const double box = metrics.capHeight();
    for (std::size_t i = 0; i < m_lines.size(); ++i) {
        const GuardLine& line = m_lines[i];
        const QRectF cell(double(i / rows) * wide, double(i % rows) * tall, wide, tall);
        const QRectF mark(cell.left() + 2, cell.center().y() - box / 2, box, box);
        painter.setPen(QPen(line.met ? colour::secondary : colour::bright, 1.5));
        if (line.met)
            painter.drawPolyline(QPolygonF{mark.topLeft() + QPointF(0, box * 0.55), mark.topLeft() + QPointF(box * 0.4, box * 0.95),
                                           mark.topRight() + QPointF(0, box * 0.05)});
        else
            painter.drawRect(mark);
        const QRectF text = cell.adjusted(box + 9, 0, -6, 0);
        drawFigures(painter, text, Qt::AlignLeft | Qt::AlignVCenter, metrics.elidedText(line.text, Qt::ElideRight, text.width()));
    }
}

} // namespace console
