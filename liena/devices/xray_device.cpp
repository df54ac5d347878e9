// The X-ray system as a device: commands in, events and status.
#include "xray_device.hpp"

#include <boost/outcome/try.hpp>

#include <algorithm>

namespace liena::devices {

namespace {

using std::chrono::milliseconds;

// Nothing of the robot for this long: its injector counts as still.
constexpr milliseconds robotSilence{200};

SteadyTime steadyNow() { return std::chrono::steady_clock::now(); }

std::vector<DeviceId> viewersOf(const DistributedSystem& system)
{
    auto viewers = PatientSide::linked(system, DeviceClass::Brain);
    const auto others = PatientSide::linked(system, DeviceClass::Special); // recorders and monitors
    viewers.insert(viewers.end(), others.begin(), others.end());
    return viewers;
}

// create() has asked for it.
MessageDefinition frameDefinition(const DistributedSystem& system) { return system.report("XrayFrame").value().definition(); }

std::size_t mostBytesIn(const MessageDefinition& frame) { return frame.fields.at(frame.indexOf("pixels").value()).count; }

} // namespace

XrayDevice::XrayDevice(DistributedSystem& system, XrayOptions options, LogSink log)
    : m_system(system),
      m_log(log),
      m_viewers(viewersOf(system)),
      m_patientSide(system, log, PatientSide::linked(system, DeviceClass::Hand),
                    [this](std::string_view reason) {
                        withMachine([](XrayMachine& machine) { machine.interrupt("stop at the patient's side", steadyNow()); });
                        m_patientSide.stopRobots(reason);
                    }),
      m_source(std::move(options.source)),
      m_encoder(options.encoding, options.quality),
      m_ladder(options.encoding, options.quality, options.reduction),
      m_mostBytes(mostBytesIn(frameDefinition(system))),
      m_paths(m_viewers, frameDefinition(system).number),
      m_links(options.links ? std::move(options.links) : [&system] { return system.links(); }),
      m_encode(std::move(options.encode))
{
    m_machine.fixPulseRate(m_source->ownRate());
}

Result<std::unique_ptr<XrayDevice>> XrayDevice::create(DistributedSystem& system, XrayOptions options, LogSink log)
{
    if (!system.report("XrayFrame"))
        return fail(Errc::InvalidArgument, "device '" + system.self().name + "' is no X-ray system (message set '" +
                                               system.self().messageSet + "'); name one with --device");
    std::unique_ptr<XrayDevice> device(new XrayDevice(system, std::move(options), std::move(log)));
    BOOST_OUTCOME_TRYV(device->subscribe(!PatientSide::linked(system, DeviceClass::Hand).empty()));
    device->m_log(LogLevel::Info, "pictures: " + device->m_source->describe());
    device->m_thread = std::thread([raw = device.get()] { raw->takePictures(); });
    return device;
}

Result<void> XrayDevice::subscribe(bool robotLinked)
{
    BOOST_OUTCOME_TRYV(m_system.subscribe("AcquisitionCommand", [this](const Message& message) { onAcquisition(message); }));
    BOOST_OUTCOME_TRYV(m_system.subscribe("GeometryCommand", [this](const Message& message) { onGeometry(message); }));
    if (robotLinked) {
        BOOST_OUTCOME_TRYV(m_system.subscribe("RobotStatus", [this](const Message& message) { onRobotStatus(message); }));
    }
    m_system.subscribe([this](const SessionEvent& event) { onEvent(event); });
    m_system.every(milliseconds(10), [this] { tick(); });
    m_system.every(milliseconds(100), [this] { publishStatus(); });
    return ok();
}

template <typename Use>
void XrayDevice::withMachine(Use use)
{
    std::unique_lock lock(m_mutex);
    const bool before = m_machine.beamOn();
    use(m_machine);
    const bool after = m_machine.beamOn();
    const bool holds = m_machine.holds();
    const std::string_view reason = m_machine.reason();
    lock.unlock();
    tellBeam(before, after, reason);
    tellHold(holds);
}

void XrayDevice::endRun(std::string_view reason)
{
    withMachine([reason](XrayMachine& machine) { machine.interrupt(reason, steadyNow()); });
}

void XrayDevice::tellBeam(bool before, bool after, std::string_view reason)
{
    if (before == after)
        return;
    m_wake.notify_one();
    m_log(LogLevel::Info, std::string(after ? "beam on: " : "beam off: ") + std::string(reason));
}

// Also outside of a stand-by, as the next one begins with it; and taken back within one, where a new press turns the beam on.
void XrayDevice::tellHold(bool holds)
{
    if (std::exchange(m_confirmed, holds) != holds)
        m_system.confirmHold(holds);
}

void XrayDevice::onAcquisition(const Message& message)
{
    const AcquisitionRequest request{message.origin(), message.get<AcquisitionMode>("mode"), message.get<double>("pulse_rate"),
                                     message.get<bool>("pedal"), message.get<std::uint32_t>("press")};
    std::string_view reason;
    bool accepted = false;
    withMachine([&](XrayMachine& machine) {
        accepted = machine.command(request, message.arrival());
        reason = machine.reason();
    });
    // A stream of refused commands is one cause, and one line.
    if (!accepted && std::exchange(m_lastRefusal, reason) != reason) {
        m_log(LogLevel::Warning, "command refused: " + std::string(reason));
        m_system.audit("command-refused", {}, reason);
    }
    if (accepted)
        m_lastRefusal = {};
}

void XrayDevice::onGeometry(const Message& message)
{
    CArmGeometry target;
    target.primaryAngle = message.get<double>("primary_angle");
    target.secondaryAngle = message.get<double>("secondary_angle");
    target.sourceDetectorDistance = message.get<double>("source_detector_distance");
    target.fieldOfView = message.get<double>("field_of_view");
    const auto table = message.get<std::vector<double>>("table_position");
    std::copy_n(table.begin(), std::min<std::size_t>(table.size(), 3), target.table.begin());
    std::string_view reason;
    bool accepted = false;
    withMachine([&](XrayMachine& machine) {
        accepted = machine.moveTo(message.origin(), target);
        reason = machine.reason();
    });
    m_log(accepted ? LogLevel::Info : LogLevel::Warning, accepted ? "the C-arm moves" : "geometry refused: " + std::string(reason));
}

void XrayDevice::onRobotStatus(const Message& message)
{
    const double remaining = message.get<double>("contrast_remaining");
    const std::unique_lock lock(m_mutex);
    const double seconds = std::chrono::duration<double>(message.arrival() - m_robotHeard).count();
    // The robot reports what is left; what left meanwhile is the flow, smoothed over the status messages' jitter.
    const bool comparable = m_instruments.present && seconds > 0.001 && seconds < 0.5;
    const double flow = comparable ? std::clamp((m_contrastRemaining - remaining) / seconds, 0.0, 10.0) : 0;
    m_instruments.contrastFlow += (flow - m_instruments.contrastFlow) * 0.3;
    if (m_instruments.contrastFlow < 0.01)
        m_instruments.contrastFlow = 0;
    m_instruments.present = true;
    m_instruments.guidewire = message.get<double>("guidewire_position");
    m_instruments.guidewireAngle = message.get<double>("guidewire_angle");
    m_instruments.catheter = message.get<double>("catheter_position");
    m_contrastRemaining = remaining;
    m_robotHeard = message.arrival();
}

void XrayDevice::onEvent(const SessionEvent& event)
{
    using Kind = SessionEvent::Kind;
    withMachine([&](XrayMachine& machine) {
        switch (event.kind) {
        case Kind::StateChanged:
            if (!carriesMessages(event.to))
                machine.sessionLost(event.peer);
            break;
        case Kind::Interrupted:
        case Kind::Lost:
        case Kind::Closed:
            machine.sessionLost(event.peer);
            break;
        case Kind::StandByBegan:
            machine.setStandBy(true, steadyNow());
            break;
        case Kind::StandByEnded:
            machine.setStandBy(false, steadyNow());
            break;
        case Kind::LocalStall:
            machine.interrupt("this process did not run in time", steadyNow());
            break;
        case Kind::SendFailed:
            if (event.message == "XrayFrame")
                ++m_lost[event.peer];
            break;
        default:
            break;
        }
    });
}

void XrayDevice::tick()
{
    withMachine([&](XrayMachine& machine) {
        const SteadyTime now = steadyNow();
        machine.tick(now);
        if (now - m_robotHeard > robotSilence)
            m_instruments.contrastFlow = 0;
    });
}

void XrayDevice::publishStatus()
{
    Message status = m_system.report("AcquisitionStatus").value();
    {
        const std::unique_lock lock(m_mutex);
        const TubeSettings tube = m_machine.tube();
        const Dose& dose = m_machine.dose();
        const CArmGeometry& geometry = m_machine.geometry();
        status.set("mode", m_machine.mode()).set("beam_on", m_machine.beamOn());
        status.set("tube_voltage", tube.voltage).set("tube_current", tube.current).set("pulse_width", tube.pulseWidth);
        status.set("pulse_rate", m_machine.beamOn() ? m_machine.pulseRate() : 0.0);
        status.set("fluoroscopy_time", std::min(dose.fluoroscopyTime, 100000.0)).set("air_kerma", std::min(dose.airKerma, 100000.0));
        status.set("air_kerma_rate", std::min(dose.airKermaRate, 10000.0)).set("dose_area_product", std::min(dose.areaProduct, 100000.0));
        status.set("primary_angle", geometry.primaryAngle).set("secondary_angle", geometry.secondaryAngle);
        status.set("source_detector_distance", geometry.sourceDetectorDistance)
            .set("source_object_distance", geometry.sourceObjectDistance);
        status.set("table_position", std::vector<double>(geometry.table.begin(), geometry.table.end()));
        status.set("frames_acquired", m_books.acquired).set("frames_sent", m_books.sent).set("frames_withheld", m_books.withheld);
    }
    m_system.publish(status);
}

} // namespace liena::devices
