// The surgeon's hand, whatever it holds: motion, dead-man, clutch, and whether it is alive.
#pragma once

#include "model/hand_state.hpp"
#include "model/instant.hpp"

#include <QObject>
#include <QString>

namespace console {

/// What a master says at one moment; unscaled.
struct MasterReading {
    bool alive = false; ///< it can be relied on to say when the hand lets go
    bool deadMan = false;
    bool clutch = false;
    HandMotion motion;
};

/// GUI thread only. Edges come as signals, at once; motion is read on the control loop's own clock.
class MasterDevice : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;

    virtual QString name() const = 0;
    virtual MasterReading read(Instant now) = 0;

    /// The hand is where it is: motion counts from here on. Called on each engage.
    virtual void rezero(Instant now) = 0;

Q_SIGNALS:
    void deadManChanged(bool pressed);
    void armHeldChanged(bool held);
    void scaleStepRequested(int steps); ///< positive: larger
};

} // namespace console
