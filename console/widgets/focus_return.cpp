// Where the keyboard goes when the control that has it goes.
#include "widgets/focus_return.hpp"

#include <QWidget>

namespace console {

void returnFocus(QWidget* going)
{
    const QWidget* focus = going->window()->focusWidget();
    if (focus != nullptr && (focus == going || going->isAncestorOf(focus)))
        going->window()->setFocus();
}

} // namespace console
