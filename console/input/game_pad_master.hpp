// A game pad as a master.
#pragma once

#include "input/connected_master.hpp"
#include "input/hand_mapping.hpp"
#include "input/pad_source.hpp"

#include <memory>

namespace console {

/// Left trigger held is the dead-man. Left stick: push advances the guidewire, pull retracts it, right and left turn it; right stick: the
/// same for the catheter. Right shoulder button held is the clutch, Start held 1.5 s arms, cross up / down changes the scale, the right one
/// of the four buttons (B, circle) holds at once.
class GamePadMaster : public ConnectedMaster {
    Q_OBJECT
public:
    explicit GamePadMaster(std::unique_ptr<PadSource> pads, QObject* parent = nullptr);

    MasterKind kind() const override { return MasterKind::GamePad; }
    QString name() const override;
    QString legend() const override;
    QString note() const override;

    /// Sticks rest up to this part of their way: worn ones do not return to the middle.
    static constexpr AxisShape stick{1, 0.15};

protected:
    void take(Instant now) override;

private:
    void follow(const PadState& state);

    std::unique_ptr<PadSource> m_pads;
    TriggerButton m_trigger;
    PadState m_state;
    HandSpeeds m_speeds;
};

} // namespace console
