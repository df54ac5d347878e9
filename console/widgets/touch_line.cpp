// A line to write in that a finger hits.
#include "widgets/touch_line.hpp"

#include "widgets/theme.hpp"

#include <algorithm>

namespace console {

TouchLine::TouchLine(const QString& accessibleName, const QString& whenEmpty, QWidget* parent) : QLineEdit(parent)
{
    theme::setTextRole(this, theme::TextRole::Body);
    setAccessibleName(accessibleName);
    setPlaceholderText(whenEmpty);
    setContextMenuPolicy(Qt::NoContextMenu);
}

QSize TouchLine::sizeHint() const
{
    const QSize needed = QLineEdit::sizeHint();
    return {needed.width(), std::max(needed.height(), theme::touchSide(this))};
}

QSize TouchLine::minimumSizeHint() const
{
    const QSize needed = QLineEdit::minimumSizeHint();
    return {needed.width(), std::max(needed.height(), theme::touchSide(this))};
}

} // namespace console
