// Every event and value of a session, as the console's models come to know it.
#include "link/session_intake.hpp"
#include "link/translate.hpp"
#include "linked_models.hpp"
#include "model/log_roles.hpp"

#include <QSignalSpy>
#include <QTest>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;
using Kind = liena::SessionEvent::Kind;

namespace {

const Instant start = Instant{} + 1h;

liena::SessionEvent occurred(liena::SessionEvent::Kind kind, liena::DeviceId peer = robot)
{
    liena::SessionEvent e;
    e.kind = kind;
    e.peer = peer;
    e.at = start;
    e.incident.id = 77;
    e.incident.a = robot;
    e.incident.b = cockpit;
    e.incident.cause = liena::LossCause::HeartbeatLost;
    return e;
}

/// A line of the log, without its time and kind.
QString lineOf(const ConsoleModels& models, int row) { return models.log.index(row, 0).data(LogTextRole).toString(); }

} // namespace

class TestSessionIntake : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void everySessionStateHasItsOwn()
    {
        for (int state = 0; state < 8; ++state)
            QCOMPARE(int(linkState(static_cast<liena::SessionState>(state))), state);
        for (int cause = 0; cause < 6; ++cause)
            QCOMPARE(int(lossKind(static_cast<liena::LossCause>(cause))), cause);
        for (int probe = 0; probe < 8; ++probe)
            QCOMPARE(int(probeFinding(static_cast<liena::ProbeResult>(probe))), probe);
    }

    void ratesAreOfTheTimeBetweenTwoReadings()
    {
        liena::LinkStatus before, now;
        before.messagesReceived = 100;
        now.messagesReceived = 150;
        before.bytesSent = 1000;
        now.bytesSent = 500; // a new session counts from zero
        QCOMPARE(linkFigures(now, &before, 500ms).messagesInPerSecond, 100.0);
        QCOMPARE(linkFigures(now, &before, 500ms).bytesOutPerSecond, 0.0);
        QCOMPARE(linkFigures(now, nullptr, 0ms).messagesInPerSecond, 0.0);
        QVERIFY(!linkFigures(now, nullptr, 0ms).jitter);
    }

    void anotherWayToTheSameDeviceIsToldOnce()
    {
        ConsoleModels models;
        fill(models);
        SessionIntake intake(models);
        liena::LinkStatus status;
        status.peer = robot;
        const auto reads = [&](const char* local, const char* remote) {
            status.localAddress = local;
            status.remoteAddress = remote;
            intake.takeFigures({status}, start);
            return models.log.rowCount();
        };
        QCOMPARE(reads("", ""), 0);
        QCOMPARE(reads("10.0.0.1", "10.0.0.2"), 0); // the first is no change
        QCOMPARE(reads("10.0.0.1", "10.0.0.2"), 0);
        QCOMPARE(reads("10.0.1.1", "10.0.1.2"), 1);
        QVERIFY2(lineOf(models, 0).contains(QStringLiteral("another way now, from 10.0.1.1 to 10.0.1.2; before from 10.0.0.1 to 10.0.0.2")),
                 qPrintable(lineOf(models, 0)));
        QCOMPARE(reads("10.0.1.1", "10.0.1.2"), 1);
    }

    void stateThatHealedWithinOneBurstIsToldAllTheSame()
    {
        ConsoleModels models;
        fill(models);
        SessionIntake intake(models);
        QSignalSpy changes(&models.sessions, &SessionModel::linkStateChanged);
        QSignalSpy interruptions(&intake, &SessionIntake::interrupted);
        for (const auto to : {liena::SessionState::Open, liena::SessionState::Reconnecting, liena::SessionState::Open}) {
            auto change = occurred(Kind::StateChanged);
            change.to = to;
            intake.take(change);
        }
        auto healed = occurred(Kind::Interrupted);
        healed.duration = 300ms;
        intake.take(healed);
        QCOMPARE(changes.size(), 3);
        QCOMPARE(interruptions.size(), 1);
    }

    void lossRaisesAnIncidentWithItsDiagnosis()
    {
        ConsoleModels models;
        fill(models);
        SessionIntake intake(models);
        auto lost = occurred(Kind::Lost);
        lost.diagnosis.cause = liena::LossCause::HeartbeatLost;
        lost.diagnosis.heartbeatsReceived = 12;
        intake.take(lost);
        const auto* incident = models.incidents.incident(77);
        QVERIFY(incident != nullptr);
        QCOMPARE(incident->peer, robot.value());
        QCOMPARE(incident->diagnosis->heartbeatsReceived, quint64(12));
        QCOMPARE(models.sessions.linkTo(robot.value())->incident, quint64(77));

        intake.take(occurred(Kind::IncidentRaised)); // the broadcast comes after the loss
        QVERIFY(models.incidents.incident(77)->diagnosis.has_value());
        auto found = occurred(Kind::Diagnosed);
        found.diagnosis.probe = liena::ProbeResult::ConnectionRefused;
        intake.take(found);
        QCOMPARE(models.incidents.incident(77)->diagnosis->probe, ProbeFinding::ConnectionRefused);

        auto failed = occurred(Kind::OpenFailed);
        failed.reason = liena::RejectReason::Timeout;
        intake.take(failed);
        QVERIFY(!models.incidents.incident(77)->reopenFailure.isEmpty());
        QVERIFY(!models.sessions.linkTo(robot.value())->failure.isEmpty());

        intake.take(occurred(Kind::IncidentEnded));
        QVERIFY(models.incidents.empty());
        QCOMPARE(models.sessions.linkTo(robot.value())->incident, quint64(0));
    }

    void anotherSystemOnTheOtherSideIsKnownUntilItOpens()
    {
        ConsoleModels models;
        fill(models);
        SessionIntake intake(models);
        auto refused = occurred(Kind::OpenFailed);
        refused.reason = liena::RejectReason::Busy;
        intake.take(refused);
        QVERIFY(!models.sessions.linkTo(robot.value())->systemDiffers);
        for (const auto reason : {liena::RejectReason::TopologyMismatch, liena::RejectReason::MessageSetChanged}) {
            refused.reason = reason;
            intake.take(refused);
            QVERIFY(models.sessions.linkTo(robot.value())->systemDiffers);
            intake.take(occurred(Kind::Opened));
            QVERIFY(!models.sessions.linkTo(robot.value())->systemDiffers);
        }
    }

    void aLostAuditFileIsTold()
    {
        ConsoleModels models;
        SessionIntake intake(models);
        const QSignalSpy lost(&intake, &SessionIntake::auditLost);
        const QSignalSpy restored(&intake, &SessionIntake::auditRestored);
        auto event = occurred(Kind::AuditLost);
        event.detail = "disk full";
        intake.take(event);
        QCOMPARE(lost.value(0).value(0).toString(), QStringLiteral("disk full"));
        intake.take(occurred(Kind::AuditRestored));
        QCOMPARE(restored.count(), 1);
    }

    void holdIsTimedOnlyWhereTheClocksWereCompared()
    {
        ConsoleModels models;
        fill(models);
        SessionIntake intake(models);
        liena::LinkStatus status;
        status.peer = robot;
        status.clockOffset = 5s; // the robot's clock is ahead
        intake.takeFigures({status}, start);
        auto lost = occurred(Kind::Lost);
        lost.diagnosis.since = liena::Timestamp{1'000'000'000};
        intake.take(lost);
        auto said = occurred(Kind::HoldReported);
        said.incident.holds = {{robot, true, liena::Timestamp{6'041'000'000}}, {arm, true, liena::Timestamp{1}}};
        intake.take(said);
        const auto& holds = models.incidents.incident(77)->holds;
        QCOMPARE(holds.size(), std::size_t(2));
        QCOMPARE(*holds[0].afterMs, 41.0);
        QVERIFY(holds[1].holding && !holds[1].afterMs);
    }

    void standByOfOthersIsKnown()
    {
        ConsoleModels models;
        fill(models);
        SessionIntake intake(models);
        auto raised = occurred(Kind::IncidentRaised, arm);
        raised.incident.b = arm;
        intake.take(raised);
        intake.take(occurred(Kind::StandByBegan));
        QCOMPARE(models.incidents.incident(77)->peer, 0U);
        QVERIFY(models.sessions.link(robot.value(), arm.value())->inIncident);
        QVERIFY(models.sessions.inStandBy());
        intake.take(occurred(Kind::StandByEnded));
        QVERIFY(!models.sessions.inStandBy());
    }

    /// A robot that is lost has lost its arm, too: two incidents, and one hold for each.
    void linesOfAnIncidentNameItsPair_data()
    {
        QTest::addColumn<int>("kind");
        QTest::addColumn<bool>("yes"); // it holds, or the incident is given up
        QTest::addColumn<QString>("line");
        QTest::newRow("cause") << int(Kind::CauseReported) << false << QStringLiteral("Robot saw: %1").arg(word(LossKind::HeartbeatLost));
        QTest::newRow("holds") << int(Kind::HoldReported) << true << QStringLiteral("Robot confirms that it holds");
        QTest::newRow("holds no longer") << int(Kind::HoldReported) << false << QStringLiteral("Robot no longer holds");
        QTest::newRow("ended") << int(Kind::IncidentEnded) << false << QStringLiteral("incident ended");
        QTest::newRow("given up") << int(Kind::IncidentEnded) << true << QStringLiteral("incident given up: by hand");
    }

    void linesOfAnIncidentNameItsPair()
    {
        QFETCH(int, kind);
        QFETCH(bool, yes);
        QFETCH(QString, line);
        ConsoleModels models;
        fill(models);
        SessionIntake intake(models);
        for (const auto other : {arm, cockpit}) {
            auto event = occurred(static_cast<Kind>(kind));
            event.incident.id = other.value();
            event.incident.b = other;
            event.incident.causeOfA = liena::LossCause::HeartbeatLost;
            event.hold = {robot, yes, {}};
            event.dismissed = yes;
            event.detail = "by hand";
            intake.take(event);
        }
        QCOMPARE(models.log.rowCount(), 2);
        QCOMPARE(lineOf(models, 0), QStringLiteral("Robot \u2013 Arm: ") + line);
        QCOMPARE(lineOf(models, 1), QStringLiteral("Robot \u2013 Cockpit: ") + line);
    }

    void overdueReportsAreLoggedByTheirTitles_data()
    {
        QTest::addColumn<QByteArray>("message");
        QTest::addColumn<QString>("line");
        QTest::newRow("tip") << QByteArray("TipPose") << QStringLiteral("Robot: position of the tip is overdue");
        QTest::newRow("drives") << QByteArray("DriveStatus") << QStringLiteral("Robot: report of its drives is overdue");
        QTest::newRow("another set's") << QByteArray("PumpFlow") << QStringLiteral("Robot: PumpFlow is overdue");
    }

    void overdueReportsAreLoggedByTheirTitles()
    {
        QFETCH(QByteArray, message);
        QFETCH(QString, line);
        ConsoleModels models;
        fill(models);
        SessionIntake intake(models);
        auto missed = occurred(Kind::DeadlineMissed);
        missed.message = message.toStdString();
        intake.take(missed);
        QCOMPARE(models.log.rowCount(), 1);
        QCOMPARE(lineOf(models, 0), line);
    }

    /// The pedal is up: they have ended, and are not late.
    void picturesAreOverdueOnlyWhereTheyAreDue()
    {
        ConsoleModels models;
        fill(models);
        SessionIntake intake(models);
        const QSignalSpy told(&intake, &SessionIntake::deadlineMissed);
        auto missed = occurred(Kind::DeadlineMissed, xray);
        missed.message = "XrayFrame";
        intake.take(missed);
        QCOMPARE(models.log.rowCount(), 0);
        models.xray.setPedal(true);
        intake.take(missed);
        QCOMPARE(models.log.rowCount(), 1);
        QCOMPARE(lineOf(models, 0), QStringLiteral("X-ray: picture is overdue"));
        QCOMPARE(told.count(), 2);
    }

    void everyEventIsLoggedOrShown_data()
    {
        QTest::addColumn<int>("kind");
        for (const auto kind :
             {Kind::Opened, Kind::OpenFailed, Kind::Closed, Kind::Interrupted, Kind::ReOpened, Kind::DeadlineMissed, Kind::MessagesDropped,
              Kind::SendFailed, Kind::IdentityRefused, Kind::LocalStall, Kind::AuditLost, Kind::AuditRestored})
            QTest::addRow("kind %d", int(kind)) << int(kind);
    }

    void everyEventIsLoggedOrShown()
    {
        QFETCH(int, kind);
        ConsoleModels models;
        fill(models);
        SessionIntake intake(models);
        intake.take(occurred(static_cast<Kind>(kind)));
        QCOMPARE(models.log.rowCount(), 1);
    }
};

QTEST_GUILESS_MAIN(TestSessionIntake)
#include "test_session_intake.moc"
