// A button of the diagnosis sheet. Enter presses it only where that can do no harm.
#pragma once

#include "widgets/touch_button.hpp"

namespace console {

class SheetButton : public TouchButton {
    Q_OBJECT
public:
    enum class Enter { Ignored, Clicks };
    SheetButton(const QString& text, Enter enter, QWidget* parent = nullptr);

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;

private:
    Enter m_enter;
};

} // namespace console
