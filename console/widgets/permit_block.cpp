// Grey unless motion is near: blue edge when armed, blue surface when engaged, a double edge when held.
#include "widgets/permit_block.hpp"

#include "widgets/figures.hpp"
#include "widgets/theme.hpp"

#include <QPainter>

#include <algorithm>
#include <utility>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

QString sentenceStart(QString text)
{
    if (!text.isEmpty())
        text[0] = text[0].toUpper();
    return text;
}

} // namespace

PermitBlock::PermitBlock(QWidget* parent) : QWidget(parent)
{
    theme::setTextRole(this, TextRole::Permit);
    setAccessibleName(tr("Motion permit"));
}

QSize PermitBlock::sizeHint() const
{
    const double scale = theme::scaleOf(this);
    const QFontMetrics word(font());
    const QFontMetrics line(theme::font(TextRole::Caption, scale));
    int widest = theme::px(this, 300);
    for (int phase = 0; phase < permitPhaseCount; ++phase)
        widest = std::max(widest, word.horizontalAdvance(console::word(PermitPhase(phase))));
    return {widest + theme::px(this, 44), word.height() + 2 * line.height()};
}

QString PermitBlock::explanation(const PermitModel& permit, Instant now)
{
    const PermitState& state = permit.state();
    const int unmet = permit.unmetCount();
    switch (state.phase) {
    case PermitPhase::Off:
        return tr("No session with the robot. Open the links.");
    case PermitPhase::Standby:
        return unmet == 1 ? tr("1 condition is missing") : tr("%1 conditions are missing").arg(unmet);
    case PermitPhase::Ready:
        return tr("Hold ARM for 1.5 s to arm");
    case PermitPhase::Arming:
        return state.awaitingRobot ? tr("Waiting for the robot's answer") : tr("Keep holding");
    case PermitPhase::Armed: {
        const auto left = std::max(Duration::zero(), Duration(PermitTiming{}.unused) - Duration(now - state.since));
        return state.deadMan && !state.deadManReleasedSeen ? tr("Release the dead-man, then press it to move")
                                                           : tr("Press the dead-man to move. Ends in %1").arg(clockDuration(left));
    }
    case PermitPhase::Engaged:
        return tr("Instruments follow your hand");
    case PermitPhase::Hold:
        // Of the moment of the hold: by now it may be otherwise, and worse.
        return tr("Held because: %1. %2")
            .arg(sentenceStart(permit.holdReasons().value(0)), !state.robotHolds ? tr("Robot not holding yet")
                                                               : state.deadMan   ? tr("Release the dead-man")
                                                                                 : tr("The robot holds"));
    case PermitPhase::Incident:
        return tr("Stand-by: a link is lost");
    case PermitPhase::Verifying:
        return unmet == 0   ? tr("Re-opened. Checking for 1 s")
               : unmet == 1 ? tr("Re-opened. 1 condition is missing")
                            : tr("Re-opened. %1 conditions are missing").arg(unmet);
    }
    return {};
}

void PermitBlock::setPermit(const PermitModel& permit, Instant now)
{
    const QString words = explanation(permit, now);
    if (m_phase == permit.phase() && m_explanation == words)
        return;
    m_phase = permit.phase();
    m_explanation = words;
    setAccessibleDescription(word(m_phase) + QStringLiteral(". ") + m_explanation);
    update();
}

void PermitBlock::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const bool engaged = m_phase == PermitPhase::Engaged;
    const bool armed = m_phase == PermitPhase::Armed;
    const bool held = m_phase == PermitPhase::Hold || m_phase == PermitPhase::Incident;
    const QRectF box = QRectF(rect()).adjusted(1.5, 1.5, -1.5, -1.5);
    painter.setPen(QPen(engaged || armed ? colour::armed : held ? colour::bright : colour::strongLine, engaged || armed || held ? 3 : 1.5));
    painter.setBrush(engaged ? colour::armed : armed ? colour::armedSurface : colour::panel);
    painter.drawRoundedRect(box, 5, 5);
    if (held)
        painter.drawRoundedRect(box.adjusted(6, 6, -6, -6), 3, 3);
    const double pad = theme::px(this, 18);
    const double air = held ? 9.5 : 4; // held: the inner frame, and two pixels within it
    paintWords(painter, box.adjusted(pad, air, -pad, -air),
               engaged ? colour::onAlarm
               : armed ? colour::armed
                       : colour::bright,
               engaged ? colour::onAlarm : colour::text);
}

/// In the largest letters that `room` has the height for; it is measured by the word's ink, above and below which a line of it is empty.
void PermitBlock::paintWords(QPainter& painter, const QRectF& room, const QColor& wordInk, const QColor& lineInk) const
{
    using Roles = std::pair<TextRole, TextRole>;
    constexpr int inLines = Qt::AlignLeft | Qt::TextWordWrap;
    const double leastGap = theme::px(this, 4);
    const double scale = theme::scaleOf(this);
    QFont large;
    QFont small;
    QRectF ink;
    double lines = 0;
    for (const auto& [wordRole, lineRole] :
         {Roles{TextRole::Permit, TextRole::Body}, Roles{TextRole::Permit, TextRole::Caption}, Roles{TextRole::Alarm, TextRole::Caption}}) {
        large = theme::font(wordRole, scale);
        small = theme::font(lineRole, scale);
        ink = QFontMetricsF(large).tightBoundingRect(word(m_phase));
        lines = QFontMetricsF(small).boundingRect(QRectF(0, 0, room.width(), room.height()), inLines, m_explanation).height();
        if (ink.height() + leastGap + lines <= room.height())
            break;
    }
    const QFontMetricsF metrics(large);
    const double gap = std::max(leastGap, std::min(metrics.descent(), room.height() - ink.height() - lines));
    const double top = room.center().y() - (ink.height() + gap + lines) / 2;
    painter.setFont(large);
    painter.setPen(wordInk);
    painter.drawText(QRectF(room.left(), top - ink.top() - metrics.ascent(), room.width(), metrics.height() + 1),
                     Qt::AlignLeft | Qt::AlignTop, word(m_phase));
    painter.setFont(small);
    painter.setPen(lineInk);
    painter.drawText(QRectF(room.left(), top + ink.height() + gap, room.width(), lines + 1), inLines, m_explanation);
}

} // namespace console
