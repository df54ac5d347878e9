// A button of a picture's row of controls.
#include "widgets/small_button.hpp"

#include "widgets/theme.hpp"

namespace console {

SmallButton::SmallButton(const QString& text, const QString& accessibleName, const QString& tip, QWidget* parent)
    : TouchButton(text, parent)
{
    setAutoDefault(false);
    setFocusPolicy(Qt::TabFocus);
    setProperty("slim", true);
    setAccessibleName(accessibleName);
    setToolTip(tip);
    theme::setTextRole(this, theme::TextRole::Caption);
}

void SmallButton::setInForce(bool inForce)
{
    setCheckable(true);
    setChecked(inForce);
}

QSize SmallButton::sizeHint() const
{
    constexpr int air = 4;
    const int side = theme::touchSide(this);
    return (QPushButton::sizeHint() + QSize(air, 0)).expandedTo({side, side});
}

} // namespace console
