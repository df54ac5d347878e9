// The words of the diagnosis prompt, and the incidents behind it.
#include "model/incident_model.hpp"
#include "model/session_model.hpp"

#include <QSignalSpy>
#include <QTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

constexpr quint32 cockpit = 0x40018208;
constexpr quint32 robot = 0x00008208;
constexpr quint32 xray = 0x20010208;
constexpr quint32 arm = 0x60008208;
const Instant start = Instant{} + 1h;

void fill(SessionModel& sessions)
{
    SessionModel::Topology topology;
    topology.name = QStringLiteral("t");
    const auto add = [&topology](quint32 id, const char* title, const char* site, bool self) {
        DeviceNode node;
        node.id = id;
        node.title = QString::fromLatin1(title);
        node.site = QString::fromLatin1(site);
        node.self = self;
        topology.devices.push_back(node);
    };
    add(cockpit, "Cockpit", "surgeon", true);
    add(robot, "Robot", "patient", false);
    add(arm, "Arm", "patient", false);
    add(xray, "X-ray", "patient", false);
    topology.links = {{robot, cockpit}, {arm, cockpit}, {xray, cockpit}, {robot, arm}};
    sessions.setTopology(topology);
    for (const auto peer : {robot, arm, xray})
        sessions.setLinkState(peer, LinkState::Open, start);
}

IncidentRecord lost(quint32 peer)
{
    IncidentRecord record;
    record.id = 11;
    record.a = std::min(peer, cockpit);
    record.b = std::max(peer, cockpit);
    record.peer = peer;
    record.cause = LossKind::HeartbeatLost;
    record.since = start;
    LinkDiagnosis diagnosis;
    diagnosis.heartbeatsExpected = 50;
    diagnosis.heartbeatsReceived = 44;
    diagnosis.lastRoundTrip = 1500us;
    diagnosis.silence = 610ms;
    diagnosis.toPeerConnected = true;
    diagnosis.fromPeerConnected = true;
    record.diagnosis = diagnosis;
    return record;
}

IncidentRecord interrupted(quint32 peer)
{
    auto record = lost(peer);
    record.cause = LossKind::None;
    record.diagnosis.reset();
    return record;
}

PromptSurroundings around()
{
    PromptSurroundings value;
    value.robot = robot;
    value.lostLinks = 1;
    value.ownLinks = 3;
    return value;
}

} // namespace

class TestIncidents : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void saysWhatIsLostAndForHowLong()
    {
        SessionModel sessions;
        fill(sessions);
        const auto content = promptContent(lost(robot), sessions, around(), start + 72s);
        QCOMPARE(content.headline, QStringLiteral("Robot link lost"));
        QCOMPARE(content.directions, QStringLiteral("to Robot: unknown · from Robot: silent"));
        QVERIFY(content.since.startsWith(QStringLiteral("for 1:12, since ")));
        QVERIFY(content.flaps.isEmpty());
        QVERIFY(content.canReopen);
        QCOMPARE(content.folded, QStringLiteral("Robot link lost, 1:12"));
    }

    void saysWhetherThePatientIsSafe()
    {
        SessionModel sessions;
        fill(sessions);
        auto incident = lost(robot);
        auto content = promptContent(incident, sessions, around(), start);
        QVERIFY(!content.holdConfirmed);
        QVERIFY(content.patient.contains(QStringLiteral("NOT CONFIRMED")));
        QVERIFY(content.patient.contains(QStringLiteral("Ask the patient side now")));
        incident.holds = {{robot, {}, true, 41.0}};
        content = promptContent(incident, sessions, around(), start);
        QVERIFY(content.holdConfirmed);
        QCOMPARE(content.patient, QStringLiteral("Robot holds: CONFIRMED 41 ms after the stop"));
        incident.holds = {{arm, {}, true, 12.0}};
        QVERIFY(!promptContent(incident, sessions, around(), start).holdConfirmed); // another's hold is not the robot's
    }

    void saysHowToCallThePatientSide()
    {
        SessionModel sessions;
        fill(sessions);
        auto seen = around();
        QVERIFY(promptContent(lost(robot), sessions, seen, start).call.contains(QStringLiteral("not set up")));
        seen.patientSide = QStringLiteral("lab 2, tel. 4711");
        QCOMPARE(promptContent(lost(robot), sessions, seen, start).call, QStringLiteral("Call the patient side: lab 2, tel. 4711"));
    }

    void theReportSaysWhatTheSheetSays()
    {
        SessionModel sessions;
        fill(sessions);
        const auto incident = lost(robot);
        const auto content = promptContent(incident, sessions, around(), start);
        const auto report = promptReport(incident, content);
        QVERIFY(report.endsWith(QLatin1Char('\n')) && !report.contains(QStringLiteral("\n\n")));
        for (const auto& fact : QStringList{content.headline, content.since, content.directions, content.patient, content.call,
                                            content.picture, content.tip, content.likelyCause, content.tryFirst} +
                                    content.evidence)
            QVERIFY2(report.contains(fact), qPrintable(fact));
        for (const auto& hold : content.rollCall)
            QVERIFY2(report.contains(hold.title + QStringLiteral(": ")), qPrintable(hold.title));
    }

    void rollCallNamesEveryDevice()
    {
        SessionModel sessions;
        fill(sessions);
        auto incident = lost(robot);
        incident.holds = {{arm, {}, true, std::nullopt}};
        const auto lines = promptContent(incident, sessions, around(), start).rollCall;
        QCOMPARE(lines.size(), std::size_t(4));
        QCOMPARE(lines[2].title, QStringLiteral("Arm"));
        QVERIFY(lines[2].holding);
        QVERIFY(!lines[1].holding);
    }

    void saysWhatIsSeen()
    {
        SessionModel sessions;
        fill(sessions);
        auto seen = around();
        QCOMPARE(promptContent(lost(robot), sessions, seen, start).picture, QStringLiteral("Picture: none"));
        seen.pictureSeen = true;
        seen.frozenSinceWallMs = 1'700'000'000'200;
        const auto frozen = promptContent(lost(robot), sessions, seen, start).picture;
        QVERIFY2(frozen.startsWith(QStringLiteral("Picture: frozen since ")) && frozen.endsWith(QStringLiteral(".2")), qPrintable(frozen));
        seen.pictureHeld = true; // no fault: the pedal is up
        const auto held = promptContent(lost(robot), sessions, seen, start).picture;
        QVERIFY2(held.startsWith(QStringLiteral("Picture: last image hold, of ")), qPrintable(held));
        seen.pictureHeld = false;
        seen.pictureLive = true;
        seen.tipKnown = true;
        const auto content = promptContent(lost(robot), sessions, seen, start);
        QCOMPARE(content.picture, QStringLiteral("Picture: live"));
        QCOMPARE(content.tip, QStringLiteral("Tip position: last known"));
    }

    void givesTheEvidence()
    {
        SessionModel sessions;
        fill(sessions);
        const auto lines = promptContent(lost(robot), sessions, around(), start).evidence;
        QVERIFY(lines.contains(QStringLiteral("Heartbeats in the last second: 44 of 50")));
        QVERIFY(lines.contains(QStringLiteral("Last round trip: 1.5 ms")));
        QVERIFY(lines.contains(QStringLiteral("Silent for 610 ms before it was given up")));
        QVERIFY(lines.contains(QStringLiteral("Links of this console: 3 of 3 open")));
    }

    void advisesByWhatTheProbeFound_data()
    {
        QTest::addColumn<ProbeFinding>("probe");
        QTest::addColumn<quint32>("peer");
        QTest::addColumn<int>("lostLinks");
        QTest::addColumn<QString>("cause");
        QTest::addColumn<QString>("tryFirst");
        const auto row = [](const char* name, ProbeFinding probe, quint32 peer, int count, const char* cause, const char* first) {
            QTest::newRow(name) << probe << peer << count << QString::fromUtf8(cause) << QString::fromUtf8(first);
        };
        row("interface", ProbeFinding::InterfaceDown, robot, 1, "This console has no network", "at this side");
        row("no route", ProbeFinding::NoRoute, robot, 1, "no way to the hospital", "VPN");
        row("host", ProbeFinding::HostUnreachable, robot, 1, "others there do", "Power");
        row("refused", ProbeFinding::ConnectionRefused, robot, 1, "its program is not running", "Restart the program");
        row("identity", ProbeFinding::TlsFailure, robot, 1, "identity was refused", "Do not bypass");
        row("silent", ProbeFinding::PeerSilent, robot, 1, "hangs or is overloaded", "Wait 2 s");
        row("not probed", ProbeFinding::NotProbed, robot, 1, "run the checks", "Run checks");
        row("all lost", ProbeFinding::PeerSilent, robot, 3, "All links were lost at once", "VPN of this console");
        row("all lost, interface", ProbeFinding::InterfaceDown, robot, 3, "This console has no network", "at this side");
        row("only pictures", ProbeFinding::PeerSilent, xray, 1, "Only the pictures are lost", "motion stays inhibited");
        row("pictures, identity", ProbeFinding::TlsFailure, xray, 1, "identity was refused", "Do not bypass");
    }

    void advisesByWhatTheProbeFound()
    {
        QFETCH(ProbeFinding, probe);
        QFETCH(quint32, peer);
        QFETCH(int, lostLinks);
        QFETCH(QString, cause);
        QFETCH(QString, tryFirst);
        SessionModel sessions;
        fill(sessions);
        auto incident = lost(peer);
        incident.diagnosis->probe = probe;
        auto seen = around();
        seen.lostLinks = lostLinks;
        const auto content = promptContent(incident, sessions, seen, start);
        QVERIFY2(content.likelyCause.contains(cause), qPrintable(content.likelyCause));
        QVERIFY2(content.tryFirst.contains(tryFirst), qPrintable(content.tryFirst));
    }

    void neverPromisesToResume()
    {
        SessionModel sessions;
        fill(sessions);
        for (const auto probe : {ProbeFinding::NotProbed, ProbeFinding::PeerSilent, ProbeFinding::Reachable, ProbeFinding::TlsFailure}) {
            auto incident = lost(robot);
            incident.diagnosis->probe = probe;
            const auto content = promptContent(incident, sessions, around(), start);
            QVERIFY(!(content.likelyCause + content.tryFirst + content.patient).contains(QStringLiteral("resume"), Qt::CaseInsensitive));
        }
    }

    void incidentOfOthersIsNotOursToReopen()
    {
        SessionModel sessions;
        fill(sessions);
        auto incident = lost(robot);
        incident.a = robot;
        incident.b = arm;
        incident.peer = 0;
        const auto content = promptContent(incident, sessions, around(), start);
        QCOMPARE(content.headline, QStringLiteral("Link between Robot and Arm lost"));
        QVERIFY(!content.canReopen);
    }

    void countsFlapsOfAPairWithinTwoMinutes()
    {
        IncidentModel model;
        const auto raise = [&model](quint64 id, quint32 peer, Instant at) {
            auto incident = lost(peer);
            incident.id = id;
            model.raise(incident, at);
        };
        raise(1, robot, start);
        raise(2, xray, start + 1s);
        model.end(1);
        raise(3, robot, start + 60s);
        QCOMPARE(model.incident(3)->flaps, 2);
        raise(4, robot, start + 121s);
        QCOMPARE(model.incident(4)->flaps, 2); // the first is longer ago
        SessionModel sessions;
        fill(sessions);
        QCOMPARE(promptContent(*model.incident(4), sessions, around(), start).flaps, QStringLiteral("2nd time in 2 min"));
    }

    void anInterruptionIsNoIncident()
    {
        IncidentModel model;
        QSignalSpy raised(&model, &IncidentModel::incidentRaised);
        model.interrupt(interrupted(robot), start);
        QVERIFY(model.empty());
        QVERIFY(model.ofPair(cockpit, robot) == nullptr);
        QCOMPARE(model.interruptions().size(), std::size_t(1));
        model.heal(robot, start + 300ms);
        model.forgetHealed(start + 300ms + IncidentModel::healedShown - 1ms);
        QCOMPARE(model.interruptions().size(), std::size_t(1));
        QSignalSpy ended(&model, &IncidentModel::interruptionEnded);
        model.forgetHealed(start + 300ms + IncidentModel::healedShown);
        QVERIFY(model.interruptions().empty());
        QCOMPARE(ended.size(), 1);
        QCOMPARE(raised.size(), 0);
        QCOMPARE(model.raisedInAll(), quint64(0));
    }

    void anInterruptionThatDoesNotHealBecomesTheIncident()
    {
        IncidentModel model;
        model.interrupt(interrupted(robot), start);
        const auto interruption = model.interruptions().front().id;
        QSignalSpy decided(&model, &IncidentModel::interruptionDecided);
        model.raise(lost(robot), start + 500ms);
        QCOMPARE(decided.size(), 1);
        QCOMPARE(decided.front().at(0).toULongLong(), interruption);
        QCOMPARE(decided.front().at(1).toULongLong(), quint64(11));
        QVERIFY(model.interruptions().empty());
        QCOMPARE(model.incident(11)->flaps, 1);             // one loss, told twice
        model.interrupt(interrupted(robot), start + 600ms); // told late
        QVERIFY(model.interruptions().empty());
    }

    void everyInterruptionCounts()
    {
        IncidentModel model;
        for (int i = 1; i <= 5; ++i) {
            model.interrupt(interrupted(robot), start + i * 1s);
            QCOMPARE(model.interruptions().size(), std::size_t(1));
            QCOMPARE(model.interruptions().front().flaps, i);
            model.heal(robot, start + i * 1s + 200ms);
        }
        model.raise(lost(robot), start + 7s); // without an interruption that this console saw
        QCOMPARE(model.incident(11)->flaps, 6);
    }

    void anInterruptionNeverHasTheNumberOfAnIncident()
    {
        IncidentModel model;
        auto other = lost(xray);
        other.id = robot;
        model.raise(other, start);
        model.interrupt(interrupted(robot), start);
        QVERIFY(model.interruptions().front().id != other.id);
        QCOMPARE(model.incident(robot)->peer, xray);
    }

    void anInterruptionSaysThatNothingIsDecided()
    {
        SessionModel sessions;
        fill(sessions);
        IncidentModel model;
        model.interrupt(interrupted(robot), start);
        auto content = promptContent(model.interruptions().front(), sessions, around(), start + 200ms);
        QCOMPARE(content.headline, QStringLiteral("Robot link interrupted"));
        QVERIFY(!content.decided && !content.healed && !content.holdConfirmed);
        QVERIFY(content.patient.contains(QStringLiteral("not confirmed yet")));
        model.heal(robot, start + 312ms);
        content = promptContent(model.interruptions().front(), sessions, around(), start + 5s);
        QCOMPARE(content.headline, QStringLiteral("Robot link was interrupted"));
        QVERIFY(content.since.startsWith(QStringLiteral("for 312 ms, at ")));
        QCOMPARE(content.patient, QStringLiteral("Motion needs a new ARM."));
        QVERIFY(content.healed && !content.decided);
    }

    void staysUntilItEnds()
    {
        IncidentModel model;
        QSignalSpy raised(&model, &IncidentModel::incidentRaised);
        QSignalSpy ended(&model, &IncidentModel::incidentEnded);
        model.raise(lost(robot), start);
        model.raise(lost(robot), start + 1s); // told again by another device
        QCOMPARE(raised.size(), 1);
        QCOMPARE(model.raisedInAll(), quint64(1));
        model.setFolded(11, true);
        QVERIFY(model.incident(11)->folded);
        model.setReopenFailure(11, QStringLiteral("no answer"));
        model.setReopenFailure(11, QStringLiteral("no answer"));
        QCOMPARE(model.incident(11)->reopenTries, 2);
        QVERIFY(model.ofPair(cockpit, robot) != nullptr);
        model.end(11);
        model.end(11);
        QCOMPARE(ended.size(), 1);
        QVERIFY(model.empty());
    }
};

QTEST_GUILESS_MAIN(TestIncidents)
#include "test_incidents.moc"
