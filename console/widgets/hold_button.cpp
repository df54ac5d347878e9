// Holding, and everything that counts as letting go.
#include "widgets/hold_button.hpp"

#include "widgets/theme.hpp"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>

namespace console {

using theme::TextRole;

HoldButton::HoldButton(QWidget* parent) : QAbstractButton(parent), m_accent(theme::colour::armed)
{
    setFocusPolicy(Qt::StrongFocus);
    theme::setTextRole(this, TextRole::Title);
}

void HoldButton::setTexts(const QString& word, const QString& explanation)
{
    if (word == text() && explanation == m_explanation)
        return;
    setText(word);
    m_explanation = explanation;
    setAccessibleDescription(explanation);
    updateGeometry();
    update();
}

void HoldButton::setAccent(const QColor& accent)
{
    m_accent = accent;
    update();
}

void HoldButton::setProgress(double progress)
{
    const double bounded = std::clamp(progress, 0.0, 1.0);
    if (bounded == m_progress)
        return;
    m_progress = bounded;
    update();
}

QSize HoldButton::sizeHint() const
{
    const QFontMetrics word(theme::font(TextRole::Title, theme::scaleOf(this)));
    const QFontMetrics line(theme::font(TextRole::Caption, theme::scaleOf(this)));
    const int width = std::max(word.horizontalAdvance(text()), line.horizontalAdvance(m_explanation));
    const QSize written(width + theme::px(this, 16), word.height() + line.height() + theme::px(this, 20));
    return written.expandedTo({theme::px(this, 156), theme::safetySide(this)});
}

void HoldButton::setHeld(bool held)
{
    if (held == m_held || (held && m_unseen))
        return;
    m_held = held;
    if (!held)
        m_progress = 0;
    update();
    Q_EMIT holdChanged(held);
}

void HoldButton::setKeyHeld(bool held)
{
    if (!held || (isVisible() && isEnabled()))
        setHeld(held);
}

void HoldButton::setUnseen(bool unseen)
{
    m_unseen = unseen;
    if (unseen)
        setHeld(false);
}

void HoldButton::mousePressEvent(QMouseEvent* event)
{
    event->accept();
    if (event->button() == Qt::LeftButton && isEnabled())
        setHeld(true);
}

void HoldButton::mouseReleaseEvent(QMouseEvent* event)
{
    event->accept();
    if (event->button() == Qt::LeftButton)
        setHeld(false);
}

void HoldButton::mouseMoveEvent(QMouseEvent* event)
{
    event->accept();
    if (!rect().contains(event->position().toPoint()))
        setHeld(false);
}

// The second press of a double click starts no hold: a nervous hand shall not arm.
void HoldButton::mouseDoubleClickEvent(QMouseEvent* event) { event->accept(); }

void HoldButton::keyPressEvent(QKeyEvent* event) { event->ignore(); }
void HoldButton::keyReleaseEvent(QKeyEvent* event) { event->ignore(); }

void HoldButton::changeEvent(QEvent* event)
{
    if (event->type() == QEvent::EnabledChange && !isEnabled())
        setHeld(false);
    if (event->type() == QEvent::ActivationChange && !isActiveWindow())
        setHeld(false);
    QAbstractButton::changeEvent(event);
}

void HoldButton::hideEvent(QHideEvent* event)
{
    setHeld(false);
    QAbstractButton::hideEvent(event);
}

bool HoldButton::event(QEvent* event)
{
    if (event->type() == QEvent::UngrabMouse || event->type() == QEvent::WindowDeactivate)
        setHeld(false);
    return QAbstractButton::event(event);
}

void HoldButton::paintEvent(QPaintEvent*)
{
    using namespace theme;
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF body = QRectF(rect()).adjusted(2, 2, -2, -2);
    QPainterPath outline;
    outline.addRoundedRect(body, 5, 5);
    painter.fillPath(outline, isEnabled() ? colour::raised : colour::panel);
    if (m_progress > 0) {
        painter.save();
        painter.setClipPath(outline);
        QColor fill = m_accent;
        fill.setAlphaF(0.45F);
        painter.fillRect(QRectF(body.left(), body.top(), body.width() * m_progress, body.height()), fill);
        painter.restore();
    }
    const QColor edge = hasFocus() ? colour::focus : m_held ? m_accent : isEnabled() ? colour::strongLine : colour::line;
    painter.setPen(QPen(edge, hasFocus() || m_held ? 2.5 : 1.2, isEnabled() ? Qt::SolidLine : Qt::DashLine));
    painter.drawPath(outline);

    const QFont word = theme::font(TextRole::Title, scaleOf(this));
    const QFont line = theme::font(TextRole::Caption, scaleOf(this));
    const double wordHeight = QFontMetricsF(word).height();
    const double lineHeight = m_explanation.isEmpty() ? 0 : QFontMetricsF(line).height();
    const double top = body.center().y() - (wordHeight + lineHeight) / 2;
    painter.setFont(word);
    painter.setPen(isEnabled() || m_progress >= 1 ? colour::bright : colour::secondary);
    painter.drawText(QRectF(body.left(), top, body.width(), wordHeight), Qt::AlignCenter, text());
    painter.setFont(line);
    painter.setPen(isEnabled() || m_progress >= 1 ? colour::bright : colour::secondary);
    painter.drawText(QRectF(body.left(), top + wordHeight, body.width(), lineHeight), Qt::AlignCenter, m_explanation);
}

} // namespace console
