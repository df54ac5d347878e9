// From models to alarms.
#include "app/alarm_watch.hpp"

#include <QDateTime>

#include <algorithm>
#include <chrono>

namespace console {

namespace {

constexpr std::chrono::seconds overdueMemory{5};
constexpr std::chrono::milliseconds clockLimit{25};

bool isArmed(PermitPhase phase) { return phase == PermitPhase::Armed || phase == PermitPhase::Engaged; }

} // namespace

AlarmWatch::AlarmWatch(ConsoleModels& models, std::optional<quint32> robot, QObject* parent)
    : QObject(parent), m_models(models), m_robot(robot)
{
    connect(&models.permit, &PermitModel::phaseChanged, this, &AlarmWatch::notePhase);
}

void AlarmWatch::notePhase(PermitPhase from, PermitPhase to)
{
    const bool stopped = isArmed(from) && (to == PermitPhase::Hold || to == PermitPhase::Incident || to == PermitPhase::Off);
    if (stopped) {
        m_stopAt = std::chrono::steady_clock::now();
        m_troubleWhileArmed = true;
    }
    if (to == PermitPhase::Ready || isArmed(to))
        m_troubleWhileArmed = false;
}

/// By the robot's own report after the stop, or by what it told others for an incident.
bool AlarmWatch::robotHoldsSince(Instant stop) const
{
    const auto& status = m_models.instrument.robot();
    if (status.known() && *status.received > stop && status.value.holdConfirmed)
        return true;
    const auto& incidents = m_models.incidents.incidents();
    return m_robot && std::any_of(incidents.begin(), incidents.end(), [this](const IncidentRecord& incident) {
               return std::any_of(incident.holds.begin(), incident.holds.end(),
                                  [this](const HoldLine& line) { return line.device == *m_robot && line.holding; });
           });
}

void AlarmWatch::noteDeadlineMissed(quint32 peer, const QString& message, Instant now)
{
    // Pictures end with the pedal; whether one is missing is the picture's own rule.
    if (message != QLatin1String("XrayFrame"))
        m_overdue[peer] = {message, now};
}

AlarmLinkReading AlarmWatch::linkReading(const LinkNode& link, Instant now) const
{
    AlarmLinkReading reading;
    reading.peer = link.peer;
    reading.title = m_models.sessions.titleOf(link.peer);
    reading.state = link.state;
    reading.suspectsInMinute = static_cast<int>(
        std::count_if(link.suspects.begin(), link.suspects.end(), [now](Instant at) { return at > now - SessionModel::historyLength; }));
    reading.clockUncertain = link.state == LinkState::Open && link.figures.clockOffset && link.figures.clockUncertainty > clockLimit;
    const auto overdue = m_overdue.find(link.peer);
    if (overdue != m_overdue.end() && now - overdue->second.at < overdueMemory)
        reading.deadlineMissed = overdue->second.message;
    return reading;
}

AlarmReadings AlarmWatch::readings(Instant now) const
{
    AlarmReadings all;
    const auto phase = m_models.permit.phase();
    all.armed = isArmed(phase) || m_troubleWhileArmed;
    all.engaged = phase == PermitPhase::Engaged;
    for (const auto& link : m_models.sessions.links())
        if (link.own)
            all.links.push_back(linkReading(link, now));
    if (m_stopAt)
        all.awaitingHold = now - *m_stopAt;
    all.picture = m_models.picture.reading(now);
    all.pictureLimit = m_models.picture.limit();
    const auto& robot = m_models.instrument.robot();
    all.robotFresh = m_models.instrument.robotFresh(now);
    all.force = robot.value.guidewireForce;
    all.limits = m_models.instrument.limits();
    all.limitSwitches = robot.value.limitSwitches;
    all.faultCode = robot.value.faultCode;
    all.drivesKnown = m_models.instrument.drives().known();
    all.drivesHealthy = m_models.instrument.drivesHealthy(now);
    all.emergencyStop = robot.known() && robot.value.emergencyStopToken != 0;
    return all;
}

void AlarmWatch::update(Instant now)
{
    if (m_stopAt && robotHoldsSince(*m_stopAt))
        m_stopAt.reset();
    m_models.alarms.update(presentAlarms(readings(now)), now, QDateTime::currentMSecsSinceEpoch());
}

} // namespace console
