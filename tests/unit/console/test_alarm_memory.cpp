// What an alarm remembers of a moment ago: that it was armed, that a hold is awaited, that a link is lost, that something never came.
#include "watched_cockpit.hpp"

#include <QTest>

#include <algorithm>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;
using C = AlarmCondition;

namespace {

void setLink(Watched& w, quint32 peer, LinkState state) { w.models().sessions.setLinkState(peer, state, w.now); }

/// What is told of the permit is told now: the clock of the test goes on from there.
void goOn(Watched& w)
{
    w.now = std::chrono::steady_clock::now() + 1ms;
    w.receive(w.robot());
}

/// Looked at before and after: a look comes ten times a second.
void pass(Watched& w, Duration time)
{
    w.look();
    w.now += time;
    w.look();
}

/// Motion ended, the robot holds, and the hand let go; the pedal is up.
void settle(Watched& w)
{
    goOn(w);
    w.models().picture.expect(0, w.now);
    w.robotHolds();
    w.tell(PermitEventKind::DeadManReleased);
}

int ended(Watched& w, const QString& words)
{
    const auto& log = w.models().alarms.log();
    return int(std::count_if(log.begin(), log.end(), [&words](const AlarmLogEntry& entry) {
        return entry.text.startsWith(QStringLiteral("ended")) && entry.text.contains(words);
    }));
}

/// `peer`: 0 for one of two other devices.
void raiseIncident(Watched& w, quint64 id, quint32 a, quint32 b, quint32 peer, bool robotHolds)
{
    IncidentRecord record;
    record.id = id;
    record.a = a;
    record.b = b;
    record.peer = peer;
    record.since = w.now;
    record.holds = {{robotId, QStringLiteral("Vascular robot"), robotHolds, {}}};
    w.models().incidents.raise(record, w.now);
    w.tell(PermitEventKind::SystemStandsBy);
}

} // namespace

class TestAlarmMemory : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void someTimeAfterAHoldAlarmsAreNoLongerOfAnArmedTime_data()
    {
        QTest::addColumn<bool>("closed");
        QTest::newRow("held, and in stand-by again") << false;
        QTest::newRow("closed while armed") << true;
    }

    void someTimeAfterAHoldAlarmsAreNoLongerOfAnArmedTime()
    {
        QFETCH(bool, closed);
        Watched w;
        w.cockpit.arm();
        w.cockpit.engage();
        w.tell(closed ? PermitEventKind::SessionClosed : PermitEventKind::PanicHold);
        settle(w);
        QCOMPARE(w.models().permit.phase(), closed ? PermitPhase::Off : PermitPhase::Standby);
        pass(w, 10s);
        setLink(w, xrayId, LinkState::Reconnecting);
        QVERIFY(!w.priorityOf(C::ImageLost)); // it may heal
        setLink(w, xrayId, LinkState::StandBy);
        QCOMPARE(w.priorityOf(C::ImageLost), std::optional(AlarmPriority::Medium));
        w.models().picture.expect(15, w.now);
        pass(w, 2s);
        QCOMPARE(w.priorityOf(C::PictureStale), std::optional(AlarmPriority::Low));
    }

    void whatIsFoundDuringOrSoonAfterAHoldIsUrgent_data()
    {
        QTest::addColumn<bool>("over");
        QTest::addColumn<int>("passed");
        QTest::newRow("soon after it") << true << 9900;
        QTest::newRow("while it lasts") << false << 60'000;
    }

    void whatIsFoundDuringOrSoonAfterAHoldIsUrgent()
    {
        QFETCH(bool, over);
        QFETCH(int, passed);
        Watched w;
        w.cockpit.arm();
        w.tell(PermitEventKind::PanicHold);
        over ? settle(w) : goOn(w);
        pass(w, std::chrono::milliseconds(passed));
        setLink(w, xrayId, LinkState::Reconnecting);
        QCOMPARE(w.priorityOf(C::ImageLost), std::optional(AlarmPriority::High));
    }

    /// Else its alarm would end while nothing has got better.
    void anInterruptionThatEndedMotionStaysUrgentUntilItIsDecided()
    {
        Watched w;
        w.cockpit.arm();
        setLink(w, xrayId, LinkState::Reconnecting);
        w.tell(PermitEventKind::SessionInterrupted);
        settle(w);
        QCOMPARE(w.models().permit.phase(), PermitPhase::Standby);
        const auto raised = w.idOf(C::ImageLost);
        QVERIFY(raised != 0);
        pass(w, 1min);
        QCOMPARE(w.idOf(C::ImageLost), raised);
        setLink(w, xrayId, LinkState::StandBy);
        QCOMPARE(w.idOf(C::ImageLost), raised);
        QCOMPARE(w.priorityOf(C::ImageLost), std::optional(AlarmPriority::High));
    }

    void aHoldThatNobodyConfirmsIsOneAlarmThroughTheStandByThatFollows()
    {
        Watched w;
        w.cockpit.arm();
        setLink(w, robotId, LinkState::Reconnecting);
        w.tell(PermitEventKind::SessionInterrupted);
        w.now = std::chrono::steady_clock::now() + 200ms + 1ns; // just over: the loss that follows is less than that ago
        const auto raised = w.idOf(C::HoldNotConfirmed);
        QVERIFY(raised != 0);
        setLink(w, robotId, LinkState::StandBy);
        w.tell(PermitEventKind::SessionClosed);
        raiseIncident(w, 1, robotId, cockpitId, robotId, false);
        QCOMPARE(w.models().permit.phase(), PermitPhase::Incident);
        QCOMPARE(w.idOf(C::HoldNotConfirmed), raised);
        QCOMPARE(ended(w, QStringLiteral("NOT CONFIRMED")), 0);
        w.models().incidents.setHolds(1, {{robotId, QStringLiteral("Vascular robot"), true, {}}});
        QCOMPARE(w.idOf(C::HoldNotConfirmed), quint64(0));
    }

    void aHoldThatWasConfirmedBeforeALossIsAwaitedFromTheLossOn()
    {
        Watched w;
        raiseIncident(w, 1, robotId, armId, 0, false);
        goOn(w);
        QVERIFY(w.robot().holdConfirmed); // and nobody looked in between
        w.now += 1s;
        setLink(w, robotId, LinkState::StandBy);
        QCOMPARE(w.idOf(C::HoldNotConfirmed), quint64(0));
        w.now += 201ms;
        QVERIFY(w.idOf(C::HoldNotConfirmed) != 0);
    }

    void theRobotsLinkThatIsLostInAnIncidentOfOthersIsAwaitedToo()
    {
        Watched w;
        raiseIncident(w, 1, robotId, armId, 0, true);
        goOn(w);
        QCOMPARE(w.idOf(C::HoldNotConfirmed), quint64(0));
        w.now += 1s;
        setLink(w, robotId, LinkState::StandBy);
        QCOMPARE(w.idOf(C::HoldNotConfirmed), quint64(0));
        w.now += 201ms;
        QVERIFY(w.idOf(C::HoldNotConfirmed) != 0);
        raiseIncident(w, 2, robotId, cockpitId, robotId, true);
        QCOMPARE(w.idOf(C::HoldNotConfirmed), quint64(0));
    }

    void aRobotThatAnotherConsoleHasArmedNeedNotConfirmAHold_data()
    {
        QTest::addColumn<bool>("incident");
        QTest::addColumn<quint32>("owner");
        QTest::addColumn<bool>("awaited");
        QTest::newRow("armed by another console") << false << cockpitId + 1 << false;
        QTest::newRow("armed by this one") << false << quint32(cockpitId) << true;
        QTest::newRow("armed by nobody") << false << quint32(0) << true;
        QTest::newRow("armed by another console, in an incident") << true << cockpitId + 1 << true;
    }

    /// It was asked to arm at the same moment, and took the other one; this console stopped before it heard so.
    void aRobotThatAnotherConsoleHasArmedNeedNotConfirmAHold()
    {
        QFETCH(bool, incident);
        QFETCH(quint32, owner);
        QFETCH(bool, awaited);
        Watched w;
        w.tell(PermitEventKind::ArmPressed);
        w.now += 1500ms;
        w.tell(PermitEventKind::Tick);
        QVERIFY(w.models().permit.state().awaitingRobot);
        if (incident)
            raiseIncident(w, 1, robotId, armId, 0, false);
        else
            w.tell(PermitEventKind::PanicHold);
        w.now = std::chrono::steady_clock::now() + 1ms;
        auto status = w.robot();
        status.state = RobotState::Armed;
        status.holdConfirmed = false;
        status.owner = owner;
        w.receive(status);
        w.look();
        QCOMPARE(w.watch.holdAwaited(), awaited);
        w.now += 201ms;
        QCOMPARE(w.idOf(C::HoldNotConfirmed) != 0, awaited);
    }

    void aReopeningThatFailsLeavesTheAlarmOfTheLossAsItIs_data()
    {
        QTest::addColumn<quint32>("peer");
        QTest::addColumn<int>("condition");
        QTest::newRow("robot") << quint32(robotId) << int(C::LinkLost);
        QTest::newRow("picture link") << quint32(xrayId) << int(C::ImageLost);
    }

    void aReopeningThatFailsLeavesTheAlarmOfTheLossAsItIs()
    {
        QFETCH(quint32, peer);
        QFETCH(int, condition);
        Watched w;
        setLink(w, peer, LinkState::StandBy);
        const auto raised = w.idOf(C(condition));
        w.models().alarms.acknowledge(raised, 0);
        for (int i = 0; i < 3; ++i) {
            setLink(w, peer, LinkState::Reopening);
            QCOMPARE(w.idOf(C(condition)), raised);
            setLink(w, peer, LinkState::StandBy);
            QCOMPARE(w.idOf(C(condition)), raised);
        }
        QCOMPARE(ended(w, QStringLiteral("stand-by")), 0);
        QVERIFY(!w.priorityOf(C::LinkUnsteady)); // it was lost once
        setLink(w, peer, LinkState::Reopening);
        setLink(w, peer, LinkState::Open);
        QCOMPARE(w.idOf(C(condition)), quint64(0));
    }

    /// The system stands by, and none of this console's links is concerned.
    void aLinkOfTwoOthersThatIsLostIsAnAlarmUntilItIsOpenAgain()
    {
        Watched w;
        w.cockpit.arm();
        raiseIncident(w, 1, robotId, armId, 0, true);
        QCOMPARE(w.models().permit.phase(), PermitPhase::Incident);
        QCOMPARE(w.priorityOf(C::LinkLost), std::optional(AlarmPriority::High));
        const auto raised = w.idOf(C::LinkLost);
        setLink(w, robotId, LinkState::StandBy); // that is another alarm, and does not end this one
        raiseIncident(w, 2, robotId, cockpitId, robotId, true);
        w.look();
        QCOMPARE(w.models().alarms.count(AlarmPriority::High), 2);
        QCOMPARE(ended(w, QStringLiteral("Link between")), 0);
        w.models().alarms.acknowledge(raised, 0);
        w.models().incidents.end(1);
        w.look();
        QCOMPARE(ended(w, QStringLiteral("Link between")), 1);
    }

    /// A device that dies is one alarm, and not one for each of its links.
    void whatALostDeviceLostBesideIsNotToldAgain()
    {
        Watched w;
        setLink(w, robotId, LinkState::Suspect);
        raiseIncident(w, 1, robotId, armId, 0, false);
        QVERIFY(!w.priorityOf(C::LinkLost)); // not known yet
        setLink(w, robotId, LinkState::StandBy);
        raiseIncident(w, 2, robotId, cockpitId, robotId, false);
        raiseIncident(w, 3, robotId, xrayId, 0, false);
        const auto raised = w.idOf(C::LinkLost);
        QVERIFY(raised != 0);
        setLink(w, robotId, LinkState::Open);
        w.models().incidents.end(2);
        QVERIFY(!w.priorityOf(C::LinkLost)); // the others follow
    }

    /// The system stands by, and only one of those two can re-open it.
    void whatDoesNotFollowThisConsolesOwnLinkIsAnAlarm()
    {
        Watched w;
        setLink(w, robotId, LinkState::StandBy);
        raiseIncident(w, 2, robotId, cockpitId, robotId, true);
        raiseIncident(w, 1, robotId, armId, 0, true);
        const auto lost = [&w] {
            const auto& all = w.models().alarms.alarms();
            return int(std::count_if(all.begin(), all.end(), [](const Alarm& one) { return one.condition == C::LinkLost && one.present; }));
        };
        pass(w, 1h);
        QCOMPARE(lost(), 1); // that of its own link tells both
        setLink(w, robotId, LinkState::Reopening);
        pass(w, 5s);
        setLink(w, robotId, LinkState::Open);
        pass(w, 1900ms);
        setLink(w, robotId, LinkState::StandBy); // lost again: that tells both again
        pass(w, 5s);
        QCOMPARE(lost(), 1);
        setLink(w, robotId, LinkState::Reopening);
        setLink(w, robotId, LinkState::Open);
        w.models().incidents.end(2);
        pass(w, 1900ms);
        QVERIFY(!w.priorityOf(C::LinkLost)); // the others may follow
        w.now += 100ms;
        QCOMPARE(w.priorityOf(C::LinkLost), std::optional(AlarmPriority::Medium));
        const auto raised = w.idOf(C::LinkLost);
        pass(w, 1h);
        QCOMPARE(w.idOf(C::LinkLost), raised);
        w.models().incidents.end(1);
        QCOMPARE(w.idOf(C::LinkLost), quint64(0));
    }

    void aLinkOfTwoOthersIsToldWhenThisConsolesOwnHealed()
    {
        Watched w;
        setLink(w, robotId, LinkState::Suspect);
        raiseIncident(w, 1, robotId, armId, 0, false);
        QVERIFY(!w.priorityOf(C::LinkLost));
        setLink(w, robotId, LinkState::Open);
        QCOMPARE(w.priorityOf(C::LinkLost), std::optional(AlarmPriority::Medium));
    }

    /// Dose is given, and there is nothing that could be called frozen.
    void aRunWithoutAnyPictureIsAnAlarm()
    {
        Watched w(false);
        setLink(w, xrayId, LinkState::Open);
        w.models().picture.setLinkUp(true);
        pass(w, 1h);
        QVERIFY(!w.priorityOf(C::PictureStale)); // the pedal is up
        w.models().picture.expect(15, w.now);
        pass(w, 1s);
        QVERIFY(!w.priorityOf(C::PictureStale));
        pass(w, 1ms);
        QCOMPARE(w.models().picture.reading(w.now).condition, PictureCondition::None);
        QCOMPARE(w.priorityOf(C::PictureStale), std::optional(AlarmPriority::Low));
        w.models().picture.expect(0, w.now);
        QVERIFY(w.ends(C::PictureStale));
    }

    /// Then it is neither the line nor the pedal; what was refused in a run before is not of this one.
    void picturesThatAreRefusedAreNotCalledMissing()
    {
        Watched w(false);
        setLink(w, xrayId, LinkState::Open);
        auto& picture = w.models().picture;
        picture.setLinkUp(true);
        for (const bool refuses : {true, false, true}) {
            picture.expect(15, w.now);
            if (refuses)
                picture.noteRefused(QStringLiteral("17 bits are not known"));
            pass(w, 2s);
            const auto& all = w.models().alarms.alarms();
            const auto found = std::find_if(all.begin(), all.end(), [](const Alarm& one) { return one.condition == C::PictureStale; });
            QVERIFY(found != all.end());
            QCOMPARE(found->text,
                     refuses ? QStringLiteral("Pictures are refused: 17 bits are not known") : QStringLiteral("No picture is shown"));
            picture.expect(0, w.now);
            QVERIFY(w.ends(C::PictureStale));
        }
    }

    /// The library tells a gap once, when it begins.
    void aReportThatNeverCameIsAnAlarmUntilItComes()
    {
        Watched w(false);
        setLink(w, robotId, LinkState::Open);
        w.watch.noteDeadlineMissed(robotId, QStringLiteral("TipPose"), w.now);
        w.watch.noteDeadlineMissed(robotId, QStringLiteral("PumpFlow"), w.now); // of another set: not kept
        pass(w, 6s);
        const auto text = [&w] {
            w.look();
            const auto& all = w.models().alarms.alarms();
            const auto found = std::find_if(all.begin(), all.end(), [](const Alarm& one) { return one.condition == C::DeadlineMissed; });
            return found == all.end() ? QString() : found->text;
        };
        QVERIFY2(text().contains(QStringLiteral("position of the tip")), qPrintable(text()));
        pass(w, 1min);
        QVERIFY2(text().contains(QStringLiteral("position of the tip")), qPrintable(text()));
        w.now += 100ms;
        w.models().instrument.receiveTip(TipPose{}, w.now);
        QVERIFY(w.ends(C::DeadlineMissed));
    }
};

QTEST_GUILESS_MAIN(TestAlarmMemory)
#include "test_alarm_memory.moc"
