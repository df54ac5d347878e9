// The bar's parts from left to right; what they show comes from the permit, the hand and the robot.
#include "widgets/motion_bar.hpp"

#include "model/present_readings.hpp"
#include "widgets/figures.hpp"
#include "widgets/focus_return.hpp"
#include "widgets/further_fingers.hpp"
#include "widgets/guard_list.hpp"
#include "widgets/hand_block.hpp"
#include "widgets/hold_button.hpp"
#include "widgets/labels.hpp"
#include "widgets/master_row.hpp"
#include "widgets/permit_block.hpp"
#include "widgets/small_button.hpp"
#include "widgets/stop_button.hpp"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QStackedLayout>
#include <QVBoxLayout>

#include <cmath>

namespace console {

using theme::TextRole;
namespace colour = theme::colour;

namespace {

/// Five millimetres, whatever the scale.
class SafetyGap : public QWidget {
public:
    explicit SafetyGap(QWidget* parent) : QWidget(parent) { setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed); }

    QSize sizeHint() const override { return {theme::safetyGap(this), 0}; }
};

/// As wide for every force: what stands beside it stays where it is.
class AcceptButton : public SmallButton {
public:
    using SmallButton::SmallButton;

    QSize sizeHint() const override { return SmallButton::sizeHint().expandedTo({theme::px(this, 150), 0}); }
    QSize minimumSizeHint() const override { return sizeHint(); }
};

QString acceptText(double newtons) { return MotionBar::tr("Accept %1").arg(figure(newtons, 2, MotionBar::tr("N"))); }

} // namespace

// What shows is on the left, what acts on the right, each as tall as the bar.
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
      m_acceptForce(new AcceptButton(acceptText(0), tr("Accept this force"),
                                     tr("You have looked at it: the next arming within 30 s is not refused for it"), this)),
      m_stopKeys(plainLabel({}, TextRole::Body, this)),
      m_handKeys(new ElidedLabel(TextRole::Body, this)),
      m_viewKeys(new ElidedLabel(TextRole::Body, this))
{
    setAccessibleName(tr("Motion"));
    nameButtons();
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(8, 3, 8, 2);
    row->setSpacing(0);
    auto* left = new QVBoxLayout;
    left->setSpacing(1);
    left->addLayout(makeState(), 1);
    left->addLayout(makeFoot());
    row->addLayout(left, 1);
    auto* swap = new QWidget(this);
    m_armOrReset = new QStackedLayout(swap);
    m_armOrReset->addWidget(m_arm);
    m_armOrReset->addWidget(m_reset);
    for (QWidget* safety : std::initializer_list<QWidget*>{swap, m_inject, m_pedal, m_stop}) {
        row->addWidget(new SafetyGap(this));
        row->addWidget(safety);
    }
    for (QWidget* part : std::initializer_list<QWidget*>{m_permit, m_arm, m_reset, m_inject, m_pedal, m_stop})
        part->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Expanding);
    connectButtons();
    new FurtherFingers(this);
}

void MotionBar::nameButtons()
{
    m_arm->setAccessibleName(tr("Arm: hold for one and a half seconds"));
    m_reset->setAccessibleName(tr("Reset the emergency stop: hold for one and a half seconds"));
    m_reset->setTexts(tr("RESET STOP"), tr("hold or U, 1.5 s"));
    m_reset->setAccent(colour::text);
    m_inject->setAccessibleName(tr("Inject contrast: hold for one second while armed"));
    m_inject->setAccent(colour::text);
    m_pedal->setAccessibleName(tr("X-ray pedal: fluoroscopy while held"));
    m_pedal->setAccent(colour::xray);
}

QLayout* MotionBar::makeState()
{
    auto* row = new QHBoxLayout;
    row->setSpacing(14);
    row->addWidget(m_permit);
    row->addWidget(m_guards, 1);
    row->addWidget(m_hand);
    return row;
}

/// Its first place is the accepted force's, also while there is none: nothing moves when it comes, least of all under a finger.
QLayout* MotionBar::makeFoot()
{
    theme::setTextRole(m_acceptForce, TextRole::Strong);
    m_acceptForce->setProperty("emphasis", true);
    QSizePolicy kept = m_acceptForce->sizePolicy();
    kept.setRetainSizeWhenHidden(true);
    m_acceptForce->setSizePolicy(kept);
    m_acceptForce->hide();
    setInk(m_handKeys, colour::secondary);
    setInk(m_viewKeys, colour::secondary);
    m_handKeys->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred); // beside several masters there may be no room for all of it
    m_viewKeys->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    auto* keys = new QGridLayout;
    keys->setHorizontalSpacing(22);
    keys->setVerticalSpacing(0);
    keys->setColumnStretch(1, 1);
    keys->addWidget(m_stopKeys, 0, 0);
    keys->addWidget(m_handKeys, 0, 1);
    keys->addWidget(m_viewKeys, 1, 0, 1, 2);
    auto* row = new QHBoxLayout;
    row->setSpacing(14);
    row->addWidget(m_acceptForce);
    row->addWidget(m_masters);
    row->addLayout(keys, 1);
    return row;
}

void MotionBar::connectButtons()
{
    connect(m_arm, &HoldButton::holdChanged, this, &MotionBar::armHoldChanged);
    connect(m_inject, &HoldButton::holdChanged, this, &MotionBar::injectHoldChanged);
    connect(m_pedal, &HoldButton::holdChanged, this, &MotionBar::pedalChanged);
    connect(m_masters, &MasterRow::masterChosen, this, &MotionBar::masterChosen);
    connect(m_guards, &GuardList::clicked, this, [this] {
        const auto phase = m_models.permit.phase(); // a view takes the keys from the hand, and so would end these
        if (phase != PermitPhase::Arming && phase != PermitPhase::Armed && phase != PermitPhase::Engaged)
            Q_EMIT checklistRequested();
    });
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
        if (!held)
            return;
        m_resetSince = std::chrono::steady_clock::now();
        m_resetToken = stopInForce();
    });
}

void MotionBar::setKeyLegend(const KeyLegend& legend)
{
    m_stopKeys->setText(legend.stop);
    m_handKeys->setText(legend.hand);
    m_handKeys->setToolTip(legend.hand);
    m_viewKeys->setText(legend.views);
    m_viewKeys->setToolTip(legend.views);
}

void MotionBar::setPedalShown(bool held) { m_pedal->setProgress(held ? 1.0 : 0.0); }

void MotionBar::setResetHeld(bool held) { m_reset->setKeyHeld(held); }

void MotionBar::setUnseen(bool unseen)
{
    for (auto* button : {m_arm, m_reset, m_inject, m_pedal})
        button->setUnseen(unseen);
}

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

quint64 MotionBar::stopInForce() const
{
    const auto& robot = m_models.instrument.robot();
    return robot.known() ? robot.value.emergencyStopToken : 0;
}

void MotionBar::refreshReset(Instant now)
{
    const quint64 stop = stopInForce();
    if (stop == 0)
        m_resetToken = 0;
    const bool another = m_resetToken != 0 && stop != m_resetToken;
    m_stop->setStopped(stop != 0);
    m_armOrReset->setCurrentWidget(stop != 0 ? m_reset : m_arm);
    m_reset->setTexts(tr("RESET STOP"), another ? tr("another: hold again") : tr("hold or U, 1.5 s"));
    if (stop != m_resetToken && m_resetSince) { // it was begun for a stop that somebody had looked at
        m_resetSince.reset();
        m_reset->setProgress(0);
    }
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
        m_acceptForce->setText(acceptText(m_forceShown));
    } else if (!stands) {
        m_forceSince.reset();
    }
    if (!m_acceptForce->isDown())
        m_forceRead = m_forceSince && now - *m_forceSince >= forceIsRead;
    if (!m_forceSince)
        returnFocus(m_acceptForce);
    m_acceptForce->setVisible(m_forceSince.has_value());
}

void MotionBar::refresh(Instant now)
{
    m_permit->setPermit(m_models.permit, now);
    m_guards->setChecklist(m_models.permit.checklist(), m_models.permit.state());
    const auto owner = anotherOwner(m_models);
    m_hand->setState(m_models.hand, m_models.instrument, owner ? m_models.sessions.titleOf(*owner) : QString(), now);
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
