// How a session ends and is opened again: restart, rejection, violation, re-opening, closing.
#include "session_side.hpp"

#include <QTest>

using namespace liena;
using namespace liena::test;
using namespace liena::session;

class SessionEndingTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void healthySessionProvesItselfAgainstAHandshake();
    void handshakeOfARestartedPeerEndsInStandBy();
    void restartIsNamedWhenTheSessionIsInterrupted();
    void restartIsNotBelievedForAStallOfOurOwn();
    void diagnosisHandshakeInSessionIsAnswered_data();
    void diagnosisHandshakeInSessionIsAnswered();
    void withdrawnReopeningReadLateDoesNotEndTheSession();
    void handshakeWhileClosingIsBusy_data();
    void handshakeWhileClosingIsBusy();
    void rejectedEndsAttemptAndSession();
    void rejectedOfAnotherAttemptIsPassedOver();
    void reopeningNamesTheIncidentOfEitherEnd_data();
    void reopeningNamesTheIncidentOfEitherEnd();
    void failedReopeningStaysInStandBy();
    void confirmationCountsForTheIncidentThatWasSeen();
    void plainHandshakeIsRefusedInStandBy();
    void incidentHeardWhileOpeningEndsTheOpening();
    void lossOfTheSessionHeardBeforeItOpensEndsTheReopening();
    void incidentThatIsOverIsNotShownAnyMore();
    void incidentHeardInSessionOutlivesItsClose();
    void closeTakesAtMostASecond();
    void bothMayCloseAtOnce();
    void losingAConnectionInClosingIsTheClose();
    void violationEndsWhateverIsInHand_data();
    void violationEndsWhateverIsInHand();
};

void SessionEndingTest::healthySessionProvesItselfAgainstAHandshake()
{
    Side side;
    side.becomeOpen();
    QCOMPARE(wordsOf(side.handle(side.handshake(300))), std::string());
    side.pass(20ms);
    const auto actions = side.beat();
    QCOMPARE(wordsOf(actions), std::string("Refuse:AlreadyOpen"));
    QCOMPARE(find<Refuse>(actions)->token, 300ULL);
    side.live(1s);
    QVERIFY(side.machine.state() == SessionState::Open);
    // A peer that beats but is not open there proves nothing.
    side.peerState = SessionState::Opening;
    side.handle(side.handshake(301));
    side.pass(10ms);
    QCOMPARE(wordsOf(side.beat()), std::string());
    QVERIFY(find<SessionLost>(side.tick(30ms))->diagnosis.cause == LossCause::PeerRestarted);
}

void SessionEndingTest::handshakeOfARestartedPeerEndsInStandBy()
{
    Side side;
    side.becomeOpen();
    side.handle(side.handshake(300));
    QVERIFY(*side.machine.nextDeadline() <= side.now.mono + 30ms);
    side.tick(20ms);
    QVERIFY(side.machine.state() == SessionState::Open);
    const auto actions = side.tick(10ms);
    QCOMPARE(wordsOf(actions), std::string("DiscardAll CloseLanes Lost:PeerRestarted Refuse:StandBy"));
    QCOMPARE(find<SessionLost>(actions)->incident, IncidentId{100});
    QCOMPARE(find<Refuse>(actions)->token, 300ULL);
}

void SessionEndingTest::restartIsNamedWhenTheSessionIsInterrupted()
{
    Side waiting;
    waiting.becomeOpen();
    waiting.handle(waiting.handshake(300));
    QCOMPARE(wordsOf(waiting.handle(IncomingLost{"reset"})), std::string("DiscardAll CloseLanes Lost:PeerRestarted Refuse:StandBy"));
    Side reconnecting;
    reconnecting.becomeReconnecting();
    QCOMPARE(wordsOf(reconnecting.handle(reconnecting.handshake(300))),
             std::string("DiscardAll CloseLanes Lost:PeerRestarted Refuse:StandBy"));
}

/// What refutes the handshake lies unread when this process runs again.
void SessionEndingTest::restartIsNotBelievedForAStallOfOurOwn()
{
    Side side;
    side.becomeOpen();
    side.handle(side.handshake(300));
    side.pass(80ms);
    QCOMPARE(wordsOf(side.handle(Stalled{80ms})), std::string("DiscardAll Heartbeat"));
    QVERIFY(side.machine.state() == SessionState::Reconnecting);
    side.handle(Tick{});
    QVERIFY(side.machine.state() == SessionState::Reconnecting);
    const auto healed = side.beat();
    QVERIFY(find<SessionInterrupted>(healed) != nullptr);
    QVERIFY(find<Refuse>(healed)->reason == RejectReason::AlreadyOpen && find<Refuse>(healed)->token == 300);
    QVERIFY(side.machine.state() == SessionState::Open);
    side.live(1s);
    QVERIFY(side.machine.state() == SessionState::Open);

    Side broken; // meanwhile: it heals later, and lives
    broken.becomeOpen();
    broken.handle(broken.handshake(300));
    broken.pass(80ms);
    broken.handle(Stalled{80ms});
    broken.handle(IncomingLost{"reset"});
    QCOMPARE(wordsOf(broken.beat(LifePath::Packet)), std::string("Refuse:AlreadyOpen"));
    broken.handle(IncomingUp{});
    QVERIFY(find<SessionInterrupted>(broken.beat()) != nullptr);

    Side restarted; // stalled twice, and nothing comes
    restarted.becomeOpen();
    restarted.handle(restarted.handshake(300));
    for (int stall = 0; stall < 2; ++stall) {
        restarted.pass(80ms);
        restarted.handle(Stalled{80ms});
    }
    restarted.handle(Tick{});
    QVERIFY(*restarted.machine.nextDeadline() <= restarted.now.mono + 30ms);
    restarted.tick(30ms - 1ns);
    QVERIFY(restarted.machine.state() == SessionState::Reconnecting);
    const auto lost = restarted.tick(1ns);
    QCOMPARE(wordsOf(lost).substr(wordsOf(lost).find("DiscardAll")),
             std::string("DiscardAll CloseLanes Lost:PeerRestarted Refuse:StandBy"));
}

void SessionEndingTest::diagnosisHandshakeInSessionIsAnswered_data()
{
    QTest::addColumn<int>("stage");
    QTest::addColumn<quint64>("previous");
    for (const quint64 previous : {quint64{100}, quint64{0}}) {
        const auto* who = previous == 0 ? "restarted" : "lost it";
        QTest::addRow("Open, the peer %s", who) << 0 << previous;
        QTest::addRow("Suspect, the peer %s", who) << 1 << previous;
        QTest::addRow("Reconnecting, the peer %s", who) << 2 << previous;
    }
}

void SessionEndingTest::diagnosisHandshakeInSessionIsAnswered()
{
    QFETCH(int, stage);
    QFETCH(quint64, previous);
    Side side;
    stage == 0 ? side.becomeOpen() : stage == 1 ? side.becomeSuspect() : side.becomeReconnecting();
    auto actions = side.handle(side.handshake(300, true, previous));
    if (previous == 0 && stage < 2) { // the peer was restarted: its silence in the old session has to show it
        QCOMPARE(wordsOf(actions), std::string());
        side.handle(Tick{});
        actions = side.tick(30ms);
        QVERIFY(find<Adopt>(actions) != nullptr && find<SessionLost>(actions) != nullptr);
        return;
    }
    QCOMPARE(wordsOf(actions), std::string("DiscardAll CloseLanes Lost:PeerRestarted Adopt Connect"));
    QVERIFY(side.machine.state() == SessionState::Reopening);
    const auto commit = side.handle(OutgoingUp{});
    QCOMPARE(findSent<protocol::DiagnosisHandshakeCommit>(commit)->previous, 100ULL); // names what the peer does not know (ruling A8)
    const auto opened = side.hear(protocol::ChannelReOpened{300, 100, robotId, cockpitId});
    QCOMPARE(wordsOf(opened), std::string("ReOpened Heartbeat"));
    QCOMPARE(find<SessionOpened>(opened)->incident, IncidentId{100});
}

void SessionEndingTest::withdrawnReopeningReadLateDoesNotEndTheSession()
{
    // Both persons re-opened at once. This side leads: the other withdrew its attempt and answered; its connection is read after that.
    Side side;
    side.becomeReopening(200);
    side.handle(side.commit(true));
    QVERIFY(side.machine.state() == SessionState::Open);
    side.peerSequence = 0;
    side.beat();
    QCOMPARE(wordsOf(side.handle(side.handshake(150, true, 100))), std::string());
    side.pass(20ms);
    const auto actions = side.beat();
    QCOMPARE(wordsOf(actions), std::string("Refuse:AlreadyOpen"));
    QCOMPARE(find<Refuse>(actions)->token, 150ULL);
    side.live(1s);
    QVERIFY(side.machine.state() == SessionState::Open);
}

void SessionEndingTest::handshakeWhileClosingIsBusy_data()
{
    QTest::addColumn<bool>("diagnosis");
    QTest::newRow("plain") << false;
    QTest::newRow("diagnosis") << true;
}

void SessionEndingTest::handshakeWhileClosingIsBusy()
{
    QFETCH(bool, diagnosis);
    Side side;
    side.becomeClosing();
    QCOMPARE(wordsOf(side.handle(side.handshake(300, diagnosis))), std::string("Refuse:Busy"));
    Side waiting; // one that waits for its proof when the closing begins
    waiting.becomeOpen();
    waiting.handle(waiting.handshake(300));
    waiting.handle(CloseRequested{"done"});
    QCOMPARE(wordsOf(waiting.tick(1s)), std::string("Heartbeat Refuse:Busy CloseLanes Closed"));
}

void SessionEndingTest::rejectedEndsAttemptAndSession()
{
    Side opening;
    opening.becomeOpening();
    QCOMPARE(wordsOf(opening.hear(protocol::Rejected{100, RejectReason::Busy, {""}})), std::string("CloseLanes Failed:Busy"));
    Side open;
    open.becomeOpen();
    const auto lost = open.hear(protocol::Rejected{100, RejectReason::ProtocolViolation, {"origin"}});
    QCOMPARE(wordsOf(lost), std::string("DiscardAll CloseLanes Lost:ProtocolViolation"));
    QVERIFY(find<SessionLost>(lost)->diagnosis.detail.find("origin") != std::string::npos);
}

void SessionEndingTest::rejectedOfAnotherAttemptIsPassedOver()
{
    Side side;
    side.becomeOpening(100);
    QCOMPARE(wordsOf(side.hear(protocol::Rejected{99, RejectReason::Busy, {""}})), std::string());
    QVERIFY(side.machine.state() == SessionState::Opening);
}

void SessionEndingTest::reopeningNamesTheIncidentOfEitherEnd_data()
{
    QTest::addColumn<quint64>("ours");
    QTest::addColumn<quint64>("theirs");
    QTest::addColumn<quint64>("named");
    QTest::newRow("both know it") << quint64{100} << quint64{100} << quint64{100};
    QTest::newRow("the responder restarted") << quint64{100} << quint64{0} << quint64{100};
    QTest::newRow("the responder holds another") << quint64{100} << quint64{90} << quint64{100};
}

void SessionEndingTest::reopeningNamesTheIncidentOfEitherEnd()
{
    QFETCH(quint64, ours);
    QFETCH(quint64, theirs);
    QFETCH(quint64, named);
    Side side;
    side.becomeStandBy();
    side.handle(ReopenRequested{200});
    QCOMPARE(findSent<protocol::DiagnosisHandshake>(side.handle(OutgoingUp{}))->previous, ours);
    side.handle(IncomingUp{});
    auto commit = side.commit(true);
    commit.previous = theirs;
    const auto opened = side.handle(commit);
    QCOMPARE(wordsOf(opened), std::string("ChannelReOpened ReOpened Heartbeat"));
    QVERIFY((*findSent<protocol::ChannelReOpened>(opened) == protocol::ChannelReOpened{200, named, robotId, cockpitId}));
    QCOMPARE(find<SessionOpened>(opened)->incident, named);
    // The other end: one that restarted learns the incident from the initiator's `previous`.
    Side restarted(cockpitId);
    restarted.handle(restarted.handshake(200, true, ours));
    QCOMPARE(findSent<protocol::DiagnosisHandshakeCommit>(restarted.handle(OutgoingUp{}))->previous, 0ULL);
    QCOMPARE(find<SessionOpened>(restarted.hear(protocol::ChannelReOpened{200, ours, robotId, cockpitId}))->incident, ours);
}

void SessionEndingTest::failedReopeningStaysInStandBy()
{
    Side side;
    side.becomeReopening();
    QCOMPARE(wordsOf(side.hear(protocol::Rejected{200, RejectReason::Busy, {""}})), std::string("CloseLanes Failed:Busy"));
    QVERIFY(side.machine.state() == SessionState::StandBy);
    QCOMPARE(side.machine.incident(), IncidentId{100});
    Side refused;
    refused.becomeStandBy();
    refused.handle(ReopenRequested{200});
    QCOMPARE(wordsOf(refused.handle(OutgoingFailed{ProbeResult::HostUnreachable, "no answer"})), std::string("CloseLanes Failed:None"));
    QVERIFY(refused.machine.state() == SessionState::StandBy);
}

void SessionEndingTest::confirmationCountsForTheIncidentThatWasSeen()
{
    Side side;
    side.becomeStandBy();
    QVERIFY(side.handle(ReopenRequested{200, 99}).empty());
    QVERIFY(side.machine.state() == SessionState::StandBy);
    QVERIFY(!side.handle(ReopenRequested{200, 100}).empty());
    QVERIFY(side.machine.state() == SessionState::Reopening);
}

void SessionEndingTest::plainHandshakeIsRefusedInStandBy()
{
    Side side;
    side.becomeStandBy();
    QCOMPARE(wordsOf(side.handle(side.handshake(300))), std::string("Refuse:StandBy"));
    QVERIFY(side.handle(OpenRequested{300}).empty());
    QVERIFY(side.machine.state() == SessionState::StandBy);
}

void SessionEndingTest::incidentHeardWhileOpeningEndsTheOpening()
{
    Side side;
    side.becomeOpening();
    QCOMPARE(wordsOf(side.handle(IncidentHeld{55})), std::string("Rejected CloseLanes Failed:StandBy"));
    QVERIFY(side.machine.state() == SessionState::StandBy);
    QCOMPARE(side.machine.incident(), IncidentId{55});
    side.handle(IncidentGone{});
    QVERIFY(side.machine.state() == SessionState::Closed);
}

void SessionEndingTest::lossOfTheSessionHeardBeforeItOpensEndsTheReopening()
{
    // This device was frozen: a third one tells that the session was opened and lost at the other end before its ChannelReOpened is read.
    Side side;
    side.becomeReopeningResponder();
    QCOMPARE(wordsOf(side.handle(IncidentHeld{200})), std::string("Rejected CloseLanes Failed:StandBy"));
    QCOMPARE(side.machine.incident(), IncidentId{200});
    QCOMPARE(find<SessionOpened>(side.hear(protocol::ChannelReOpened{200, 100, robotId, cockpitId})), nullptr);
    QVERIFY(side.machine.state() == SessionState::StandBy);
}

void SessionEndingTest::incidentThatIsOverIsNotShownAnyMore()
{
    Side side;
    side.becomeStandBy();
    side.handle(IncidentHeld{55});
    QCOMPARE(side.machine.incident(), IncidentId{100});
    side.handle(IncidentHeld{55, 44});
    QCOMPARE(side.machine.incident(), IncidentId{100});
    side.handle(IncidentHeld{55, 100});
    QCOMPARE(side.machine.incident(), IncidentId{55});
    QVERIFY(side.handle(ReopenRequested{200, 100}).empty());
    QVERIFY(!side.handle(ReopenRequested{200, 55}).empty());
}

void SessionEndingTest::incidentHeardInSessionOutlivesItsClose()
{
    Side side;
    side.becomeOpen();
    QCOMPARE(wordsOf(side.handle(IncidentHeld{55})), std::string());
    QVERIFY(side.machine.state() == SessionState::Open);
    side.handle(CloseRequested{"done"});
    side.hear(protocol::DisengagementCommit{100});
    QVERIFY(side.machine.state() == SessionState::StandBy);
}

void SessionEndingTest::closeTakesAtMostASecond()
{
    Side side;
    side.becomeOpen();
    QCOMPARE(wordsOf(side.handle(CloseRequested{"lunch"})), std::string("DiscardControl Disengagement"));
    side.tick(1s - 1ns);
    QVERIFY(side.machine.state() == SessionState::Closing);
    QVERIFY(find<SessionClosed>(side.tick(1ns))->detail == "lunch");
    QVERIFY(side.machine.state() == SessionState::Closed);
    Side other;
    other.becomeOpen();
    QCOMPARE(wordsOf(other.hear(protocol::Disengagement{100, {"lunch"}})), std::string("DiscardControl DisengagementCommit(last)"));
    const auto closed = other.hear(protocol::ChannelClosed{100});
    QVERIFY(find<SessionClosed>(closed)->byPeer && find<SessionClosed>(closed)->detail == "lunch");
}

void SessionEndingTest::bothMayCloseAtOnce()
{
    Side side;
    side.becomeClosing();
    QCOMPARE(wordsOf(side.hear(protocol::Disengagement{100, {"too"}})), std::string("DisengagementCommit(last)"));
    QCOMPARE(wordsOf(side.hear(protocol::DisengagementCommit{100})), std::string("ChannelClosed CloseLanes Closed"));
    QVERIFY(side.machine.state() == SessionState::Closed && side.machine.incident() == 0);
}

void SessionEndingTest::losingAConnectionInClosingIsTheClose()
{
    Side first;
    first.becomeClosing();
    QCOMPARE(wordsOf(first.handle(OutgoingLost{ProbeResult::NotProbed, "closed"})), std::string("CloseLanes Closed"));
    Side second;
    second.becomeClosingByPeer();
    QCOMPARE(wordsOf(second.handle(IncomingLost{"closed"})), std::string("CloseLanes ClosedByPeer"));
}

void SessionEndingTest::violationEndsWhateverIsInHand_data()
{
    QTest::addColumn<int>("stage");
    QTest::addColumn<QString>("actions");
    QTest::addColumn<QString>("state");
    const auto lost = QStringLiteral("Rejected DiscardAll CloseLanes Lost:ProtocolViolation");
    QTest::newRow("Open") << 0 << lost << QStringLiteral("StandBy");
    QTest::newRow("Suspect") << 1 << lost << QStringLiteral("StandBy");
    QTest::newRow("Reconnecting") << 2 << lost << QStringLiteral("StandBy");
    QTest::newRow("Opening") << 3 << QStringLiteral("Rejected CloseLanes Failed:ProtocolViolation") << QStringLiteral("Closed");
    QTest::newRow("Reopening") << 4 << QStringLiteral("Rejected CloseLanes Failed:ProtocolViolation") << QStringLiteral("StandBy");
    QTest::newRow("Closing") << 5 << QStringLiteral("Rejected CloseLanes Closed") << QStringLiteral("Closed");
}

void SessionEndingTest::violationEndsWhateverIsInHand()
{
    QFETCH(int, stage);
    QFETCH(QString, actions);
    QFETCH(QString, state);
    Side side;
    switch (stage) {
    case 0:
        side.becomeOpen();
        break;
    case 1:
        side.becomeSuspect();
        break;
    case 2:
        side.becomeReconnecting();
        break;
    case 3:
        side.becomeOpening();
        break;
    case 4:
        side.becomeReopening();
        break;
    default:
        side.becomeClosing();
        break;
    }
    const auto epoch = side.machine.guard().epoch();
    QCOMPARE(QString::fromStdString(wordsOf(side.handle(ViolationFound{"origin of another device"}))), actions);
    QCOMPARE(QString::fromStdString(nameOf(side.machine.state())), state);
    if (stage <= 2)
        QVERIFY(side.machine.guard().epoch() > epoch);
}

QTEST_APPLESS_MAIN(SessionEndingTest)
#include "session_ending_test.moc"
