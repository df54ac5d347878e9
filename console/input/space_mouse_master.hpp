// A 3-D mouse as a master.
#pragma once

#include "input/connected_master.hpp"
#include "input/hand_mapping.hpp"
#include "input/spnav_line.hpp"

#include <optional>

namespace console {

/// First (left) button held is the dead-man: the cap has none of its own, and a hand that rests on it moves it. Second button held is the
/// clutch. The cap pushed away advances the guidewire, pulled retracts it, twisted turns it; lifted or pressed down, the catheter advances
/// or retracts, tilted sideways it turns. Only the instrument that is moved more moves: nobody pushes a cap without tilting it.
class SpaceMouseMaster : public ConnectedMaster {
    Q_OBJECT
public:
    explicit SpaceMouseMaster(QObject* parent = nullptr);

    /// A deflection counts that long, unless it is told again: a hand is never so still that a mouse falls silent under it.
    static constexpr std::chrono::milliseconds deflectionLasts{250};

    /// In the daemon's units, at its sensitivity of 1; the cap's stop is near 350.
    static constexpr AxisShape cap{350, 0.12};

    MasterKind kind() const override { return MasterKind::SpaceMouse; }
    QString name() const override { return word(kind()); }
    QString legend() const override;
    QString note() const override { return m_line.trouble(); }

protected:
    void take(Instant now) override;

private:
    void forget();
    void follow();

    SpnavLine m_line;
    HandSpeeds m_speeds;
    PuckDeflection m_deflection{};
    std::optional<Instant> m_told;
    bool m_expired = false; ///< moves nothing, and is no rest
    bool m_deadMan = false;
    bool m_clutch = false;
};

} // namespace console
