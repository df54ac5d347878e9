// How devices and links are drawn.
#include "editor/topology_items.hpp"

#include "editor/topology_view.hpp"
#include "widgets/figures.hpp"
#include "widgets/icons.hpp"
#include "widgets/link_arrow.hpp"
#include "widgets/theme.hpp"

#include <QPainter>
#include <QPainterPath>
#include <QPainterPathStroker>

#include <cmath>
#include <utility>

namespace console {

namespace colour = theme::colour;

namespace {

constexpr double parallel = 6; // half the distance of the two arrows

QFont sceneFont(double pixels, QFont::Weight weight)
{
    QFont font = theme::font(theme::TextRole::Body, 1.0);
    font.setPixelSize(int(std::lround(pixels)));
    font.setWeight(weight);
    return font;
}

QFont stateFont(double factor) { return sceneFont(20 * factor, QFont::DemiBold); }
QFont figureFont(double factor) { return sceneFont(17 * factor, QFont::Normal); }

QLineF shifted(const QLineF& line, double by)
{
    const QPointF along = (line.p2() - line.p1()) / std::max(1.0, line.length());
    return line.translated(QPointF(-along.y(), along.x()) * by);
}

} // namespace

DeviceItem::DeviceItem(const DeviceNode& device, const QRectF& box, bool mini) : m_device(device), m_box(box), m_mini(mini)
{
    setZValue(2);
}

void DeviceItem::setCurrent(bool current)
{
    m_current = current;
    update();
}

void DeviceItem::setTextFactor(double factor)
{
    m_factor = factor;
    update();
}

QRectF DeviceItem::boundingRect() const { return m_box.adjusted(-6, -6, 6, 6); }

void DeviceItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*)
{
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(m_current ? QPen(colour::focus, 3.5)
                              : QPen(m_device.self ? colour::text : colour::strongLine, m_device.self ? 2.5 : 1.5));
    painter->setBrush(colour::raised);
    painter->drawRoundedRect(m_box, 8, 8);
    if (m_mini) {
        icons::draw(*painter, m_box.adjusted(8, 8, -8, -8), icons::forKind(m_device.kind), colour::text);
        return;
    }
    const double side = 38;
    icons::draw(*painter, QRectF(m_box.left() + 12, m_box.center().y() - side / 2, side, side), icons::forKind(m_device.kind),
                colour::text);
    const QRectF text = m_box.adjusted(side + 22, 12, -6, -12);
    painter->setFont(stateFont(m_factor));
    painter->setPen(colour::bright);
    painter->drawText(QRectF(text.left(), text.top(), text.width(), text.height() / 2), Qt::AlignLeft | Qt::AlignVCenter,
                      QFontMetricsF(painter->font()).elidedText(m_device.title, Qt::ElideRight, text.width()));
    painter->setFont(figureFont(m_factor));
    painter->setPen(colour::secondary);
    const QString below = m_device.self ? TopologyView::tr("this console") : m_device.address;
    painter->drawText(QRectF(text.left(), text.center().y(), text.width(), text.height() / 2), Qt::AlignLeft | Qt::AlignVCenter,
                      QFontMetricsF(painter->font()).elidedText(below, Qt::ElideMiddle, text.width()));
}

LinkItem::LinkItem(const LinkNode& link, PlacedLink place, bool mini) : m_link(link), m_place(std::move(place)), m_mini(mini)
{
    setZValue(1);
}

void LinkItem::setCurrent(bool current)
{
    m_current = current;
    setZValue(current ? 1.5 : 1);
    update();
}

void LinkItem::setLink(const LinkNode& link, Instant now)
{
    prepareGeometryChange();
    m_link = link;
    m_now = now;
    update();
}

void LinkItem::setTextFactor(double factor)
{
    prepareGeometryChange();
    m_factor = factor;
    update();
}

double LinkItem::roomBeside() const
{
    if (!m_place.besideLane || m_mini)
        return 0;
    const QFont largest = stateFont(largestTextFactor);
    double wide = 0;
    for (const QString& words : {TopologyView::tr("lost,\nin stand-by"), TopologyView::tr("state not\nknown here")})
        for (const QString& line : words.split(QLatin1Char('\n')))
            wide = std::max(wide, figuresWidth(largest, line));
    return m_place.label.x() + wide + 20;
}

QString LinkItem::stateText() const
{
    if (m_link.stateKnown())
        return word(m_link.state);
    return m_link.inIncident ? TopologyView::tr("lost,\nin stand-by") : TopologyView::tr("state not\nknown here");
}

QString LinkItem::figureText() const
{
    if (!m_link.stateKnown() || !carriesMessages(m_link.state))
        return {};
    const LinkFigures& f = m_link.figures;
    const bool brief = m_factor > 1.1;
    const auto trip = f.roundTrip ? std::optional<double>(milliseconds(*f.roundTrip)) : std::nullopt;
    if (brief)
        return figure(trip, 1, TopologyView::tr("ms"));
    return TopologyView::tr("%1 \u00B7 out %2/s \u00B7 in %3/s")
        .arg(figure(trip, 1, TopologyView::tr("ms")), figure(f.messagesOutPerSecond, 0, {}), figure(f.messagesInPerSecond, 0, {}));
}

QRectF LinkItem::labelBox() const
{
    const QFontMetricsF state(stateFont(m_factor));
    const QFontMetricsF figures(figureFont(m_factor));
    const QStringList lines = stateText().split(QLatin1Char('\n'));
    const QString below = figureText();
    double wide = figuresWidth(figureFont(m_factor), below);
    for (const QString& line : lines)
        wide = std::max(wide, figuresWidth(stateFont(m_factor), line));
    wide += 20;
    const double tall = state.height() * double(lines.size()) + (below.isEmpty() ? 0 : figures.height()) + 8;
    const bool broken = m_link.stateKnown() && arrowLook(m_link.state, true) == ArrowLook::Broken;
    const QPointF place = broken ? m_place.labelWhenBroken : m_place.label;
    return {m_place.besideLane ? place.x() : place.x() - wide / 2, place.y() - tall / 2, wide, tall};
}

QRectF LinkItem::boundingRect() const
{
    return QPolygonF(QList<QPointF>(m_place.way.begin(), m_place.way.end())).boundingRect().adjusted(-16, -16, 16, 16);
}

QPainterPath LinkItem::shape() const
{
    QPainterPath way(m_place.way.front());
    for (const QPointF& point : m_place.way)
        way.lineTo(point);
    QPainterPathStroker stroker;
    stroker.setWidth(30);
    return stroker.createStroke(way);
}

void LinkItem::paintWay(QPainter& painter) const
{
    if (!m_link.stateKnown()) {
        painter.setPen(QPen(m_link.inIncident ? colour::high : colour::strongLine, m_mini ? 4 : 2.2, Qt::DotLine));
        painter.setBrush(Qt::NoBrush);
        painter.drawPolyline(QPolygonF(QList<QPointF>(m_place.way.begin(), m_place.way.end())));
        return;
    }
    for (std::size_t i = 1; i < m_place.way.size(); ++i) {
        const QLineF part(m_place.way[i - 1], m_place.way[i]);
        if (part == m_place.shaft)
            continue;
        painter.setPen(QPen(colour::strongLine, 2));
        painter.drawLine(part);
    }
    const bool outwards = m_link.peer == m_place.b; // of the pair, this console is a
    const double thick = m_mini ? 5 : 2.6;
    const double apart = m_mini ? 11 : parallel;
    const ArrowLook sent = arrowLook(m_link.state, m_link.toPeerStands());
    const ArrowLook heard = arrowLook(m_link.state, m_link.fromPeerStands());
    const QLineF forth = shifted(m_place.shaft, apart);
    const QLineF back = shifted(m_place.shaft, -apart);
    drawLinkArrow(painter, forth, outwards ? sent : heard, thick);
    drawLinkArrow(painter, QLineF(back.p2(), back.p1()), outwards ? heard : sent, thick);
}

void LinkItem::paintLabel(QPainter& painter) const
{
    const QRectF box = labelBox();
    const bool trouble = (m_link.stateKnown() && isTrouble(m_link.state)) || m_link.inIncident;
    const bool lost = m_link.inIncident || m_link.state == LinkState::StandBy || m_link.state == LinkState::Reconnecting;
    painter.setPen(m_current ? QPen(colour::focus, 3.5)
                   : trouble ? QPen(lost ? colour::high : colour::bright, 2)
                             : QPen(colour::line, 1.2));
    painter.setBrush(colour::background);
    painter.drawRoundedRect(box, 5, 5);
    painter.setFont(stateFont(m_factor));
    const QStringList lines = stateText().split(QLatin1Char('\n'));
    const double line = QFontMetricsF(painter.font()).height();
    const double first = line * double(lines.size());
    painter.setPen(trouble ? colour::bright : m_link.stateKnown() ? colour::text : colour::secondary);
    for (qsizetype i = 0; i < lines.size(); ++i)
        drawFigures(painter, QRectF(box.left() + 10, box.top() + 4 + double(i) * line, box.width() - 20, line),
                    Qt::AlignHCenter | Qt::AlignVCenter, lines[i]);
    painter.setFont(figureFont(m_factor));
    painter.setPen(colour::secondary);
    drawFigures(painter, QRectF(box.left() + 10, box.top() + 4 + first, box.width() - 20, box.height() - first - 8),
                Qt::AlignHCenter | Qt::AlignVCenter, figureText());
}

void LinkItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*)
{
    painter->setRenderHint(QPainter::Antialiasing);
    paintWay(*painter);
}

LinkLabel::LinkLabel(const LinkItem& link) : m_link(link) { setZValue(1.8); }

QPainterPath LinkLabel::shape() const
{
    QPainterPath box;
    box.addRect(m_link.labelBox());
    return box;
}

void LinkLabel::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*)
{
    painter->setRenderHint(QPainter::Antialiasing);
    m_link.paintLabel(*painter);
}

} // namespace console
