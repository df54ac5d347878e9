// Fingers beside the first one, where they stop or hold.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QPointer>

#include <map>

class QAbstractButton;
class QEventPoint;
class QTouchEvent;
class QWidget;

namespace console {

/// Qt makes a mouse of the finger that comes first, and lets those beside it do nothing: a finger that scrolls, or a palm, would keep the
/// emergency stop from the next one. Of `part` the emergency stop and the buttons that are held take each finger for itself, as they take
/// the mouse, whatever else is touched. All other controls know one finger. `part` owns it; its window may come later.
class FurtherFingers : public QObject {
    Q_OBJECT
public:
    explicit FurtherFingers(QWidget* part);

    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void follow(const QTouchEvent& touch);
    void press(const QEventPoint& finger);
    void follow(const QEventPoint& finger);
    void letGo();

    QWidget* m_part;
    std::map<int, QPointer<QAbstractButton>> m_pressed; ///< by the finger
    std::map<const QAbstractButton*, QElapsedTimer> m_presses;
};

} // namespace console
