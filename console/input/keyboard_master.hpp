// The keyboard as a master: always there, one key held to permit motion, others to move.
#pragma once

#include "input/master_device.hpp"

#include <QList>
#include <QPair>
#include <QPointer>
#include <QSet>

class QKeyEvent;
class QWindow;

namespace console {

/// Left hand: D held is the dead-man, C the clutch, R held 1.5 s arms. Right hand: arrow up / down advance / retract the guidewire,
/// right / left turn it; I / K advance / retract the catheter, L / J turn it. Page up / down change the scale. F12 is panic Hold.
/// Space, Enter and Return are bound to nothing: they press buttons.
///
/// Keys count only while the master listens and its window is active; when either ends, everything counts as released, and a key that is
/// still down must be let go and pressed again. Auto-repeat is neither a press nor a release.
class KeyboardMaster : public MasterDevice {
    Q_OBJECT
public:
    struct Speeds {
        double guidewireVelocity = 10;  ///< mm/s at scale 1
        double guidewireRotation = 180; ///< deg/s
        double catheterVelocity = 5;
        double catheterRotation = 90;
    };

    explicit KeyboardMaster(QObject* parent = nullptr);

    QString name() const override;
    MasterReading read(Instant now) override;
    void rezero(Instant now) override;

    /// Takes the keys that arrive at this window, before its widgets see them.
    void watch(QWindow* window);

    /// False while something else has the keyboard: a dialogue, a text field, the prompt.
    void setListening(bool listening);
    bool listening() const { return m_listening; }

    /// The keys as events; true when the key belongs to the hand. F12 is heard even when not listening.
    bool press(int key, bool autoRepeat);
    bool release(int key, bool autoRepeat);
    void releaseAll();

    bool eventFilter(QObject* watched, QEvent* event) override;

    /// The keys with what they do, for the help page: `D` `dead-man`.
    static QList<QPair<QString, QString>> bindings();

private:
    bool handleKey(const QKeyEvent& event, bool pressed);
    bool isDown(int key) const { return m_down.contains(key); }
    double direction(int positive, int negative) const;

    QPointer<QWindow> m_window;
    QSet<int> m_down;
    Speeds m_speeds;
    bool m_listening = true;
};

} // namespace console
