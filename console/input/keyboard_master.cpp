// The keyboard as a master.
#include "input/keyboard_master.hpp"

#include <QKeyEvent>
#include <QWindow>

#include <algorithm>
#include <array>

namespace console {

namespace {

constexpr int deadManKey = Qt::Key_D;
constexpr int clutchKey = Qt::Key_C;
constexpr int armKey = Qt::Key_R;
constexpr int panicKey = Qt::Key_F12;

constexpr std::array handKeys{deadManKey,         clutchKey,      armKey,         int(Qt::Key_Up), int(Qt::Key_Down), int(Qt::Key_Left),
                              int(Qt::Key_Right), int(Qt::Key_I), int(Qt::Key_K), int(Qt::Key_J),  int(Qt::Key_L)};

bool isHandKey(int key) { return std::find(handKeys.begin(), handKeys.end(), key) != handKeys.end(); }

int scaleStep(int key) { return key == Qt::Key_PageUp ? 1 : key == Qt::Key_PageDown ? -1 : 0; }

/// With these a key is a shortcut, not the hand's.
bool isShortcut(const QKeyEvent& event) { return (event.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier)) != 0; }

} // namespace

KeyboardMaster::KeyboardMaster(QObject* parent) : MasterDevice(parent) {}

QString KeyboardMaster::name() const { return tr("Keyboard"); }

void KeyboardMaster::watch(QWindow* window)
{
    if (m_window)
        m_window->removeEventFilter(this);
    m_window = window;
    if (m_window)
        m_window->installEventFilter(this);
    releaseAll();
}

void KeyboardMaster::setListening(bool listening)
{
    if (m_listening == listening)
        return;
    m_listening = listening;
    if (!listening)
        releaseAll();
}

bool KeyboardMaster::press(int key, bool autoRepeat)
{
    if (key == panicKey) {
        if (!autoRepeat)
            Q_EMIT panicRequested();
        return true;
    }
    if (!m_listening || (!isHandKey(key) && scaleStep(key) == 0))
        return false;
    if (autoRepeat || isDown(key))
        return true;
    if (scaleStep(key) != 0) {
        Q_EMIT scaleStepRequested(scaleStep(key));
        return true;
    }
    m_down.insert(key);
    if (key == deadManKey)
        Q_EMIT deadManChanged(true);
    else if (key == armKey)
        Q_EMIT armHeldChanged(true);
    return true;
}

bool KeyboardMaster::release(int key, bool autoRepeat)
{
    if (autoRepeat)
        return isHandKey(key) && m_listening;
    if (!m_down.remove(key))
        return false;
    if (key == deadManKey)
        Q_EMIT deadManChanged(false);
    else if (key == armKey)
        Q_EMIT armHeldChanged(false);
    return true;
}

void KeyboardMaster::releaseAll()
{
    const bool deadMan = isDown(deadManKey);
    const bool arm = isDown(armKey);
    m_down.clear();
    if (deadMan)
        Q_EMIT deadManChanged(false);
    if (arm)
        Q_EMIT armHeldChanged(false);
}

bool KeyboardMaster::handleKey(const QKeyEvent& event, bool pressed)
{
    if (pressed && isShortcut(event))
        return false;
    return pressed ? press(event.key(), event.isAutoRepeat()) : release(event.key(), event.isAutoRepeat());
}

bool KeyboardMaster::eventFilter(QObject* watched, QEvent* event)
{
    if (watched != m_window)
        return MasterDevice::eventFilter(watched, event);
    switch (event->type()) {
    case QEvent::KeyPress:
        return handleKey(*static_cast<QKeyEvent*>(event), true);
    case QEvent::KeyRelease:
        return handleKey(*static_cast<QKeyEvent*>(event), false);
    case QEvent::FocusOut:
    case QEvent::Hide:
        releaseAll();
        return false;
    default:
        return false;
    }
}

double KeyboardMaster::direction(int positive, int negative) const
{
    // Both at once are a contradiction, and a contradiction moves nothing.
    return static_cast<double>(isDown(positive)) - static_cast<double>(isDown(negative));
}

MasterReading KeyboardMaster::read(Instant)
{
    MasterReading reading;
    reading.alive = m_listening;
    reading.deadMan = isDown(deadManKey);
    reading.clutch = isDown(clutchKey);
    reading.motion = {direction(Qt::Key_Up, Qt::Key_Down) * m_speeds.guidewireVelocity,
                      direction(Qt::Key_Right, Qt::Key_Left) * m_speeds.guidewireRotation,
                      direction(Qt::Key_I, Qt::Key_K) * m_speeds.catheterVelocity,
                      direction(Qt::Key_L, Qt::Key_J) * m_speeds.catheterRotation};
    return reading;
}

void KeyboardMaster::rezero(Instant)
{
    // A motion key that was down before the dead-man must be pressed again, or the robot would move at once.
    m_down &= QSet<int>{deadManKey, clutchKey, armKey};
}

QList<QPair<QString, QString>> KeyboardMaster::bindings()
{
    return {{tr("D, held"), tr("dead-man: motion only while it is down")},
            {tr("R, held 1.5 s"), tr("arm")},
            {tr("Up / Down"), tr("advance / retract the guidewire")},
            {tr("Right / Left"), tr("turn the guidewire clockwise / counter-clockwise")},
            {tr("I / K"), tr("advance / retract the catheter")},
            {tr("L / J"), tr("turn the catheter clockwise / counter-clockwise")},
            {tr("C, held"), tr("clutch: the hand moves, the robot does not")},
            {tr("Page Up / Page Down"), tr("larger / smaller scale; never larger while engaged")},
            {tr("F12"), tr("panic Hold")}};
}

} // namespace console
