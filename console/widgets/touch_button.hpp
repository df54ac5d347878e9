// A button that a finger hits, also in a glove.
#pragma once

#include <QPushButton>

namespace console {

/// At least theme::touchSide() tall, whatever is written on it, and never narrower than theme::leastTouchSide: rows have no room for more.
class TouchButton : public QPushButton {
    Q_OBJECT
public:
    using QPushButton::QPushButton;

    /// In a row that has no room for that: as low as its text lets it be.
    void setTight(bool tight);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

private:
    bool m_tight = false;
};

} // namespace console
