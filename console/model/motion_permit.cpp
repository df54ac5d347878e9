// The motion permit's rules, phase by phase.
#include "model/motion_permit.hpp"

#include <QCoreApplication>

#include <algorithm>

namespace console {

namespace {

struct Text {
    Q_DECLARE_TR_FUNCTIONS(console::MotionPermit)
};

using Kind = PermitEventKind;
using Phase = PermitPhase;

/// One step in hand: the next state, what to do, and what it is reckoned from.
struct Move {
    PermitState state;
    PermitActions actions;
    Instant now;
    const PermitTiming& timing;

    void enter(Phase phase)
    {
        state.phase = phase;
        state.since = now;
        state.awaitingRobot = false;
        state.guardsTrueSince.reset();
        if (phase != Phase::Hold)
            state.cause = HoldCause::None;
    }

    /// Motion ends, whatever was running: the robot is told, and nothing follows.
    void stop(HoldCause cause)
    {
        giveBack();
        enter(Phase::Hold);
        state.cause = cause;
        state.robotHolds = false;
        state.deadManReleasedSeen = !state.deadMan;
    }

    void giveBack()
    {
        const bool wasArmed = state.phase == Phase::Armed || state.phase == Phase::Engaged;
        if (wasArmed || state.awaitingRobot) {
            actions.release = true;
            actions.permit = state.permit;
        }
        if (wasArmed)
            state.spentPermit = state.permit;
        state.permit = 0;
    }
};

void note(PermitState& state, const PermitEvent& event)
{
    switch (event.kind) {
    case Kind::DeadManPressed:
        state.deadMan = true;
        break;
    case Kind::DeadManReleased:
        state.deadMan = false;
        state.deadManReleasedSeen = true;
        break;
    case Kind::GuardsChecked:
        state.armable = event.armable;
        state.kept = event.kept;
        break;
    case Kind::RobotReported:
        state.robotPermit = event.permit;
        break;
    default:
        break;
    }
}

/// Events of the session and the system, which are the same for every phase. True: the event is dealt with.
bool sessionRules(Move& move, const PermitEvent& event)
{
    auto& state = move.state;
    switch (event.kind) {
    case Kind::SystemStandsBy:
        if (state.phase != Phase::Incident) {
            move.giveBack();
            move.enter(Phase::Incident);
        }
        return true;
    case Kind::SessionClosed:
        if (state.phase != Phase::Off) {
            move.giveBack();
            move.enter(Phase::Off);
        }
        state.spentPermit.reset();
        return true;
    case Kind::SessionOpen:
        if (state.phase == Phase::Off)
            move.enter(Phase::Standby);
        if (state.phase == Phase::Incident) {
            move.enter(Phase::Verifying);
            state.spentPermit.reset();
        }
        return true;
    case Kind::SessionInterrupted:
        if (state.phase == Phase::Arming || state.phase == Phase::Armed || state.phase == Phase::Engaged)
            move.stop(HoldCause::Interrupted);
        else if (state.phase == Phase::Ready)
            move.enter(Phase::Standby);
        state.guardsTrueSince.reset();
        return true;
    default:
        return false;
    }
}

void waiting(Move& move, const PermitEvent& event)
{
    auto& state = move.state;
    if (event.kind != Kind::GuardsChecked)
        return;
    if (state.phase == Phase::Standby && state.armable.all())
        move.enter(Phase::Ready);
    else if (state.phase == Phase::Ready && !state.armable.all())
        move.enter(Phase::Standby);
}

void ready(Move& move, const PermitEvent& event)
{
    if (event.kind == Kind::ArmPressed)
        move.enter(Phase::Arming);
    else if (event.kind == Kind::DeadManPressed)
        move.enter(Phase::Standby);
    else
        waiting(move, event);
}

/// Arming, the button held: everything must stay true until the time is full.
void holdingArm(Move& move, const PermitEvent& event)
{
    auto& state = move.state;
    switch (event.kind) {
    case Kind::ArmReleased:
        move.enter(Phase::Ready);
        break;
    case Kind::DeadManPressed:
    case Kind::Stalled:
    case Kind::PanicHold:
        move.enter(Phase::Standby);
        break;
    case Kind::GuardsChecked:
        if (!state.armable.all())
            move.enter(Phase::Standby);
        break;
    case Kind::RobotReported: // not left to the next look: the request may be due before it
        if (event.robot != RobotState::Ready)
            move.enter(Phase::Standby);
        break;
    case Kind::Tick:
        if (move.now - state.since < move.timing.armHold)
            break;
        state.awaitingRobot = true;
        state.since = move.now;
        state.permit = state.robotPermit;
        move.actions.requestArm = true;
        move.actions.permit = state.permit;
        break;
    default:
        break;
    }
}

bool endsMotion(Move& move, const PermitEvent& event)
{
    switch (event.kind) {
    case Kind::GuardsChecked:
        if (move.state.kept.all())
            return false;
        move.stop(HoldCause::GuardFailed);
        return true;
    case Kind::PanicHold:
        move.stop(HoldCause::Panic);
        return true;
    case Kind::Stalled:
        move.stop(HoldCause::Stalled);
        return true;
    case Kind::GateClosed:
        if (event.permit != move.state.permit)
            return false;
        move.stop(HoldCause::GateClosed);
        return true;
    default:
        return false;
    }
}

/// Arming, the request out: the robot's own word decides.
void awaitingRobot(Move& move, const PermitEvent& event)
{
    auto& state = move.state;
    if (endsMotion(move, event))
        return;
    if (event.kind == Kind::RobotReported && event.robot == RobotState::Armed && event.permit == state.permit && event.own) {
        move.enter(Phase::Armed);
        state.deadManReleasedSeen = !state.deadMan;
    } else if (event.kind == Kind::RobotReported && event.permit != state.permit) {
        move.stop(HoldCause::RobotWithdrew);
    } else if (event.kind == Kind::RobotReported && isArmed(event.robot) && !event.own) {
        move.giveBack();            // if it is nobody's, it is not left armed
        move.enter(Phase::Standby); // no Hold: the robot need not hold, and nothing of this console has moved it
    } else if (event.kind == Kind::Tick && move.now - state.since >= move.timing.armAnswer) {
        move.stop(HoldCause::ArmTimedOut);
    }
}

bool robotWithdrew(const PermitState& state, const PermitEvent& event)
{
    if (event.kind != Kind::RobotReported)
        return false;
    return event.permit != state.permit || !isArmed(event.robot) || !event.own;
}

void armed(Move& move, const PermitEvent& event)
{
    auto& state = move.state;
    if (endsMotion(move, event))
        return;
    if (robotWithdrew(state, event)) {
        move.stop(HoldCause::RobotWithdrew);
    } else if (event.kind == Kind::DeadManPressed && state.deadManReleasedSeen) {
        move.enter(Phase::Engaged);
        ++state.engagement;
        move.actions.rezero = true;
    } else if (event.kind == Kind::Tick && move.now - state.since >= move.timing.unused) {
        move.giveBack();
        move.enter(Phase::Ready);
    }
}

void engaged(Move& move, const PermitEvent& event)
{
    if (endsMotion(move, event))
        return;
    if (robotWithdrew(move.state, event))
        move.stop(HoldCause::RobotWithdrew);
    else if (event.kind == Kind::DeadManReleased)
        move.enter(Phase::Armed);
}

/// Hold ends when the robot itself said that it holds, or that another console has armed it, and the dead-man was let go; it ends in
/// Standby, never in Armed.
void hold(Move& move, const PermitEvent& event)
{
    auto& state = move.state;
    if (event.kind == Kind::RobotReported) {
        const bool holds = (event.robot == RobotState::Hold || event.robot == RobotState::Ready) && event.holdConfirmed;
        const bool anothers = isArmed(event.robot) && !event.own; // it moves for that one only, and may not hold for hours
        state.robotHolds = (holds || anothers) && event.permit != state.spentPermit;
    }
    if (state.robotHolds && state.deadManReleasedSeen && !state.deadMan)
        move.enter(Phase::Standby);
}

void verifying(Move& move, const PermitEvent& event)
{
    auto& state = move.state;
    if (event.kind == Kind::Stalled || event.kind == Kind::PanicHold)
        state.guardsTrueSince.reset();
    if (event.kind == Kind::GuardsChecked && !state.armable.all())
        state.guardsTrueSince.reset();
    else if (event.kind == Kind::GuardsChecked && !state.guardsTrueSince)
        state.guardsTrueSince = move.now;
    if (state.guardsTrueSince && move.now - *state.guardsTrueSince >= move.timing.verifying)
        move.enter(Phase::Standby);
}

} // namespace

PermitStep step(const PermitState& state, const PermitEvent& event, Instant now, const PermitTiming& timing)
{
    Move move{state, {}, now, timing};
    note(move.state, event);
    if (sessionRules(move, event))
        return {move.state, move.actions};
    switch (state.phase) {
    case Phase::Off:
    case Phase::Incident:
        break;
    case Phase::Standby:
        waiting(move, event);
        break;
    case Phase::Ready:
        ready(move, event);
        break;
    case Phase::Arming:
        state.awaitingRobot ? awaitingRobot(move, event) : holdingArm(move, event);
        break;
    case Phase::Armed:
        armed(move, event);
        break;
    case Phase::Engaged:
        engaged(move, event);
        break;
    case Phase::Hold:
        hold(move, event);
        break;
    case Phase::Verifying:
        verifying(move, event);
        break;
    }
    return {move.state, move.actions};
}

MotionStream PermitState::stream() const
{
    if (phase == Phase::Engaged)
        return MotionStream::Motion;
    return phase == Phase::Armed ? MotionStream::Zero : MotionStream::None;
}

double PermitState::armProgress(Instant now) const
{
    if (phase != Phase::Arming)
        return 0;
    if (awaitingRobot)
        return 1;
    return std::clamp(milliseconds(now - since) / milliseconds(PermitTiming{}.armHold), 0.0, 1.0);
}

QString word(PermitPhase phase)
{
    switch (phase) {
    case Phase::Off:
        return Text::tr("OFF");
    case Phase::Standby:
        return Text::tr("STANDBY");
    case Phase::Ready:
        return Text::tr("READY");
    case Phase::Arming:
        return Text::tr("ARMING");
    case Phase::Armed:
        return Text::tr("ARMED");
    case Phase::Engaged:
        return Text::tr("ENGAGED");
    case Phase::Hold:
        return Text::tr("HOLD");
    case Phase::Incident:
        return Text::tr("INCIDENT");
    case Phase::Verifying:
        return Text::tr("VERIFYING");
    }
    return {};
}

QString word(HoldCause cause, const QString& link)
{
    switch (cause) {
    case HoldCause::None:
        return {};
    case HoldCause::GuardFailed:
        return Text::tr("a condition for motion was no longer met");
    case HoldCause::Interrupted:
        return link.isEmpty() ? Text::tr("a link is not open any more") : Text::tr("%1 link is not open any more").arg(link);
    case HoldCause::Panic:
        return Text::tr("Hold was asked for, or the window lost the hand");
    case HoldCause::Stalled:
        return Text::tr("this console stood still for longer than 100 ms");
    case HoldCause::GateClosed:
        return Text::tr("for a moment the picture was too old, or this console stood still");
    case HoldCause::RobotWithdrew:
        return Text::tr("the robot withdrew its permit");
    case HoldCause::ArmTimedOut:
        return Text::tr("the robot did not answer the request to arm");
    }
    return {};
}

} // namespace console
