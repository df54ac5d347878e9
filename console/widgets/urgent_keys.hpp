// The three keys that work in every window, whatever has the focus.
#pragma once

#include <QObject>

class QWidget;

namespace console {

/// Esc, F12 and F9 of one window and of what opens from it, with whichever modifiers are down, latched or locked; a shortcut asks for
/// exactly its own. No widget, no shortcut and no menu hears them before. A repeat is no press. The window owns it.
class UrgentKeys : public QObject {
    Q_OBJECT
public:
    explicit UrgentKeys(QWidget* window);

    bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
    void emergencyStopPressed();
    void holdPressed();
    void audioPausePressed();

private:
    bool isOfWindow(const QObject* receiver) const;
    void tell(int key);

    const QWidget* m_window;
};

} // namespace console
