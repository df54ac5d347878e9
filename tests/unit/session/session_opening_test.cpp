// How a session opens, and how an opening fails: sets, refusals, both at once.
#include "session_side.hpp"

#include <QTest>

using namespace liena;
using namespace liena::test;
using namespace liena::session;

class SessionOpeningTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initiatorOpensWithTheCommit();
    void responderOpensWithChannelOpened();
    void initiatorAsksForAnUnknownSetFirst();
    void responderWantsAnUnknownSet();
    void responderRejectsBadSetBeforeItOpens();
    void givesItsOwnSetOnce();
    void refusesHandshakesItCannotAnswer_data();
    void refusesHandshakesItCannotAnswer();
    void beginsNoSessionThatIsNotAdmitted();
    void lowerIdLeadsWhenBothOpen();
    void higherIdYieldsWhenBothOpen();
    void leadHoldsForReopeningsToo();
    void newerHandshakeReplacesAResponders();
    void peerThatMissedChannelOpenedStartsAgain();
    void attemptEndsAfterThreeSeconds();
    void waitsForARejectedBeforeItNamesTheConnection();
    void neverOpensOverALostLane();
    void blamesNobodyAfterALaneWasLost();
    void peerThatConnectsAnewMayHaveLostChannelOpened();
};

void SessionOpeningTest::initiatorOpensWithTheCommit()
{
    Side side;
    QCOMPARE(wordsOf(side.handle(OpenRequested{100})), std::string("Connect"));
    QVERIFY(side.machine.state() == SessionState::Opening);
    const auto up = side.handle(OutgoingUp{});
    QVERIFY((*findSent<protocol::Handshake>(up) == protocol::Handshake{100, topologyHash, robotSet, {"test"}}));
    side.handle(IncomingUp{});
    side.pass(30ms);
    const auto opened = side.handle(side.commit());
    QCOMPARE(wordsOf(opened), std::string("ChannelOpened Opened Heartbeat"));
    QCOMPARE(findSent<protocol::ChannelOpened>(opened)->token, 100ULL);
    QVERIFY(find<SessionOpened>(opened)->initiator && find<SessionOpened>(opened)->duration == 30ms);
    QVERIFY(findSent<protocol::Heartbeat>(opened)->state == SessionState::Open);
}

void SessionOpeningTest::responderOpensWithChannelOpened()
{
    Side side;
    QCOMPARE(wordsOf(side.handle(side.handshake(100))), std::string("Adopt Connect"));
    const auto up = side.handle(OutgoingUp{});
    QVERIFY((*findSent<protocol::HandshakeCommit>(up) == protocol::HandshakeCommit{100, robotSet, false, {"test"}}));
    const auto opened = side.hear(protocol::ChannelOpened{100});
    QCOMPARE(wordsOf(opened), std::string("Opened Heartbeat"));
    QVERIFY(!find<SessionOpened>(opened)->initiator);
    QCOMPARE(side.machine.guard().epoch(), 1U);
}

void SessionOpeningTest::initiatorAsksForAnUnknownSetFirst()
{
    Side side;
    side.becomeOpening();
    auto commit = side.commit();
    commit.standing = SetStanding::Unknown;
    commit.commit.wantSet = true;
    QCOMPARE(wordsOf(side.handle(commit)), std::string("OwnSet MessageSetRequest"));
    QVERIFY(side.machine.state() == SessionState::Opening);
    QCOMPARE(wordsOf(side.handle(SetHeard{})), std::string("ChannelOpened Opened Heartbeat"));
}

void SessionOpeningTest::responderWantsAnUnknownSet()
{
    Side side;
    auto handshake = side.handshake(100);
    handshake.standing = SetStanding::Unknown;
    side.handle(handshake);
    QVERIFY(findSent<protocol::HandshakeCommit>(side.handle(OutgoingUp{}))->wantSet);
    QCOMPARE(wordsOf(side.handle(SetHeard{})), std::string());
    QCOMPARE(wordsOf(side.hear(protocol::ChannelOpened{100})), std::string("Opened Heartbeat"));
}

void SessionOpeningTest::responderRejectsBadSetBeforeItOpens()
{
    Side side;
    auto handshake = side.handshake(100);
    handshake.standing = SetStanding::Unknown;
    side.handle(handshake);
    side.handle(OutgoingUp{});
    const auto failed = side.handle(SetHeard{SetStanding::Invalid, "composes to another id"});
    QCOMPARE(wordsOf(failed), std::string("Rejected CloseLanes Failed:MessageSetInvalid"));
    QVERIFY(find<CloseLanes>(failed)->grace == 100ms);
    QVERIFY(side.machine.state() == SessionState::Closed);
    // ChannelOpened that overtakes the set is a violation (ruling A7).
    Side hasty;
    hasty.handle(handshake);
    hasty.handle(OutgoingUp{});
    QCOMPARE(wordsOf(hasty.hear(protocol::ChannelOpened{100})), std::string("Rejected CloseLanes Failed:ProtocolViolation"));
}

void SessionOpeningTest::givesItsOwnSetOnce()
{
    Side side;
    side.becomeResponder();
    QCOMPARE(wordsOf(side.hear(protocol::MessageSetRequest{robotSet})), std::string("OwnSet"));
    QCOMPARE(wordsOf(side.hear(protocol::MessageSetRequest{robotSet})), std::string("Rejected CloseLanes Failed:ProtocolViolation"));
    Side other;
    other.becomeResponder();
    QCOMPARE(wordsOf(other.hear(protocol::MessageSetRequest{cockpitSet})), std::string("Rejected CloseLanes Failed:ProtocolViolation"));
    Side initiator;
    initiator.becomeOpening();
    QCOMPARE(wordsOf(initiator.hear(protocol::MessageSetRequest{robotSet})), std::string("Rejected CloseLanes Failed:ProtocolViolation"));
}

void SessionOpeningTest::refusesHandshakesItCannotAnswer_data()
{
    QTest::addColumn<bool>("sameTopology");
    QTest::addColumn<int>("standing");
    QTest::addColumn<QString>("reason");
    QTest::newRow("another topology") << false << int(SetStanding::Held) << QStringLiteral("Refuse:TopologyMismatch");
    QTest::newRow("another set than pinned") << true << int(SetStanding::Changed) << QStringLiteral("Refuse:MessageSetChanged");
    QTest::newRow("a set of another device") << true << int(SetStanding::Invalid) << QStringLiteral("Refuse:MessageSetInvalid");
}

void SessionOpeningTest::refusesHandshakesItCannotAnswer()
{
    QFETCH(bool, sameTopology);
    QFETCH(int, standing);
    QFETCH(QString, reason);
    Side side;
    auto handshake = side.handshake(100);
    handshake.standing = static_cast<SetStanding>(standing);
    if (!sameTopology)
        handshake.handshake.topology = robotSet;
    const auto actions = side.handle(handshake);
    QCOMPARE(QString::fromStdString(wordsOf(actions)), reason);
    QVERIFY(find<Refuse>(actions)->connection == 7 && find<Refuse>(actions)->token == 100);
    QVERIFY(side.machine.state() == SessionState::Closed);
    // An attempt of our own goes on, and what the peer shows in its Commit ends it the same way.
    if (sameTopology) {
        side.becomeOpening(101);
        auto commit = side.commit();
        commit.standing = static_cast<SetStanding>(standing);
        QCOMPARE(QString::fromStdString(wordsOf(side.handle(commit))),
                 QStringLiteral("Rejected CloseLanes ") + reason.replace(QStringLiteral("Refuse"), QStringLiteral("Failed")));
    }
}

void SessionOpeningTest::beginsNoSessionThatIsNotAdmitted()
{
    Side side;
    auto handshake = side.handshake(100);
    handshake.notAdmitted = "a certificate ends";
    const auto actions = side.handle(handshake);
    QCOMPARE(wordsOf(actions), std::string("Refuse:NotAdmitted"));
    QCOMPARE(find<Refuse>(actions)->detail, std::string("a certificate ends"));
    QVERIFY(side.machine.state() == SessionState::Closed);
}

void SessionOpeningTest::lowerIdLeadsWhenBothOpen()
{
    Side robot(robotId);
    robot.becomeOpening(100);
    QCOMPARE(wordsOf(robot.handle(robot.handshake(200))), std::string("Ignore"));
    QCOMPARE(robot.machine.token(), 100ULL);
    QCOMPARE(wordsOf(robot.handle(robot.commit())), std::string("ChannelOpened Opened Heartbeat"));
}

void SessionOpeningTest::higherIdYieldsWhenBothOpen()
{
    Side cockpit(cockpitId);
    cockpit.becomeOpening(200);
    QCOMPARE(wordsOf(cockpit.handle(cockpit.handshake(100))), std::string("CloseLanes Adopt Connect"));
    QCOMPARE(cockpit.machine.token(), 100ULL);
    QVERIFY(findSent<protocol::HandshakeCommit>(cockpit.handle(OutgoingUp{}))->token == 100);
    QCOMPARE(wordsOf(cockpit.hear(protocol::ChannelOpened{100})), std::string("Opened Heartbeat"));
}

void SessionOpeningTest::leadHoldsForReopeningsToo()
{
    Side robot(robotId);
    robot.becomeReopening(200);
    QCOMPARE(wordsOf(robot.handle(robot.handshake(300, true, 100))), std::string("Ignore"));
    Side cockpit(cockpitId);
    cockpit.becomeReopening(300);
    QCOMPARE(wordsOf(cockpit.handle(cockpit.handshake(200, true, 100))), std::string("CloseLanes Adopt Connect"));
    QVERIFY(cockpit.machine.state() == SessionState::Reopening && cockpit.machine.token() == 200);
    // A plain Handshake never takes a re-opening over.
    Side again(cockpitId);
    again.becomeReopening(300);
    QCOMPARE(wordsOf(again.handle(again.handshake(200))), std::string("Refuse:StandBy"));
    QCOMPARE(again.machine.token(), 300ULL);
}

void SessionOpeningTest::newerHandshakeReplacesAResponders()
{
    for (const auto id : {robotId, cockpitId}) {
        Side side(id);
        side.becomeResponder(100);
        QCOMPARE(wordsOf(side.handle(side.handshake(101))), std::string("CloseLanes Adopt Connect"));
        QCOMPARE(side.machine.token(), 101ULL);
        QVERIFY(findSent<protocol::HandshakeCommit>(side.handle(OutgoingUp{}))->token == 101);
    }
}

void SessionOpeningTest::peerThatMissedChannelOpenedStartsAgain()
{
    // The initiator is Open; its ChannelOpened was lost with the connection, the responder gave up and opens anew.
    Side side;
    side.becomeOpening(100);
    side.handle(side.commit());
    QCOMPARE(wordsOf(side.handle(IncomingLost{"closed"})), std::string("DiscardControl Heartbeat"));
    QCOMPARE(wordsOf(side.handle(side.handshake(300))), std::string("DiscardAll CloseLanes Lost:PeerRestarted Refuse:StandBy"));
    QVERIFY(side.machine.state() == SessionState::StandBy);
}

void SessionOpeningTest::attemptEndsAfterThreeSeconds()
{
    Side side;
    side.becomeOpening();
    side.tick(3s - 1ns);
    QVERIFY(side.machine.state() == SessionState::Opening);
    const auto actions = side.tick(1ns);
    QVERIFY(findSent<protocol::Rejected>(actions)->reason == RejectReason::Timeout);
    QVERIFY(find<OpenFailed>(actions)->reason == RejectReason::Timeout);
    QVERIFY(side.machine.state() == SessionState::Closed && !side.machine.nextDeadline());
    Side silent; // nothing stands: nobody to tell
    silent.handle(OpenRequested{100});
    QCOMPARE(wordsOf(silent.tick(3s)), std::string("CloseLanes Failed:Timeout"));
}

void SessionOpeningTest::waitsForARejectedBeforeItNamesTheConnection()
{
    Side side;
    side.becomeOpening();
    QCOMPARE(wordsOf(side.handle(OutgoingLost{ProbeResult::NotProbed, "closed by the peer"})), std::string());
    QVERIFY(side.machine.nextDeadline() == side.now.mono + 200ms);
    side.pass(199ms);
    const auto told = side.hear(protocol::Rejected{100, RejectReason::MessageSetChanged, {"accept it"}});
    QVERIFY(find<OpenFailed>(told)->reason == RejectReason::MessageSetChanged && find<OpenFailed>(told)->detail == "accept it");

    side.becomeOpening(101);
    side.handle(OutgoingLost{ProbeResult::TlsFailure, "certificate refused"});
    side.tick(200ms - 1ns);
    QVERIFY(side.machine.state() == SessionState::Opening);
    const auto failed = side.tick(1ns);
    QCOMPARE(wordsOf(failed), std::string("CloseLanes Failed:None"));
    QVERIFY(find<OpenFailed>(failed)->probe == ProbeResult::TlsFailure);
    QVERIFY(find<OpenFailed>(failed)->detail.find("certificate refused") != std::string::npos);
}

void SessionOpeningTest::neverOpensOverALostLane()
{
    Side initiator;
    initiator.becomeOpening();
    initiator.handle(OutgoingLost{ProbeResult::NotProbed, "reset"});
    QCOMPARE(wordsOf(initiator.handle(initiator.commit())), std::string());
    QCOMPARE(wordsOf(initiator.tick(200ms)), std::string("CloseLanes Failed:None"));
    Side responder; // nor does it blame the peer, whose ChannelOpened crossed the loss
    responder.becomeResponder();
    responder.handle(OutgoingLost{ProbeResult::NotProbed, "reset"});
    QCOMPARE(wordsOf(responder.hear(protocol::ChannelOpened{100})), std::string());
    QCOMPARE(wordsOf(responder.tick(200ms)), std::string("CloseLanes Failed:None"));
}

void SessionOpeningTest::blamesNobodyAfterALaneWasLost()
{
    // The initiator opened, closed, and ended its connections; what it wrote before that is read last.
    Side side;
    side.becomeResponder();
    side.handle(OutgoingLost{ProbeResult::NotProbed, "closed by the peer"});
    QCOMPARE(wordsOf(side.hear(protocol::ChannelOpened{100})), std::string());
    QCOMPARE(wordsOf(side.hear(protocol::Disengagement{100, {"done"}})), std::string());
    QVERIFY(find<OpenFailed>(side.tick(200ms))->reason == RejectReason::None);
    Side violated;
    violated.becomeResponder();
    violated.handle(OutgoingLost{ProbeResult::NotProbed, "closed by the peer"});
    const auto ended = violated.handle(ViolationFound{"StandBy cannot be broadcast now"});
    QVERIFY(find<OpenFailed>(ended)->reason == RejectReason::None);
    QVERIFY(find<OpenFailed>(ended)->detail.find("closed by the peer") != std::string::npos);
}

void SessionOpeningTest::peerThatConnectsAnewMayHaveLostChannelOpened()
{
    // The initiator's connection broke with ChannelOpened on it; it is open, connects again, and says what an open session may say.
    Side side;
    side.becomeResponder();
    QCOMPARE(wordsOf(side.handle(IncomingUp{})), std::string());
    QCOMPARE(wordsOf(side.hear(protocol::Disengagement{100, {"done"}})), std::string());
    QCOMPARE(wordsOf(side.hear(protocol::LinkReport{})), std::string());
    QVERIFY(side.machine.state() == SessionState::Opening);
    const auto ended = side.tick(200ms);
    QVERIFY(find<OpenFailed>(ended)->reason == RejectReason::None);
    QVERIFY(side.machine.state() == SessionState::Closed);
}

QTEST_APPLESS_MAIN(SessionOpeningTest)
#include "session_opening_test.moc"
