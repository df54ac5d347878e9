// The surgeon's hand, whatever it holds: motion, dead-man, clutch, and whether it is alive.
#pragma once

#include "model/hand_state.hpp"
#include "model/instant.hpp"
#include "model/master_status.hpp"

#include <QObject>
#include <QString>

#include <optional>

namespace console {

/// What a master says at one moment; unscaled.
struct MasterReading {
    bool alive = false; ///< it can be relied on to say when the hand lets go
    bool deadMan = false;
    bool clutch = false;
    HandMotion motion;
};

/// What the robot feels at the guidewire, and whether a hand may feel it.
struct RobotForce {
    double force = 0;   ///< N, against advance positive
    bool given = false; ///< the report is recent, the session open, and both ends are engaged
};

/// GUI thread only. Edges come as signals, at once; motion is read on the control loop's own clock.
class MasterDevice : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;

    virtual MasterKind kind() const = 0;
    virtual QString name() const = 0;
    virtual QString legend() const = 0;         ///< keys or buttons in one short line, for the motion bar
    virtual QString note() const { return {}; } ///< what else a person should know
    virtual MasterLife life(Instant now) const = 0;

    /// It has no dead-man of a person: the keyboard's counts for it.
    virtual bool borrowsDeadMan() const { return false; }

    /// Takes what the device says. Once in each run of the control loop, also while another master is in use.
    virtual void poll(Instant) {}

    virtual MasterReading read(Instant now) = 0;

    /// The hand is where it is: motion counts from here on. Called on each engage.
    virtual void rezero(Instant now) = 0;

    /// Nothing counts until the hand was seen let go and at rest. Called when this master comes into use or goes out of it.
    virtual void requireRelease() = 0;

    virtual void feel(const RobotForce&, Instant) {}
    virtual std::optional<double> forceToHand() const { return std::nullopt; } ///< as HandReading says

    /// False while something else has the keyboard: a dialogue, a text field, the prompt, another window. No hand counts then.
    void setListening(bool listening);
    bool listening() const { return m_listening; }

Q_SIGNALS:
    /// Before the edges that follow from it: a dead-man that is gone is no dead-man that was let go.
    void lifeChanged();
    void deadManChanged(bool pressed);
    void armHeldChanged(bool held);
    void scaleStepRequested(int steps); ///< positive: larger
    void holdRequested();

protected:
    virtual void listeningChanged() = 0;

private:
    bool m_listening = false;
};

} // namespace console
