// The devices' last reports, kept with their ages.
#include "model/arm_state.hpp"
#include "model/hand_state.hpp"
#include "model/instrument_state.hpp"
#include "model/xray_state.hpp"

#include <algorithm>
#include <cmath>

namespace console {

namespace {

constexpr std::size_t injectionLimit = 16;
constexpr double forceMargin = 0.1; ///< N, more than this above what was accepted is another force
constexpr double goneShare = 0.5;   ///< of what is near zero: below it the force has gone, and noise about the limit is no new force

} // namespace

InstrumentState::InstrumentState(QObject* parent) : QObject(parent) {}

bool InstrumentState::drivesHealthy(Instant now) const
{
    if (m_drives.freshness(now, driveLimit) != Freshness::Fresh || m_robot.value.state == RobotState::Fault)
        return false;
    const auto& warm = m_drives.value.temperature;
    return std::all_of(warm.begin(), warm.end(), [this](double celsius) { return celsius <= m_limits.driveTemperature; });
}

bool InstrumentState::mayAcceptForce(Instant now) const
{
    const double force = std::abs(m_robot.value.guidewireForce);
    return robotFresh(now) && force > m_limits.forceNearZero && force < m_limits.forceWarn && !forceAccepted(now);
}

bool InstrumentState::acceptForce(double shown, Instant now)
{
    const double force = std::abs(m_robot.value.guidewireForce);
    const double seen = std::abs(shown);
    const bool there = robotFresh(now) && force > goneShare * m_limits.forceNearZero && force < m_limits.forceWarn;
    if (!there || seen <= m_limits.forceNearZero || force > seen + forceMargin)
        return false;
    m_acceptedForce = seen;
    m_acceptedAt = now;
    return true;
}

bool InstrumentState::forceAccepted(Instant now) const
{
    const double force = std::abs(m_robot.value.guidewireForce);
    return m_acceptedForce && now - m_acceptedAt <= acceptedFor && force <= *m_acceptedForce + forceMargin && force < m_limits.forceWarn;
}

void InstrumentState::noteStopAsked(quint64 token, Instant at) { m_unheard.push_back({token, at}); }

/// With the one that the robot names the earlier ones are answered, too: it stands still until that one is reset.
void InstrumentState::hearStop(quint64 token)
{
    const auto named = std::find_if(m_unheard.begin(), m_unheard.end(), [token](const AskedStop& asked) { return asked.token == token; });
    if (named != m_unheard.end())
        m_unheard.erase(m_unheard.begin(), named + 1);
}

void InstrumentState::receiveRobot(const RobotStatus& status, Instant at)
{
    const bool changed = !m_robot.known() || m_robot.value.state != status.state;
    m_robot.receive(status, at);
    ++m_statusCount;
    hearStop(status.emergencyStopToken);
    if (std::abs(status.guidewireForce) <= goneShare * m_limits.forceNearZero)
        dropForce(); // what comes after it is another force, whichever way it points
    m_peakForce = std::max(m_peakForce, std::abs(status.guidewireForce));
    noteContrast(at);
    m_mostContrast = std::max(m_mostContrast, status.contrastRemaining);
    m_forces.push_back({at, status.guidewireForce});
    while (m_forces.front().at < at - forceTrail)
        m_forces.pop_front();
    if (changed)
        Q_EMIT robotStateChanged(status.state);
    Q_EMIT robotChanged();
}

void InstrumentState::receiveDrives(const DriveStatus& status, Instant at)
{
    m_drives.receive(status, at);
    Q_EMIT drivesChanged();
}

void InstrumentState::receiveTip(const TipPose& pose, Instant at)
{
    m_tip.receive(pose, at);
    Q_EMIT tipChanged();
}

void InstrumentState::endWatch(Instant now)
{
    dropForce();
    if (!injecting())
        return;
    auto last = m_injections.back();
    last.progress = InjectionProgress::Stopped;
    last.reason = tr("the robot was not heard any more; look at the contrast left");
    receiveInjection(last, now);
}

bool InstrumentState::injecting() const
{
    return !m_injections.empty() &&
           (m_injections.back().progress == InjectionProgress::Accepted || m_injections.back().progress == InjectionProgress::Running);
}

/// An injector that runs dry stops in the moment in which it reports that nothing is left: it is hardly ever seen to run without contrast.
/// One that gives the last of it and is done has not run dry.
void InstrumentState::noteContrast(Instant at)
{
    const double left = m_robot.value.contrastRemaining;
    if (!m_robot.known() || left >= emptyContrast)
        m_ranDry = false;
    else if ((injecting() && left <= 0) || (m_injectionStopped && at - *m_injectionStopped <= contrastSettles))
        m_ranDry = true;
}

void InstrumentState::receiveInjection(const InjectionStatus& status, Instant at)
{
    const bool repeated = !m_injections.empty() && m_injections.back().injection == status.injection &&
                          m_injections.back().progress == InjectionProgress::Stopped;
    const auto place = std::find_if(m_injections.begin(), m_injections.end(),
                                    [&status](const InjectionStatus& known) { return known.injection == status.injection; });
    if (place != m_injections.end())
        *place = status;
    else
        m_injections.push_back(status);
    while (m_injections.size() > injectionLimit)
        m_injections.pop_front();
    if (m_injections.back().injection == status.injection) {
        m_injectionHeard = at;
        if (injecting())
            m_injectionStopped.reset();
        else if (status.progress == InjectionProgress::Stopped && !repeated)
            m_injectionStopped = at;
    }
    noteContrast(at);
    Q_EMIT injectionChanged(status.injection);
}

XraySystemState::XraySystemState(QObject* parent) : QObject(parent) {}

void XraySystemState::receive(const AcquisitionStatus& status, Instant at)
{
    const bool before = beamOn();
    m_status.receive(status, at);
    if (before != beamOn())
        Q_EMIT beamChanged(beamOn());
    Q_EMIT statusChanged();
}

void XraySystemState::setPedal(bool down)
{
    if (m_pedal == down)
        return;
    m_pedal = down;
    Q_EMIT pedalChanged(down);
}

void XraySystemState::setRequestedRate(double pulsesPerSecond) { m_requestedRate = std::clamp(pulsesPerSecond, 1.0, 30.0); }

double picturesDue(const XraySystemState& xray, LinkState link)
{
    const bool beam = xray.beamOn() && link != LinkState::Closed;
    if (!beam && !xray.pedalDown())
        return 0;
    const double reported = xray.status().value.pulseRate;
    return beam && reported > 0 ? reported : xray.requestedRate();
}

ArmState::ArmState(QObject* parent) : QObject(parent) {}

void ArmState::receive(const ArmStatus& status, Instant at)
{
    m_status.receive(status, at);
    Q_EMIT statusChanged();
}

HandState::HandState(QObject* parent) : QObject(parent) {}

void HandState::set(const HandReading& reading)
{
    if (m_reading == reading)
        return;
    m_reading = reading;
    Q_EMIT changed();
}

const MasterStatus* HandState::masterInUse() const
{
    const auto found = std::find_if(m_masters.begin(), m_masters.end(), [](const MasterStatus& master) { return master.inUse; });
    return found != m_masters.end() ? &*found : nullptr;
}

void HandState::setMasters(std::vector<MasterStatus> masters)
{
    if (m_masters == masters)
        return;
    m_masters = std::move(masters);
    Q_EMIT changed();
}

void HandState::setCommandsSent(quint64 count)
{
    if (m_commandsSent == count)
        return;
    m_commandsSent = count;
    Q_EMIT changed();
}

} // namespace console
