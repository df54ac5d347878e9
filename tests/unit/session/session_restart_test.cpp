// A handshake that is read first after a stall of our own (section 8, Restart).
#include "session_side.hpp"

#include <QTest>

using namespace liena;
using namespace liena::test;
using namespace liena::session;

class SessionRestartTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void handshakeReadFirstAfterAStallWaitsForItsProof_data();
    void handshakeReadFirstAfterAStallWaitsForItsProof();
    void newerOneTakesItsPlace();
    void lossThatItNamesIsBelievedAtOnce();
    void restartIsNamedWhenNothingComes();
    void interruptionThatFollowsIsNotAStall();

private:
    /// Interrupted by a stall of its own, and nothing was read since.
    static void becomeStalled(Side& side)
    {
        side.becomeOpen();
        side.pass(80ms);
        side.handle(Stalled{80ms});
        QVERIFY(side.machine.state() == SessionState::Reconnecting);
    }
};

void SessionRestartTest::handshakeReadFirstAfterAStallWaitsForItsProof_data()
{
    QTest::addColumn<bool>("diagnosis");
    QTest::addColumn<quint64>("previous");
    QTest::newRow("plain") << false << quint64{0};
    QTest::newRow("of a re-opening that was withdrawn") << true << quint64{90};
    QTest::newRow("of a peer that knows of no loss") << true << quint64{0};
}

void SessionRestartTest::handshakeReadFirstAfterAStallWaitsForItsProof()
{
    QFETCH(bool, diagnosis);
    QFETCH(quint64, previous);
    Side side;
    becomeStalled(side);
    QCOMPARE(wordsOf(side.handle(side.handshake(150, diagnosis, previous))), std::string());
    QVERIFY(*side.machine.nextDeadline() <= side.now.mono + 30ms);
    const auto healed = side.beat(); // it lay unread
    QCOMPARE(wordsOf(healed), std::string("Interrupted Heartbeat Refuse:AlreadyOpen"));
    QCOMPARE(find<Refuse>(healed)->token, 150ULL);
    side.live(1s);
    QVERIFY(side.machine.state() == SessionState::Open);
}

void SessionRestartTest::newerOneTakesItsPlace()
{
    Side side;
    becomeStalled(side);
    side.handle(side.handshake(150));
    const auto replaced = side.handle(side.handshake(151));
    QCOMPARE(wordsOf(replaced), std::string("Refuse:Busy"));
    QCOMPARE(find<Refuse>(replaced)->token, 150ULL);
    QCOMPARE(find<Refuse>(side.beat())->token, 151ULL);
}

void SessionRestartTest::lossThatItNamesIsBelievedAtOnce()
{
    Side side;
    becomeStalled(side);
    QCOMPARE(wordsOf(side.handle(side.handshake(150, true, 100))), std::string("DiscardAll CloseLanes Lost:PeerRestarted Adopt Connect"));
}

void SessionRestartTest::restartIsNamedWhenNothingComes()
{
    Side side;
    becomeStalled(side);
    side.handle(side.handshake(150));
    side.tick(30ms - 1ns);
    QVERIFY(side.machine.state() == SessionState::Reconnecting);
    const auto lost = side.tick(1ns);
    QVERIFY(find<SessionLost>(lost) != nullptr && find<SessionLost>(lost)->diagnosis.cause == LossCause::PeerRestarted);
    QVERIFY(find<Refuse>(lost)->reason == RejectReason::StandBy);
}

void SessionRestartTest::interruptionThatFollowsIsNotAStall()
{
    Side side;
    becomeStalled(side);
    side.beat();
    QVERIFY(side.machine.state() == SessionState::Open);
    side.handle(IncomingLost{"reset"});
    QCOMPARE(wordsOf(side.handle(side.handshake(150))), std::string("DiscardAll CloseLanes Lost:PeerRestarted Refuse:StandBy"));
}

QTEST_APPLESS_MAIN(SessionRestartTest)
#include "session_restart_test.moc"
