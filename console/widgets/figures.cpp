// Numbers as a person reads them.
#include "widgets/figures.hpp"

#include "model/number_text.hpp"

#include <QFontMetricsF>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace console {

QString figure(std::optional<double> value, int decimals, const QString& unit)
{
    const QString shown = value && std::isfinite(*value) ? numberText(*value, decimals) : QStringLiteral("\u2014");
    const bool degrees = unit.startsWith(QChar(0x00B0)) && !unit.endsWith(QLatin1Char('C'));
    if (unit.isEmpty() || degrees)
        return shown + unit;
    return shown + QChar(0x00A0) + unit;
}

QString signedFigure(std::optional<double> value, int decimals, const QString& unit)
{
    const bool plus = value && std::isfinite(*value) && asShown(*value, decimals) > 0;
    return (plus ? QStringLiteral("+") : QString()) + figure(value, decimals, unit);
}

QString spokenAge(std::chrono::nanoseconds age)
{
    const double seconds = std::max(0.0, std::chrono::duration<double>(age).count());
    if (seconds < 1.0)
        return QStringLiteral("%1\u00A0ms").arg(std::lround(seconds * 1000));
    if (seconds < 60.0)
        return QStringLiteral("%1\u00A0s").arg(seconds, 0, 'f', 1);
    return clockDuration(age);
}

QString clockDuration(std::chrono::nanoseconds duration)
{
    const auto total = std::max<std::int64_t>(0, std::chrono::duration_cast<std::chrono::seconds>(duration).count());
    const auto two = [](std::int64_t n) { return QStringLiteral("%1").arg(n, 2, 10, QLatin1Char('0')); };
    if (total < 3600)
        return QStringLiteral("%1:%2").arg(total / 60).arg(two(total % 60));
    return QStringLiteral("%1:%2:%3").arg(total / 3600).arg(two(total / 60 % 60), two(total % 60));
}

FigureLabel::FigureLabel(QWidget* parent) : QLabel(parent)
{
    setTextFormat(Qt::PlainText);
    setAlignment(Qt::AlignLeft | Qt::AlignVCenter);
}

void FigureLabel::reserve(const QString& widest)
{
    m_widest = widest;
    updateGeometry();
}

QSize FigureLabel::sizeHint() const
{
    const QFontMetricsF metrics(font());
    const double width = std::max(figuresWidth(font(), text()), figuresWidth(font(), m_widest));
    const QMargins margins = contentsMargins();
    return {int(std::ceil(width)) + 1 + margins.left() + margins.right(),
            int(std::ceil(metrics.height())) + margins.top() + margins.bottom()};
}

void FigureLabel::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setFont(font());
    painter.setPen(palette().color(foregroundRole()));
    drawFigures(painter, contentsRect(), alignment(), text());
}

} // namespace console
