// When a loss began and when the picture was taken, by this console's clock and by no other; and what the readings take over.
#include "flapping_link.hpp"
#include "invented_cockpit.hpp"
#include "link/session_intake.hpp"
#include "model/present_readings.hpp"

#include <QDateTime>
#include <QTest>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

namespace {

qint64 wallNow() { return QDateTime::currentMSecsSinceEpoch(); }

qint64 wholeMs(Duration duration) { return std::chrono::duration_cast<std::chrono::milliseconds>(duration).count(); }

/// Figures of the robot, of its links and of the picture, no two of which are the same; those of the other links are ten times as large.
void fillForTrends(InventedCockpit& cockpit)
{
    cockpit.openAll();
    auto& models = cockpit.models;
    for (const quint32 peer : {robotId, armId, xrayId}) {
        const int times = peer == robotId ? 1 : 10;
        auto figures = models.sessions.linkTo(peer)->figures;
        figures.roundTrip = times * 7ms;
        figures.jitter = times * 3ms;
        figures.heartbeatsReceived = quint64(times) * 500;
        figures.heartbeatsMissed = quint64(times) * 11;
        models.sessions.setLinkFigures(peer, figures, cockpit.now);
    }
    auto status = cockpit.status(RobotState::Ready);
    status.guidewireForce = -0.7;
    models.instrument.receiveRobot(status, cockpit.now - 9ms);
    auto stamp = *models.picture.newest();
    ++stamp.frame;
    stamp.captured = cockpit.now - 90ms;
    stamp.arrived = cockpit.now - 20ms;
    stamp.painted = cockpit.now;
    stamp.filterDelay = {};
    models.picture.notePainted(stamp);
}

} // namespace

class TestLossTimes : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// The end that first said so may be another device, with a clock that is hours off.
    void aLossBeganWhenThisConsoleLearntOfIt()
    {
        InventedCockpit cockpit;
        SessionIntake intake(cockpit.models);
        liena::SessionEvent raised;
        raised.kind = liena::SessionEvent::Kind::IncidentRaised;
        raised.peer = liena::DeviceId(armId);
        raised.at = std::chrono::steady_clock::now() - 30s; // the program was busy since
        raised.incident.id = 5;
        raised.incident.a = liena::DeviceId(robotId);
        raised.incident.b = liena::DeviceId(armId);
        raised.incident.since = liena::Timestamp{1'000'000'000};
        const auto before = wallNow();
        intake.take(raised);
        const auto* record = cockpit.models.incidents.incident(5);
        QVERIFY(record != nullptr);
        QVERIFY2(record->sinceWallMs >= before - 30'010 && record->sinceWallMs <= wallNow() - 30'000,
                 qPrintable(QString::number(record->sinceWallMs - before)));
    }

    void itsTimeRunsOnFromTheInterruption()
    {
        InventedCockpit cockpit;
        cockpit.openAll();
        SessionIntake intake(cockpit.models);
        FlappingLink link(intake);
        link.interrupt(cockpit.now);
        const auto begun = cockpit.models.incidents.interruptions().front().sinceWallMs;
        link.decide(cockpit.now + 500ms);
        const auto& incidents = cockpit.models.incidents.incidents();
        QCOMPARE(incidents.size(), std::size_t(1));
        QCOMPARE(incidents.front().since, cockpit.now);
        QCOMPARE(incidents.front().sinceWallMs, begun);
    }

    /// The robot held for long when another link was lost: no time passed, and none is invented.
    void aHoldFromBeforeTheLossHasNoTime()
    {
        InventedCockpit cockpit;
        SessionIntake intake(cockpit.models);
        liena::LinkStatus status;
        status.peer = liena::DeviceId(robotId);
        status.clockOffset = 5s; // the robot's clock is ahead
        status.clockUncertainty = 2ms;
        intake.takeFigures({status}, cockpit.now);
        liena::SessionEvent event;
        event.kind = liena::SessionEvent::Kind::Lost;
        event.peer = liena::DeviceId(xrayId);
        event.at = cockpit.now;
        event.incident.id = 5;
        event.incident.a = liena::DeviceId(cockpitId);
        event.incident.b = liena::DeviceId(xrayId);
        event.diagnosis.since = liena::Timestamp{700'000'000'000};
        intake.take(event);
        event.kind = liena::SessionEvent::Kind::HoldReported;
        const auto heldAt = [&](std::uint64_t ns) {
            event.incident.holds = {{liena::DeviceId(robotId), true, liena::Timestamp{ns}}};
            intake.take(event);
            return cockpit.models.incidents.incident(5)->holds.front();
        };
        const auto before = heldAt(105'000'000'000);
        QVERIFY(before.holding && before.already && !before.afterMs);
        const auto within = heldAt(704'998'500'000); // 1.5 ms before it, or after it
        QVERIFY(within.holding && !within.already);
        QCOMPARE(within.afterMs, std::optional(0.0));
        QVERIFY(heldAt(704'997'000'000).already);
        QCOMPARE(heldAt(705'041'000'000).afterMs, std::optional(41.0));
    }

    void aConnectionThatWasNotLetInIsNotSaidToBeAnIdentity()
    {
        InventedCockpit cockpit;
        SessionIntake intake(cockpit.models);
        liena::SessionEvent refused;
        refused.kind = liena::SessionEvent::Kind::IdentityRefused;
        refused.peer = liena::DeviceId::broadcast();
        refused.detail = "10.0.0.7:50022: the peer closed the connection";
        intake.take(refused);
        const auto& log = cockpit.models.log;
        const auto line = log.data(log.index(log.rowCount() - 1, 0)).toString();
        QVERIFY2(!line.contains(QStringLiteral("identity")), qPrintable(line));
    }

    void aFrozenPictureWasTakenByThisConsolesClock_data()
    {
        QTest::addColumn<bool>("compared");
        QTest::newRow("clocks compared: when it was taken") << true;
        QTest::newRow("not compared: when it was painted") << false;
    }

    void aFrozenPictureWasTakenByThisConsolesClock()
    {
        QFETCH(bool, compared);
        InventedCockpit cockpit;
        cockpit.openAll();
        auto stamp = *cockpit.models.picture.newest();
        ++stamp.frame;
        stamp.captureNs = 3'600'000'000'000U; // an hour after 1970: that device's clock was never set
        if (!compared)
            stamp.captured.reset();
        cockpit.models.picture.notePainted(stamp);
        const auto taken = compared ? *stamp.captured : stamp.painted;
        const auto now = cockpit.now + 2s;
        const auto before = wallNow() - wholeMs(now - taken);
        const auto around = promptSurroundings(cockpit.models, now);
        const auto after = wallNow() - wholeMs(now - taken);
        QVERIFY(around.frozenSinceWallMs.has_value());
        QVERIFY2(*around.frozenSinceWallMs >= before && *around.frozenSinceWallMs <= after,
                 qPrintable(QString::number(*around.frozenSinceWallMs - before)));
    }

    void aPictureWhoseAgeIsUnknownStandsSinceNoTime()
    {
        InventedCockpit cockpit;
        cockpit.openAll();
        QCOMPARE(promptSurroundings(cockpit.models, cockpit.now).picture, PictureCondition::Live);
        auto stamp = *cockpit.models.picture.newest();
        ++stamp.frame;
        stamp.captured.reset();
        cockpit.models.picture.notePainted(stamp);
        const auto around = promptSurroundings(cockpit.models, cockpit.now);
        QCOMPARE(around.picture, PictureCondition::Unknown);
        QVERIFY(!around.frozenSinceWallMs);
    }

    void aRecordingIsToldToThePrompt()
    {
        InventedCockpit cockpit;
        QVERIFY(!promptSurroundings(cockpit.models, cockpit.now).pictureRecorded); // there is none
        cockpit.openAll();
        QVERIFY(!promptSurroundings(cockpit.models, cockpit.now).pictureRecorded);
        auto stamp = *cockpit.models.picture.newest();
        ++stamp.frame;
        stamp.source = PictureSource::Recorded;
        cockpit.models.picture.notePainted(stamp);
        auto around = promptSurroundings(cockpit.models, cockpit.now);
        QVERIFY(around.pictureRecorded && !around.rehearsal);
        cockpit.models.picture.setRehearsal(true);
        around = promptSurroundings(cockpit.models, cockpit.now);
        QVERIFY(around.pictureRecorded && around.rehearsal);
    }

    void theRobotsOwnWordCountsWhileItsLinkIsOpenAndItIsFresh()
    {
        InventedCockpit cockpit;
        cockpit.openAll();
        auto& models = cockpit.models;
        QCOMPARE(promptSurroundings(models, cockpit.now).robotHeldAt, models.instrument.robot().received);
        QVERIFY(!promptSurroundings(models, cockpit.now + 10s).robotHeldAt);
        models.sessions.setLinkState(robotId, LinkState::Reconnecting, cockpit.now);
        QVERIFY(!promptSurroundings(models, cockpit.now).robotHeldAt);
        models.sessions.setLinkState(robotId, LinkState::Open, cockpit.now);
        models.instrument.receiveRobot(cockpit.status(RobotState::Engaged), cockpit.now);
        QVERIFY(!promptSurroundings(models, cockpit.now).robotHeldAt);
    }

    void trendsReadTheRobotsLinkAndNoOther()
    {
        InventedCockpit cockpit;
        fillForTrends(cockpit);
        const auto reading = trendReading(cockpit.models, robotId, cockpit.now);
        QCOMPARE(reading.roundTripMs, std::optional(7.0));
        QCOMPARE(reading.jitterMs, std::optional(3.0));
        QCOMPARE(reading.heartbeatsReceived, std::optional<quint64>(500));
        QCOMPARE(reading.heartbeatsMissed, quint64(11));
        QCOMPARE(reading.force, std::optional(-0.7)); // its sign is the book's affair
        QCOMPARE(reading.pictureAgeMs, std::optional(90.0));
        const auto ofAnother = trendReading(cockpit.models, armId, cockpit.now);
        QCOMPARE(ofAnother.roundTripMs, std::optional(70.0));
        QCOMPARE(ofAnother.heartbeatsMissed, quint64(110));
    }

    void trendsEndWhereTheKnowledgeEnds()
    {
        InventedCockpit cockpit;
        fillForTrends(cockpit);
        auto& models = cockpit.models;
        const auto late = trendReading(models, robotId, cockpit.now + 1s); // the robot has said nothing since
        QVERIFY(!late.force);
        QCOMPARE(late.roundTripMs, std::optional(7.0));
        QCOMPARE(late.pictureAgeMs, std::optional(1090.0)); // frozen, it grows older
        models.picture.expect(0, cockpit.now);              // held, it is none of the present
        QVERIFY(!trendReading(models, robotId, cockpit.now).pictureAgeMs);
        auto figures = models.sessions.linkTo(robotId)->figures;
        figures.roundTrip.reset();
        models.sessions.setLinkFigures(robotId, figures, cockpit.now);
        QVERIFY(!trendReading(models, robotId, cockpit.now).roundTripMs);
        QCOMPARE(trendReading(models, robotId, cockpit.now).jitterMs, std::optional(3.0));
        figures.roundTrip = 7ms;
        figures.jitter.reset();
        models.sessions.setLinkFigures(robotId, figures, cockpit.now);
        QCOMPARE(trendReading(models, robotId, cockpit.now).roundTripMs, std::optional(7.0));
        QVERIFY(!trendReading(models, robotId, cockpit.now).jitterMs);
    }

    void trendsOfALinkThatCarriesNothingHaveNoFigures()
    {
        InventedCockpit cockpit;
        fillForTrends(cockpit);
        auto& models = cockpit.models;
        models.sessions.setLinkState(robotId, LinkState::Suspect, cockpit.now);
        QVERIFY(trendReading(models, robotId, cockpit.now).roundTripMs.has_value()); // messages pass
        const auto isEmpty = [&](std::optional<quint32> robot) {
            const auto reading = trendReading(models, robot, cockpit.now);
            return !reading.roundTripMs && !reading.jitterMs && !reading.heartbeatsReceived && reading.heartbeatsMissed == 0;
        };
        QVERIFY(isEmpty(std::nullopt)); // the topology has none
        for (const auto state : {LinkState::Reconnecting, LinkState::StandBy, LinkState::Reopening, LinkState::Closed}) {
            models.sessions.setLinkState(robotId, state, cockpit.now);
            QVERIFY2(isEmpty(robotId), qPrintable(word(state)));
        }
        QVERIFY(trendReading(models, robotId, cockpit.now).force.has_value()); // what it said is not older for that
    }

    void guardsReadTheTopologysHeartbeatAndWhereTheKeysComeFrom()
    {
        InventedCockpit cockpit;
        auto& models = cockpit.models;
        SessionModel::Topology topology;
        topology.devices = models.sessions.devices();
        topology.links = {{cockpitId, armId}, {cockpitId, robotId}};
        topology.heartbeats = {10ms, 50ms};
        models.sessions.setTopology(topology);
        models.remoteInput = QStringLiteral("XRDP");
        const auto readings = guardReadings(models, robotId, true, cockpit.now);
        QCOMPARE(readings.heartbeat, Duration(50ms));
        QCOMPARE(readings.remoteInput, QStringLiteral("XRDP"));
        topology.heartbeats.clear();
        models.sessions.setTopology(topology);
        QCOMPARE(guardReadings(models, robotId, true, cockpit.now).heartbeat, Duration(20ms));
    }

    void guardsReadThatTheRobotsCommandsDiffer()
    {
        InventedCockpit cockpit;
        cockpit.openAll();
        auto& models = cockpit.models;
        const auto identity = [&] {
            return checkGuards(guardReadings(models, robotId, true, cockpit.now)).at(std::size_t(Guard::IdentityEqual));
        };
        QVERIFY(identity().met);
        models.sessions.setCommandsDiffer(robotId, true);
        QVERIFY(!identity().met);
        QCOMPARE(identity().text, QStringLiteral("Robot's commands differ (F4)"));
        models.sessions.setCommandsDiffer(robotId, false);
        QVERIFY(identity().met);
        models.sessions.setLinkState(robotId, LinkState::Closed, cockpit.now);
        QCOMPARE(identity().text, QStringLiteral("System not confirmed"));
    }

    void guardsReadTheFaultOfAnArmThatIsInSession()
    {
        InventedCockpit cockpit;
        cockpit.openAll();
        auto& models = cockpit.models;
        const auto fault = [&] { return guardReadings(models, robotId, true, cockpit.now).armFault; };
        QVERIFY(!fault());
        ArmStatus arm = models.arm.status().value;
        arm.phase = ArmPhase::Fault;
        models.arm.receive(arm, cockpit.now - 10s);
        QVERIFY(fault()); // silence is no repair
        models.sessions.setLinkState(armId, LinkState::Closed, cockpit.now);
        QVERIFY(!fault());
        models.sessions.setLinkState(armId, LinkState::Open, cockpit.now);
        arm.phase = ArmPhase::Hold;
        models.arm.receive(arm, cockpit.now);
        QVERIFY(!fault());
    }
};

QTEST_GUILESS_MAIN(TestLossTimes)
#include "test_loss_times.moc"
