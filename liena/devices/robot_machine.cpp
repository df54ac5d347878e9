// The vascular robot's state machine: implementation.
#include "robot_machine.hpp"

#include <algorithm>

namespace liena::devices {

namespace {

bool isCockpit(DeviceId device) { return device.classNumber() == static_cast<std::uint8_t>(DeviceClass::Brain); }

} // namespace

std::string_view toString(RobotState state)
{
    switch (state) {
    case RobotState::Off:
        return "Off";
    case RobotState::Hold:
        return "Hold";
    case RobotState::Ready:
        return "Ready";
    case RobotState::Armed:
        return "Armed";
    case RobotState::Engaged:
        return "Engaged";
    case RobotState::EmergencyStop:
        return "EmergencyStop";
    case RobotState::Fault:
        return "Fault";
    }
    return "unknown";
}

RobotActions RobotMachine::handle(const RobotEvent& event, SteadyTime now)
{
    m_actions = {};
    std::visit([&](const auto& concrete) { on(concrete, now); }, event);
    settle(now);
    return m_actions;
}

void RobotMachine::refuse(std::string_view reason)
{
    ++m_refused;
    m_actions.accepted = false;
    m_actions.reason = reason;
}

void RobotMachine::leaveMotion()
{
    m_actions.stopInjection = true;
    m_owner.reset();
    m_neutralSeen = false;
    m_heardCommand = false;
}

void RobotMachine::endClearance()
{
    if (m_clearance == Clearance::Given)
        m_clearance = Clearance::Awaited;
}

void RobotMachine::enterHold(std::string_view reason, SteadyTime now)
{
    m_holdSince = now;
    leaveMotion();
    m_actions.drives = RobotActions::Drives::Stop;
    m_actions.revokeControl = true;
    m_actions.reason = reason;
    m_state = RobotState::Hold;
    m_permit = m_permit == UINT32_MAX ? 1 : m_permit + 1;
    m_lastSequence = 0;
}

// What follows from the states of things rather than from the event itself.
void RobotMachine::settle(SteadyTime now)
{
    if (m_state == RobotState::Hold && mayBeReady() && now - m_holdSince >= leastHold)
        m_state = RobotState::Ready;
    else if (m_state == RobotState::Ready && !mayBeReady())
        enterHold("no longer ready to be armed", now);
    const bool holds = m_state != RobotState::Off && !permitsMotion() && m_still;
    if (holds != m_holdConfirmed) {
        m_holdConfirmed = holds;
        m_actions.confirmHold = holds;
    }
}

bool RobotMachine::mayBeReady() const
{
    return m_still && m_healthy && !m_standBy && !m_cockpits.empty() && m_clearance != Clearance::Awaited;
}

bool RobotMachine::mayArm(const ArmRequested& event)
{
    if (!isCockpit(event.origin) || !m_cockpits.contains(event.origin))
        refuse("only a cockpit in session may arm");
    else if (permitsMotion())
        refuse(m_owner == event.origin ? "already armed" : "another cockpit has armed");
    else if (m_state != RobotState::Ready)
        refuse(m_clearance == Clearance::Awaited ? "the person beside the robot has not said that it may be armed"
                                                 : "not ready: it must hold, be healthy and not stand by");
    else if (event.permit != m_permit)
        refuse("the permit is not the present one");
    else
        return true;
    return false;
}

void RobotMachine::on(const ArmRequested& event, SteadyTime now)
{
    if (!mayArm(event))
        return;
    m_state = RobotState::Armed;
    m_owner = event.origin;
    m_silentSince = now;
    m_fault = RobotFault::None;
    m_actions.drives = RobotActions::Drives::Enable;
    m_actions.reason = "armed";
}

bool RobotMachine::fromOwner(DeviceId origin, std::uint32_t permit)
{
    if (!permitsMotion())
        refuse("not armed");
    else if (m_owner != origin)
        refuse("another cockpit has armed");
    else if (permit != m_permit)
        refuse("the permit is not the present one");
    else
        return true;
    return false;
}

void RobotMachine::on(const ReleaseRequested& event, SteadyTime now)
{
    if (fromOwner(event.origin, event.permit))
        enterHold("the cockpit gave the permit back", now);
}

void RobotMachine::on(const MotionCommanded& event, SteadyTime now)
{
    const bool mismatch = permitsMotion() && m_owner == event.origin && event.permit != m_permit;
    if (!fromOwner(event.origin, event.permit)) {
        if (mismatch)
            enterHold("the armed cockpit commanded under another permit", now);
        return;
    }
    if (m_heardCommand && event.sequence <= m_lastSequence)
        return refuse("older than the last command");
    const bool neutral = !event.engaged && event.velocities == AxisValues{};
    if (!neutral && !m_neutralSeen)
        return refuse("the first command must be neutral, with the dead-man released");
    m_neutralSeen = true;
    m_heardCommand = true;
    m_lastSequence = event.sequence;
    m_silentSince = now;
    applyMotion(event);
}

void RobotMachine::applyMotion(const MotionCommanded& event)
{
    ++m_applied;
    if (event.engaged) {
        m_state = RobotState::Engaged;
        m_actions.drives = RobotActions::Drives::Drive;
        return;
    }
    if (m_state == RobotState::Engaged)
        m_actions.drives = RobotActions::Drives::Release;
    m_state = RobotState::Armed;
}

void RobotMachine::on(const GripperCommanded& event, SteadyTime)
{
    if (!fromOwner(event.origin, event.permit))
        return;
    if (m_state == RobotState::Engaged || !m_still)
        refuse("a gripper is worked only while the drives stand still");
}

void RobotMachine::on(const InjectionCommanded& event, SteadyTime) { fromOwner(event.origin, event.permit); }

void RobotMachine::on(const EmergencyStopCommanded& event, SteadyTime)
{
    // Each stop has to be reset by its own token: a reset that crossed a second stop on its way must not end that one. A newer one from the
    // same device takes the place of its last: it is reset once, however often it was pressed there.
    std::erase_if(m_stops, [&event](const EmergencyStopCommanded& known) { return known.origin == event.origin; });
    m_stops.push_back(event);
    if (m_state == RobotState::EmergencyStop)
        return;
    endClearance();
    leaveMotion();
    m_actions.drives = RobotActions::Drives::Cut;
    m_actions.revokeControl = true;
    m_actions.reason = "emergency stop";
    m_state = RobotState::EmergencyStop;
}

bool RobotMachine::isInForce(const EmergencyStopCommanded& stop) const
{
    return std::any_of(m_stops.begin(), m_stops.end(),
                       [&stop](const EmergencyStopCommanded& known) { return known.origin == stop.origin && known.token == stop.token; });
}

void RobotMachine::on(const ResetCommanded& event, SteadyTime now)
{
    const auto found =
        std::find_if(m_stops.begin(), m_stops.end(), [&event](const EmergencyStopCommanded& known) { return known.token == event.token; });
    if (m_state != RobotState::EmergencyStop || found == m_stops.end())
        return refuse("no emergency stop of that token is in force");
    if (!isCockpit(event.origin))
        return refuse("only a cockpit resets an emergency stop");
    m_stops.erase(found);
    if (!m_stops.empty())
        return;
    enterHold("the emergency stop was reset", now);
    if (!m_healthy)
        m_state = RobotState::Fault;
}

void RobotMachine::on(const SessionOpened& event, SteadyTime)
{
    if (isCockpit(event.peer))
        m_cockpits.insert(event.peer);
}

void RobotMachine::on(const SessionLost& event, SteadyTime now)
{
    m_cockpits.erase(event.peer);
    const bool armed = permitsMotion();
    if (armed && m_owner == event.peer)
        enterHold("the armed cockpit's session is not open", now);
    if (event.over && isCockpit(event.peer) && !permitsMotion())
        endClearance(); // the next at that cockpit may be another person; one that is armed elsewhere was meant, too
}

void RobotMachine::on(const StandByBegan&, SteadyTime now)
{
    m_standBy = true;
    endClearance();
    if (permitsMotion())
        enterHold("the system stands by", now);
}

void RobotMachine::on(const StandByEnded&, SteadyTime) { m_standBy = false; }

void RobotMachine::on(const ProcessStalled&, SteadyTime now)
{
    if (permitsMotion())
        enterHold("this process did not run in time", now);
}

void RobotMachine::on(const GateStopped& event, SteadyTime now)
{
    if (!permitsMotion())
        return;
    switch (event.cause) {
    case StopCause::ForceStop:
        m_fault = RobotFault::ForceStop;
        break;
    case StopCause::Watchdog:
        m_fault = RobotFault::Watchdog;
        break;
    case StopCause::LeaseOver:
        m_fault = RobotFault::CommandStreamLost;
        break;
    case StopCause::SoftLimit:
    case StopCause::HardLimit:
        break;
    }
    enterHold(toString(event.cause), now);
}

void RobotMachine::on(const DrivesChecked& event, SteadyTime now)
{
    m_still = event.still;
    m_healthy = event.healthy;
    const bool running = m_state != RobotState::Off && m_state != RobotState::EmergencyStop;
    if (running && !m_healthy && m_state != RobotState::Fault) {
        endClearance();
        enterHold("a drive has failed", now);
        m_fault = RobotFault::Drive;
        m_state = RobotState::Fault;
    } else if (m_state == RobotState::Fault && m_healthy) {
        enterHold("the drives are healthy again", now);
    }
}

void RobotMachine::on(const SwitchedOn&, SteadyTime now)
{
    if (m_state == RobotState::Off)
        enterHold("switched on", now);
}

void RobotMachine::on(const ClearanceSaid& event, SteadyTime now)
{
    if (m_clearance == Clearance::NotAsked)
        return refuse("this robot does not wait for a second person");
    const bool mayBeGiven = m_state == RobotState::Hold && !m_standBy;
    if (event.given && m_clearance == Clearance::Awaited && !mayBeGiven)
        return refuse("not while the robot is off, stopped or faulty, or the system stands by");
    if (event.given && m_cockpits.empty())
        return refuse("no cockpit is in session that could arm the robot");
    m_clearance = event.given ? Clearance::Given : Clearance::Awaited;
    if (!event.given && permitsMotion())
        enterHold("the person beside the robot withdrew the word to arm", now);
}

void RobotMachine::on(const Ticked&, SteadyTime now)
{
    if (!permitsMotion())
        return;
    const auto patience = m_heardCommand ? commandSilence : firstCommandWait;
    if (now - m_silentSince <= patience)
        return;
    m_fault = m_heardCommand ? RobotFault::CommandStreamLost : m_fault;
    enterHold(m_heardCommand ? toString(StopCause::LeaseOver) : "the armed cockpit sent no motion command", now);
}

} // namespace liena::devices
