// Steps, their medians, and how far one picture in a hundred goes beyond.
#include "widgets/waterfall.hpp"

#include "widgets/figures.hpp"
#include "widgets/theme.hpp"

#include <QPainter>

#include <algorithm>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

Waterfall::Waterfall(QWidget* parent) : QWidget(parent)
{
    theme::setTextRole(this, TextRole::Caption);
    setAccessibleName(tr("Where the picture's age comes from"));
}

QSize Waterfall::sizeHint() const
{
    const int line = QFontMetrics(font()).height();
    return {theme::px(this, 420), int(pictureStageCount + 2) * (line + theme::px(this, 6))};
}

void Waterfall::refresh(const PictureStages& stages, double limitMs, Instant now)
{
    m_limit = limitMs;
    m_steps.clear();
    double begin = 0;
    for (std::size_t i = 0; i < pictureStageCount; ++i) {
        const auto stage = static_cast<PictureStage>(i);
        const auto summary = stages.of(stage, now);
        if (!summary)
            break;
        m_steps.push_back({word(stage), begin, *summary});
        begin += summary->p50;
    }
    const auto age = stages.ofAge(now);
    if (age)
        m_steps.push_back({tr("age at the paint"), 0, *age});
    if (const auto presenting = stages.ofPresenting(now); age && presenting)
        m_steps.push_back({tr("to the screen"), age->p50, *presenting});
    QStringList words;
    for (const Step& step : m_steps)
        words << tr("%1: median %2, 99th percentile %3")
                     .arg(step.name, figure(step.summary.p50, 1, tr("ms")), figure(step.summary.p99, 1, tr("ms")));
    setAccessibleDescription(words.isEmpty() ? tr("No picture in the last minute") : words.join(QStringLiteral("; ")));
    update();
}

void Waterfall::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    if (m_steps.empty()) {
        painter.setPen(colour::secondary);
        painter.drawText(rect(), Qt::AlignLeft | Qt::AlignTop, tr("No picture in the last minute"));
        return;
    }
    const double full = fullScale();
    const double tall = double(height()) / double(m_steps.size());
    for (std::size_t i = 0; i < m_steps.size(); ++i)
        paintStep(painter, QRectF(0, double(i) * tall, width(), tall), m_steps[i], full);
}

// By what was measured, so that the stages can be told apart; of the limit at least the half, so that a small age looks small.
double Waterfall::fullScale() const
{
    double full = m_limit / 2;
    for (const Step& step : m_steps)
        full = std::max(full, step.begin + step.summary.p99);
    return 1.05 * full;
}

// Where it lies beyond what is drawn, its line is the edge.
void Waterfall::paintLimit(QPainter& painter, const QRectF& chart, double full, bool named) const
{
    const bool beyond = m_limit > full;
    const double x = chart.left() + chart.width() * std::min(m_limit / full, 1.0);
    painter.setPen(QPen(colour::strongLine, 1, Qt::DashLine));
    painter.drawLine(QPointF(x, chart.top()), QPointF(x, chart.bottom()));
    if (!named)
        return;
    painter.setPen(colour::secondary);
    drawFigures(painter, QRectF(chart.left(), chart.top(), x - chart.left() - 6, chart.height()), Qt::AlignRight | Qt::AlignVCenter,
                tr("limit %1").arg(figure(m_limit, 0, tr("ms"))) + (beyond ? QStringLiteral(" \u25B6") : QString()));
}

// The median is a bar; to where one picture in a hundred goes beyond is a line with an end.
void Waterfall::paintStep(QPainter& painter, const QRectF& row, const Step& step, double full) const
{
    double nameWidth = 0;
    for (const Step& each : m_steps)
        nameWidth = std::max(nameWidth, painter.fontMetrics().horizontalAdvance(each.name) * 1.15);
    const double valueWidth = figuresWidth(painter.font(), tr("000.0 / 0000.0 ms"));
    painter.setPen(colour::secondary);
    painter.drawText(QRectF(row.left(), row.top(), nameWidth, row.height()), Qt::AlignLeft | Qt::AlignVCenter, step.name);
    painter.setPen(colour::text);
    drawFigures(painter, QRectF(row.right() - valueWidth, row.top(), valueWidth, row.height()), Qt::AlignRight | Qt::AlignVCenter,
                tr("%1 / %2").arg(QString::number(step.summary.p50, 'f', 1), figure(step.summary.p99, 1, tr("ms"))));
    const QRectF chart(row.left() + nameWidth, row.top(), row.width() - nameWidth - valueWidth - 12, row.height());
    const auto xOf = [&](double ms) { return chart.left() + chart.width() * std::clamp(ms / full, 0.0, 1.0); };
    paintLimit(painter, chart, full, &step == &m_steps.front());
    const double middle = row.center().y();
    const double thick = row.height() * 0.46;
    const double begin = xOf(step.begin);
    const double end = xOf(step.begin + step.summary.p50);
    painter.fillRect(QRectF(begin, middle - thick / 2, std::max(end - begin, 1.0), thick), colour::plot);
    const double far = xOf(step.begin + step.summary.p99);
    painter.setPen(QPen(colour::plot, 1.4));
    painter.drawLine(QPointF(end, middle), QPointF(far, middle));
    painter.drawLine(QPointF(far, middle - thick / 2), QPointF(far, middle + thick / 2));
}

} // namespace console
