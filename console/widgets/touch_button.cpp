// A button that a finger hits.
#include "widgets/touch_button.hpp"

#include "widgets/theme.hpp"

namespace console {

TouchButton::TouchButton(const QString& text, QWidget* parent) : QPushButton(text, parent)
{
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed); // a button of Qt is never narrower than its size hint
}

QSize TouchButton::sizeHint() const
{
    const int side = theme::touchSide(this);
    return QPushButton::sizeHint().expandedTo({side, side});
}

QSize TouchButton::minimumSizeHint() const { return QPushButton::sizeHint().expandedTo({theme::leastTouchSide, theme::touchSide(this)}); }

} // namespace console
