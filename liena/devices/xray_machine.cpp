// The X-ray system's state machine: implementation.
#include "xray_machine.hpp"

#include <algorithm>
#include <cmath>

namespace liena::devices {

namespace {

constexpr double angleSpeed = 25;      // deg/s
constexpr double distanceSpeed = 60;   // mm/s
constexpr double spinSpeed = 20;       // deg/s
constexpr double spinReach = 100;      // deg
constexpr double referencePoint = 600; // mm from the source: 15 cm before the isocentre

bool isCockpit(DeviceId device) { return device.classNumber() == static_cast<std::uint8_t>(DeviceClass::Brain); }

void approach(double& value, double target, double most) { value += std::clamp(target - value, -most, most); }

} // namespace

bool XrayMachine::refuse(std::string_view reason)
{
    m_reason = reason;
    return false;
}

void XrayMachine::beamOff(std::string_view reason)
{
    if (!m_owner)
        return;
    m_owner.reset();
    m_mode = AcquisitionMode::Stop;
    m_dose.airKermaRate = 0;
    m_reason = reason;
}

void XrayMachine::note(DeviceId origin, std::uint32_t press)
{
    m_presses[origin] = press;
    m_refused.erase(origin);
}

// Whoever pressed while another's pedal was down gets the beam by that one's release only.
void XrayMachine::end(std::string_view reason)
{
    beamOff(reason);
    for (const auto& [origin, press] : m_refused)
        m_presses[origin] = press;
    m_refused.clear();
}

bool XrayMachine::command(const AcquisitionRequest& request, SteadyTime now)
{
    if (!isCockpit(request.origin))
        return refuse("only a cockpit switches the beam");
    const auto seen = m_presses.find(request.origin);
    const bool heardUp = seen != m_presses.end();
    const bool known = heardUp && seen->second == request.press;
    if (!request.pedal || request.mode == AcquisitionMode::Stop) {
        if (heardUp || (!request.pedal && now >= m_upsCountFrom))
            note(request.origin, request.press);
        if (m_owner == request.origin)
            beamOff("the pedal was released");
        return true;
    }
    if (!heardUp) // nobody knows how long it has been down, nor whether a foot is on it
        return refuse("the pedal was not heard up since the session opened, or the last stop or stand-by; release it and press again");
    if (m_standBy && request.mode == AcquisitionMode::Spin) {
        note(request.origin, request.press); // spent: the end of the stand-by must not turn the C-arm by itself
        if (m_owner == request.origin)
            end("the system stands by");
        return refuse("the system stands by: the C-arm does not turn");
    }
    if (!known && m_owner != request.origin)
        m_refused[request.origin] = request.press; // unless it begins below
    if (!(request.pulseRate >= 1 && request.pulseRate <= 30))
        return refuse("the pulse rate is outside 1 to 30 per second");
    if (m_owner && *m_owner != request.origin)
        return refuse("another cockpit's pedal is down");
    if (known && m_owner != request.origin)
        return refuse("this press of the pedal has ended; release it and press again");
    note(request.origin, request.press);
    if (!known)
        startRun(request);
    // Beyond its reach, where a command of the geometry can bring it, the C-arm turns inward.
    if (request.mode == AcquisitionMode::Spin && m_mode != AcquisitionMode::Spin && std::abs(m_geometry.primaryAngle) >= spinReach)
        m_spinDirection = m_geometry.primaryAngle > 0 ? -1 : 1;
    m_mode = request.mode;
    m_pulseRate = m_fixedRate > 0 ? std::min(m_fixedRate, 30.0) : request.pulseRate;
    m_leaseEnd = now + lease + margin;
    return true;
}

void XrayMachine::startRun(const AcquisitionRequest& request)
{
    m_owner = request.origin;
    ++m_acquisition;
    m_reason = "the pedal was pressed";
}

bool XrayMachine::moveTo(DeviceId origin, const CArmGeometry& target)
{
    if (!isCockpit(origin))
        return refuse("only a cockpit moves the C-arm");
    if (m_standBy)
        return refuse("the system stands by");
    if (m_owner && *m_owner != origin)
        return refuse("another cockpit's pedal is down");
    const double sourceObject = m_target.sourceObjectDistance; // fixed by the arm
    m_target = target;
    m_target.sourceObjectDistance = sourceObject;
    m_gantryOwner = origin;
    return true;
}

void XrayMachine::sessionLost(DeviceId peer)
{
    if (m_owner == peer)
        end("the session of the pedal's cockpit is not open");
    m_presses.erase(peer);
    m_refused.erase(peer);
    if (m_gantryOwner == peer)
        m_target = m_geometry;
}

void XrayMachine::setStandBy(bool standsBy, SteadyTime now)
{
    m_standBy = standsBy;
    if (standsBy)
        interrupt("the system stands by", now);
}

// A press that was about to begin is not known yet: only the up before it was heard.
void XrayMachine::interrupt(std::string_view reason, SteadyTime now)
{
    end(reason);
    m_presses.clear();
    m_upsCountFrom = now + lateUps;
    m_target = m_geometry;
}

void XrayMachine::tick(SteadyTime now)
{
    if (m_owner && now > m_leaseEnd)
        end("the pedal's command was not repeated");
    const double seconds = std::clamp(std::chrono::duration<double>(now - m_lastTick.value_or(now)).count(), 0.0, 0.1);
    m_lastTick = now;
    moveGantry(seconds);
    if (!m_owner)
        return;
    m_dose.fluoroscopyTime += seconds;
    m_dose.airKermaRate = kermaPerPulse() * pulseRate() * 60;
}

void XrayMachine::moveGantry(double seconds)
{
    approach(m_geometry.primaryAngle, m_target.primaryAngle, angleSpeed * seconds);
    approach(m_geometry.secondaryAngle, m_target.secondaryAngle, angleSpeed * seconds);
    approach(m_geometry.sourceDetectorDistance, m_target.sourceDetectorDistance, distanceSpeed * seconds);
    for (std::size_t axis = 0; axis < 3; ++axis)
        approach(m_geometry.table[axis], m_target.table[axis], distanceSpeed * seconds);
    m_geometry.fieldOfView = m_target.fieldOfView;
    if (!m_owner || m_mode != AcquisitionMode::Spin)
        return;
    m_geometry.primaryAngle += m_spinDirection * spinSpeed * seconds;
    if (m_geometry.primaryAngle * m_spinDirection >= spinReach) {
        m_geometry.primaryAngle = m_spinDirection * spinReach;
        m_spinDirection = -m_spinDirection;
        end("the rotation is complete");
    }
    m_target.primaryAngle = m_geometry.primaryAngle;
}

TubeSettings XrayMachine::tube() const
{
    switch (m_owner ? m_mode : AcquisitionMode::Stop) {
    case AcquisitionMode::Fluoroscopy:
        return {70, 60, 8};
    case AcquisitionMode::Acquisition:
        return {75, 400, 60};
    case AcquisitionMode::Spin:
        return {70, 250, 8};
    case AcquisitionMode::Stop:
        break;
    }
    return {};
}

// Tube output: about 0.1 mGy per mA·s at 80 kV and 1 m behind the usual filters, with the square of the voltage.
double XrayMachine::kermaPerPulse() const
{
    const TubeSettings settings = tube();
    const double chargeMas = settings.current * settings.pulseWidth / 1000;
    const double voltage = settings.voltage / 80;
    const double distance = 1000 / referencePoint;
    return 0.03 * chargeMas * voltage * voltage * distance * distance;
}

void XrayMachine::pulsed()
{
    const double kerma = kermaPerPulse();
    const double edge = m_geometry.fieldOfView / 10 * referencePoint / m_geometry.sourceDetectorDistance; // cm at the reference point
    m_dose.airKerma += kerma;
    m_dose.areaProduct += kerma / 1000 * edge * edge;
}

} // namespace liena::devices
