// The loop between hand, permit and link.
#include "app/cockpit_control.hpp"

#include "model/present_readings.hpp"

#include <QDateTime>

#include <algorithm>
#include <utility>

namespace console {

namespace {

constexpr std::chrono::milliseconds period{10};
constexpr std::chrono::milliseconds stallLimit{100};
constexpr int guardRuns = 5;  ///< 20 Hz
constexpr int alarmRuns = 10; ///< 10 Hz

Instant presentTime() { return std::chrono::steady_clock::now(); }

} // namespace

// A press, and an injection, has a number that this console did not use before it was started: a system that remembers those of before
// would refuse it, or take it for done.
CockpitControl::CockpitControl(ConsoleModels& models, SystemLink& link, HandDesk& hand, QObject* parent)
    : QObject(parent),
      m_models(models),
      m_link(link),
      m_hand(hand),
      m_alarms(models, link.robot()),
      m_interruptions(models, [&link] { return link.framesReceived(); }),
      m_press(static_cast<quint32>(QDateTime::currentSecsSinceEpoch())),
      m_injectionNumber(m_press)
{
    m_timer.setTimerType(Qt::PreciseTimer);
    m_timer.setInterval(period);
    connect(&m_timer, &QTimer::timeout, this, &CockpitControl::run);
    connect(&models.sessions, &SessionModel::linkStateChanged, this, [this](quint32 peer, LinkState from, LinkState to) {
        const bool closed = carriesMessages(from) && (to == LinkState::Closing || to == LinkState::Closed);
        if (m_link.robot() == peer)
            tellSession();
        else if (to == LinkState::Reconnecting || closed)
            interrupt(peer); // whichever device it is: nobody sees what it does meanwhile
        if (to == LinkState::Reconnecting || to == LinkState::StandBy || closed)
            m_alarms.update(presentTime(), m_link.framesReceived()); // not kept for the next turn
    });
    connect(&models.sessions, &SessionModel::standByChanged, this, &CockpitControl::tellSession);
    connect(&models.incidents, &IncidentModel::incidentRaised, this, &CockpitControl::tellSession);
    connect(&models.incidents, &IncidentModel::incidentEnded, this, &CockpitControl::tellSession);
    connect(&models.instrument, &InstrumentState::robotChanged, this, &CockpitControl::tellRobot);
    connect(&models.instrument, &InstrumentState::injectionChanged, this, &CockpitControl::hearInjection);
    connect(&models.permit, &PermitModel::phaseChanged, this, &CockpitControl::notePhase);
    connect(&link.sessionEvents(), &SessionIntake::stalled, this, [this] { apply(PermitEventKind::Stalled); });
    connect(&link.sessionEvents(), &SessionIntake::deadlineMissed, this,
            [this](quint32 peer, const QString& message) { m_alarms.noteDeadlineMissed(peer, message, presentTime()); });
    connect(&link.sessionEvents(), &SessionIntake::auditLost, this,
            [this](const QString& reason) { m_models.recorder.auditTrouble = tr("the audit file is not written: %1").arg(reason); });
    connect(&link.sessionEvents(), &SessionIntake::auditRestored, this, [this] { m_models.recorder.auditTrouble.clear(); });
    connectHand();
}

void CockpitControl::connectHand()
{
    const auto* hand = &m_hand;
    // All guards at once: a master that is back before the next full look would otherwise not even end an ARM that is being held.
    connect(hand, &HandDesk::lifeChanged, this, [this] { checkAllGuards(presentTime()); });
    connect(hand, &HandDesk::deadManChanged, this,
            [this](bool pressed) { apply(pressed ? PermitEventKind::DeadManPressed : PermitEventKind::DeadManReleased); });
    connect(hand, &HandDesk::armHeldChanged, this, &CockpitControl::setArmHeld);
    connect(hand, &HandDesk::pedalChanged, this, &CockpitControl::setPedal);
    connect(hand, &HandDesk::injectHeldChanged, this, &CockpitControl::setInjectHeld);
    connect(hand, &HandDesk::holdRequested, this, &CockpitControl::panicHold);
}

void CockpitControl::start()
{
    m_timer.start();
    run();
}

void CockpitControl::stop()
{
    m_timer.stop();
    setPedal(false);
    apply(PermitEventKind::PanicHold);
}

void CockpitControl::run()
{
    const auto now = presentTime();
    if (m_lastRun && now - *m_lastRun > stallLimit)
        apply(PermitEventKind::Stalled);
    m_lastRun = now;
    if (const auto blocked = m_link.blockedPermit()) {
        PermitEvent closed;
        closed.kind = PermitEventKind::GateClosed;
        closed.permit = blocked->permit;
        if (blocked->byPicture && m_models.permit.phase() == PermitPhase::Engaged && blocked->permit == m_models.permit.state().permit)
            m_alarms.notePictureTooOld(now);
        apply(closed, now); // else it would go on as engaged, and nothing would move
    }
    m_hand.poll(now);
    expectPictures(now);
    if (m_runs % guardRuns == 0)
        checkAllGuards(now);
    else
        checkGuards(now);
    apply(PermitEventKind::Tick);
    driveInjection(now);
    if (m_runs % guardRuns == 0)
        publishStatus(now);
    if (m_runs % alarmRuns == 0) {
        m_alarms.update(now, m_link.framesReceived());
        m_interruptions.update(now);
        m_models.trends.note(trendReading(m_models, m_link.robot(), now), now);
    }
    ++m_runs;
}

void CockpitControl::checkAllGuards(Instant now) { carryOut(m_models.permit.check(readGuards(now), now), now); }

/// Between two full checks only what ends motion is looked at.
void CockpitControl::checkGuards(Instant now) { carryOut(m_models.permit.keep(readGuards(now), now), now); }

void CockpitControl::apply(PermitEventKind kind)
{
    PermitEvent event;
    event.kind = kind;
    event.armable = m_models.permit.state().armable;
    event.kept = m_models.permit.state().kept;
    apply(event, presentTime());
}

void CockpitControl::apply(const PermitEvent& event, Instant now) { carryOut(m_models.permit.apply(event, now), now); }

void CockpitControl::interrupt(quint32 peer)
{
    const auto now = presentTime();
    carryOut(m_models.permit.interrupt(m_models.sessions.titleOf(peer), now), now);
}

/// Motion is published first: what is no longer permitted must not wait behind a request.
void CockpitControl::carryOut(const PermitActions& actions, Instant now)
{
    if (actions.rezero)
        m_hand.rezero(now);
    publishMotion(now);
    if (actions.release)
        m_link.releasePermit(actions.permit);
    if (actions.requestArm)
        m_link.requestArm(actions.permit);
    const bool holding = m_models.permit.phase() != PermitPhase::Engaged;
    if (m_confirmed != holding) {
        m_confirmed = holding;
        m_link.confirmHold(holding);
    }
}

void CockpitControl::tellSession()
{
    if (!m_link.robot() || !carriesMessages(m_models.sessions.state(*m_link.robot())))
        m_models.instrument.endWatch(presentTime()); // nobody sees what it does meanwhile
    if (m_models.sessions.inStandBy() || !m_models.incidents.empty())
        return apply(PermitEventKind::SystemStandsBy);
    const auto state = m_link.robot() ? m_models.sessions.state(*m_link.robot()) : LinkState::Closed;
    if (carriesMessages(state))
        apply(PermitEventKind::SessionOpen);
    else if (state == LinkState::Reconnecting)
        interrupt(*m_link.robot());
    else
        apply(PermitEventKind::SessionClosed);
}

void CockpitControl::tellRobot()
{
    const auto& status = m_models.instrument.robot().value;
    PermitEvent event;
    event.kind = PermitEventKind::RobotReported;
    event.robot = status.state;
    event.holdConfirmed = status.holdConfirmed;
    event.permit = status.permit;
    event.own = ownsRobot(m_models);
    const auto now = presentTime();
    if (m_models.permit.phase() == PermitPhase::Arming)
        checkAllGuards(now); // first, so that what ends the arming is known by its name
    apply(event, now);
}

void CockpitControl::expectPictures(Instant now)
{
    const auto& xray = m_models.xray;
    const auto state = m_link.xray() ? m_models.sessions.state(*m_link.xray()) : LinkState::Closed;
    m_models.picture.setLinkUp(carriesMessages(state));
    m_models.picture.expect(picturesDue(xray, state), now);
    m_link.setPedal({xray.pedalDown(), m_press, xray.requestedRate(), now});
}

GuardReadings CockpitControl::readGuards(Instant now) const
{
    auto readings = guardReadings(m_models, m_link.robot(), m_hand.listening(), now);
    readings.handMissing = m_hand.missing();
    return readings;
}

void CockpitControl::publishMotion(Instant now)
{
    const auto& permit = m_models.permit.state();
    MotionSnapshot snapshot;
    snapshot.stream = permit.stream();
    snapshot.permit = permit.permit;
    snapshot.engagement = permit.engagement;
    snapshot.engagedSince = permit.since;
    snapshot.motion = m_models.hand.reading().motion;
    snapshot.guiTick = now;
    snapshot.pictureLimit = m_models.picture.limit();
    const auto& shown = m_models.picture.newest();
    if (shown && m_models.picture.mayGuide(shown->source))
        snapshot.shownCapture = m_models.picture.shownAtEarliest();
    m_link.setMotion(snapshot);
}

void CockpitControl::publishStatus(Instant now)
{
    const auto& hand = m_models.hand.reading();
    CockpitReport report;
    report.phase = m_models.permit.phase();
    report.deadMan = hand.deadMan;
    report.clutch = hand.clutch;
    report.scale = hand.scale;
    constexpr double longest = 3'600'000; // the message's bound; also what "no picture" and "age unknown" are told as
    const auto age = m_models.picture.reading(now).age;
    report.pictureAgeMs = age ? std::clamp(milliseconds(*age), 0.0, longest) : longest;
    report.alarmsHigh = m_models.alarms.count(AlarmPriority::High);
    report.alarmsMedium = m_models.alarms.count(AlarmPriority::Medium);
    report.alarmsLow = m_models.alarms.count(AlarmPriority::Low);
    m_link.publish(report);
}

void CockpitControl::setArmHeld(bool held) { apply(held ? PermitEventKind::ArmPressed : PermitEventKind::ArmReleased); }

void CockpitControl::setPedal(bool wanted)
{
    // A pedal whose release may get lost on a network would leave the beam on.
    const bool remote = wanted && !m_models.remoteInput.isEmpty();
    if (remote)
        m_models.log.append(
            LogKind::Trouble,
            tr("the X-ray pedal counts at the console itself only, and this is remote input (%1)").arg(m_models.remoteInput),
            QDateTime::currentMSecsSinceEpoch());
    const bool down = wanted && !remote && m_models.role == OperatorRole::Operator;
    if (down && !pedalDown())
        ++m_press;
    m_models.xray.setPedal(down);
    expectPictures(presentTime());
}

void CockpitControl::setInjectHeld(bool held)
{
    m_injectHeld = held;
    driveInjection(presentTime());
}

void CockpitControl::driveInjection(Instant now)
{
    const auto phase = m_models.permit.phase();
    const auto& instrument = m_models.instrument;
    InjectionReadings readings;
    readings.held = m_injectHeld;
    readings.armed = phase == PermitPhase::Armed || phase == PermitPhase::Engaged;
    readings.robotFresh = instrument.robotFresh(now);
    readings.running = instrument.injecting();
    readings.contrastLeft = instrument.robot().value.contrastRemaining;
    auto& order = m_models.injection;
    if (order.advance(readings, now)) {
        ++m_injectionNumber;
        m_unansweredTold = false;
        order.note(m_injectionNumber, now);
        m_link.inject(m_models.permit.state().permit, m_injectionNumber);
    }
    if (order.unanswered(now) && !std::exchange(m_unansweredTold, true))
        m_models.log.append(LogKind::Trouble,
                            tr("injection %1: the robot has not answered; look at the contrast left").arg(m_injectionNumber),
                            QDateTime::currentMSecsSinceEpoch());
}

void CockpitControl::hearInjection(quint32 number)
{
    const auto& injections = m_models.instrument.injections();
    const auto told = std::find_if(injections.begin(), injections.end(), [number](const auto& one) { return one.injection == number; });
    if (told == injections.end())
        return;
    const auto status = *told;
    m_models.injection.hear(status);
    if (status.progress == InjectionProgress::Accepted || status.progress == InjectionProgress::Running)
        return;
    auto line = tr("injection %1: %2, %3 mL").arg(status.injection).arg(word(status.progress)).arg(status.delivered, 0, 'f', 1);
    if (!status.reason.isEmpty())
        line += tr(": %1").arg(status.reason);
    const bool good = status.progress == InjectionProgress::Done;
    m_models.log.append(good ? LogKind::Note : LogKind::Trouble, line, QDateTime::currentMSecsSinceEpoch());
}

void CockpitControl::panicHold() { apply(PermitEventKind::PanicHold); }

void CockpitControl::acceptForce(double newtons, const QString& who)
{
    const auto force = QString::number(newtons, 'f', 2);
    const auto line = m_models.instrument.acceptForce(newtons, presentTime())
                          ? tr("force of %1 N accepted for the next arming by %2").arg(force, who.isEmpty() ? tr("the operator") : who)
                          : tr("force of %1 N not accepted: it is another by now").arg(force);
    m_models.log.append(LogKind::Operator, line, QDateTime::currentMSecsSinceEpoch());
}

void CockpitControl::setHandHasKeys(bool has)
{
    if (!has)
        apply(PermitEventKind::PanicHold);
    m_hand.setListening(has);
}

void CockpitControl::notePhase(PermitPhase from, PermitPhase to)
{
    const bool wasArmed = from == PermitPhase::Armed || from == PermitPhase::Engaged;
    const bool isArmed = to == PermitPhase::Armed || to == PermitPhase::Engaged;
    if ((wasArmed && !isArmed) || to == PermitPhase::Hold || to == PermitPhase::Incident || to == PermitPhase::Off)
        m_models.instrument.dropForce(); // what was accepted was accepted for one arming
    if (wasArmed && !isArmed)
        m_alarms.update(presentTime(), m_link.framesReceived()); // what ended it may be over at the next turn
    if (from == PermitPhase::Arming && to == PermitPhase::Armed)
        m_models.instrument.resetPeakForce(); // an early peak does not stand for the whole procedure
    auto line = tr("%1 -> %2").arg(word(from), word(to));
    if (to == PermitPhase::Hold)
        line += tr(": %1").arg(m_models.permit.holdReasons().join(QStringLiteral(" · ")));
    else if (from == PermitPhase::Arming && to == PermitPhase::Standby && m_models.permit.unmetCount() > 0)
        line += tr(": %1").arg(m_models.permit.unmetText());
    m_models.log.append(LogKind::Permit, line, QDateTime::currentMSecsSinceEpoch());
}

} // namespace console
