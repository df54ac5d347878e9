// A filled lamp is pressed, a grey one at another console; an empty one is not pressed, a dashed one is not known.
#include "widgets/hand_block.hpp"

#include "widgets/axis_panel.hpp"
#include "widgets/figures.hpp"
#include "widgets/icons.hpp"
#include "widgets/theme.hpp"

#include <QPainter>

#include <cmath>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

HandBlock::HandBlock(QWidget* parent) : QWidget(parent)
{
    theme::setTextRole(this, TextRole::Body);
    setAccessibleName(tr("Hand"));
}

QSize HandBlock::sizeHint() const
{
    const QFontMetrics body(font());
    return {int(namesWidth() + 2 * cellWidth() + theme::px(this, 28) + askedWidth()) + 1, body.height() * 4};
}

double HandBlock::lampSide() const { return QFontMetricsF(font()).height() * 1.9; }

double HandBlock::namesWidth() const
{
    const QFontMetricsF caption(theme::font(TextRole::Caption, theme::scaleOf(this)));
    return caption.horizontalAdvance(tr("Dead-man")) + theme::px(this, 14);
}

double HandBlock::cellWidth() const
{
    const QFontMetricsF caption(theme::font(TextRole::Caption, theme::scaleOf(this)));
    return lampSide() * 1.25 + std::max(caption.horizontalAdvance(tr("released")), caption.horizontalAdvance(tr("unknown"))) +
           theme::px(this, 12);
}

double HandBlock::askedWidth() const
{
    const double scale = theme::scaleOf(this);
    const QFontMetricsF caption(theme::font(TextRole::Caption, scale));
    const QFont strong = theme::font(TextRole::Strong, scale);
    const double motion = caption.horizontalAdvance(tr("Guidewire")) + figuresWidth(strong, tr("advance +00.0 mm/s"));
    const double force = caption.horizontalAdvance(tr("FORCE TO HAND")) + figuresWidth(strong, tr("resistance 0.00 N"));
    return (m_hand.forceToHand ? std::max(motion, force) : motion) + theme::px(this, 14);
}

void HandBlock::setState(const HandState& hand, const InstrumentState& instrument, const QString& owner, Instant now)
{
    const bool fresh = instrument.robotFresh(now);
    const QString another = fresh ? owner : QString();
    const Lamp pressed = another.isEmpty() ? Lamp::On : Lamp::AnothersOn;
    const Lamp received = !fresh ? Lamp::Unknown : instrument.robot().value.engaged ? pressed : Lamp::Off;
    if (m_hand == hand.reading() && m_received == received && m_owner == another)
        return;
    const bool other = m_hand.forceToHand.has_value() != hand.reading().forceToHand.has_value();
    m_hand = hand.reading();
    m_received = received;
    m_owner = another;
    if (other)
        updateGeometry();
    setToolTip(m_owner.isEmpty() ? QString()
                                 : tr("%1 has armed the robot: the dead-man at the robot is not yours").arg(m_owner).toHtmlEscaped());
    setAccessibleDescription(
        tr("Dead-man sent %1, at the robot %2, clutch %3")
            .arg(m_hand.deadMan ? tr("pressed") : tr("released"), receivedWords(), m_hand.clutch ? tr("pressed") : tr("released")) +
        (m_hand.forceToHand ? tr(", force to hand %1").arg(forceText()) : QString()) +
        (m_hand.scaleBefore ? tr(", scale %1").arg(scaleText()) : QString()));
    update();
}

QString HandBlock::lampWord(Lamp lamp)
{
    switch (lamp) {
    case Lamp::Unknown:
        return tr("unknown");
    case Lamp::Off:
        return tr("released");
    case Lamp::On:
    case Lamp::AnothersOn:
        break;
    }
    return tr("pressed");
}

QString HandBlock::receivedWords() const
{
    const QString word = lampWord(m_received);
    return m_owner.isEmpty() ? word : tr("%1 (that of %2)").arg(word, m_owner);
}

void HandBlock::paintLamp(QPainter& painter, const QRectF& where, bool deadMan, Lamp lamp) const
{
    const double side = std::min(where.height() * 0.9, lampSide());
    const QRectF disc(where.left(), where.center().y() - side / 2, side, side);
    const bool ours = lamp == Lamp::On;
    const bool on = ours || lamp == Lamp::AnothersOn;
    painter.setPen(QPen(ours ? colour::armed : colour::strongLine, 1.8, lamp == Lamp::Unknown ? Qt::DashLine : Qt::SolidLine));
    painter.setBrush(on ? QBrush(ours ? colour::armed : colour::secondary) : QBrush(Qt::NoBrush));
    painter.drawRoundedRect(disc, side * 0.22, side * 0.22);
    icons::draw(painter, disc.adjusted(side * 0.15, side * 0.15, -side * 0.15, -side * 0.15),
                deadMan ? icons::Icon::DeadMan : icons::Icon::Clutch, on ? colour::onAlarm : colour::secondary);
    painter.setPen(on ? colour::bright : colour::secondary);
    painter.drawText(QRectF(disc.right() + side * 0.25, where.top(), where.right() - disc.right(), where.height()),
                     Qt::AlignLeft | Qt::AlignVCenter, lampWord(lamp));
}

void HandBlock::paintLamps(QPainter& painter, const QRectF& where) const
{
    const double head = QFontMetricsF(painter.font()).height();
    const double row = (where.height() - head) / 2;
    const double names = namesWidth();
    const double cell = cellWidth();
    painter.setPen(colour::secondary);
    painter.drawText(QRectF(where.left() + names, where.top(), cell, head), Qt::AlignLeft | Qt::AlignVCenter, tr("Sent"));
    const QRectF atRobot(where.left() + names + cell, where.top(), cell + theme::px(this, 18), head); // some of the gap behind it, too
    painter.setPen(m_owner.isEmpty() ? colour::secondary : colour::bright);
    painter.drawText(atRobot, Qt::AlignLeft | Qt::AlignVCenter,
                     m_owner.isEmpty()
                         ? tr("At the robot")
                         : QFontMetricsF(painter.font()).elidedText(tr("Of %1").arg(m_owner), Qt::ElideRight, atRobot.width()));
    const QRectF first(where.left(), where.top() + head, names, row);
    const QRectF second = first.translated(0, row);
    painter.setPen(colour::text);
    painter.drawText(first, Qt::AlignLeft | Qt::AlignVCenter, tr("Dead-man"));
    painter.drawText(second, Qt::AlignLeft | Qt::AlignVCenter, tr("Clutch"));
    paintLamp(painter, QRectF(first.right(), first.top(), cell, row), true,
              !m_hand.alive    ? Lamp::Unknown
              : m_hand.deadMan ? Lamp::On
                               : Lamp::Off);
    paintLamp(painter, QRectF(first.right() + cell, first.top(), cell, row), true, m_received);
    paintLamp(painter, QRectF(second.right(), second.top(), cell, row), false,
              !m_hand.alive   ? Lamp::Unknown
              : m_hand.clutch ? Lamp::On
                              : Lamp::Off);
    painter.setPen(colour::secondary);
    painter.drawText(QRectF(second.right() + cell, second.top(), cell, row), Qt::AlignLeft | Qt::AlignVCenter, tr("console only"));
}

QString HandBlock::forceText() const
{
    const double force = m_hand.forceToHand.value_or(0);
    const auto way = std::abs(force) < 0.02 ? tr("none") : force > 0 ? tr("resistance") : tr("pull");
    return tr("%1 %2").arg(way, figure(std::abs(force), 2, tr("N")));
}

QString HandBlock::scaleText() const
{
    return m_hand.scaleBefore ? tr("%1 : 1, was %2").arg(m_hand.scale, 0, 'f', 2).arg(*m_hand.scaleBefore, 0, 'f', 2)
                              : tr("%1 : 1").arg(m_hand.scale, 0, 'f', 2);
}

std::vector<HandBlock::Row> HandBlock::rows() const
{
    const auto& motion = m_hand.motion;
    std::vector<Row> rows{
        {tr("Scale"), scaleText()},
        {tr("Guidewire"), tr("%1 %2").arg(advanceWord(motion.guidewireVelocity), signedFigure(motion.guidewireVelocity, 1, tr("mm/s")))},
        {tr("Catheter"), tr("%1 %2").arg(advanceWord(motion.catheterVelocity), signedFigure(motion.catheterVelocity, 1, tr("mm/s")))}};
    if (m_hand.forceToHand)
        rows.push_back({tr("FORCE TO HAND"), forceText()});
    return rows;
}

void HandBlock::paintAsked(QPainter& painter, const QRectF& where) const
{
    const auto shown = rows();
    const double head = QFontMetricsF(painter.font()).height();
    const double row = (where.height() - head) / double(shown.size());
    painter.setPen(colour::secondary);
    painter.drawText(QRectF(where.left(), where.top(), where.width(), head), Qt::AlignLeft | Qt::AlignVCenter, tr("Asked by the hand"));
    const QFont body = painter.font();
    QRectF line(where.left(), where.top() + head, where.width(), row);
    for (const auto& [name, value] : shown) {
        painter.setFont(body);
        painter.setPen(colour::secondary);
        painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, name);
        painter.setFont(theme::font(TextRole::Strong, theme::scaleOf(this)));
        painter.setPen(m_hand.alive ? colour::text : colour::secondary);
        drawFigures(painter, line, Qt::AlignRight | Qt::AlignVCenter, m_hand.alive ? value : QStringLiteral("\u2014"));
        line.translate(0, row);
    }
}

void HandBlock::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setFont(theme::font(TextRole::Caption, theme::scaleOf(this)));
    const double gap = theme::px(this, 28);
    const double lamps = namesWidth() + 2 * cellWidth();
    paintLamps(painter, QRectF(0, 0, lamps, height()));
    painter.setFont(theme::font(TextRole::Caption, theme::scaleOf(this)));
    paintAsked(painter, QRectF(lamps + gap, 0, width() - lamps - gap, height()));
}

} // namespace console
