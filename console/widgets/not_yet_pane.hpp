// A pane that says plainly what is not there.
#pragma once

#include <QFrame>

class QLabel;

namespace console {

class NotYetPane : public QFrame {
    Q_OBJECT
public:
    NotYetPane(const QString& heading, const QString& sentence, QWidget* parent = nullptr);

protected:
    void paintEvent(QPaintEvent* event) override;
};

} // namespace console
