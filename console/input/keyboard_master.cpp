// The keyboard as a master.
#include "input/keyboard_master.hpp"

#include <algorithm>
#include <array>

namespace console {

namespace {

constexpr int deadManKey = Qt::Key_D;
constexpr int pedalKey = Qt::Key_F;
constexpr int clutchKey = Qt::Key_C;
constexpr int armKey = Qt::Key_R;
constexpr int injectKey = Qt::Key_G;
constexpr int resetKey = Qt::Key_U;

constexpr std::array<int, 14> handKeys{deadManKey,   injectKey,    pedalKey,      clutchKey, armKey,    resetKey,  Qt::Key_Up,
                                       Qt::Key_Down, Qt::Key_Left, Qt::Key_Right, Qt::Key_I, Qt::Key_K, Qt::Key_J, Qt::Key_L};

bool isHandKey(int key) { return std::find(handKeys.begin(), handKeys.end(), key) != handKeys.end(); }

int scaleStep(int key)
{
    if (key == Qt::Key_PageUp)
        return 1;
    return key == Qt::Key_PageDown ? -1 : 0;
}

} // namespace

KeyboardMaster::KeyboardMaster(QObject* parent) : MasterDevice(parent) {}

QString KeyboardMaster::name() const { return word(kind()); }

MasterLife KeyboardMaster::life(Instant) const { return listening() ? MasterLife::Alive : MasterLife::Unheard; }

void KeyboardMaster::listeningChanged()
{
    Q_EMIT lifeChanged();
    if (!listening())
        releaseAll();
}

void KeyboardMaster::tell(int key, bool pressed)
{
    if (key == deadManKey)
        Q_EMIT deadManChanged(pressed);
    else if (key == armKey)
        Q_EMIT armHeldChanged(pressed);
    else if (key == pedalKey)
        Q_EMIT pedalChanged(pressed);
    else if (key == injectKey)
        Q_EMIT injectHeldChanged(pressed);
    else if (key == resetKey)
        Q_EMIT resetHeldChanged(pressed);
}

bool KeyboardMaster::press(int key, bool autoRepeat)
{
    if (!listening() || (!isHandKey(key) && scaleStep(key) == 0))
        return false;
    if (autoRepeat || isDown(key))
        return true;
    if (scaleStep(key) != 0) {
        Q_EMIT scaleStepRequested(scaleStep(key));
        return true;
    }
    m_down.insert(key);
    tell(key, true);
    return true;
}

bool KeyboardMaster::release(int key, bool autoRepeat)
{
    if (autoRepeat)
        return listening() && isHandKey(key);
    if (!m_down.remove(key))
        return false;
    tell(key, false);
    return true;
}

void KeyboardMaster::releaseAll()
{
    const auto down = m_down;
    m_down.clear();
    for (const int key : down)
        tell(key, false);
}

double KeyboardMaster::direction(int positive, int negative) const
{
    // Both at once are a contradiction, and a contradiction moves nothing.
    return static_cast<double>(isDown(positive)) - static_cast<double>(isDown(negative));
}

MasterReading KeyboardMaster::read(Instant)
{
    MasterReading reading;
    reading.alive = listening();
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
    m_down &= QSet<int>{deadManKey, pedalKey, clutchKey, armKey, injectKey, resetKey};
}

QList<QPair<QString, QString>> KeyboardMaster::bindings()
{
    return {{tr("D, held"), tr("dead-man: motion only while it is down")},
            {tr("F, held"), tr("X-ray pedal")},
            {tr("R, held 1.5 s"), tr("arm")},
            {tr("G, held 1 s"), tr("inject contrast, while armed")},
            {tr("U, held 1.5 s"), tr("reset the emergency stop")},
            {tr("Up / Down"), tr("advance / retract the guidewire")},
            {tr("Right / Left"), tr("turn the guidewire clockwise / counter-clockwise")},
            {tr("I / K"), tr("advance / retract the catheter")},
            {tr("L / J"), tr("turn the catheter clockwise / counter-clockwise")},
            {tr("C, held"), tr("clutch: the hand moves, the robot does not")},
            {tr("Page Up / Page Down"), tr("larger / smaller scale; never larger while engaged")}};
}

QString KeyboardMaster::legend() const
{
    return tr("D dead-man · F X-ray · R arm · G inject · arrows guidewire · I K J L catheter · C clutch · Page Up/Down scale");
}

} // namespace console
