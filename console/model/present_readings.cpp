// From models to readings; nothing is decided here.
#include "model/present_readings.hpp"

#include <QDateTime>

namespace console {

namespace {

void readLink(GuardReadings& r, const LinkNode& link, Instant now)
{
    r.robotLink = link.state;
    r.inLinkState = now - link.since;
    r.heartbeat = link.heartbeat;
    // A session opens only between devices whose topology, message sets and certificates agree.
    r.identityEqual = carriesMessages(link.state);
    r.commandsDiffer = link.commandsDiffer;
    r.heartbeatsOnTime = link.figures.heartbeatsOnTime;
    if (link.figures.clockOffset)
        r.clockUncertainty = link.figures.clockUncertainty;
    r.queuedMessages = link.leastQueued();
    r.roundTrip = link.figures.roundTrip;
    r.usualRoundTrip = link.usualRoundTrip();
    r.carried = link.carried;
}

/// The device's own clock is another: what it says is told by the age that this console knows, else by when the picture was painted.
qint64 takenWallMs(const PictureStamp& picture, bool ageKnown, Instant now)
{
    const auto taken = ageKnown && picture.captured ? *picture.captured : picture.painted;
    return QDateTime::currentMSecsSinceEpoch() - std::chrono::duration_cast<std::chrono::milliseconds>(now - taken).count();
}

} // namespace

bool ownsRobot(const ConsoleModels& models)
{
    const auto* self = models.sessions.self();
    return self != nullptr && models.instrument.robot().value.owner == self->id;
}

std::optional<quint32> anotherOwner(const ConsoleModels& models)
{
    const quint32 owner = models.instrument.robot().value.owner;
    return owner != 0 && !ownsRobot(models) ? std::optional(owner) : std::nullopt;
}

bool armFault(const ConsoleModels& models)
{
    const auto arm = models.sessions.firstPeer(DeviceKind::Arm);
    const auto& status = models.arm.status();
    return arm && models.sessions.state(*arm) != LinkState::Closed && status.known() && status.value.phase == ArmPhase::Fault;
}

std::optional<Duration> soundStaysFor(const ConsoleModels& models, Instant now)
{
    const auto phase = models.permit.phase();
    const bool armed = phase == PermitPhase::Armed || phase == PermitPhase::Engaged;
    const bool barred = armed && !models.alarms.audioPauseLeft(now) && !models.alarms.audibleForLong(now);
    return barred ? std::optional(models.alarms.audibleForLongIn(now)) : std::nullopt;
}

std::optional<TipPose> shownTip(const ConsoleModels& models, std::optional<quint32> robot, Instant now)
{
    const auto& tip = models.instrument.tip();
    const bool linked = robot && carriesMessages(models.sessions.state(*robot));
    const bool shown = tip.known() && tip.value.valid && (models.instrument.tipFresh(now) || !linked);
    return shown ? std::optional(tip.value) : std::nullopt;
}

GuardReadings guardReadings(const ConsoleModels& models, std::optional<quint32> robot, bool windowActive, Instant now)
{
    GuardReadings r;
    if (const auto* link = robot ? models.sessions.linkTo(*robot) : nullptr)
        readLink(r, *link, now);
    const auto& status = models.instrument.robot().value;
    r.picture = models.picture.reading(now);
    r.pictureLimit = models.picture.limit();
    r.robotFresh = models.instrument.robotFresh(now);
    r.robotState = status.state;
    r.robotHoldConfirmed = status.holdConfirmed;
    r.robotPermit = status.permit;
    r.anotherHasRobot = isArmed(status.state) && anotherOwner(models);
    r.spentPermit = models.permit.state().spentPermit;
    r.drivesHealthy = models.instrument.drivesHealthy(now);
    r.armFault = armFault(models);
    r.role = models.role;
    r.clearance = status.clearance;
    r.force = status.guidewireForce;
    r.forceAccepted = models.instrument.forceAccepted(now);
    r.tipTracked = models.instrument.tipFresh(now);
    r.tipShown = shownTip(models, robot, now).has_value();
    r.limits = models.instrument.limits();
    r.recorded = models.recorder.logKept;
    r.auditKept = models.recorder.auditTrouble.isEmpty();
    r.incident = models.sessions.inStandBy() || !models.incidents.empty();
    r.highAlarm = models.alarms.unacknowledgedHigh();
    r.handAlive = models.hand.reading().alive;
    r.remoteInput = models.remoteInput;
    r.windowActive = windowActive;
    r.screenGone = models.screenGone;
    r.unseen = models.unseen;
    r.deadMan = models.hand.reading().deadMan;
    r.alarmsTested = models.selfTest.passed();
    r.interruptionRead = models.interruption.settled();
    return r;
}

TrendReading trendReading(const ConsoleModels& models, std::optional<quint32> robot, Instant now)
{
    TrendReading reading;
    const auto* link = robot ? models.sessions.linkTo(*robot) : nullptr;
    if (link != nullptr && carriesMessages(link->state)) {
        if (link->figures.roundTrip)
            reading.roundTripMs = milliseconds(*link->figures.roundTrip);
        if (link->figures.jitter)
            reading.jitterMs = milliseconds(*link->figures.jitter);
        reading.heartbeatsReceived = link->figures.heartbeatsReceived;
        reading.heartbeatsMissed = link->figures.heartbeatsMissed;
    }
    if (models.instrument.robotFresh(now))
        reading.force = models.instrument.robot().value.guidewireForce;
    const auto picture = models.picture.reading(now);
    if (picture.age && picture.condition != PictureCondition::Held)
        reading.pictureAgeMs = milliseconds(*picture.age);
    return reading;
}

SystemSnapshot systemSnapshot(const ConsoleModels& models, quint64 picturesReceived, Instant now)
{
    SystemSnapshot snapshot;
    const auto& instrument = models.instrument;
    if (instrument.robotFresh(now)) {
        snapshot.robot = instrument.robot().value;
        snapshot.robotAt = *instrument.robot().received;
        if (instrument.tipFresh(now))
            snapshot.tip = instrument.tip().value;
        if (instrument.drives().freshness(now, InstrumentState::driveLimit) == Freshness::Fresh)
            snapshot.drives = instrument.drives().value;
    }
    if (models.xray.fresh(now)) {
        snapshot.xray = models.xray.status().value;
        snapshot.xrayAt = *models.xray.status().received;
        snapshot.picturesReceived = picturesReceived;
    }
    return snapshot;
}

PromptSurroundings promptSurroundings(const ConsoleModels& models, Instant now)
{
    PromptSurroundings around;
    around.robot = models.sessions.firstPeer(DeviceKind::Hand).value_or(0);
    const PictureReading picture = models.picture.reading(now);
    around.picture = picture.condition;
    around.pictureRecorded = picture.condition != PictureCondition::None && picture.source == PictureSource::Recorded;
    around.rehearsal = models.picture.isRehearsal();
    if (picture.condition == PictureCondition::Frozen || picture.condition == PictureCondition::Held)
        around.frozenSinceWallMs = takenWallMs(*models.picture.newest(), picture.age.has_value(), now);
    const auto& robot = models.instrument.robot();
    if (carriesMessages(models.sessions.state(around.robot)) && models.instrument.robotFresh(now) && robot.value.holdConfirmed)
        around.robotHeldAt = robot.received;
    around.patientSide = models.patientSide;
    if (const auto* self = models.sessions.self())
        around.ownHost = self->address.section(QLatin1Char(':'), 0, -2);
    around.audioPause = models.alarms.audioPauseLength();
    around.tipLive = models.instrument.tipFresh(now);
    around.tipKnown = models.instrument.tip().known();
    for (const LinkNode& link : models.sessions.links()) {
        if (!link.own)
            continue;
        ++around.ownLinks;
        if (link.state == LinkState::StandBy)
            ++around.lostLinks;
    }
    around.lostTogether = beganTogether(models.sessions, models.incidents);
    return around;
}

} // namespace console
