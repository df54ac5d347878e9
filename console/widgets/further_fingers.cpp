// A mouse of its own for each finger, on the buttons that stop or hold.
#include "widgets/further_fingers.hpp"

#include "widgets/double_click.hpp"
#include "widgets/hold_button.hpp"
#include "widgets/stop_button.hpp"

#include <QApplication>
#include <QMouseEvent>
#include <QTouchEvent>
#include <QWindow>

#include <utility>

namespace console {

namespace {

void sendAsMouse(QEvent::Type type, QAbstractButton& button, const QEventPoint& finger)
{
    const QPointF place = finger.globalPosition();
    const bool down = type != QEvent::MouseButtonRelease;
    QMouseEvent mouse(type, button.mapFromGlobal(place), button.window()->mapFromGlobal(place), place,
                      type == QEvent::MouseMove ? Qt::NoButton : Qt::LeftButton, down ? Qt::LeftButton : Qt::NoButton, Qt::NoModifier,
                      Qt::MouseEventSynthesizedByApplication);
    QCoreApplication::sendEvent(&button, &mouse);
}

} // namespace

FurtherFingers::FurtherFingers(QWidget* part) : QObject(part), m_part(part) { qApp->installEventFilter(this); }

/// Of the window itself: widgets hear of a finger only where none of what is around them is touched already.
bool FurtherFingers::eventFilter(QObject* watched, QEvent* event)
{
    switch (event->type()) {
    case QEvent::TouchBegin:
    case QEvent::TouchUpdate:
    case QEvent::TouchEnd:
    case QEvent::TouchCancel:
        if (watched == m_part->window()->windowHandle())
            follow(*static_cast<QTouchEvent*>(event));
        return false;
    default:
        return false;
    }
}

void FurtherFingers::follow(const QTouchEvent& touch)
{
    if (touch.type() == QEvent::TouchCancel)
        return letGo();
    bool isFirst = touch.type() == QEvent::TouchBegin; // that Qt makes a mouse of
    for (const QEventPoint& finger : touch.points()) {
        if (finger.state() != QEventPoint::State::Pressed)
            follow(finger);
        else if (!isFirst)
            press(finger);
        isFirst = false;
    }
}

void FurtherFingers::press(const QEventPoint& finger)
{
    QWidget* window = m_part->window();
    QWidget* touched = window->childAt(window->mapFromGlobal(finger.globalPosition()).toPoint());
    const bool acts = qobject_cast<StopButton*>(touched) != nullptr || qobject_cast<HoldButton*>(touched) != nullptr;
    if (!acts || !touched->isEnabled() || !m_part->isAncestorOf(touched))
        return;
    auto* button = static_cast<QAbstractButton*>(touched);
    m_pressed[finger.id()] = button;
    sendAsMouse(isDoubleClick(m_presses[button]) ? QEvent::MouseButtonDblClick : QEvent::MouseButtonPress, *button, finger);
}

void FurtherFingers::follow(const QEventPoint& finger)
{
    const auto pressed = m_pressed.find(finger.id());
    if (pressed == m_pressed.end())
        return;
    const bool isUp = finger.state() == QEventPoint::State::Released;
    const QPointer<QAbstractButton> button = pressed->second;
    if (isUp)
        m_pressed.erase(pressed);
    if (button)
        sendAsMouse(isUp ? QEvent::MouseButtonRelease : QEvent::MouseMove, *button, finger);
}

void FurtherFingers::letGo()
{
    const auto pressed = std::exchange(m_pressed, {});
    for (const auto& [finger, button] : pressed)
        if (button)
            sendAsMouse(QEvent::MouseButtonRelease, *button, QEventPoint(finger));
}

} // namespace console
