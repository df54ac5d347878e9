// A padlock for a confirmed hold, an empty box for one that is missing.
#include "widgets/roll_call.hpp"

#include "widgets/figures.hpp"
#include "widgets/icons.hpp"
#include "widgets/theme.hpp"

#include <QPainter>
#include <QStringList>

namespace console {

namespace colour = theme::colour;

namespace {

QString holdWords(const HoldLine& line)
{
    if (!line.holding)
        return RollCall::tr("not confirmed");
    if (line.afterMs)
        return RollCall::tr("holds, after %1").arg(figure(line.afterMs, 0, RollCall::tr("ms")));
    return line.already ? RollCall::tr("holds already") : RollCall::tr("holds");
}

} // namespace

RollCall::RollCall(QWidget* parent) : QWidget(parent)
{
    theme::setTextRole(this, theme::TextRole::Body);
    setAccessibleName(tr("Roll-call: which devices hold"));
}

double RollCall::rowHeight() const { return QFontMetricsF(font()).height() * 1.18; }

void RollCall::setLines(const std::vector<HoldLine>& lines)
{
    const bool grows = lines.size() != m_lines.size();
    m_lines = lines;
    QStringList words;
    for (const HoldLine& line : m_lines)
        words << line.title + QStringLiteral(": ") + holdWords(line);
    setAccessibleDescription(words.join(QStringLiteral("; ")));
    if (grows)
        updateGeometry();
    update();
}

QSize RollCall::sizeHint() const { return {theme::px(this, 340), int(rowHeight() * double(m_lines.size())) + 1}; }

void RollCall::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setFont(font());
    const QFontMetricsF metrics(font());
    const double row = rowHeight();
    const double side = metrics.height() * 0.9;
    for (std::size_t i = 0; i < m_lines.size(); ++i) {
        const HoldLine& line = m_lines[i];
        const QRectF cell(0, double(i) * row, width(), row);
        const QRectF mark(cell.left(), cell.center().y() - side / 2, side, side);
        if (line.holding) {
            icons::draw(painter, mark, icons::Icon::Hold, colour::text);
        } else {
            painter.setPen(QPen(colour::bright, 1.8));
            painter.drawRect(mark.adjusted(side * 0.15, side * 0.15, -side * 0.15, -side * 0.15));
        }
        const QString words = holdWords(line);
        const double wide = figuresWidth(font(), words);
        painter.setPen(line.holding ? colour::text : colour::bright);
        drawFigures(painter, cell, Qt::AlignRight | Qt::AlignVCenter, words);
        const QRectF name = cell.adjusted(side * 1.4, 0, -wide - side, 0);
        painter.drawText(name, Qt::AlignLeft | Qt::AlignVCenter, metrics.elidedText(line.title, Qt::ElideRight, name.width()));
    }
}

} // namespace console
