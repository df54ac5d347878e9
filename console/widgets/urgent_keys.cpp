// The three keys that work in every window, whatever has the focus.
#include "widgets/urgent_keys.hpp"

#include <QApplication>
#include <QKeyEvent>
#include <QWidget>

namespace console {

namespace {

bool isUrgent(int key) { return key == Qt::Key_Escape || key == Qt::Key_F12 || key == Qt::Key_F9; }

} // namespace

UrgentKeys::UrgentKeys(QWidget* window) : QObject(window), m_window(window) { qApp->installEventFilter(this); }

bool UrgentKeys::eventFilter(QObject* watched, QEvent* event)
{
    const bool press = event->type() == QEvent::KeyPress;
    if ((!press && event->type() != QEvent::ShortcutOverride) || !isOfWindow(watched))
        return false;
    const auto* key = static_cast<const QKeyEvent*>(event);
    if (!isUrgent(key->key()))
        return false;
    event->accept(); // to be asked before shortcuts are: the press itself comes, whatever shortcut there may be
    if (press && !key->isAutoRepeat())
        tell(key->key());
    return true;
}

/// A menu that opens from a control is a window of its own, and still of this one.
bool UrgentKeys::isOfWindow(const QObject* receiver) const
{
    if (!receiver->isWidgetType())
        return false;
    const auto* widget = static_cast<const QWidget*>(receiver);
    while (widget != nullptr && widget != m_window)
        widget = widget->parentWidget();
    return widget != nullptr;
}

void UrgentKeys::tell(int key)
{
    if (key == Qt::Key_Escape)
        Q_EMIT emergencyStopPressed();
    else if (key == Qt::Key_F12)
        Q_EMIT holdPressed();
    else
        Q_EMIT audioPausePressed();
}

} // namespace console
