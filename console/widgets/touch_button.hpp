// A button that a finger hits, also in a glove.
#pragma once

#include <QPushButton>

namespace console {

/// At least theme::touchSide() tall and wide, whatever is written on it; a row without that room makes it narrower, and never lower. Space
/// presses it; Enter only where it says so, on every desktop.
class TouchButton : public QPushButton {
    Q_OBJECT
public:
    enum class Enter { Ignored, Clicks };
    explicit TouchButton(QWidget* parent = nullptr) : TouchButton({}, parent) {}
    explicit TouchButton(const QString& text, QWidget* parent = nullptr, Enter enter = Enter::Ignored);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;

private:
    Enter m_enter;
};

} // namespace console
