// The band's colour says the priority from afar; its badge flashes, its text never does. What has ended is dark, in a dashed frame, with
// ENDED before it: only its mark flashes until somebody has seen it.
#include "widgets/alarm_band.hpp"
#include "widgets/alarm_colours.hpp"
#include "widgets/flash_clock.hpp"
#include "widgets/self_test_block.hpp"
#include "widgets/theme.hpp"

#include <QPainter>
#include <QPainterPath>
#include <QPushButton>

#include <algorithm>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

QString badgeWord(AlarmPriority priority) { return word(priority).toUpper(); }

QString testText(AlarmPriority priority, bool brief)
{
    switch (priority) {
    case AlarmPriority::High:
        return brief ? AlarmBand::tr("SELF-TEST, no alarm: red, flashing fast, five pulses")
                     : AlarmBand::tr("SELF-TEST, no alarm: red, flashing fast, ten pulses");
    case AlarmPriority::Medium:
        return AlarmBand::tr("SELF-TEST, no alarm: yellow, flashing slowly, three pulses");
    case AlarmPriority::Low:
        break;
    }
    return AlarmBand::tr("SELF-TEST, no alarm: cyan, steady, two pulses");
}

} // namespace

std::optional<AlarmColours> AlarmBand::colours() const
{
    if (const auto test = testSignal())
        return alarmColours(*test, false);
    if (m_alarms.empty())
        return std::nullopt;
    return alarmColours(m_alarms.front().priority, m_alarms.front().acknowledged || !m_alarms.front().present);
}

QColor AlarmBand::surface() const
{
    const auto shown = colours();
    return shown ? shown->surface : colour::panel;
}

QColor AlarmBand::ink() const
{
    const auto shown = colours();
    return shown ? shown->ink : colour::secondary;
}

int AlarmBand::paintBadge(QPainter& painter, AlarmPriority priority, bool acknowledged) const
{
    const AlarmColours colours = alarmColours(priority, acknowledged);
    const bool lit = !acknowledged && m_clock->isLit(priority);
    painter.setFont(theme::font(TextRole::Title, theme::scaleOf(this)));
    const QFontMetricsF metrics(painter.font());
    const double bars = metrics.height();
    const double width = metrics.horizontalAdvance(badgeWord(priority)) + bars + theme::px(this, 44);
    const QRectF badge(6, 5, width, height() - 10);
    QPainterPath path;
    path.addRoundedRect(badge, 4, 4);
    painter.fillPath(path, lit ? colours.badgeLit : colours.badgeDim);
    painter.setPen(lit ? colours.badgeInkLit : colours.badgeInkDim);
    const double pad = theme::px(this, 14);
    drawPriorityBars(painter, QRectF(badge.left() + pad, badge.center().y() - bars * 0.38, bars, bars * 0.76), priority);
    painter.drawText(badge.adjusted(pad + bars + pad / 2, 0, -pad / 2, 0), Qt::AlignLeft | Qt::AlignVCenter, badgeWord(priority));
    return int(badge.right()) + theme::px(this, 16);
}

void AlarmBand::paintChips(QPainter& painter, const QRectF& room, std::size_t first) const
{
    painter.setFont(theme::font(TextRole::Strong, theme::scaleOf(this)));
    const QFontMetricsF metrics(painter.font());
    const double pad = theme::px(this, 12);
    double x = room.left();
    for (std::size_t i = first; i < m_alarms.size(); ++i) {
        const QString more = tr("+%1 more").arg(m_alarms.size() - i);
        const double reserve = i + 1 < m_alarms.size() ? metrics.horizontalAdvance(more) + pad : 0;
        const double width = metrics.horizontalAdvance(textOf(m_alarms[i])) + metrics.height() * 0.8 + 3 * pad;
        if (x + width + reserve > room.right()) {
            painter.setPen(ink());
            painter.drawText(QRectF(x, room.top(), room.right() - x, room.height()), Qt::AlignLeft | Qt::AlignVCenter, more);
            return;
        }
        paintChip(painter, QRectF(x, room.top() + room.height() * 0.16, width, room.height() * 0.68), m_alarms[i]);
        x += width + pad * 0.7;
    }
}

/// One that nobody acknowledged flashes, whatever stands before it in the band: whole while it is there, with its mark once it has ended.
void AlarmBand::paintChip(QPainter& painter, const QRectF& chip, const Alarm& alarm) const
{
    const AlarmColours colours = alarmColours(alarm.priority, alarm.acknowledged || !alarm.present);
    const bool lit = alarm.acknowledged || m_clock->isLit(alarm.priority);
    const double pad = theme::px(this, 12);
    const double bars = QFontMetricsF(painter.font()).height() * 0.8;
    const QRectF mark(chip.left() + pad, chip.center().y() - bars * 0.4, bars, bars * 0.8);
    QPainterPath path;
    path.addRoundedRect(chip, 4, 4);
    painter.fillPath(path, lit || !alarm.present ? colours.surface : colours.badgeDim);
    painter.setPen(QPen(colour::background, 2));
    painter.drawPath(path);
    if (!alarm.present) {
        QPainterPath badge;
        badge.addRect(chip.left(), chip.top(), pad * 1.25 + bars, chip.height());
        painter.fillPath(path.intersected(badge), lit ? colours.badgeLit : colours.badgeDim);
        painter.setPen(lit ? colours.badgeInkLit : colours.badgeInkDim);
        drawPriorityBars(painter, mark, alarm.priority);
        painter.setPen(QPen(colours.ink, 2, Qt::DashLine));
        painter.drawPath(path);
        painter.setPen(colours.ink);
    } else {
        painter.setPen(lit ? colours.ink : colours.badgeInkDim);
        drawPriorityBars(painter, mark, alarm.priority);
    }
    painter.drawText(chip.adjusted(pad * 2 + bars, 0, 0, 0), Qt::AlignLeft | Qt::AlignVCenter, textOf(alarm));
}

/// What is left of the band for the highest alarm's text: the others' chips give way to it, down to how many they are, and what is to be
/// done about a single one down to two small lines.
double AlarmBand::textRoom(double room) const
{
    const QFontMetricsF metrics(theme::font(TextRole::Strong, theme::scaleOf(this)));
    const double beside = m_alarms.size() > 1 ? metrics.horizontalAdvance(tr("+%1 more").arg(m_alarms.size() - 1))
                                              : leastRemedyRoom(remedyOf(m_alarms.front()));
    return room - beside - theme::px(this, 24 + 12);
}

double AlarmBand::leastRemedyRoom(const QString& remedy) const
{
    const QFontMetricsF metrics(theme::font(TextRole::Caption, theme::scaleOf(this)));
    double width = metrics.horizontalAdvance(remedy) / 2;
    while (metrics.boundingRect(QRectF(0, 0, width, height()), Qt::TextWordWrap, remedy).height() > 2.5 * metrics.height())
        width *= 1.05;
    return width;
}

void AlarmBand::paintQuiet(QPainter& painter, double right) const
{
    using Step = AlarmSelfTest::Step;
    painter.setPen(ink());
    QString text = tr("No alarms");
    if (m_testStep == Step::Asking)
        text = tr("Were all three colours seen, and all three sounds heard?");
    else if (m_testStep == Step::Failed)
        text = tr("No alarms. The alarm self-test was not confirmed: have screen and sound looked at");
    else if (m_testStep == Step::NotDone)
        text = tr("No alarms. The alarm self-test is to be done before arming");
    const double left = theme::px(this, 20);
    painter.setFont(fitting(text, right - left, {TextRole::Title, TextRole::Strong, TextRole::Body, TextRole::Caption}));
    const QString shown = QFontMetricsF(painter.font()).elidedText(text, Qt::ElideRight, right - left);
    painter.drawText(QRectF(left, 0, right - left, height()), Qt::AlignLeft | Qt::AlignVCenter, shown);
}

/// The first of `roles` in which `text` is whole: smaller letters are better than none.
QFont AlarmBand::fitting(const QString& text, double room, std::initializer_list<TextRole> roles) const
{
    QFont face = font();
    for (const TextRole role : roles) {
        face = theme::font(role, theme::scaleOf(this));
        if (QFontMetricsF(face).horizontalAdvance(text) <= room)
            break;
    }
    return face;
}

/// The text of the test or of the highest alarm, in one line, or in two before its letters are smaller than a title's; returns where it
/// ends.
double AlarmBand::paintText(QPainter& painter, const QString& text, double left, double most) const
{
    constexpr int inTwoLines = Qt::AlignLeft | Qt::AlignVCenter | Qt::TextWordWrap;
    const QRectF room(left, 0, most, height());
    QString shown = text;
    painter.setPen(ink());
    painter.setFont(fitting(text, most, {TextRole::Alarm, TextRole::Title}));
    const QRectF asked = painter.boundingRect(room, inTwoLines, text);
    if (asked.height() > room.height() || asked.width() > most + 1) {
        painter.setFont(fitting(text, most, {TextRole::Strong}));
        shown = QFontMetricsF(painter.font()).elidedText(text, Qt::ElideRight, most);
    }
    painter.drawText(room, inTwoLines, shown);
    return painter.boundingRect(room, inTwoLines, shown).right() + theme::px(this, 24);
}

void AlarmBand::paintAlarms(QPainter& painter, double right) const
{
    const Alarm& top = m_alarms.front();
    const int left = paintBadge(painter, top.priority, top.acknowledged);
    const double room = right - left;
    const double end = paintText(painter, textOf(top), left, textRoom(room));
    if (!top.present)
        paintEndedFrame(painter, QRectF(3, 3, end - theme::px(this, 12) - 3, height() - 6));
    if (m_alarms.size() > 1)
        return paintChips(painter, QRectF(end, 0, right - end, height()), 1);
    paintRemedy(painter, remedyOf(top), QRectF(end, 0, right - end, height()));
}

/// Round what has ended alone: the chips beside it may be there.
void AlarmBand::paintEndedFrame(QPainter& painter, const QRectF& where) const
{
    painter.setPen(QPen(ink(), 2, Qt::DashLine));
    painter.drawRect(where);
}

/// One line, or two of smaller letters.
void AlarmBand::paintRemedy(QPainter& painter, const QString& remedy, const QRectF& room) const
{
    painter.setFont(fitting(remedy, room.width(), {TextRole::Body, TextRole::Caption}));
    painter.drawText(room, Qt::AlignLeft | Qt::AlignVCenter | Qt::TextWordWrap, remedy);
}

double AlarmBand::freeRight() const
{
    double right = m_mark->x();
    for (const QWidget* other :
         {static_cast<const QWidget*>(m_test), static_cast<const QWidget*>(m_pause), static_cast<const QWidget*>(m_acknowledge)})
        if (other->isVisible())
            right = std::min(right, double(other->x()));
    for (const QPushButton* chip : m_chips)
        right = std::min(right, double(chip->x()));
    return right - theme::px(this, 16);
}

void AlarmBand::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.fillRect(rect(), surface());
    const double right = freeRight();
    if (const auto test = testSignal()) {
        const int left = paintBadge(painter, *test, false);
        const double end = paintText(painter, testText(*test, m_testBrief), left, right - left);
        paintChips(painter, QRectF(end, 0, right - end, height()), 0);
    } else if (m_alarms.empty()) {
        paintQuiet(painter, right);
    } else {
        paintAlarms(painter, right);
    }
}

} // namespace console
