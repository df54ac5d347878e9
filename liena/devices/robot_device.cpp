// The vascular robot as a device: commands in, events, and the control loop.
#include "robot_device.hpp"

#include <boost/outcome/try.hpp>

#include <algorithm>
#include <random>

namespace liena::devices {

namespace {

using std::chrono::milliseconds;

SteadyTime steadyNow() { return std::chrono::steady_clock::now(); }

// A robot that was started anew must not issue the permits of its last run again.
std::uint32_t randomPermit()
{
    std::random_device entropy;
    return (entropy() & 0x7FFFFFFFU) | 1U;
}

} // namespace

RobotDevice::RobotDevice(DistributedSystem& system, RobotBindings bindings, const VesselTree& tree, const RobotOptions& options,
                         LogSink log)
    : m_system(system),
      m_bindings(std::move(bindings)),
      m_log(log),
      m_gate(DriveLimits::forWay(VesselWay(tree).length())),
      m_machine(randomPermit(), options.arming),
      m_body(VesselWay(tree), options.start.value_or(VesselWay(tree).length() * 0.65), options.seed),
      m_patientSide(system, log, {}, [this](std::string_view reason) { stopLocally(reason); },
                    {[this](bool given) { sayClearance(given); }, [this] { return describe(); }})
{}

Result<std::unique_ptr<RobotDevice>> RobotDevice::create(DistributedSystem& system, const VesselTree& tree, const RobotOptions& options,
                                                         LogSink log)
{
    if (!system.report("RobotStatus"))
        return fail(Errc::InvalidArgument, "device '" + system.self().name + "' is no vascular robot (message set '" +
                                               system.self().messageSet + "'); name one with --device");
    auto bindings = RobotBindings::to(system.messageSet(system.self().id));
    if (!bindings)
        return bindings.as_failure();
    std::unique_ptr<RobotDevice> device(new RobotDevice(system, std::move(bindings).value(), tree, options, std::move(log)));
    BOOST_OUTCOME_TRYV(device->subscribe());
    return device;
}

Result<void> RobotDevice::subscribe()
{
    using Handler = void (RobotDevice::*)(const Message&);
    const std::pair<std::string_view, Handler> commands[] = {
        {"PermitRequest", &RobotDevice::onPermitRequest}, {"MotionCommand", &RobotDevice::onMotion},
        {"GripperCommand", &RobotDevice::onGripper},      {"ContrastInjection", &RobotDevice::onInjection},
        {"EmergencyStop", &RobotDevice::onEmergencyStop}, {"ResetEmergencyStop", &RobotDevice::onReset}};
    for (const auto& [name, handler] : commands) {
        BOOST_OUTCOME_TRYV(m_system.subscribe(name, [this, call = handler](const Message& message) { (this->*call)(message); }));
    }
    m_system.subscribe([this](const SessionEvent& event) { onEvent(event); });
    m_system.every(milliseconds(2), [this] { control(); });
    m_system.every(milliseconds(10), [this] { publishStatus(); });
    m_system.every(milliseconds(25), [this] { publishTip(); });
    m_system.every(milliseconds(200), [this] { publishDrives(); });
    m_system.every(std::chrono::seconds(1), [this] { publishTravelLimits(); });
    return ok();
}

void RobotDevice::onEvent(const SessionEvent& event)
{
    using Kind = SessionEvent::Kind;
    switch (event.kind) {
    case Kind::StateChanged:
        if (carriesMessages(event.to) && !carriesMessages(event.from))
            handle(SessionOpened{event.peer});
        else if (!carriesMessages(event.to) && carriesMessages(event.from))
            handle(SessionLost{event.peer, event.to != SessionState::Reconnecting});
        break;
    case Kind::Interrupted: // the session is open again; the permission to move has ended all the same
        handle(SessionLost{event.peer});
        handle(SessionOpened{event.peer});
        break;
    case Kind::Lost:
    case Kind::Closed:
        handle(SessionLost{event.peer, true});
        break;
    case Kind::StandByBegan:
        handle(StandByBegan{});
        break;
    case Kind::StandByEnded:
        handle(StandByEnded{});
        break;
    case Kind::LocalStall:
        handle(ProcessStalled{});
        break;
    default:
        break;
    }
}

bool RobotDevice::handle(const RobotEvent& event, const MotionCommanded* motion)
{
    const SteadyTime now = steadyNow();
    const RobotState before = m_machine.state();
    const RobotActions actions = m_machine.handle(event, now);
    actOnDrives(actions.drives, motion, now);
    if (actions.stopInjection)
        if (const auto answer = m_injector.stop(std::string(actions.reason)))
            publish(*answer);
    if (actions.revokeControl)
        m_system.revokeControl();
    if (actions.confirmHold) {
        m_holdSince = *actions.confirmHold ? Timestamp::now().ns : 0;
        m_system.confirmHold(*actions.confirmHold);
    }
    if (m_machine.state() != before) {
        m_lastRefusal = {};
        const auto change = std::string(toString(before)) + " -> " + std::string(toString(m_machine.state())) +
                            (actions.reason.empty() ? "" : ": " + std::string(actions.reason));
        m_log(LogLevel::Info, change);
        m_system.audit("robot-state", {}, change);
    }
    if (!actions.accepted)
        sayRefusal(actions.reason);
    return actions.accepted;
}

/// A stream of refused commands is one cause, and one line.
void RobotDevice::sayRefusal(std::string_view reason)
{
    if (std::exchange(m_lastRefusal, reason) == reason)
        return;
    m_log(LogLevel::Warning, "command refused: " + std::string(reason));
    m_system.audit("command-refused", {}, reason);
}

void RobotDevice::actOnDrives(RobotActions::Drives drives, const MotionCommanded* motion, SteadyTime now)
{
    using Drives = RobotActions::Drives;
    switch (drives) {
    case Drives::Leave:
        break;
    case Drives::Enable:
        m_gate.enable();
        break;
    case Drives::Drive:
        if (motion && !m_gate.drive(motion->velocities, std::min(m_commanded, now), now))
            m_machine.countRefusal();
        break;
    case Drives::Release:
        m_gate.release();
        break;
    case Drives::Stop:
        m_gate.stop();
        break;
    case Drives::Cut:
        m_gate.cut();
        break;
    }
}

void RobotDevice::control()
{
    const SteadyTime now = steadyNow();
    const DriveStep step = m_gate.step(now, m_body.feedback());
    m_body.move(step, m_lastControl == SteadyTime{} ? milliseconds(0) : now - m_lastControl);
    m_lastControl = now;
    handle(DrivesChecked{m_body.drivesHealthy(), step.still});
    if (step.stop)
        handle(GateStopped{*step.stop});
    handle(Ticked{});
    handle(SwitchedOn{});
    if (const auto answer = m_injector.advance(now))
        publish(*answer);
}

void RobotDevice::onPermitRequest(const Message& message)
{
    const auto permit = message.get<std::uint32_t>("permit");
    if (message.get<int>("request") == 1)
        handle(ArmRequested{message.origin(), permit});
    else
        handle(ReleaseRequested{message.origin(), permit});
}

void RobotDevice::onMotion(const Message& message)
{
    MotionFields fields;
    if (!m_bindings.motion.read(message, fields)) {
        m_machine.countRefusal();
        return sayRefusal("a MotionCommand of another message set");
    }
    const MotionCommanded motion{message.origin(),
                                 fields.permit,
                                 fields.sequence,
                                 fields.engaged,
                                 {fields.guidewireVelocity, fields.guidewireRotation, fields.catheterVelocity, fields.catheterRotation}};
    m_commanded = message.arrival();
    handle(motion, &motion);
}

void RobotDevice::onGripper(const Message& message)
{
    if (handle(GripperCommanded{message.origin(), message.get<std::uint32_t>("permit")}))
        m_body.setGripper(message.get<Gripper>("gripper"), message.get<bool>("closed"));
}

void RobotDevice::onInjection(const Message& message)
{
    const InjectionRequest request{message.origin(), message.get<std::uint32_t>("injection"), message.get<double>("volume"),
                                   message.get<double>("rate")};
    if (const auto answer = m_injector.known(request.origin, request.number))
        return publish(*answer);
    const bool permitted = handle(InjectionCommanded{request.origin, message.get<std::uint32_t>("permit")});
    const auto answer =
        permitted ? m_injector.request(request, steadyNow()) : m_injector.refuse(request, "not armed under this permit by this cockpit");
    if (permitted && answer.state == InjectionState::Refused)
        m_machine.countRefusal();
    publish(answer);
}

void RobotDevice::onEmergencyStop(const Message& message)
{
    const EmergencyStopCommanded stop{message.origin(), message.get<std::uint64_t>("token")};
    const bool repeated = m_machine.isInForce(stop);
    handle(stop);
    if (repeated) // it is sent until it is named
        return;
    m_system.audit("emergency-stop", m_patientSide.nameOf(message.origin()), message.get<std::string_view>("reason"));
    m_log(LogLevel::Error, "emergency stop from " + m_patientSide.nameOf(message.origin()) + " (" +
                               printable(message.get<std::string_view>("source")) +
                               "): " + printable(message.get<std::string_view>("reason"), 128));
}

void RobotDevice::stopLocally(std::string_view reason)
{
    std::random_device entropy;
    handle(EmergencyStopCommanded{m_system.self().id, (std::uint64_t{entropy()} << 32U | entropy()) | 1U});
    m_system.audit("emergency-stop", m_system.self().name, reason);
    m_log(LogLevel::Error, "emergency stop here: " + printable(reason, 128));
}

void RobotDevice::sayClearance(bool given)
{
    m_lastRefusal = {}; // a person hears an answer each time
    if (!handle(ClearanceSaid{given}))
        return;
    const std::string_view said = given ? "clear to arm" : "wait: the robot cannot be armed";
    m_system.audit("clearance", m_system.self().name, said);
    m_log(LogLevel::Info, std::string(said) + ", says the person beside the robot");
}

std::string RobotDevice::describe() const
{
    std::string text = "robot: " + std::string(toString(m_machine.state()));
    if (m_machine.owner())
        text += ", armed by " + m_patientSide.nameOf(*m_machine.owner());
    if (m_machine.clearance() != Clearance::NotAsked)
        text += m_machine.clearance() == Clearance::Given ? ", clear to arm" : ", waits for clear";
    return text;
}

void RobotDevice::onReset(const Message& message) { handle(ResetCommanded{message.origin(), message.get<std::uint64_t>("token")}); }

} // namespace liena::devices
