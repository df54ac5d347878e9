// Invented values, plausible and constant.
#include "invented_cockpit.hpp"

#include "model/present_readings.hpp"

#include <QDateTime>

#include <cmath>

namespace console::test {

using namespace std::chrono_literals;

namespace {

DeviceNode node(quint32 id, const char* name, const char* title, const char* site, int port)
{
    DeviceNode device;
    device.id = id;
    device.name = QString::fromLatin1(name);
    device.title = QString::fromLatin1(title);
    device.site = QString::fromLatin1(site);
    device.kind = kindOf(id);
    device.messageSet = device.name;
    device.address = QStringLiteral("127.0.0.1:%1").arg(port);
    device.self = id == cockpitId;
    return device;
}

} // namespace

InventedCockpit::InventedCockpit()
{
    SessionModel::Topology topology;
    topology.name = QStringLiteral("cerebrovascular");
    topology.title = QStringLiteral("Remote vascular intervention");
    topology.version = QStringLiteral("1.0");
    topology.hash = QStringLiteral("9f3c1a77b2d04e6581aa0c2f4b7e9d10a3f5c6d7e8091a2b3c4d5e6f708192a3");
    topology.devices = {node(cockpitId, "cockpit", "Surgeon's cockpit", "surgeon", 52100),
                        node(robotId, "robot", "Vascular robot", "patient", 52110), node(armId, "arm", "Robotic arm", "patient", 52120),
                        node(xrayId, "xray", "C-arm X-ray", "patient", 52130)};
    topology.links = {{cockpitId, robotId}, {cockpitId, armId}, {cockpitId, xrayId}, {armId, robotId}, {xrayId, robotId}};
    models.sessions.setTopology(topology);
    models.recorder.logKept = true;
    models.permit.check({}, now);
    models.hand.setMasters({{MasterKind::Keyboard, word(MasterKind::Keyboard), MasterLife::Alive, now, true, {}}});
}

LinkFigures InventedCockpit::figures(double roundTripMs) const
{
    LinkFigures f;
    f.lastHeard = now - 12ms;
    f.roundTrip = fromMilliseconds(roundTripMs);
    f.jitter = fromMilliseconds(roundTripMs * 0.09);
    f.clockOffset = 340us;
    f.clockUncertainty = 1ms;
    f.heartbeatsReceived = 14980;
    f.heartbeatsMissed = 6;
    f.heartbeatsOnTime = 812;
    f.messagesInPerSecond = 146;
    f.messagesOutPerSecond = 520;
    f.bytesInPerSecond = 3.2e6;
    f.bytesOutPerSecond = 41000;
    f.toPeerConnected = true;
    f.fromPeerConnected = true;
    f.peerState = LinkState::Open;
    return f;
}

void InventedCockpit::fillHistory(quint32 peer, double roundTripMs, LinkState state)
{
    for (int i = 600; i >= 0; --i) {
        const double wave = 1 + 0.12 * std::sin(i / 9.0) + (i % 137 == 0 ? 1.1 : 0);
        LinkFigures f = figures(roundTripMs * wave);
        const Instant at = now - i * 100ms;
        f.lastHeard = at - 9ms;
        models.sessions.setLinkState(peer, i > 560 ? LinkState::Closed : state, at);
        models.sessions.setLinkFigures(peer, f, at);
    }
    models.sessions.noteOpened(peer, fromMilliseconds(160 + roundTripMs * 3));
    models.sessions.setLinkFigures(peer, figures(roundTripMs), now);
}

/// Ten minutes, in the middle of which nothing was known for a while.
void InventedCockpit::fillTrends()
{
    for (int i = 6000; i >= 0; --i) {
        TrendReading reading;
        if (i < 3000 || i > 3300) {
            reading.roundTripMs = 8.4 + std::sin(i / 9.0) + (i % 137 == 0 ? 9 : 0);
            reading.jitterMs = 0.6 + 0.3 * std::sin(i / 5.0);
            reading.heartbeatsReceived = quint64(5 * (6000 - i));
            reading.heartbeatsMissed = quint64((6000 - i) / 400);
            reading.force = 0.3 + 0.25 * std::sin(i / 40.0) + (i % 900 == 40 ? 0.8 : 0);
            reading.pictureAgeMs = 84 + 12 * std::sin(i / 3.0) + (i % 1500 == 70 ? 230 : 0);
        }
        models.trends.note(reading, now - i * 100ms);
    }
}

RobotStatus InventedCockpit::status(RobotState state) const
{
    RobotStatus s;
    s.state = state;
    s.permit = permitNumber;
    s.owner = isArmed(state) ? cockpitId : 0;
    s.engaged = state == RobotState::Engaged;
    s.holdConfirmed = state == RobotState::Hold || state == RobotState::Ready;
    s.guidewirePosition = 842.6;
    s.guidewireAngle = 134.0;
    s.catheterPosition = 611.2;
    s.catheterAngle = -20.5;
    s.guidewireForce = state == RobotState::Engaged ? 0.46 : 0.08;
    s.guidewireVelocity = state == RobotState::Engaged ? 6.4 : 0;
    s.guidewireRotation = state == RobotState::Engaged ? -84 : 0;
    s.guidewireGripperClosed = true;
    s.contrastRemaining = 78.5;
    return s;
}

GuardReadings InventedCockpit::goodReadings() const
{
    GuardReadings r;
    r.robotLink = LinkState::Open;
    r.inLinkState = 5s;
    r.identityEqual = true;
    r.heartbeatsOnTime = 812;
    r.clockUncertainty = 1ms;
    r.picture.condition = PictureCondition::Live;
    r.picture.source = PictureSource::Simulated;
    r.picture.mayGuide = true;
    r.picture.age = 84ms;
    r.picture.liveFor = 6s;
    r.picture.shownPerSecond = 15;
    r.picture.expectedPerSecond = 15;
    r.picture.atRate = true;
    r.picture.keepsRate = true;
    r.pictureLimit = 250ms;
    r.robotFresh = true;
    r.robotState = RobotState::Ready;
    r.robotHoldConfirmed = true;
    r.robotPermit = permitNumber;
    r.drivesHealthy = true;
    r.roundTrip = 8ms;
    r.usualRoundTrip = 8ms;
    r.carried = 30ms;
    r.tipTracked = r.tipShown = true;
    r.recorded = models.recorder.logKept;
    r.auditKept = models.recorder.auditTrouble.isEmpty();
    r.handAlive = true;
    r.windowActive = true;
    r.alarmsTested = true;
    r.interruptionRead = models.interruption.settled();
    return r;
}

void InventedCockpit::paintPictures(Duration since)
{
    models.picture.setLinkUp(true);
    models.picture.expect(15, now - 8s);
    for (quint32 i = 0; i < 90; ++i) {
        PictureStamp stamp;
        stamp.frame = 100 + i;
        stamp.source = PictureSource::Simulated;
        stamp.painted = now - since - (89 - i) * 66ms;
        stamp.captured = stamp.painted - 78ms;
        stamp.captureNs = quint64(QDateTime::currentMSecsSinceEpoch() - qint64(milliseconds(since)) - 78) * 1000000U;
        stamp.beforeSending = 21ms;
        stamp.arrived = stamp.painted - 20ms;
        stamp.decoding = 6ms;
        stamp.filters = 5ms;
        stamp.window = 2ms;
        stamp.filterDelay = i % 3 == 0 ? 14ms : 11ms;
        models.picture.notePainted(stamp);
        models.picture.notePresented(stamp.frame, i % 4 == 0 ? 5ms : 3ms);
    }
}

void InventedCockpit::openAll()
{
    fillHistory(robotId, 8.4, LinkState::Open);
    fillHistory(armId, 8.9, LinkState::Open);
    fillHistory(xrayId, 11.7, LinkState::Open);
    for (int i = 100; i > 0; --i) {
        RobotStatus s = status(RobotState::Hold);
        s.guidewireForce = 0.3 + 0.25 * std::sin(i / 8.0) + (i == 40 ? 0.4 : 0);
        models.instrument.receiveRobot(s, now - i * 100ms);
    }
    models.instrument.receiveRobot(status(RobotState::Ready), now - 9ms);
    fillTrends();
    DriveStatus drives;
    drives.enabled = {true, true, true, true};
    drives.temperature = {38, 36, 41, 35};
    drives.current = {0.4, 0.2, 0.5, 0.1};
    models.instrument.receiveDrives(drives, now - 120ms);
    models.instrument.receiveTravel({{{0, 837}, {-5, 842}}, {{0, 837}, {-5, 842}}});
    ArmStatus arm;
    arm.phase = ArmPhase::Hold;
    arm.holding = true;
    models.arm.receive(arm, now - 15ms);
    TipPose tip;
    tip.valid = true;
    tip.error = 0.4;
    models.instrument.receiveTip(tip, now - 21ms);
    models.instrument.receiveInjection({3, 4.8, InjectionProgress::Done, {}}, now - 42s);
    AcquisitionStatus xray;
    xray.mode = AcquisitionMode::Fluoroscopy;
    xray.beamOn = true;
    xray.pulseRate = 15;
    xray.fluoroscopyTime = 232;
    xray.airKerma = 212.4;
    xray.airKermaRate = 9.6;
    xray.doseAreaProduct = 18.42;
    models.xray.receive(xray, now - 64ms);
    models.xray.setPedal(true);
    paintPictures(12ms);
    models.hand.set({true, false, false, 0.5, {}});
    noteSystem();
    feed(PermitEventKind::SessionOpen);
    models.permit.check(goodReadings(), now - 4s);
}

void InventedCockpit::noteSystem() { models.interruption.note(systemSnapshot(models, m_pictures, now)); }

void InventedCockpit::feed(PermitEventKind kind, RobotState robot)
{
    PermitEvent event;
    event.kind = kind;
    event.robot = robot;
    event.holdConfirmed = robot == RobotState::Hold || robot == RobotState::Ready;
    event.permit = permitNumber;
    event.own = isArmed(robot);
    const Instant at = kind == PermitEventKind::ArmPressed ? now - 4s : kind == PermitEventKind::Tick ? now - 2s : now - 1s;
    models.permit.apply(event, at);
}

void InventedCockpit::arm()
{
    feed(PermitEventKind::RobotReported);
    feed(PermitEventKind::ArmPressed);
    feed(PermitEventKind::Tick);
    feed(PermitEventKind::RobotReported, RobotState::Armed);
    feed(PermitEventKind::DeadManReleased);
    models.instrument.receiveRobot(status(RobotState::Armed), now - 9ms);
    GuardReadings readings = goodReadings();
    readings.robotState = RobotState::Armed;
    models.permit.check(readings, now);
    models.injection.advance({false, true, true, false, models.instrument.robot().value.contrastRemaining}, now);
}

void InventedCockpit::engage()
{
    feed(PermitEventKind::DeadManPressed);
    models.instrument.receiveRobot(status(RobotState::Engaged), now - 9ms);
    HandReading hand{true, true, false, 0.5, {}};
    hand.motion.guidewireVelocity = 7.5;
    hand.motion.guidewireRotation = -90;
    models.hand.set(hand);
    GuardReadings readings = goodReadings();
    readings.robotState = RobotState::Engaged;
    readings.deadMan = true;
    models.permit.check(readings, now);
}

void InventedCockpit::feelForce()
{
    auto hand = models.hand.reading();
    hand.forceToHand = 0.46;
    models.hand.set(hand);
    models.hand.setMasters({{MasterKind::HapticSimulated, word(MasterKind::HapticSimulated), MasterLife::Alive, now, true, {}},
                            {MasterKind::Keyboard, word(MasterKind::Keyboard), MasterLife::Alive, now, false, {}}});
}

void InventedCockpit::losePad()
{
    models.hand.set({false, false, false, 0.5, {}});
    models.hand.setMasters({{MasterKind::GamePad, QStringLiteral("Game pad Invented 360"), MasterLife::Gone, now - 3s, true, {}},
                            {MasterKind::Keyboard, word(MasterKind::Keyboard), MasterLife::Alive, now, false, {}},
                            {MasterKind::SpaceMouse, word(MasterKind::SpaceMouse), MasterLife::Unreleased, now, false, {}}});
    GuardReadings readings = goodReadings();
    readings.handAlive = false;
    readings.handMissing = QStringLiteral("Game pad Invented 360: gone");
    models.permit.check(readings, now);
}

void InventedCockpit::restWithForce()
{
    auto tense = status(RobotState::Ready);
    tense.guidewireForce = 0.43;
    models.instrument.receiveRobot(tense, now - 9ms);
    auto readings = goodReadings();
    readings.force = tense.guidewireForce;
    models.permit.check(readings, now);
}

void InventedCockpit::freezePicture()
{
    paintPictures(1400ms);
    models.picture.setLinkUp(true);
    GuardReadings readings = goodReadings();
    readings.picture = models.picture.reading(now);
    readings.picture.condition = PictureCondition::Frozen;
    readings.robotState = RobotState::Engaged;
    models.permit.check(readings, now - 1s);
    models.alarms.update({{AlarmCondition::PictureStale, xrayId, AlarmPriority::High, false, QStringLiteral("Live picture stands still"),
                           QStringLiteral("Let go of the dead-man. Check the X-ray link.")},
                          {AlarmCondition::ForceWarn, robotId, AlarmPriority::Medium, false, QStringLiteral("Force above 1 N"),
                           QStringLiteral("Retract a little.")},
                          {AlarmCondition::LinkUnsteady, xrayId, AlarmPriority::Low, false, QStringLiteral("X-ray link unsteady"),
                           QStringLiteral("Watch the line.")}},
                         now, QDateTime::currentMSecsSinceEpoch());
}

void InventedCockpit::renew()
{
    now = std::chrono::steady_clock::now();
    for (const quint32 peer : {robotId, armId, xrayId})
        if (carriesMessages(models.sessions.state(peer)))
            models.sessions.setLinkFigures(peer, figures(peer == xrayId ? 11.7 : 8.4), now);
    if (carriesMessages(models.sessions.state(robotId))) {
        const RobotStatus last = models.instrument.robot().value;
        models.instrument.receiveRobot(last, now - 9ms);
        const TipPose tip = models.instrument.tip().value;
        models.instrument.receiveTip(tip, now - 21ms);
        const DriveStatus drives = models.instrument.drives().value;
        models.instrument.receiveDrives(drives, now - 120ms);
    }
    if (carriesMessages(models.sessions.state(xrayId))) {
        const AcquisitionStatus last = models.xray.status().value;
        models.xray.receive(last, now - 64ms);
    }
    noteSystem();
}

void InventedCockpit::letReportsAge(Duration age)
{
    const RobotStatus last = models.instrument.robot().value;
    models.instrument.receiveRobot(last, now - age);
}

} // namespace console::test
