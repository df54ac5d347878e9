// Which master counts, and for what.
#include "input/master_rack.hpp"

#include <algorithm>

namespace console {

MasterRack::MasterRack(KeyboardMaster& keyboard, QObject* parent) : QObject(parent), m_keyboard(keyboard), m_use(&keyboard)
{
    connect(&keyboard, &KeyboardMaster::pedalChanged, this, &MasterRack::pedalChanged);
    connect(&keyboard, &KeyboardMaster::injectHeldChanged, this, &MasterRack::injectHeldChanged);
    connect(&keyboard, &KeyboardMaster::resetHeldChanged, this, &MasterRack::resetHeldChanged);
    add(keyboard);
}

void MasterRack::add(MasterDevice& device)
{
    m_places.push_back({&device, MasterLife::Gone, std::nullopt});
    const auto counts = [this, &device] { return m_use == &device || &m_keyboard == &device; };
    connect(&device, &MasterDevice::lifeChanged, this, [this, counts] {
        if (counts())
            Q_EMIT lifeChanged();
    });
    connect(&device, &MasterDevice::deadManChanged, this, [this, &device](bool pressed) {
        if (deadManOf() == &device)
            Q_EMIT deadManChanged(pressed);
    });
    connect(&device, &MasterDevice::armHeldChanged, this, [this, counts](bool held) {
        if (counts())
            Q_EMIT armHeldChanged(held);
    });
    connect(&device, &MasterDevice::scaleStepRequested, this, [this, counts](int steps) {
        if (counts())
            Q_EMIT scaleStepRequested(steps);
    });
    connect(&device, &MasterDevice::holdRequested, this, &MasterRack::holdRequested);
    device.setListening(listening());
}

MasterDevice* MasterRack::find(MasterKind kind) const
{
    const auto found = std::find_if(m_places.begin(), m_places.end(), [kind](const Place& place) { return place.device->kind() == kind; });
    return found != m_places.end() ? found->device : nullptr;
}

/// Who borrows the keyboard's dead-man is no more alive than the keyboard.
MasterLife MasterRack::lifeOf(const MasterDevice& device, Instant now) const
{
    const auto life = device.life(now);
    return device.borrowsDeadMan() && life == MasterLife::Alive ? m_keyboard.life(now) : life;
}

const MasterDevice* MasterRack::deadManOf() const { return m_use->borrowsDeadMan() ? &m_keyboard : m_use; }

void MasterRack::begin(MasterKind kind)
{
    if (auto* device = find(kind))
        takeInUse(*device);
}

bool MasterRack::choose(MasterKind kind, PermitPhase phase, Instant now)
{
    auto* device = find(kind);
    if (!masterMayChange(phase) || device == nullptr || device->life(now) == MasterLife::Gone)
        return false;
    if (device != m_use)
        takeInUse(*device);
    return true;
}

/// The old one is let go while it still counts, so that nobody goes on believing in its dead-man.
void MasterRack::takeInUse(MasterDevice& device)
{
    m_use->requireRelease();
    m_keyboard.requireRelease();
    device.requireRelease();
    m_use = &device;
    Q_EMIT inUseChanged();
    Q_EMIT lifeChanged();
}

void MasterRack::setListening(bool listening)
{
    for (const auto& place : m_places)
        place.device->setListening(listening);
}

void MasterRack::poll(Instant now)
{
    for (const auto& place : m_places)
        place.device->poll(now);
}

MasterReading MasterRack::read(Instant now)
{
    auto reading = m_use->read(now);
    const auto keys = m_keyboard.read(now);
    if (m_use->borrowsDeadMan()) {
        if (!reading.deadMan)
            reading.motion = {};
        reading.alive = reading.alive && keys.alive;
        reading.deadMan = keys.deadMan;
    }
    reading.clutch = reading.clutch || keys.clutch;
    return reading;
}

void MasterRack::rezero(Instant now)
{
    m_keyboard.rezero(now);
    if (m_use != &m_keyboard)
        m_use->rezero(now);
}

void MasterRack::feel(const RobotForce& force, Instant now)
{
    for (const auto& place : m_places)
        place.device->feel(place.device == m_use ? force : RobotForce{}, now);
}

std::vector<MasterStatus> MasterRack::statuses(Instant now)
{
    std::vector<MasterStatus> result;
    for (auto& place : m_places) {
        const auto life = lifeOf(*place.device, now);
        if (!place.since || life != place.life)
            place.since = now;
        place.life = life;
        const bool used = place.device == m_use;
        const QString note = place.device->note(); // else nobody would hear why it is not there
        if (life != MasterLife::Gone || used || !note.isEmpty())
            result.push_back({place.device->kind(), place.device->name(), life, *place.since, used, note});
    }
    std::stable_partition(result.begin(), result.end(), [](const MasterStatus& status) { return status.inUse; });
    return result;
}

} // namespace console
