// The emergency stop: large, never disabled, obeyed at the press and not at the release; by mouse, Space and Enter alike.
#pragma once

#include <QAbstractButton>

namespace console {

class StopButton : public QAbstractButton {
    Q_OBJECT
public:
    explicit StopButton(QWidget* parent = nullptr);

    /// The robot reports an emergency stop in force.
    void setStopped(bool stopped);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    bool m_stopped = false;
};

} // namespace console
