// Region G: the robot's instruments, its drives and the force, and the robotic arm, as they last reported themselves.
#pragma once

#include "model/console_models.hpp"

#include <QFrame>

class QLabel;

namespace console {

class AxisPanel;
class FigureLabel;
class ForceGauge;

class RobotPanel : public QFrame {
    Q_OBJECT
public:
    explicit RobotPanel(const ConsoleModels& models, QWidget* parent = nullptr);
    void refresh(Instant now);

private:
    void refreshHeading(Instant now);
    void refreshDrives(Instant now);

    void refreshArm(Instant now);

    const ConsoleModels& m_models;
    const InstrumentState& m_instrument;
    QLabel* m_state;
    FigureLabel* m_tip;
    FigureLabel* m_drives;
    FigureLabel* m_arm;
    AxisPanel* m_guidewire;
    AxisPanel* m_catheter;
    ForceGauge* m_force;
};

} // namespace console
