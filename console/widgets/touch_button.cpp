// A button that a finger hits.
#include "widgets/touch_button.hpp"

#include "widgets/theme.hpp"

namespace console {

void TouchButton::setTight(bool tight)
{
    m_tight = tight;
    updateGeometry();
}

QSize TouchButton::sizeHint() const
{
    const QSize needed = QPushButton::sizeHint();
    return m_tight ? needed : needed.expandedTo({theme::leastTouchSide, theme::touchSide(this)});
}

} // namespace console
