// Region G: the robot's instruments, its drives and the force, as the robot last reported them.
#pragma once

#include "model/hand_state.hpp"
#include "model/instrument_state.hpp"
#include "model/permit_model.hpp"

#include <QFrame>

class QLabel;

namespace console {

class AxisPanel;
class FigureLabel;
class ForceGauge;

class RobotPanel : public QFrame {
    Q_OBJECT
public:
    RobotPanel(const InstrumentState& instrument, const HandState& hand, const PermitModel& permit, QWidget* parent = nullptr);
    void refresh(Instant now);

private:
    void refreshHeading(Instant now);
    void refreshDrives(Instant now);

    const InstrumentState& m_instrument;
    const HandState& m_hand;
    const PermitModel& m_permit;
    QLabel* m_state;
    FigureLabel* m_tip;
    FigureLabel* m_drives;
    AxisPanel* m_guidewire;
    AxisPanel* m_catheter;
    ForceGauge* m_force;
};

} // namespace console
