// A button that a finger hits.
#include "widgets/touch_button.hpp"

#include "widgets/enter_key.hpp"
#include "widgets/theme.hpp"

namespace console {

TouchButton::TouchButton(const QString& text, QWidget* parent, Enter enter) : QPushButton(text, parent), m_enter(enter)
{
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed); // a button of Qt is never narrower than its size hint
}

QSize TouchButton::sizeHint() const
{
    const int side = theme::touchSide(this);
    return QPushButton::sizeHint().expandedTo({side, side});
}

QSize TouchButton::minimumSizeHint() const { return QPushButton::sizeHint().expandedTo({theme::leastTouchSide, theme::touchSide(this)}); }

void TouchButton::keyPressEvent(QKeyEvent* event)
{
    if (!isEnter(*event)) {
        QPushButton::keyPressEvent(event);
        return;
    }
    event->accept();
    if (m_enter == Enter::Clicks && !event->isAutoRepeat())
        click();
}

void TouchButton::keyReleaseEvent(QKeyEvent* event)
{
    if (isEnter(*event))
        event->accept();
    else
        QPushButton::keyReleaseEvent(event);
}

} // namespace console
