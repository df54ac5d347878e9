// Labels that take their text as it is, and the ink they are written with.
#pragma once

#include "widgets/theme.hpp"

#include <QLabel>

namespace console {

/// Plain text only: a name from a peer is never read as mark-up.
QLabel* plainLabel(const QString& text, theme::TextRole role, QWidget* parent);

/// Plain text that ends in an ellipsis where its room is too small for the whole, which its owner gives it as a tool tip.
class ElidedLabel : public QLabel {
    Q_OBJECT
public:
    ElidedLabel(theme::TextRole role, QWidget* parent);

protected:
    void paintEvent(QPaintEvent* event) override;
};

void setInk(QWidget* widget, const QColor& ink);

/// A frame's heading: a caption in secondary ink.
QLabel* headingLabel(const QString& text, QWidget* parent);

} // namespace console
