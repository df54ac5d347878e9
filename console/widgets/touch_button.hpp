// A button that a finger hits, also in a glove.
#pragma once

#include <QPushButton>

namespace console {

/// At least theme::touchSide() tall and wide, whatever is written on it; a row without that room makes it narrower, and never lower.
class TouchButton : public QPushButton {
    Q_OBJECT
public:
    explicit TouchButton(QWidget* parent = nullptr) : TouchButton({}, parent) {}
    explicit TouchButton(const QString& text, QWidget* parent = nullptr);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;
};

} // namespace console
