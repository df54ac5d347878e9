// The surgeon's hand as the console takes it: dead-man, clutch, scale, and the motion asked for.
#pragma once

#include "model/master_status.hpp"

#include <QObject>

#include <optional>
#include <vector>

namespace console {

/// Velocities asked of the robot: advance positive, clockwise from behind positive.
struct HandMotion {
    double guidewireVelocity = 0; ///< mm/s
    double guidewireRotation = 0; ///< deg/s
    double catheterVelocity = 0;  ///< mm/s
    double catheterRotation = 0;  ///< deg/s

    bool isZero() const { return guidewireVelocity == 0 && guidewireRotation == 0 && catheterVelocity == 0 && catheterRotation == 0; }
    bool operator==(const HandMotion&) const = default;
};

struct HandReading {
    bool alive = false;
    bool deadMan = false;
    bool clutch = false; ///< the hand moves, the robot does not
    double scale = 1.0;  ///< hand to robot; cannot be raised while engaged
    HandMotion motion;   ///< scaled, before the soft start

    /// N along the guidewire, against advance positive; nothing: the master in use gives none.
    std::optional<double> forceToHand = {};

    /// For a moment after the scale was changed: what it was before. So nobody finds another one unawares.
    std::optional<double> scaleBefore = {};

    bool operator==(const HandReading&) const = default;
};

/// GUI thread only.
class HandState : public QObject {
    Q_OBJECT
public:
    explicit HandState(QObject* parent = nullptr);

    const HandReading& reading() const { return m_reading; }
    const std::vector<MasterStatus>& masters() const { return m_masters; } ///< the one in use, and all that are there or say why not
    const MasterStatus* masterInUse() const;
    quint64 commandsSent() const { return m_commandsSent; } ///< motion commands accepted for sending

    void set(const HandReading& reading);
    void setMasters(std::vector<MasterStatus> masters);
    void setCommandsSent(quint64 count);

Q_SIGNALS:
    void changed();

private:
    HandReading m_reading;
    std::vector<MasterStatus> m_masters;
    quint64 m_commandsSent = 0;
};

} // namespace console
