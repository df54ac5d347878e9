// From models to alarms.
#include "app/alarm_watch.hpp"

#include "model/present_readings.hpp"

#include <QDateTime>

#include <algorithm>
#include <chrono>

namespace console {

namespace {

constexpr std::chrono::seconds overdueMemory{5}; ///< at the least, and of what this console keeps no account of
constexpr std::chrono::seconds paintingSpan{2};
constexpr std::chrono::seconds slowSpan{2};        ///< of too few pictures without a gap, before it is told; of enough, before it ends
constexpr std::chrono::milliseconds enabling{500}; ///< from the arming until every drive must be on
constexpr std::chrono::seconds troubleMemory{10};  ///< longer than what ended motion needs to be found
constexpr std::chrono::seconds followingSpan{2};   ///< after a device is back, for what it had lost beside
constexpr std::chrono::seconds momentTold{1};      ///< for what was over when it was found
constexpr quint64 fewPictures = 10;                ///< in that time; below it one late picture would be a large part

bool isArmed(PermitPhase phase) { return phase == PermitPhase::Armed || phase == PermitPhase::Engaged; }

} // namespace

AlarmWatch::AlarmWatch(ConsoleModels& models, std::optional<quint32> robot, QObject* parent)
    : QObject(parent), m_models(models), m_robot(robot)
{
    connect(&models.permit, &PermitModel::phaseChanged, this, &AlarmWatch::notePhase);
    connect(&models.sessions, &SessionModel::linkStateChanged, this, &AlarmWatch::noteLink);
}

/// The library watches for a peer's reports from each opening on.
void AlarmWatch::noteLink(quint32 peer, LinkState from, LinkState to)
{
    if (to == LinkState::StandBy || to == LinkState::Closed)
        m_overdue.erase(peer);
    if (carriesMessages(from) && (to == LinkState::Closing || to == LinkState::Closed) && isArmed(m_models.permit.phase()))
        m_closedWhileArmed.insert(peer);
    if (carriesMessages(to))
        m_closedWhileArmed.erase(peer);
    if (carriesMessages(to) && !carriesMessages(from))
        m_carriesSince[peer] = m_models.sessions.linkTo(peer)->since;
    // In an incident of another pair the phase stays what it is; and what the robot said of that one was before its own link was lost.
    if (peer == m_robot && to == LinkState::StandBy && from != LinkState::Reopening && m_models.permit.phase() == PermitPhase::Incident)
        awaitHold(m_models.sessions.linkTo(peer)->since);
}

/// A further stop while a hold is awaited makes the wait no shorter; what the robot said before it says nothing about it.
void AlarmWatch::awaitHold(Instant now)
{
    if (!m_stopAt || robotHolds())
        m_stopAt = now;
    m_holdCounts = now;
}

void AlarmWatch::notePhase(PermitPhase from, PermitPhase to)
{
    const auto now = std::chrono::steady_clock::now();
    const bool stopped = to == PermitPhase::Hold || to == PermitPhase::Incident || to == PermitPhase::Off;
    // Who is asked to arm may have done so; and after a loss the robot must hold, whatever it did before. The loss of its own link may be
    // told before the incident: the permit is Off by then.
    const bool robotLost = m_robot && m_models.sessions.state(*m_robot) == LinkState::StandBy;
    const bool afterLoss = to == PermitPhase::Incident && (from != PermitPhase::Off || robotLost);
    if (stopped && (isArmed(from) || from == PermitPhase::Arming || afterLoss))
        awaitHold(now);
    if (stopped && isArmed(from)) {
        m_troubleWhileArmed = true;
        m_troubleWhileEngaged = from == PermitPhase::Engaged;
    }
    if (isArmed(to) && !isArmed(from))
        m_armedAt = now;
    if (to == PermitPhase::Ready || isArmed(to))
        forgetTrouble();
}

void AlarmWatch::forgetTrouble()
{
    m_troubleWhileArmed = false;
    m_troubleWhileEngaged = false;
    m_closedWhileArmed.clear();
    m_pictureTooOld.reset();
    m_settledSince.reset();
}

/// While a hold or an incident stands, or a link may still be given up, what is found may be why motion ended; some time later it is of
/// now, also where nobody arms again.
void AlarmWatch::noteSettled(Instant now)
{
    const auto phase = m_models.permit.phase();
    const auto& links = m_models.sessions.links();
    const bool undecided =
        phase == PermitPhase::Hold || phase == PermitPhase::Incident ||
        std::any_of(links.begin(), links.end(), [](const LinkNode& link) { return link.state == LinkState::Reconnecting; });
    if (undecided || !m_troubleWhileArmed)
        return m_settledSince.reset();
    if (!m_settledSince)
        m_settledSince = now;
    if (now - *m_settledSince >= troubleMemory)
        forgetTrouble();
}

/// What a device that this console has lost, too, has lost beside that is told by the alarm of the link to it, and for as long as that link
/// is lost: what does not follow it soon needs a person.
void AlarmWatch::noteIncidents(Instant now)
{
    const auto& incidents = m_models.incidents;
    std::erase_if(m_ofOthers, [&incidents](const auto& known) { return incidents.incident(known.first) == nullptr; });
    for (const auto& incident : incidents.incidents()) {
        const auto found = m_ofOthers.find(incident.id);
        if (incident.peer != 0 || (found != m_ofOthers.end() && found->second.told))
            continue;
        const auto states = {m_models.sessions.state(incident.a), m_models.sessions.state(incident.b)};
        const auto isLost = [](LinkState state) { return state == LinkState::StandBy || state == LinkState::Reopening; };
        if (std::any_of(states.begin(), states.end(), isLost))
            m_ofOthers[incident.id] = {};
        else if (found != m_ofOthers.end())
            found->second.awaitFollowing(now);
        else if (std::none_of(states.begin(), states.end(), isTrouble)) // else it is not known yet what that link comes to
            m_ofOthers[incident.id].told = true;
    }
}

void AlarmWatch::OfOthers::awaitFollowing(Instant now)
{
    if (!ownBackSince)
        ownBackSince = now;
    told = now - *ownBackSince >= followingSpan;
}

/// It moves for that one only, and was still when it was armed. In an incident it has to hold, whoever had it.
bool AlarmWatch::anotherHasRobot() const
{
    return m_models.permit.phase() != PermitPhase::Incident && isArmed(m_models.instrument.robot().value.state) &&
           anotherOwner(m_models).has_value();
}

/// By the robot's own report after the stop, or by what it told others for an incident: for that of its own link, where that is lost.
bool AlarmWatch::robotHolds() const
{
    const auto& status = m_models.instrument.robot();
    if (status.known() && *status.received > m_holdCounts && (status.value.holdConfirmed || anotherHasRobot()))
        return true;
    if (!m_robot)
        return false;
    const auto state = m_models.sessions.state(*m_robot);
    const bool lost = state == LinkState::StandBy || state == LinkState::Reopening;
    const auto& incidents = m_models.incidents.incidents();
    return std::any_of(incidents.begin(), incidents.end(), [this, lost](const IncidentRecord& incident) {
        return (!lost || incident.peer == *m_robot) &&
               std::any_of(incident.holds.begin(), incident.holds.end(),
                           [this](const HoldLine& line) { return line.device == *m_robot && line.holding; });
    });
}

void AlarmWatch::noteDeadlineMissed(quint32 peer, const QString& message, Instant now)
{
    // Pictures end with the pedal; whether one is missing is the picture's own rule.
    if (message != QLatin1String("XrayFrame"))
        m_overdue[peer][message] = now;
}

/// When the newest of those came, if one did; null for what is not kept.
const std::optional<Instant>* AlarmWatch::lastHeard(quint32 peer, const QString& message) const
{
    const auto& robot = m_models.instrument;
    if (peer == m_robot && message == QLatin1String("RobotStatus"))
        return &robot.robot().received;
    if (peer == m_robot && message == QLatin1String("DriveStatus"))
        return &robot.drives().received;
    if (peer == m_robot && message == QLatin1String("TipPose"))
        return &robot.tip().received;
    if (peer == m_models.sessions.firstPeer(DeviceKind::Eye) && message == QLatin1String("AcquisitionStatus"))
        return &m_models.xray.status().received;
    if (peer == m_models.sessions.firstPeer(DeviceKind::Arm) && message == QLatin1String("ArmStatus"))
        return &m_models.arm.status().received;
    return nullptr;
}

/// The report that is missing for longest. The library tells each gap once, when it begins.
QString AlarmWatch::overdueOf(quint32 peer, Instant now) const
{
    const auto found = m_overdue.find(peer);
    if (found == m_overdue.end())
        return {};
    QString longest;
    Instant earliest = now;
    for (const auto& [message, since] : found->second) {
        const auto* heard = lastHeard(peer, message);
        const bool missing = heard != nullptr && (!heard->has_value() || **heard <= since);
        if ((missing || now - since < overdueMemory) && since <= earliest) {
            longest = message;
            earliest = since;
        }
    }
    return longest;
}

AlarmLinkReading AlarmWatch::linkReading(const LinkNode& link, Instant now) const
{
    AlarmLinkReading reading;
    reading.peer = link.peer;
    reading.title = m_models.sessions.titleOf(link.peer);
    reading.state = link.state;
    reading.suspectsInMinute = static_cast<int>(
        std::count_if(link.suspects.begin(), link.suspects.end(), [now](Instant at) { return at > now - SessionModel::historyLength; }));
    if (const auto line = m_lines.find(link.peer); line != m_lines.end()) {
        reading.jittery = line->second.jittery();
        reading.lossy = line->second.lossy();
        reading.packetsLost = line->second.packetsLost();
    }
    reading.clockUncertain = link.state == LinkState::Open && link.figures.clockOffset &&
                             link.figures.clockUncertainty > clockUncertaintyLimit(m_models.picture.limit());
    reading.images = kindOf(link.peer) == DeviceKind::Eye;
    reading.closedWhileArmed = m_closedWhileArmed.contains(link.peer);
    reading.systemDiffers = link.systemDiffers;
    if (link.peer == m_robot)
        reading.commandRoundTrip = link.usualRoundTrip(); // one late heartbeat is not the line
    reading.deadlineMissed = overdueOf(link.peer, now);
    return reading;
}

AlarmReadings AlarmWatch::readings(Instant now) const
{
    AlarmReadings all;
    const auto phase = m_models.permit.phase();
    all.armed = isArmed(phase) || m_troubleWhileArmed;
    all.engaged = phase == PermitPhase::Engaged || m_troubleWhileEngaged;
    for (const auto& link : m_models.sessions.links())
        if (link.own)
            all.links.push_back(linkReading(link, now));
    for (const auto& incident : m_models.incidents.incidents())
        if (const auto found = m_ofOthers.find(incident.id); found != m_ofOthers.end() && found->second.told)
            all.pairs.push_back({incident.a, incident.b, m_models.sessions.titleOf(incident.a), m_models.sessions.titleOf(incident.b)});
    if (m_stopAt)
        all.awaitingHold = now - *m_stopAt;
    if (const auto asked = m_models.instrument.stopUnheard())
        all.stopUnheard = now - *asked;
    all.picture = m_models.picture.reading(now);
    all.pictureTooOld = m_pictureTooOld && now - *m_pictureTooOld < momentTold;
    all.pictureSlow = m_pictureSlow;
    all.pictureLimit = m_models.picture.limit();
    all.line = lineLimits(m_models.picture.profile());
    const auto& robot = m_models.instrument.robot();
    all.robotFresh = m_models.instrument.robotFresh(now);
    all.force = robot.value.guidewireForce;
    all.limits = m_models.instrument.limits();
    all.limitSwitches = robot.value.limitSwitches;
    all.faultCode = robot.value.faultCode;
    const auto& drives = m_models.instrument.drives();
    all.drivesKnown = drives.known() && !awaitsNew(drives.received, InstrumentState::driveLimit, now) &&
                      (all.armed || drives.freshness(now, InstrumentState::driveLimit) == Freshness::Fresh);
    all.drivesHealthy = m_models.instrument.drivesHealthy(now);
    all.driveOff = isArmed(phase) && drives.known() && *drives.received > m_armedAt + enabling && !drives.value.allEnabled();
    all.armFault = armFault(m_models);
    all.arm = m_models.sessions.firstPeer(DeviceKind::Arm).value_or(0);
    all.emergencyStop = robot.known() && robot.value.emergencyStopToken != 0;
    readInstruments(all, now);
    all.painting = painting();
    all.recorderTroubles = m_models.recorder.troubles();
    all.recorderCauses = m_models.recorder.causes();
    all.soundTrouble = m_soundTrouble;
    all.watchdogTrouble = m_watchdogTrouble;
    return all;
}

/// After a re-opening the old report of the robot stands for a moment: that is no fault.
bool AlarmWatch::awaitsNew(std::optional<Instant> received, Duration limit, Instant now) const
{
    const auto since = m_robot ? m_carriesSince.find(*m_robot) : m_carriesSince.end();
    return since != m_carriesSince.end() && received && *received < since->second && now - since->second <= limit;
}

void AlarmWatch::readInstruments(AlarmReadings& all, Instant now) const
{
    const auto& instrument = m_models.instrument;
    const bool linked = m_robot && carriesMessages(m_models.sessions.state(*m_robot));
    all.roadmapRemoved = m_models.roadmap.reason();
    const auto& tip = instrument.tip();
    all.trackerOverdue = linked && tip.known() && !instrument.tipFresh(now) && !awaitsNew(tip.received, InstrumentState::tipLimit, now);
    all.contrastLeft = instrument.robot().value.contrastRemaining;
    all.contrastRanDry = instrument.ranDry();
    // What has been given stays given, however old the report.
    if (const auto& xray = m_models.xray.status(); xray.known()) {
        all.airKerma = xray.value.airKerma;
        all.fluoroscopyTime = xray.value.fluoroscopyTime;
    }
}

void AlarmWatch::noteDelivered(quint64 delivered, Instant now)
{
    m_counted.push_back({now, delivered, m_models.picture.paintedCount()});
    while (m_counted.size() > 2 && m_counted[1].at <= now - paintingSpan)
        m_counted.pop_front();
}

void AlarmWatch::noteRate(Instant now)
{
    if (m_models.picture.reading(now).slow == m_pictureSlow) {
        m_rateChanged.reset();
        return;
    }
    if (!m_rateChanged)
        m_rateChanged = now;
    if (now - *m_rateChanged < slowSpan)
        return;
    m_pictureSlow = !m_pictureSlow;
    m_rateChanged.reset();
}

std::optional<PaintingReading> AlarmWatch::painting() const
{
    if (m_counted.size() < 2 || m_counted.back().at - m_counted.front().at < paintingSpan)
        return std::nullopt;
    const auto delivered = m_counted.back().delivered - m_counted.front().delivered;
    if (delivered < fewPictures)
        return std::nullopt;
    const double span = seconds(m_counted.back().at - m_counted.front().at);
    const auto painted = m_counted.back().painted - m_counted.front().painted;
    return PaintingReading{static_cast<double>(delivered) / span, static_cast<double>(painted) / span,
                           m_models.alarms.stands(AlarmCondition::PaintingBehind)};
}

/// One for each link of the topology, no more.
void AlarmWatch::noteLines(Instant now)
{
    const auto limits = lineLimits(m_models.picture.profile());
    for (const auto& link : m_models.sessions.links()) {
        if (!link.own)
            continue;
        if (carriesMessages(link.state))
            m_lines[link.peer].note(link.figures, limits, now);
        else
            m_lines[link.peer].forget();
    }
}

void AlarmWatch::update(Instant now, quint64 delivered)
{
    noteLines(now);
    noteDelivered(delivered, now);
    noteRate(now);
    noteSettled(now);
    noteIncidents(now);
    if (m_stopAt && robotHolds())
        m_stopAt.reset();
    m_models.alarms.update(presentAlarms(readings(now)), now, QDateTime::currentMSecsSinceEpoch());
}

} // namespace console
