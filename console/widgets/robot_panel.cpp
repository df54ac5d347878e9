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

namespace {

DriveReading driveReading(const DriveStatus& drives, Drive which)
{
    return {drives.current.at(std::size_t(which)), drives.temperature.at(std::size_t(which))};
}

AxisReading guidewireReading(AxisReading reading, const RobotStatus& robot, const DriveStatus& drives)
{
    const auto has = [&robot](LimitSwitch bit) { return (robot.limitSwitches & bit) != 0; };
    reading.position = robot.guidewirePosition;
    reading.velocity = robot.guidewireVelocity;
    reading.angle = robot.guidewireAngle;
    reading.rotation = robot.guidewireRotation;
    reading.gripperClosed = robot.guidewireGripperClosed;
    reading.softLow = has(GuidewireSoftLow);
    reading.softHigh = has(GuidewireSoftHigh);
    reading.hardLow = has(GuidewireHardLow);
    reading.hardHigh = has(GuidewireHardHigh);
    reading.advance = driveReading(drives, Drive::GuidewireAdvance);
    reading.turn = driveReading(drives, Drive::GuidewireTurn);
    return reading;
}

AxisReading catheterReading(AxisReading reading, const RobotStatus& robot, const DriveStatus& drives)
{
    const auto has = [&robot](LimitSwitch bit) { return (robot.limitSwitches & bit) != 0; };
    reading.position = robot.catheterPosition;
    reading.velocity = robot.catheterVelocity;
    reading.angle = robot.catheterAngle;
    reading.rotation = robot.catheterRotation;
    reading.gripperClosed = robot.catheterGripperClosed;
    reading.softLow = has(CatheterSoftLow);
    reading.softHigh = has(CatheterSoftHigh);
    reading.hardLow = has(CatheterHardLow);
    reading.hardHigh = has(CatheterHardHigh);
    reading.advance = driveReading(drives, Drive::CatheterAdvance);
    reading.turn = driveReading(drives, Drive::CatheterTurn);
    return reading;
}

} // namespace

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
    m_tip->reserve(tr("Tracker ±0.0\u00A0mm \u00B7 stale 000\u00A0ms"));
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
    auto* between = new QFrame(this);
    between->setFrameStyle(int(QFrame::VLine) | int(QFrame::Plain));
    setInk(between, colour::line);
    row->addWidget(between);
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
    const Aged<ArmStatus>& arm = m_models.arm.status();
    const Freshness freshness = arm.freshness(now, ArmState::statusLimit);
    QString state = freshness == Freshness::Unknown ? QStringLiteral("\u2014") : word(arm.value.phase);
    if (freshness == Freshness::Stale)
        state = tr("last known: %1").arg(state);
    m_arm->setText(tr("Robotic arm: %1").arg(state) + QStringLiteral(" \u00B7 ") + ageText(freshness, arm.age(now)));
    setInk(m_arm, freshness == Freshness::Fresh ? colour::text : colour::secondary);
}

void RobotPanel::refreshDrives(Instant now)
{
    const Aged<DriveStatus>& drives = m_instrument.drives();
    const Freshness freshness = drives.freshness(now, InstrumentState::driveLimit);
    QString text = tr("Drives \u2014");
    if (freshness != Freshness::Unknown) {
        const auto on = std::count(drives.value.enabled.begin(), drives.value.enabled.end(), true);
        text = on == 0                     ? tr("Drives off")
               : drives.value.allEnabled() ? tr("Drives enabled")
                                           : tr("%1 of %2 drives enabled").arg(on).arg(driveCount);
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
    const Aged<DriveStatus>& drives = m_instrument.drives();
    AxisReading both;
    both.freshness = m_instrument.robot().freshness(now, InstrumentState::statusLimit);
    both.age = m_instrument.robot().age(now);
    both.drives = drives.freshness(now, InstrumentState::driveLimit);
    AxisReading wire = guidewireReading(both, m_instrument.robot().value, drives.value);
    AxisReading tube = catheterReading(both, m_instrument.robot().value, drives.value);
    if (m_models.permit.state().stream() == MotionStream::Motion) {
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
