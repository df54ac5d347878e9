// Which alarms there are while instruments are armed and after a stop or a loss, and how urgent each is then.
#include "watched_cockpit.hpp"

#include <QTest>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;
using C = AlarmCondition;

class TestAlarmUrgency : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aPictureThatFrozeWhileEngagedIsUrgentThoughMotionHasEnded()
    {
        Watched w;
        w.cockpit.arm();
        w.cockpit.engage();
        w.now += 2s;
        w.receive(w.robot());
        PermitEvent guards; // none of them is kept
        guards.kind = PermitEventKind::GuardsChecked;
        w.models().permit.apply(guards, w.now);
        QCOMPARE(w.models().permit.phase(), PermitPhase::Hold);
        QCOMPARE(w.priorityOf(C::PictureStale), std::optional(AlarmPriority::High));
    }

    /// In order, so there is no incident; it is open again, or what came of it is long settled.
    void aLinkThatIsClosedWhileArmedIsUrgentUntilItIsOpenAgain()
    {
        for (const auto& [peer, condition] : {std::pair(armId, C::LinkLost), std::pair(xrayId, C::ImageLost)}) {
            Watched w;
            w.models().sessions.setLinkState(peer, LinkState::Closing, w.now);
            w.models().sessions.setLinkState(peer, LinkState::Closed, w.now);
            QVERIFY(!w.priorityOf(condition)); // nothing was armed
            w.models().sessions.setLinkState(peer, LinkState::Open, w.now);
            w.cockpit.arm();
            w.models().sessions.setLinkState(peer, LinkState::Closing, w.now);
            w.models().sessions.setLinkState(peer, LinkState::Closed, w.now);
            w.tell(PermitEventKind::SessionInterrupted);
            QCOMPARE(w.priorityOf(condition), std::optional(AlarmPriority::High));
            w.models().sessions.setLinkState(peer, LinkState::Open, w.now);
            QVERIFY(!w.priorityOf(condition));
            QVERIFY(w.models().alarms.unacknowledgedHigh()); // it latches
        }
    }

    void whatHoldsIsNotConfirmedAfterTheStop()
    {
        Watched w;
        w.cockpit.arm();
        w.cockpit.engage();
        w.now = std::chrono::steady_clock::now();
        PermitEvent panic;
        panic.kind = PermitEventKind::PanicHold;
        w.models().permit.apply(panic, w.now);
        w.now = std::chrono::steady_clock::now() + 201ms;
        QCOMPARE(w.priorityOf(C::HoldNotConfirmed), AlarmPriority::High);
        auto held = w.robot();
        held.holdConfirmed = true;
        w.receive(held);
        QVERIFY(!w.priorityOf(C::HoldNotConfirmed));
    }

    void afterALossTheRobotMustHoldWhateverItDidBefore_data()
    {
        QTest::addColumn<bool>("linkFirst"); // the link's end may be told before the incident
        QTest::newRow("the incident is told first") << false;
        QTest::newRow("the link's end is told first") << true;
    }

    void afterALossTheRobotMustHoldWhateverItDidBefore()
    {
        QFETCH(bool, linkFirst);
        Watched w;
        w.now = std::chrono::steady_clock::now();
        if (linkFirst) {
            w.models().sessions.setLinkState(robotId, LinkState::StandBy, w.now);
            PermitEvent closed;
            closed.kind = PermitEventKind::SessionClosed;
            w.models().permit.apply(closed, w.now);
            QCOMPARE(w.models().permit.phase(), PermitPhase::Off);
        }
        PermitEvent loss;
        loss.kind = PermitEventKind::SystemStandsBy;
        w.models().permit.apply(loss, w.now);
        w.now = std::chrono::steady_clock::now() + 100ms;
        QVERIFY(!w.priorityOf(C::HoldNotConfirmed));
        w.now += 101ms;
        QCOMPARE(w.priorityOf(C::HoldNotConfirmed), AlarmPriority::Medium);
        auto held = w.robot();
        held.holdConfirmed = true;
        w.receive(held);
        QVERIFY(!w.priorityOf(C::HoldNotConfirmed));
    }

    void theDrivesReportFromBeforeALossIsNoFaultUntilANewOneIsOverdue()
    {
        Watched w;
        w.cockpit.arm();
        w.now = std::chrono::steady_clock::now();
        w.models().sessions.setLinkState(robotId, LinkState::StandBy, w.now);
        PermitEvent loss;
        loss.kind = PermitEventKind::SystemStandsBy;
        w.models().permit.apply(loss, w.now);
        w.now += 3s;
        w.models().sessions.setLinkState(robotId, LinkState::Open, w.now);
        auto held = w.robot();
        held.holdConfirmed = true;
        w.now += 500ms;
        w.receive(held);
        QVERIFY(!w.priorityOf(C::DriveFault));
        w.now += 501ms;
        w.receive(held);
        QCOMPARE(w.priorityOf(C::DriveFault), AlarmPriority::High);
        w.models().instrument.receiveDrives(w.models().instrument.drives().value, w.now);
        QVERIFY(w.ends(C::DriveFault));
    }

    void aDriveThatIsOffWhileArmedIsUrgent()
    {
        Watched w;
        auto drives = w.models().instrument.drives().value;
        drives.enabled = {true, true, false, true};
        w.models().instrument.receiveDrives(drives, w.now);
        QVERIFY(!w.priorityOf(C::DriveFault)); // the robot switches them on when it is armed
        w.cockpit.arm();
        w.now = std::chrono::steady_clock::now() + 400ms;
        w.models().instrument.receiveDrives(drives, w.now);
        w.receive(w.robot());
        QVERIFY(!w.priorityOf(C::DriveFault));
        w.now += 200ms;
        w.models().instrument.receiveDrives(drives, w.now);
        w.receive(w.robot());
        QCOMPARE(w.priorityOf(C::DriveFault), AlarmPriority::High);
    }

    void limitsAreToldWhileArmed()
    {
        Watched w;
        auto status = w.robot();
        status.limitSwitches = GuidewireSoftHigh;
        w.receive(status);
        QVERIFY(!w.priorityOf(C::SoftLimit));
        w.cockpit.arm();
        status.state = RobotState::Armed;
        w.receive(status);
        QCOMPARE(w.priorityOf(C::SoftLimit), AlarmPriority::Low);
        status.limitSwitches = GuidewireHardHigh;
        w.receive(status);
        QCOMPARE(w.priorityOf(C::HardLimit), AlarmPriority::Medium);
    }

    void anInterruptionIsUrgentWhenArmedAndElseWaitsForTheDecision()
    {
        Watched w;
        w.models().sessions.setLinkState(robotId, LinkState::Reconnecting, w.now);
        QVERIFY(!w.priorityOf(C::LinkLost));
        w.models().sessions.setLinkState(robotId, LinkState::Open, w.now);
        w.cockpit.arm();
        w.models().sessions.setLinkState(robotId, LinkState::Reconnecting, w.now);
        PermitEvent interrupted;
        interrupted.kind = PermitEventKind::SessionInterrupted;
        w.models().permit.apply(interrupted, w.now);
        QCOMPARE(w.priorityOf(C::LinkLost), AlarmPriority::High);
        const auto raised = w.models().alarms.raisedInAll();
        w.models().sessions.setLinkState(robotId, LinkState::StandBy, w.now);
        QCOMPARE(w.priorityOf(C::LinkLost), AlarmPriority::High);
        QCOMPARE(w.models().alarms.raisedInAll(), raised); // the same alarm, with the decision in its words
        QVERIFY2(w.models().alarms.highest()->text.contains(QStringLiteral("stand-by")), qPrintable(w.models().alarms.highest()->text));
    }

    void anInterruptedPictureLinkIsUrgentWhenArmed()
    {
        Watched w;
        w.cockpit.arm();
        w.models().sessions.setLinkState(xrayId, LinkState::Reconnecting, w.now);
        QCOMPARE(w.priorityOf(C::ImageLost), AlarmPriority::High);
        QVERIFY(!w.priorityOf(C::LinkLost));
    }
};

QTEST_GUILESS_MAIN(TestAlarmUrgency)
#include "test_alarm_urgency.moc"
