// Red with a white edge and an octagon: known by its shape as much as by its colour.
#include "widgets/stop_button.hpp"

#include "widgets/enter_key.hpp"
#include "widgets/theme.hpp"

#include <QPainter>
#include <QPolygonF>
#include <QtMath>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

StopButton::StopButton(QWidget* parent) : QAbstractButton(parent)
{
    theme::setTextRole(this, TextRole::Title);
    setText(tr("E-STOP"));
    setAccessibleName(tr("Emergency stop"));
    setFocusPolicy(Qt::TabFocus); // a press leaves the keys with the hand
}

void StopButton::setStopped(bool stopped)
{
    if (stopped == m_stopped)
        return;
    m_stopped = stopped;
    setText(stopped ? tr("STOPPED") : tr("E-STOP"));
    setAccessibleDescription(stopped ? tr("The robot reports an emergency stop") : QString());
    update();
}

QSize StopButton::sizeHint() const { return {theme::px(this, 190), theme::px(this, 110)}; }

/// Whoever presses it by any key means it: no desktop's habit decides whether Enter stops.
void StopButton::keyPressEvent(QKeyEvent* event)
{
    if (!isEnter(*event))
        return QAbstractButton::keyPressEvent(event);
    event->accept();
    if (!event->isAutoRepeat())
        click();
}

void StopButton::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF box = QRectF(rect()).adjusted(2, 2, -2, -2);
    painter.setPen(QPen(hasFocus() ? colour::focus : colour::high, hasFocus() ? 4 : 2));
    painter.setBrush(isDown() ? colour::highSurfaceDim : colour::highSurface);
    painter.drawRoundedRect(box, 6, 6);
    const double line = QFontMetricsF(font()).height();
    const double radius = std::min(box.height() - line * 1.5, box.width()) * 0.36;
    const QPointF centre(box.center().x(), box.top() + line * 0.25 + radius * 1.15);
    QPolygonF octagon;
    for (int i = 0; i < 8; ++i)
        octagon << centre + QPointF(radius * qCos(qDegreesToRadians(22.5 + 45 * i)), radius * qSin(qDegreesToRadians(22.5 + 45 * i)));
    painter.setPen(QPen(Qt::white, std::max(2.0, radius * 0.14)));
    painter.setBrush(m_stopped ? QBrush(Qt::white) : QBrush(Qt::NoBrush));
    painter.drawPolygon(octagon);
    painter.setPen(Qt::white);
    painter.setFont(font());
    painter.drawText(QRectF(box.left(), box.bottom() - line * 1.25, box.width(), line), Qt::AlignCenter, text());
}

} // namespace console
