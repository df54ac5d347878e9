// What the robot reports, laid out; the painting is the parts' own.
#include "widgets/robot_panel.hpp"

#include "widgets/axis_panel.hpp"
#include "widgets/figures.hpp"
#include "widgets/force_gauge.hpp"
#include "widgets/labels.hpp"
#include "widgets/stale_mark.hpp"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include <algorithm>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

RobotPanel::RobotPanel(const ConsoleModels& models, QWidget* parent)
    : QFrame(parent),
      m_models(models),
      m_instrument(models.instrument),
      m_state(plainLabel({}, TextRole::Strong, this)),
      m_tip(new FigureLabel(this)),
      m_drives(new FigureLabel(this)),
      m_arm(new FigureLabel(this)),
      m_guidewire(new AxisPanel(tr("Guidewire"), icons::Icon::Guidewire, this)),
      m_catheter(new AxisPanel(tr("Catheter"), icons::Icon::Catheter, this)),
      m_force(new ForceGauge(this))
{
    setAccessibleName(tr("Robot"));
    m_state->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    theme::setTextRole(m_tip, TextRole::Caption);
    theme::setTextRole(m_drives, TextRole::Caption);
    theme::setTextRole(m_arm, TextRole::Caption);
    m_tip->reserve(tr("Tracker ±0.0\u00A0mm \u00B7 stale 00.0\u00A0s"));
    m_tip->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(14, 6, 14, 6);
    row->setSpacing(18);
    auto* left = new QVBoxLayout;
    left->setSpacing(4);
    auto* head = new QHBoxLayout;
    head->addWidget(headingLabel(tr("Robot"), this));
    head->addSpacing(8);
    head->addWidget(m_state, 1);
    head->addWidget(m_tip);
    left->addLayout(head);
    left->addWidget(m_guidewire, 1);
    left->addWidget(m_catheter, 1);
    left->addWidget(m_drives);
    left->addWidget(m_arm);
    row->addLayout(left, 1);
    row->addWidget(m_force);
}

void RobotPanel::refreshHeading(Instant now)
{
    const Aged<RobotStatus>& robot = m_instrument.robot();
    const Freshness freshness = robot.freshness(now, InstrumentState::statusLimit);
    setInk(m_state, freshness == Freshness::Fresh ? colour::bright : colour::text);
    QString text = freshness == Freshness::Unknown ? tr("no report received") : word(robot.value.state);
    if (freshness == Freshness::Stale)
        text = tr("last known: %1").arg(text);
    if (freshness == Freshness::Fresh && robot.value.holdConfirmed)
        text += tr(", stands still");
    if (freshness != Freshness::Unknown && robot.value.faultCode != 0)
        text += QStringLiteral(" \u2014 ") + faultText(robot.value.faultCode);
    m_state->setText(text);
}

void RobotPanel::refreshArm(Instant now)
{
    m_arm->setVisible(m_models.sessions.firstPeer(DeviceKind::Arm).has_value());
    const auto& arm = m_models.arm.status();
    const auto state = !arm.known()               ? QStringLiteral("\u2014")
                       : !m_models.arm.fresh(now) ? tr("last known: %1").arg(word(arm.value.phase))
                                                  : word(arm.value.phase);
    m_arm->setText(tr("Robotic arm: %1").arg(state));
    setInk(m_arm, m_models.arm.fresh(now) ? colour::text : colour::secondary);
}

void RobotPanel::refreshDrives(Instant now)
{
    const Aged<DriveStatus>& drives = m_instrument.drives();
    const Freshness freshness = drives.freshness(now, InstrumentState::driveLimit);
    QString text = tr("Drives \u2014");
    if (freshness != Freshness::Unknown) {
        const auto& v = drives.value;
        const double warmest = *std::max_element(v.temperature.begin(), v.temperature.end());
        const double current = *std::max_element(v.current.begin(), v.current.end());
        text = tr("Drives %1 \u00B7 warmest %2 \u00B7 most current %3")
                   .arg(v.allEnabled() ? tr("enabled") : tr("off"), figure(warmest, 0, tr("°C")), figure(current, 1, tr("A")));
    }
    m_drives->setText(text + QStringLiteral(" \u00B7 ") + ageText(freshness, drives.age(now)));
    setInk(m_drives, freshness == Freshness::Fresh ? colour::text : colour::secondary);

    const Aged<TipPose>& tip = m_instrument.tip();
    const Freshness seen = tip.freshness(now, InstrumentState::tipLimit);
    QString place = tr("Tracker \u2014");
    if (seen != Freshness::Unknown)
        place = tip.value.valid ? tr("Tracker \u00B1%1").arg(figure(tip.value.error, 1, tr("mm"))) : tr("Tracker does not see the tip");
    m_tip->setText(place + QStringLiteral(" \u00B7 ") + ageText(seen, tip.age(now)));
    setInk(m_tip, seen == Freshness::Fresh ? colour::text : colour::secondary);
}

void RobotPanel::refresh(Instant now)
{
    const Aged<RobotStatus>& robot = m_instrument.robot();
    const RobotStatus& v = robot.value;
    const bool moving = m_models.permit.state().stream() == MotionStream::Motion;
    const auto has = [&v](LimitSwitch bit) { return (v.limitSwitches & bit) != 0; };
    AxisReading wire;
    wire.freshness = robot.freshness(now, InstrumentState::statusLimit);
    wire.age = robot.age(now);
    AxisReading tube = wire;
    wire.position = v.guidewirePosition;
    wire.velocity = v.guidewireVelocity;
    wire.angle = v.guidewireAngle;
    wire.rotation = v.guidewireRotation;
    wire.gripperClosed = v.guidewireGripperClosed;
    wire.softLow = has(GuidewireSoftLow);
    wire.softHigh = has(GuidewireSoftHigh);
    wire.hardLow = has(GuidewireHardLow);
    wire.hardHigh = has(GuidewireHardHigh);
    tube.position = v.catheterPosition;
    tube.velocity = v.catheterVelocity;
    tube.angle = v.catheterAngle;
    tube.rotation = v.catheterRotation;
    tube.gripperClosed = v.catheterGripperClosed;
    tube.softLow = has(CatheterSoftLow);
    tube.softHigh = has(CatheterSoftHigh);
    tube.hardLow = has(CatheterHardLow);
    tube.hardHigh = has(CatheterHardHigh);
    if (moving) {
        const HandMotion& asked = m_models.hand.reading().motion;
        wire.askedVelocity = asked.guidewireVelocity;
        wire.askedRotation = asked.guidewireRotation;
        tube.askedVelocity = asked.catheterVelocity;
        tube.askedRotation = asked.catheterRotation;
    }
    if (const auto& travel = m_instrument.travel()) {
        wire.travel = travel->guidewire;
        tube.travel = travel->catheter;
    }
    m_guidewire->setReading(wire);
    m_catheter->setReading(tube);
    m_force->setState(m_instrument, now);
    refreshHeading(now);
    refreshDrives(now);
    refreshArm(now);
}

} // namespace console
