// What an alarm remembers of a moment ago: that it was armed, that a hold is awaited, that a link is lost, that a report never came.
#include "watched_cockpit.hpp"

#include <QTest>

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

    void whatIsFoundSoonAfterAHoldIsUrgent()
    {
        Watched w;
        w.cockpit.arm();
        w.tell(PermitEventKind::PanicHold);
        settle(w);
        pass(w, 9900ms);
        setLink(w, xrayId, LinkState::Reconnecting);
        QCOMPARE(w.priorityOf(C::ImageLost), std::optional(AlarmPriority::High));
    }

    void whileItHoldsEverythingIsUrgent()
    {
        Watched w;
        w.cockpit.arm();
        w.tell(PermitEventKind::PanicHold);
        goOn(w);
        pass(w, 1min);
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
};

QTEST_GUILESS_MAIN(TestAlarmMemory)
#include "test_alarm_memory.moc"
