// A button of the diagnosis sheet or of a view. Enter presses it only where that can do no harm.
#pragma once

#include "widgets/touch_button.hpp"

namespace console {

class SheetButton : public TouchButton {
    Q_OBJECT
public:
    SheetButton(const QString& text, Enter enter, QWidget* parent = nullptr);
};

} // namespace console
