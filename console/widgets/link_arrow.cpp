// Shapes of the arrows.
#include "widgets/link_arrow.hpp"

#include "widgets/theme.hpp"

#include <QPainter>
#include <QPainterPath>

namespace console {

namespace colour = theme::colour;

namespace {

QColor inkOf(ArrowLook look)
{
    switch (look) {
    case ArrowLook::Closed:
    case ArrowLook::NotKnown:
        return colour::strongLine;
    case ArrowLook::Changing:
    case ArrowLook::Doubtful:
        return colour::bright;
    case ArrowLook::Whole:
        return colour::text;
    case ArrowLook::Broken:
        return colour::high;
    }
    return colour::text;
}

Qt::PenStyle strokeOf(ArrowLook look)
{
    if (look == ArrowLook::Closed || look == ArrowLook::NotKnown)
        return Qt::DotLine;
    return look == ArrowLook::Doubtful || look == ArrowLook::Changing ? Qt::DashLine : Qt::SolidLine;
}

void drawHead(QPainter& painter, const QLineF& way, double size)
{
    const QPointF along = (way.p2() - way.p1()) / way.length();
    const QPointF across(-along.y(), along.x());
    QPainterPath head(way.p2());
    head.lineTo(way.p2() - along * size + across * size * 0.55);
    head.lineTo(way.p2() - along * size - across * size * 0.55);
    head.closeSubpath();
    painter.fillPath(head, painter.pen().color());
}

void drawCross(QPainter& painter, QPointF centre, double size)
{
    painter.drawLine(centre + QPointF(-size, -size), centre + QPointF(size, size));
    painter.drawLine(centre + QPointF(-size, size), centre + QPointF(size, -size));
}

} // namespace

ArrowLook arrowLook(LinkState state, bool connected)
{
    switch (state) {
    case LinkState::Closed:
        return ArrowLook::Closed;
    case LinkState::Opening:
    case LinkState::Reopening:
    case LinkState::Closing:
        return ArrowLook::Changing;
    case LinkState::Open:
        return connected ? ArrowLook::Whole : ArrowLook::Broken;
    case LinkState::Suspect:
        return connected ? ArrowLook::Doubtful : ArrowLook::Broken;
    case LinkState::Reconnecting:
    case LinkState::StandBy:
        break;
    }
    return ArrowLook::Broken;
}

void drawLinkArrow(QPainter& painter, const QLineF& way, ArrowLook look, double thickness)
{
    if (way.length() < 1)
        return;
    painter.save();
    const double head = 4.5 * thickness;
    QPen pen(inkOf(look), thickness, strokeOf(look), Qt::FlatCap);
    painter.setPen(pen);
    const QLineF shaft(way.p1(), way.pointAt(1 - head * 0.8 / way.length()));
    if (look == ArrowLook::Broken) {
        painter.drawLine(QLineF(shaft.p1(), way.pointAt(0.36)));
        painter.drawLine(QLineF(way.pointAt(0.64), shaft.p2()));
        drawCross(painter, way.pointAt(0.5), thickness * 2.2);
    } else {
        painter.drawLine(shaft);
    }
    pen.setStyle(Qt::SolidLine);
    painter.setPen(pen);
    if (look != ArrowLook::Closed && look != ArrowLook::NotKnown)
        drawHead(painter, way, head);
    painter.restore();
}

} // namespace console
