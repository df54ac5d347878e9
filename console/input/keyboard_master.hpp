// The keyboard as a master: always there, one key held to permit motion, others to move.
#pragma once

#include "input/hand_mapping.hpp"
#include "input/master_device.hpp"

#include <QList>
#include <QPair>
#include <QSet>

namespace console {

/// Left hand: D held is the dead-man, F held the X-ray pedal, C held the clutch, R held 1.5 s arms, G held 1 s injects contrast, U held
/// 1.5 s resets the emergency stop. Right hand: arrow up / down advance / retract the guidewire, right / left turn it; I / K advance /
/// retract the catheter, L / J turn it. Page up / down change the scale. Space, Enter and Return are bound to nothing: they press buttons.
///
/// Keys count only while the master listens. When that ends everything counts as released, and a key that is still down must be let go and
/// pressed again. Auto-repeat is neither a press nor a release.
class KeyboardMaster : public MasterDevice {
    Q_OBJECT
public:
    explicit KeyboardMaster(QObject* parent = nullptr);

    MasterKind kind() const override { return MasterKind::Keyboard; }
    QString name() const override;
    QString legend() const override;
    MasterLife life(Instant now) const override;
    MasterReading read(Instant now) override;
    void rezero(Instant now) override;
    void requireRelease() override { releaseAll(); }

    /// Qt's key codes, of a release that of the press: whoever hears the keyboard knows the key again. True when it belongs to the hand.
    bool press(int key, bool autoRepeat = false);
    bool release(int key, bool autoRepeat = false);
    void releaseAll();

    /// The keys with what they do: `D, held` `dead-man`.
    static QList<QPair<QString, QString>> bindings();

Q_SIGNALS:
    void pedalChanged(bool down);
    void injectHeldChanged(bool held);
    void resetHeldChanged(bool held); ///< for the emergency stop

protected:
    void listeningChanged() override;

private:
    bool isDown(int key) const { return m_down.contains(key); }
    double direction(int positive, int negative) const;
    void tell(int key, bool pressed);

    QSet<int> m_down;
    HandSpeeds m_speeds;
};

} // namespace console
