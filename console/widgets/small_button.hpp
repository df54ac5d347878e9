// A button of a picture's row of controls: small, and reached by Tab or the mouse without taking the keys from the hand.
#pragma once

#include "widgets/touch_button.hpp"

namespace console {

class SmallButton : public TouchButton {
    Q_OBJECT
public:
    SmallButton(const QString& text, const QString& accessibleName, const QString& tip, QWidget* parent = nullptr);

    /// What it stands for is in force; a click alone changes nothing of it.
    void setInForce(bool inForce);

    /// With some air beside its words, which a row without that room takes back.
    QSize sizeHint() const override;

protected:
    void nextCheckState() override {}
};

} // namespace console
