// The bar's parts from left to right; what they show comes from the permit, the hand and the robot.
#include "widgets/motion_bar.hpp"

#include "widgets/figures.hpp"
#include "widgets/guard_list.hpp"
#include "widgets/hand_block.hpp"
#include "widgets/hold_button.hpp"
#include "widgets/labels.hpp"
#include "widgets/master_row.hpp"
#include "widgets/permit_block.hpp"
#include "widgets/small_button.hpp"
#include "widgets/stop_button.hpp"

#include <QHBoxLayout>
#include <QStackedLayout>
#include <QVBoxLayout>

#include <cmath>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

MotionBar::MotionBar(const ConsoleModels& models, QWidget* parent)
    : QFrame(parent),
      m_models(models),
      m_permit(new PermitBlock(this)),
      m_guards(new GuardList(this)),
      m_hand(new HandBlock(this)),
      m_arm(new HoldButton(this)),
      m_reset(new HoldButton(this)),
      m_inject(new HoldButton(this)),
      m_pedal(new HoldButton(this)),
      m_stop(new StopButton(this)),
      m_masters(new MasterRow(this)),
      m_acceptForce(new SmallButton({}, tr("Accept this force"),
                                    tr("You have looked at it: the next arming within 30 s is not refused for it"), this)),
      m_legend(plainLabel({}, TextRole::Caption, this))
{
    setAccessibleName(tr("Motion"));
    m_arm->setAccessibleName(tr("Arm: hold for one and a half seconds"));
    m_reset->setAccessibleName(tr("Reset the emergency stop: hold for one and a half seconds"));
    m_reset->setTexts(tr("RESET STOP"), tr("hold 1.5 s"));
    m_reset->setAccent(colour::text);
    m_inject->setAccessibleName(tr("Inject contrast: hold for one second while armed"));
    m_inject->setAccent(colour::text);
    m_pedal->setAccessibleName(tr("X-ray pedal: fluoroscopy while held"));
    m_pedal->setAccent(colour::xray);
    m_acceptForce->setTight(true);
    setInk(m_legend, colour::secondary);
    m_legend->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(8, 4, 8, 3);
    column->setSpacing(2);
    auto* row = new QHBoxLayout;
    row->setSpacing(14);
    auto* swap = new QWidget(this);
    m_armOrReset = new QStackedLayout(swap);
    m_armOrReset->addWidget(m_arm);
    m_armOrReset->addWidget(m_reset);
    row->addWidget(m_permit, 5);
    row->addWidget(m_guards, 12);
    row->addWidget(m_hand);
    row->addWidget(swap, 3);
    for (QWidget* safety : std::initializer_list<QWidget*>{m_inject, m_pedal, m_stop}) {
        row->addSpacing(10); // with gloves a finger beside one must not meet the next
        row->addWidget(safety, 3);
    }
    for (QWidget* part : std::initializer_list<QWidget*>{m_permit, m_arm, m_reset, m_inject, m_pedal, m_stop})
        part->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Expanding);
    column->addLayout(row, 1);
    auto* below = new QHBoxLayout;
    below->setSpacing(14);
    below->addWidget(m_masters);
    below->addWidget(m_acceptForce);
    below->addWidget(m_legend, 1);
    column->addLayout(below);
    connectButtons();
}

void MotionBar::connectButtons()
{
    connect(m_arm, &HoldButton::holdChanged, this, &MotionBar::armHoldChanged);
    connect(m_inject, &HoldButton::holdChanged, this, &MotionBar::injectHoldChanged);
    connect(m_pedal, &HoldButton::holdChanged, this, &MotionBar::pedalChanged);
    connect(m_masters, &MasterRow::masterChosen, this, &MotionBar::masterChosen);
    connect(m_acceptForce, &QPushButton::clicked, this, [this] {
        if (m_forceRead)
            Q_EMIT forceAccepted(m_forceShown);
    });
    connect(m_stop, &QAbstractButton::pressed, this, [this] {
        Q_EMIT emergencyStopRequested(QString::fromLatin1(QT_TRANSLATE_NOOP("console::SystemLink", "Button on the console's screen")));
    });
    connect(m_reset, &HoldButton::holdChanged, this, [this](bool held) {
        m_resetAsked = false;
        m_resetSince.reset();
        if (held)
            m_resetSince = std::chrono::steady_clock::now();
    });
}

void MotionBar::setKeyLegend(const QString& legend)
{
    m_legend->setText(legend);
    m_legend->setToolTip(legend); // beside several masters there may be no room for all of it
}

void MotionBar::setPedalShown(bool held) { m_pedal->setProgress(held ? 1.0 : 0.0); }

void MotionBar::refreshArm(Instant now)
{
    const PermitState& state = m_models.permit.state();
    const bool armed = state.phase == PermitPhase::Armed || state.phase == PermitPhase::Engaged;
    m_arm->setProgress(armed ? 1.0 : state.armProgress(now));
    switch (state.phase) {
    case PermitPhase::Ready:
    case PermitPhase::Arming:
        m_arm->setTexts(tr("ARM"), state.awaitingRobot ? tr("asking the robot") : tr("hold 1.5 s"));
        break;
    case PermitPhase::Armed:
    case PermitPhase::Engaged:
        m_arm->setTexts(tr("ARMED"), tr("F12 holds"));
        break;
    default:
        m_arm->setTexts(tr("ARM"), tr("not ready"));
    }
    m_arm->setEnabled(state.phase == PermitPhase::Ready || state.phase == PermitPhase::Arming);
}

void MotionBar::refreshReset(Instant now)
{
    const bool stopped = m_models.instrument.robot().known() && m_models.instrument.robot().value.emergencyStopToken != 0;
    m_stop->setStopped(stopped);
    m_armOrReset->setCurrentWidget(stopped ? m_reset : m_arm);
    if (!m_resetSince)
        return;
    const double part = milliseconds(now - *m_resetSince) / double(resetHold.count());
    m_reset->setProgress(part);
    if (part >= 1.0 && !m_resetAsked) {
        m_resetAsked = true;
        Q_EMIT emergencyStopResetRequested();
    }
}

/// What stands in the way, what is under way, or what became of the last one.
QString MotionBar::injectText(Instant now) const
{
    const auto& injections = m_models.instrument.injections();
    if (m_models.injection.unanswered(now))
        return tr("no answer");
    switch (m_models.injection.bar()) {
    case InjectionBar::Running:
        return tr("running");
    case InjectionBar::NotEnough:
        return tr("too little left");
    case InjectionBar::RobotUnheard:
        return tr("robot unheard");
    case InjectionBar::NotArmed:
    case InjectionBar::None:
        break;
    }
    const bool failed = !injections.empty() && (injections.back().progress == InjectionProgress::Refused ||
                                                injections.back().progress == InjectionProgress::Stopped);
    if (failed)
        return word(injections.back().progress);
    return m_models.injection.bar() == InjectionBar::None ? tr("%1 mL, hold 1 s").arg(plannedInjection, 0, 'f', 0) : tr("not armed");
}

void MotionBar::refreshInject(Instant now)
{
    m_inject->setTexts(tr("INJECT"), injectText(now));
    m_inject->setProgress(m_models.instrument.injecting() ? 1.0 : m_models.injection.progress(now));
    m_inject->setEnabled(m_models.injection.bar() == InjectionBar::None || m_inject->isHeld());
}

void MotionBar::refreshForce(Instant now)
{
    const InstrumentState& instrument = m_models.instrument;
    const auto phase = m_models.permit.phase();
    const bool armed = phase == PermitPhase::Armed || phase == PermitPhase::Engaged;
    const bool stands = m_forceSince && (m_acceptForce->isDown() || now - *m_forceSince < forceStands);
    const bool warns = std::abs(instrument.robot().value.guidewireForce) >= instrument.limits().forceWarn;
    if (armed || warns || instrument.forceAccepted(now) || !instrument.robotFresh(now)) {
        m_forceSince.reset();
    } else if (!stands && instrument.mayAcceptForce(now)) {
        m_forceSince = now;
        m_forceShown = instrument.robot().value.guidewireForce;
        m_acceptForce->setText(tr("Accept %1").arg(figure(m_forceShown, 2, tr("N"))));
    } else if (!stands) {
        m_forceSince.reset();
    }
    if (!m_acceptForce->isDown())
        m_forceRead = m_forceSince && now - *m_forceSince >= forceIsRead;
    m_acceptForce->setVisible(m_forceSince.has_value());
}

void MotionBar::refresh(Instant now)
{
    m_permit->setPermit(m_models.permit, now);
    m_guards->setChecklist(m_models.permit.checklist(), m_models.permit.state());
    m_hand->setState(m_models.hand, m_models.instrument, now);
    m_masters->setMasters(m_models.hand.masters(), masterMayChange(m_models.permit.phase()), now);
    const bool beam = m_models.xray.fresh(now) && m_models.xray.beamOn();
    const bool operates = m_models.role == OperatorRole::Operator;
    m_pedal->setEnabled(operates);
    m_reset->setEnabled(operates);
    m_pedal->setTexts(tr("X-RAY"), !operates                   ? tr("observer")
                                   : beam                      ? tr("beam is on")
                                   : m_models.xray.pedalDown() ? tr("beam not seen")
                                                               : tr("hold to image"));
    setPedalShown(m_models.xray.pedalDown());
    refreshArm(now);
    refreshReset(now);
    refreshInject(now);
    refreshForce(now);
}

} // namespace console
