// A button of the diagnosis sheet or of a view.
#include "widgets/sheet_button.hpp"

#include "widgets/theme.hpp"

namespace console {

SheetButton::SheetButton(const QString& text, Enter enter, QWidget* parent) : TouchButton(text, parent, enter)
{
    setAutoDefault(false);
    setAccessibleName(text);
    theme::setTextRole(this, theme::TextRole::Strong);
}

} // namespace console
