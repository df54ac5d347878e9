// What happened to an invented cockpit: losses, re-openings and an hour's log.
#include "invented_cockpit.hpp"

#include <QDateTime>

namespace console::test {

using namespace std::chrono_literals;

void InventedCockpit::lose(quint32 peer, quint64 id, const LinkDiagnosis& diagnosis)
{
    models.sessions.setLinkState(peer, LinkState::StandBy, now - 12s);
    models.sessions.setLinkIncident(cockpitId, peer, id);
    models.sessions.setStandBy(true);
    IncidentRecord record;
    record.id = id;
    record.a = std::min(peer, cockpitId);
    record.b = std::max(peer, cockpitId);
    record.peer = peer;
    record.cause = LossKind::HeartbeatLost;
    record.causeOfA = LossKind::ConnectionLost;
    record.causeOfB = LossKind::HeartbeatLost;
    record.since = now - 12s;
    record.sinceWallMs = QDateTime::currentMSecsSinceEpoch() - 12000;
    record.holds = {{cockpitId, QStringLiteral("Surgeon's cockpit"), true, 0.4},
                    {robotId, QStringLiteral("Vascular robot"), peer != robotId, 41.0},
                    {armId, QStringLiteral("Robotic arm"), true, 38.0},
                    {xrayId, QStringLiteral("C-arm X-ray"), true, 52.0}};
    record.diagnosis = diagnosis;
    models.incidents.raise(record, now - 12s);
    models.interruption.begin(QStringLiteral("%1 link").arg(models.sessions.titleOf(peer)), now - 12s, record.sinceWallMs);
    feed(PermitEventKind::SystemStandsBy);
    std::vector<AlarmReport> lost;
    for (const IncidentRecord& one : models.incidents.incidents())
        lost.push_back({AlarmCondition::LinkLost, one.peer, AlarmPriority::High, true,
                        QStringLiteral("%1: link lost").arg(models.sessions.titleOf(one.peer)),
                        QStringLiteral("Ask the patient side whether the robot holds.")});
    models.alarms.update(lost, now, QDateTime::currentMSecsSinceEpoch());
}

void InventedCockpit::loseRobot(quint64 incident)
{
    LinkDiagnosis diagnosis;
    diagnosis.cause = LossKind::HeartbeatLost;
    diagnosis.probe = ProbeFinding::ConnectionRefused;
    diagnosis.silence = 110ms;
    diagnosis.heartbeatsExpected = 50;
    diagnosis.heartbeatsReceived = 44;
    diagnosis.lastRoundTrip = fromMilliseconds(8.6);
    diagnosis.toPeerConnected = false;
    LinkFigures f = figures(8.4);
    f.lastHeard = now - 12s;
    f.toPeerConnected = false;
    f.fromPeerConnected = false;
    models.sessions.setLinkFigures(robotId, f, now);
    lose(robotId, incident, diagnosis);
    letReportsAge(12s);
    GuardReadings readings = goodReadings();
    readings.robotLink = LinkState::StandBy;
    readings.robotFresh = false;
    readings.incident = true;
    readings.highAlarm = true;
    readings.heartbeatsOnTime = 0;
    models.permit.check(readings, now);
}

void InventedCockpit::loseXray(quint64 incident)
{
    LinkDiagnosis diagnosis;
    diagnosis.cause = LossKind::ConnectionLost;
    lose(xrayId, incident, diagnosis);
}

/// The patient side did not stand still meanwhile.
void InventedCockpit::reopenAll()
{
    for (const quint32 peer : {robotId, armId, xrayId}) {
        models.sessions.setLinkState(peer, LinkState::Open, now - 2s);
        models.sessions.setLinkIncident(cockpitId, peer, 0);
        models.sessions.setLinkFigures(peer, figures(8.4), now);
    }
    while (!models.incidents.empty())
        models.incidents.end(models.incidents.incidents().front().id);
    models.sessions.setStandBy(false);
    RobotStatus robot = status(RobotState::Ready);
    robot.guidewirePosition -= 1.8;
    robot.contrastRemaining -= 1.2;
    models.instrument.receiveRobot(robot, now - 9ms);
    DriveStatus drives = models.instrument.drives().value;
    drives.enabled = {};
    models.instrument.receiveDrives(drives, now - 120ms);
    TipPose tip = models.instrument.tip().value;
    tip.position = {1.1, -1.9, 0.7};
    models.instrument.receiveTip(tip, now - 21ms);
    AcquisitionStatus xray = models.xray.status().value;
    xray.fluoroscopyTime += 3.2;
    xray.framesAcquired += 48;
    models.xray.receive(xray, now - 64ms);
    m_pictures += 6;
    models.alarms.update({}, now, QDateTime::currentMSecsSinceEpoch() - 2000);
    models.interruption.end(now - 2s);
    noteSystem();
    feed(PermitEventKind::SessionOpen);
    GuardReadings readings = goodReadings();
    readings.alarmsTested = false;
    readings.highAlarm = models.alarms.unacknowledgedHigh();
    models.permit.check(readings, now);
}

void InventedCockpit::testAlarms()
{
    auto& test = models.selfTest;
    test.begin(now - 20s);
    for (Instant at = now - 20s; test.step() != AlarmSelfTest::Step::Asking; at += 100ms)
        test.update(false, at);
    test.confirm();
}

/// An hour of a quiet procedure, with one loss.
void InventedCockpit::logEvents()
{
    const qint64 wall = QDateTime::currentMSecsSinceEpoch();
    for (int i = 60; i > 0; --i) {
        const qint64 at = wall - i * 60000;
        models.log.append(LogKind::Permit, i % 2 == 0 ? QStringLiteral("READY -> ARMING") : QStringLiteral("ENGAGED -> ARMED"), at);
        if (i % 7 == 0)
            models.log.append(LogKind::Link, QStringLiteral("Vascular robot: open"), at + 120);
        if (i % 11 == 0)
            models.log.append(LogKind::Operator, QStringLiteral("re-open Vascular robot"), at + 300);
        if (i % 13 == 0)
            models.log.append(
                LogKind::Trouble,
                QStringLiteral("Vascular robot: lost, heartbeats stopped; 44 of 50 heartbeats came in the last second, the last "
                               "round trip took 8.6 ms, and both connections stood when it was decided"),
                at + 400);
        if (i % 9 == 0)
            models.log.append(LogKind::Note, QStringLiteral("picture saved: /home/operator/Pictures/liena/run3_frame%1").arg(i), at + 500);
    }
    models.alarms.restoreLog(
        {{wall - 26LL * 3600000, AlarmPriority::Low, QStringLiteral("console started.")},
         {wall - 25LL * 3600000, AlarmPriority::High, QStringLiteral("raised: FORCE STOP: Guidewire force 2.04 N")},
         {wall - 25LL * 3600000 + 4100, AlarmPriority::High, QStringLiteral("acknowledged by Dr Wu: FORCE STOP: Guidewire force 2.04 N")}});
    models.alarms.note(wall - 3500000, QStringLiteral("alarm self-test confirmed by Dr Wu"));
}

} // namespace console::test
