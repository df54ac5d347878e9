// The links a device opens by itself: again and again from closed, never out of stand-by without a person.
#include "link_keeper.hpp"

#include <QTest>

using namespace liena;
using namespace liena::devices;
using namespace std::chrono_literals;

namespace {

const DeviceId cockpit(0x40018208);
const DeviceId robot(0x00008208);
const DeviceId arm(0x60008208);
const DeviceId xray(0x20010208);
const SteadyTime start{1h};

struct Rig {
    LinkKeeper keeper{arm, {robot}};
    SteadyTime now = start;

    void tell(SessionEvent::Kind kind, RejectReason reason = RejectReason::None)
    {
        SessionEvent event;
        event.kind = kind;
        event.peer = robot;
        event.reason = reason;
        keeper.handle(event, now);
    }
    void reopened(DeviceId peer)
    {
        SessionEvent event;
        event.kind = SessionEvent::Kind::ReOpened;
        event.peer = peer;
        keeper.handle(event, now);
    }
    void ended(DeviceId a, DeviceId b, bool dismissed = false)
    {
        SessionEvent event;
        event.kind = SessionEvent::Kind::IncidentEnded;
        event.incident.a = std::min(a, b);
        event.incident.b = std::max(a, b);
        event.dismissed = dismissed;
        keeper.handle(event, now);
    }
    // What is wished for within `duration`, one letter a try: o open, r re-open.
    QByteArray wishes(std::chrono::milliseconds duration)
    {
        QByteArray all;
        for (const SteadyTime end = now + duration; now < end; now += 100ms)
            for (const auto& wish : keeper.due(now))
                all += wish.act == LinkKeeper::Act::Open ? 'o' : 'r';
        return all;
    }
};

using Kind = SessionEvent::Kind;

} // namespace

class LinkKeeperTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void opensEverySecondUntilItIsOpen()
    {
        Rig rig;
        QCOMPARE(rig.wishes(3s), QByteArray("ooo"));
        rig.tell(Kind::OpenFailed, RejectReason::Timeout);
        QCOMPARE(rig.wishes(900ms), QByteArray());
        QCOMPARE(rig.wishes(1s), QByteArray("o"));
        rig.tell(Kind::Opened);
        QCOMPARE(rig.wishes(10s), QByteArray());
    }

    void neverLeavesStandByByItself()
    {
        Rig rig;
        rig.tell(Kind::Opened);
        rig.tell(Kind::Lost);
        QCOMPARE(rig.wishes(60s), QByteArray());
    }

    void followsThePersonsReopen_data()
    {
        QTest::addColumn<quint32>("a");
        QTest::addColumn<quint32>("b");
        QTest::addColumn<bool>("dismissed");
        QTest::addColumn<QByteArray>("expected");
        QTest::newRow("cockpit and robot") << cockpit.value() << robot.value() << false << QByteArray("rrrrr");
        QTest::newRow("cockpit and us") << cockpit.value() << arm.value() << false << QByteArray("rrrrr");
        QTest::newRow("given up") << cockpit.value() << robot.value() << true << QByteArray();
        QTest::newRow("cockpit and another") << cockpit.value() << xray.value() << false << QByteArray();
        QTest::newRow("no person between machines") << xray.value() << robot.value() << false << QByteArray();
    }

    void followsThePersonsReopen()
    {
        QFETCH(quint32, a);
        QFETCH(quint32, b);
        QFETCH(bool, dismissed);
        QFETCH(QByteArray, expected);
        Rig rig;
        rig.tell(Kind::Opened);
        rig.tell(Kind::Lost);
        rig.ended(DeviceId(a), DeviceId(b), dismissed);
        QCOMPARE(rig.wishes(30s), expected);
    }

    void followingEndsWithSuccess()
    {
        Rig rig;
        rig.tell(Kind::Lost);
        rig.ended(cockpit, robot);
        QCOMPARE(rig.wishes(100ms), QByteArray("r"));
        rig.tell(Kind::ReOpened);
        QCOMPARE(rig.wishes(30s), QByteArray());
    }

    void aNewLossEndsTheFollowing()
    {
        Rig rig;
        rig.tell(Kind::Lost);
        rig.ended(cockpit, robot);
        rig.wishes(100ms);
        rig.tell(Kind::Lost);
        QCOMPARE(rig.wishes(30s), QByteArray());
    }

    void peerThatRemembersAnIncidentWaitsForAPerson()
    {
        Rig rig;
        QCOMPARE(rig.wishes(100ms), QByteArray("o"));
        rig.tell(Kind::OpenFailed, RejectReason::StandBy);
        QCOMPARE(rig.wishes(30s), QByteArray());
        rig.ended(cockpit, arm);
        QVERIFY(rig.wishes(1s).startsWith("r"));
    }

    /// A restarted device holds no incident: that a person re-opened it is all that it hears.
    void aRestartedDeviceFollowsTheCockpitThatReopensIt()
    {
        Rig rig;
        QCOMPARE(rig.wishes(100ms), QByteArray("o"));
        rig.tell(Kind::OpenFailed, RejectReason::StandBy);
        QCOMPARE(rig.wishes(30s), QByteArray());
        rig.reopened(cockpit);
        QCOMPARE(rig.wishes(30s), QByteArray("rrrrr"));
    }

    /// Before the peer was there to say that it holds an incident.
    void aReopenIsKeptUntilThePeerTellsOfItsIncident_data()
    {
        QTest::addColumn<bool>("byAnEnd");
        QTest::newRow("a channel of our own") << false;
        QTest::newRow("an incident that ended") << true;
    }

    void aReopenIsKeptUntilThePeerTellsOfItsIncident()
    {
        QFETCH(bool, byAnEnd);
        Rig rig;
        QCOMPARE(rig.wishes(100ms), QByteArray("o"));
        rig.tell(Kind::OpenFailed, RejectReason::Timeout);
        if (byAnEnd)
            rig.ended(cockpit, arm);
        else
            rig.reopened(cockpit);
        QCOMPARE(rig.wishes(1100ms), QByteArray("o")); // there may be none: it is opened as before
        rig.tell(Kind::OpenFailed, RejectReason::StandBy);
        QCOMPARE(rig.wishes(30s), QByteArray("rrrrr"));
    }

    void aReopenIsNoneForALaterLoss()
    {
        Rig rig;
        rig.reopened(cockpit);
        rig.tell(Kind::Opened);
        rig.tell(Kind::Closed);
        rig.tell(Kind::OpenFailed, RejectReason::StandBy);
        QCOMPARE(rig.wishes(30s), QByteArray());
    }

    void aRestartedDeviceFollowsNoMachine()
    {
        Rig rig;
        rig.tell(Kind::OpenFailed, RejectReason::StandBy);
        rig.reopened(xray);
        QCOMPARE(rig.wishes(30s), QByteArray());
    }

    void aReopenLeavesWhatIsNotLost()
    {
        Rig waiting;
        waiting.reopened(cockpit);
        QCOMPARE(waiting.wishes(3s), QByteArray("ooo"));
        Rig up;
        up.tell(Kind::Opened);
        up.reopened(cockpit);
        QCOMPARE(up.wishes(30s), QByteArray());
        up.tell(Kind::Lost); // after the person's command, which was not given for this loss
        QCOMPARE(up.wishes(30s), QByteArray());
    }

    void aReopenLeavesWhatAPersonClosedOrGaveUp()
    {
        Rig closed;
        closed.keeper.closedByPerson(robot);
        closed.reopened(cockpit);
        QCOMPARE(closed.wishes(30s), QByteArray());
        Rig givenUp;
        givenUp.tell(Kind::Lost);
        givenUp.ended(arm, robot, true);
        givenUp.reopened(cockpit);
        QCOMPARE(givenUp.wishes(30s), QByteArray());
    }

    void opensAgainAfterAnOrderlyClose()
    {
        Rig rig;
        rig.tell(Kind::Opened);
        rig.tell(Kind::Closed);
        QCOMPARE(rig.wishes(1100ms), QByteArray("o"));
    }

    void leavesWhatAPersonClosed()
    {
        Rig rig;
        rig.tell(Kind::Opened);
        rig.keeper.closedByPerson(robot);
        rig.tell(Kind::Closed);
        QCOMPARE(rig.wishes(30s), QByteArray());
        rig.keeper.openedByPerson(robot, rig.now);
        QCOMPARE(rig.wishes(1100ms), QByteArray("o"));
    }

    void leavesALinkWhoseIncidentWasGivenUp()
    {
        Rig rig;
        rig.tell(Kind::Lost);
        rig.ended(arm, robot, true);
        rig.ended(cockpit, robot);
        QCOMPARE(rig.wishes(30s), QByteArray());
    }
};

QTEST_GUILESS_MAIN(LinkKeeperTest)
#include "link_keeper_test.moc"
