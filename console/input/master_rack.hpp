// The masters of this console, of which one is in use.
#pragma once

#include "input/keyboard_master.hpp"
#include "input/master_device.hpp"

#include <QObject>

#include <optional>
#include <vector>

namespace console {

/// GUI thread only. The keyboard is always there: its X-ray pedal, ARM, reset, clutch and scale count beside any master, its dead-man
/// only for itself and for masters that have none of their own. A master that is lost stays in use, as lost: another one is a person's
/// choice, and never while armed.
class MasterRack : public QObject {
    Q_OBJECT
public:
    /// What is given here outlives the rack.
    explicit MasterRack(KeyboardMaster& keyboard, QObject* parent = nullptr);
    void add(MasterDevice& device);

    /// Before the loop runs: also a master that is not there yet.
    void begin(MasterKind kind);

    /// A person's choice. False, and nothing changes, while a permit is asked for or given, and for a master that is not there. The new one
    /// counts when it was seen let go.
    bool choose(MasterKind kind, PermitPhase phase, Instant now);

    const MasterDevice& inUse() const { return *m_use; }

    void setListening(bool listening);
    bool listening() const { return m_keyboard.listening(); }

    void poll(Instant now);
    MasterReading read(Instant now);
    void rezero(Instant now);

    /// For the one in use; the others feel nothing.
    void feel(const RobotForce& force, Instant now);

    /// The one in use first, then those that are there or say why they are not.
    std::vector<MasterStatus> statuses(Instant now);

Q_SIGNALS:
    void lifeChanged(); ///< of the master in use
    void inUseChanged();
    void deadManChanged(bool pressed);
    void armHeldChanged(bool held);
    void pedalChanged(bool down);
    void injectHeldChanged(bool held);
    void resetHeldChanged(bool held);
    void scaleStepRequested(int steps);
    void holdRequested();

private:
    struct Place {
        MasterDevice* device;
        MasterLife life = MasterLife::Gone;
        std::optional<Instant> since;
    };

    MasterDevice* find(MasterKind kind) const;
    MasterLife lifeOf(const MasterDevice& device, Instant now) const;
    const MasterDevice* deadManOf() const;
    void takeInUse(MasterDevice& device);

    KeyboardMaster& m_keyboard;
    MasterDevice* m_use;
    std::vector<Place> m_places;
};

} // namespace console
