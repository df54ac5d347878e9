// A line to write in that a finger hits.
#pragma once

#include <QLineEdit>

namespace console {

/// At least theme::touchSide() tall. It opens no menu: one would have the keyboard for itself.
class TouchLine : public QLineEdit {
    Q_OBJECT
public:
    TouchLine(const QString& accessibleName, const QString& whenEmpty, QWidget* parent = nullptr);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;
};

} // namespace console
