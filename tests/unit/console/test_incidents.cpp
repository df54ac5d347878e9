// The words of the diagnosis prompt, and the incidents behind it.
#include "lost_links.hpp"

#include <QSignalSpy>
#include <QTest>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

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
        const auto denied = QStringLiteral("NOT CONFIRMED that Robot holds. Its own guard should hold it. Ask the patient side now.");
        QCOMPARE(content.patient, denied); // who reads its beginning only must not take the hold for granted
        incident.holds = {{robot, {}, true, 41.0}};
        content = promptContent(incident, sessions, around(), start);
        QVERIFY(content.holdConfirmed);
        QCOMPARE(content.patient, QStringLiteral("Robot holds: CONFIRMED 41 ms after the stop"));
        incident.holds = {{robot, {}, true, std::nullopt, true}};
        content = promptContent(incident, sessions, around(), start);
        QVERIFY(content.holdConfirmed);
        QCOMPARE(content.patient, QStringLiteral("Robot holds: CONFIRMED, already before the loss was noticed"));
        QVERIFY(promptReport(content).contains(QStringLiteral("Robot: holds, already before the loss was noticed")));
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
        const auto report = promptReport(content);
        QVERIFY(report.endsWith(QLatin1Char('\n')) && !report.contains(QStringLiteral("\n\n")));
        for (const auto& fact : QStringList{content.headline, content.since, content.directions, content.patient, content.call,
                                            content.picture, content.tip, content.likelyCause, content.tryFirst} +
                                    content.evidence)
            QVERIFY2(report.contains(fact), qPrintable(fact));
        for (const auto& hold : content.rollCall)
            QVERIFY2(report.contains(hold.title + QStringLiteral(": ")), qPrintable(hold.title));
    }

    /// Of each device whether it holds, and how soon it did: a time makes no hold of what was not confirmed.
    void theReportSaysWhoHoldsAndHowSoon()
    {
        SessionModel sessions;
        fill(sessions);
        auto incident = lost(robot);
        incident.holds = {
            {cockpit, {}, true, std::nullopt}, {robot, {}, false, 12.0}, {arm, {}, true, 41.0}, {xray, {}, true, std::nullopt, true}};
        const auto lines = promptReport(promptContent(incident, sessions, around(), start)).split(QLatin1Char('\n'));
        const QStringList expected{QStringLiteral("Cockpit: holds"), QStringLiteral("Robot: NOT CONFIRMED"),
                                   QStringLiteral("Arm: holds, 41 ms after the loss"),
                                   QStringLiteral("X-ray: holds, already before the loss was noticed")};
        const auto first = lines.indexOf(expected.front());
        QVERIFY2(first >= 0, qPrintable(lines.join(QLatin1Char('\n'))));
        QCOMPARE(lines.mid(first, expected.size()), expected);
        incident.holds.clear(); // nobody said anything
        const auto silent = promptReport(promptContent(incident, sessions, around(), start)).split(QLatin1Char('\n'));
        for (const char* title : {"Cockpit", "Robot", "Arm", "X-ray"})
            QVERIFY2(silent.contains(QString::fromLatin1(title) + QStringLiteral(": NOT CONFIRMED")), title);
    }

    void detailsAreForWhoeverHasToFindTheCause()
    {
        SessionModel sessions;
        fill(sessions);
        auto incident = lost(robot);
        incident.sinceWallMs = 1'700'000'000'250;
        incident.diagnosis->peerState = LinkState::StandBy;
        const auto content = promptContent(incident, sessions, around(), start);
        const QStringList expected{QStringLiteral("Began 2023-11-14T22:13:20.250Z, incident 000000000000000b"),
                                   QStringLiteral("Robot: device 0x00008208 at 10.0.0.2:1 (patient)"),
                                   QStringLiteral("Cockpit: device 0x40018208 at 10.0.0.1:1 (surgeon)"),
                                   QStringLiteral("Robot said last: ") + word(LinkState::StandBy), QStringLiteral("Topology t, hash ")};
        QCOMPARE(content.details, expected);
        for (const auto& line : content.details)
            QVERIFY2(promptReport(content).contains(line), qPrintable(line));
        incident.peer = 0; // of others: what neither of them said to this console is not invented
        QCOMPARE(promptContent(incident, sessions, around(), start).details.size(), 4);
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
        seen.picture = PictureCondition::Frozen;
        seen.frozenSinceWallMs = 1'700'000'000'200;
        const auto frozen = promptContent(lost(robot), sessions, seen, start).picture;
        QVERIFY2(frozen.startsWith(QStringLiteral("Picture: frozen since ")) && frozen.endsWith(QStringLiteral(".2")), qPrintable(frozen));
        seen.picture = PictureCondition::Held; // no fault: the pedal is up
        const auto held = promptContent(lost(robot), sessions, seen, start).picture;
        QVERIFY2(held.startsWith(QStringLiteral("Picture: last image hold, of ")), qPrintable(held));
        seen.pictureRecorded = true;
        const auto recorded = promptContent(lost(robot), sessions, seen, start).picture;
        QCOMPARE(recorded, held + QStringLiteral(" (a recording)"));
        seen.pictureRecorded = false;
        seen.picture = PictureCondition::Live;
        seen.tipKnown = true;
        const auto content = promptContent(lost(robot), sessions, seen, start);
        QCOMPARE(content.picture, QStringLiteral("Picture: live"));
        QCOMPARE(content.tip, QStringLiteral("Tip position: last known"));
    }

    void saysNothingIsFrozenOrLiveThatIsNot()
    {
        SessionModel sessions;
        fill(sessions);
        auto seen = around();
        seen.picture = PictureCondition::Unknown;
        QCOMPARE(promptContent(lost(robot), sessions, seen, start).picture, QStringLiteral("Picture: new ones come, age unknown"));
        seen.picture = PictureCondition::Live;
        seen.pictureRecorded = true;
        QCOMPARE(promptContent(lost(robot), sessions, seen, start).picture, QStringLiteral("Picture: a recording, nothing to move by"));
        seen.rehearsal = true;
        QCOMPARE(promptContent(lost(robot), sessions, seen, start).picture, QStringLiteral("Picture: a recording, for a rehearsal"));
    }

    void givesTheEvidence()
    {
        SessionModel sessions;
        fill(sessions);
        const auto lines = promptContent(lost(robot), sessions, around(), start).evidence;
        QVERIFY(lines.contains(QStringLiteral("Heartbeats in the second before the loss: 44 of 50")));
        QVERIFY(lines.contains(QStringLiteral("Last round trip: 1.5 ms")));
        QVERIFY(lines.contains(QStringLiteral("Silent for 610 ms before it was given up")));
        QVERIFY(lines.contains(QStringLiteral("Our connection to it held, its connection to us held")));
    }

    void namesTheOtherLinksAndWhetherTheyAreOpen()
    {
        SessionModel sessions;
        fill(sessions);
        sessions.setLinkState(xray, LinkState::StandBy, start);
        const auto lines = promptContent(lost(robot), sessions, around(), start).evidence;
        const auto others = QStringLiteral("Other links of this console: Arm (same computer) open, X-ray (patient) not open");
        QVERIFY2(lines.contains(others), qPrintable(lines.join(QLatin1Char('\n'))));
        LinkFigures figures;
        figures.localAddress = QStringLiteral("10.0.0.1");
        sessions.setLinkFigures(robot, figures, start);
        sessions.setLinkFigures(arm, figures, start); // of the same computer, whatever it goes by
        sessions.setLinkFigures(xray, figures, start);
        const auto told = [&] { return promptContent(lost(robot), sessions, around(), start).evidence.join(QLatin1Char('\n')); };
        QVERIFY2(told().contains(QStringLiteral("Arm (same computer) open, X-ray (patient, same interface) not open")), qPrintable(told()));
        figures.localAddress = QStringLiteral("10.0.1.1");
        sessions.setLinkFigures(xray, figures, start);
        QVERIFY2(told().contains(QStringLiteral("X-ray (patient, by 10.0.1.1) not open")), qPrintable(told()));
        sessions.setTopology({});
        QVERIFY(!promptContent(lost(robot), sessions, around(), start).evidence.join(QLatin1Char(' ')).contains(QStringLiteral("Other")));
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

    void incidentOfOthersSaysWhetherThisConsolesLinksStand_data()
    {
        QTest::addColumn<LinkState>("toRobot");
        QTest::addColumn<LinkState>("toArm");
        QTest::addColumn<LinkState>("toXray");
        QTest::addColumn<QString>("cause");
        const auto row = [](const char* name, LinkState robots, LinkState arms, LinkState xrays, const char* cause) {
            QTest::newRow(name) << robots << arms << xrays << QString::fromLatin1(cause);
        };
        const auto apart = "Between those two devices; this console's links are not concerned";
        const auto one = "Not only between those two: this console's link to Robot is lost, too; its own prompt says more";
        const auto both = "Not only between those two: this console's links to both are lost, too; their own prompts say more";
        row("both stand", LinkState::Open, LinkState::Suspect, LinkState::Open, apart);
        row("another is lost", LinkState::Open, LinkState::Open, LinkState::StandBy, apart);
        row("one is lost", LinkState::StandBy, LinkState::Open, LinkState::Open, one);
        row("one is being re-opened", LinkState::Reopening, LinkState::Open, LinkState::Open, one);
        row("both are lost", LinkState::StandBy, LinkState::StandBy, LinkState::Open, both);
        row("one may heal", LinkState::Reconnecting, LinkState::Open, LinkState::Open, "Between those two devices");
        row("one is closed", LinkState::Open, LinkState::Closed, LinkState::Open, "Between those two devices");
    }

    void incidentOfOthersSaysWhetherThisConsolesLinksStand()
    {
        QFETCH(LinkState, toRobot);
        QFETCH(LinkState, toArm);
        QFETCH(LinkState, toXray);
        QFETCH(QString, cause);
        SessionModel sessions;
        fill(sessions);
        sessions.setLinkState(robot, toRobot, start);
        sessions.setLinkState(arm, toArm, start);
        sessions.setLinkState(xray, toXray, start);
        auto incident = lost(robot);
        incident.a = robot;
        incident.b = arm;
        incident.peer = 0;
        QCOMPARE(promptContent(incident, sessions, around(), start).likelyCause, cause);
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
        auto later = lost(robot);
        later.since = start + 500ms;
        model.raise(later, start + 500ms);
        QCOMPARE(decided.size(), 1);
        QCOMPARE(decided.front().at(0).toULongLong(), interruption);
        QCOMPARE(decided.front().at(1).toULongLong(), quint64(11));
        QVERIFY(model.interruptions().empty());
        QCOMPARE(model.incident(11)->flaps, 1);             // one loss, told twice
        QCOMPARE(model.incident(11)->since, start);         // its time runs on
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
        QCOMPARE(content.patient, QStringLiteral("Not confirmed yet that Robot holds. Its own guard should stop it."));
        auto seen = around();
        seen.robotHeldAt = start - 1ms; // before the interruption: it says nothing of now
        QVERIFY(!promptContent(model.interruptions().front(), sessions, seen, start + 200ms).holdConfirmed);
        seen.robotHeldAt = start + 40ms;
        content = promptContent(model.interruptions().front(), sessions, seen, start + 200ms);
        QVERIFY(content.holdConfirmed);
        QCOMPARE(content.patient, QStringLiteral("Robot holds: CONFIRMED by its own report"));
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
