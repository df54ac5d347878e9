// Heartbeats, silence, reconnecting and stand-by by their rulings, one machine in virtual time.
#include "session_side.hpp"

#include <QTest>

using namespace liena;
using namespace liena::test;
using namespace liena::session;

namespace {

bool raisedTo(const Side& side, std::uint32_t epoch) { return side.machine.guard().epoch() == epoch; }

} // namespace

class SessionLivenessTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void beatsFromTheHandshakeOn();
    void keepsItsBeat();
    void echoesTheNewestHeartbeat();
    void beatsOnOverReconnecting();
    void passesOverOldHeartbeats();
    void silenceIsShownThenActedOn();
    void lifeEndsSuspicion();
    void otherPathsDoNotReplaceLaneZero();
    void silentLaneZeroThatSpeaksAgainHeals();
    void peerThatMissesLaneZeroGetsItAnew();
    void peerThatIsNotOpenIsLostAtOnce();
    void retriesFiftyMillisecondsAfterTheLastFailure();
    void connectsAgainAfterSilenceThoughTheLaneLooksWhole();
    void connectsOnlyWhatItConnectedBefore();
    void healsWhenBothLanesStandAndAHeartbeatCame();
    void doesNotHealWithAPeerThatNeverOpened();
    void healsWithoutABrokenConnection();
    void replacedLaneDoesNotDisturb();
    void goesToStandByWhenReconnectHasPassed();
    void stallDiscardsEverything();
    void stallInReconnectingDiscardsAgain();
    void epochRisesWithEveryPermissionThatEnds();
    void revocationIsSaidAtOnce();
    void controlWaitsForAHeartbeatOfThisSession();
    void otherEndsIncidentEndsTheSession();
    void diagnosisTellsWhatWasHeard();
};

void SessionLivenessTest::beatsFromTheHandshakeOn()
{
    Side side;
    side.handle(OpenRequested{100});
    QCOMPARE(wordsOf(side.tick()), std::string());
    side.handle(OutgoingUp{});
    const auto first = side.tick();
    QCOMPARE(findSent<protocol::Heartbeat>(first)->sequence, 1U);
    QVERIFY(findSent<protocol::Heartbeat>(first)->state == SessionState::Opening);
    QCOMPARE(wordsOf(side.tick(20ms - 1ns)), std::string());
    QCOMPARE(findSent<protocol::Heartbeat>(side.tick(1ns))->sequence, 2U);
    Side responder;
    responder.handle(responder.handshake(100));
    responder.handle(OutgoingUp{});
    QCOMPARE(wordsOf(responder.tick()), std::string("Heartbeat"));
}

void SessionLivenessTest::keepsItsBeat()
{
    Side side;
    side.becomeOpen();
    std::uint32_t heartbeats = 0;
    std::uint32_t last = 0;
    const auto until = side.now.mono + 10s;
    while (side.now.mono < until) { // ticks come up to 3 ms late
        side.pass(*side.machine.nextDeadline() - side.now.mono + std::chrono::milliseconds(heartbeats % 4));
        const auto actions = side.handle(Tick{});
        if (const auto* beat = findSent<protocol::Heartbeat>(actions)) {
            QVERIFY(last == 0 || beat->sequence == last + 1);
            last = beat->sequence;
            ++heartbeats;
        }
        side.beat();
        QVERIFY(side.machine.state() == SessionState::Open);
    }
    QVERIFY2(heartbeats >= 499 && heartbeats <= 501, std::to_string(heartbeats).c_str());
}

void SessionLivenessTest::echoesTheNewestHeartbeat()
{
    Side side;
    side.becomeOpening();
    const auto silent = side.tick(20ms);
    const auto* nothing = findSent<protocol::Heartbeat>(silent);
    QVERIFY(nothing->echoSequence == 0 && nothing->echoSentNs == 0 && nothing->echoReceivedNs == 0);
    side.handle(side.commit());
    side.pass(5ms);
    const auto received = side.now.wall.ns;
    side.beat();
    side.pass(15ms);
    side.machine.setIncidents(3);
    const auto actions = side.handle(Tick{});
    const auto* echo = findSent<protocol::Heartbeat>(actions);
    QCOMPARE(echo->echoSequence, 1U);
    QCOMPARE(echo->echoSentNs, received);
    QCOMPARE(echo->echoReceivedNs, received);
    QCOMPARE(echo->sentNs, side.now.wall.ns);
    QCOMPARE(echo->incidents, std::uint16_t{3});
    QCOMPARE(echo->epoch, 1U);
}

void SessionLivenessTest::beatsOnOverReconnecting()
{
    Side side;
    side.becomeOpen();
    const auto before = findSent<protocol::Heartbeat>(side.tick(20ms))->sequence;
    const auto lost = side.tick(90ms);
    QVERIFY(side.machine.state() == SessionState::Reconnecting);
    std::uint32_t newest = before;
    for (const auto& action : lost)
        if (const auto* send = std::get_if<Send>(&action))
            if (const auto* beat = std::get_if<protocol::Heartbeat>(&send->message)) {
                QCOMPARE(beat->sequence, newest + 1);
                newest = beat->sequence;
            }
    QVERIFY(newest > before);
    const auto next = side.tick(20ms);
    QCOMPARE(findSent<protocol::Heartbeat>(next)->sequence, newest + 1);
    QVERIFY(findSent<protocol::Heartbeat>(next)->state == SessionState::Reconnecting);
}

void SessionLivenessTest::passesOverOldHeartbeats()
{
    Side side;
    side.becomeOpen();
    side.peerEpoch = 5;
    side.beat();
    QCOMPARE(side.machine.stamper().targetEpoch(), 5U);
    side.peerEpoch = 4;
    side.peerSequence = 0; // a copy of the first, late on the other path
    side.beat();
    QCOMPARE(side.machine.stamper().targetEpoch(), 5U);
    QCOMPARE(side.machine.monitor().received(), std::uint64_t{2});
}

void SessionLivenessTest::silenceIsShownThenActedOn()
{
    Side side;
    side.becomeOpen();
    side.tick(70ms - 1ns);
    QVERIFY(side.machine.state() == SessionState::Open);
    side.tick(1ns);
    QVERIFY(side.machine.state() == SessionState::Suspect);
    QVERIFY(raisedTo(side, 1));
    side.tick(37ms - 1ns);
    QVERIFY(side.machine.state() == SessionState::Suspect);
    const auto lost = side.tick(1ns);
    QVERIFY(side.machine.state() == SessionState::Reconnecting);
    QVERIFY(find<DiscardControl>(lost) != nullptr && find<ConnectLaneZero>(lost) != nullptr);
    QVERIFY(raisedTo(side, 2));
}

void SessionLivenessTest::lifeEndsSuspicion()
{
    Side side;
    side.becomeSuspect();
    side.handle(LifeHeard{LifePath::Packet}); // on any path
    QVERIFY(side.machine.state() == SessionState::Open);
    QVERIFY(raisedTo(side, 1));
}

void SessionLivenessTest::otherPathsDoNotReplaceLaneZero()
{
    Side side;
    side.becomeOpen();
    for (auto at = 20ms; at < 500ms; at += 20ms) {
        side.tick(20ms);
        side.handle(LifeHeard{LifePath::Packet});
        QVERIFY(side.machine.state() == SessionState::Open);
    }
    side.tick(20ms);
    QVERIFY(side.machine.state() == SessionState::Reconnecting);
    QVERIFY(!side.machine.isIncomingUp()); // heals only over lane 0
    side.beat(LifePath::Packet);
    QVERIFY(side.machine.state() == SessionState::Reconnecting);
    side.handle(IncomingUp{});
    side.beat();
    QVERIFY(side.machine.state() == SessionState::Open);
}

void SessionLivenessTest::silentLaneZeroThatSpeaksAgainHeals()
{
    Side side;
    side.becomeOpen();
    for (auto at = 20ms; at <= 500ms; at += 20ms) {
        side.tick(20ms);
        side.handle(LifeHeard{LifePath::Packet});
    }
    QVERIFY(side.machine.state() == SessionState::Reconnecting);
    side.beat(); // TCP sent it again, late
    QVERIFY(side.machine.state() == SessionState::Open);

    // One that broke meanwhile says nothing more.
    Side other;
    other.becomeOpen();
    for (auto at = 20ms; at <= 500ms; at += 20ms) {
        other.tick(20ms);
        other.handle(LifeHeard{LifePath::Packet});
    }
    other.handle(IncomingLost{"reset"});
    other.beat();
    QVERIFY(other.machine.state() == SessionState::Reconnecting);
}

void SessionLivenessTest::peerThatMissesLaneZeroGetsItAnew()
{
    Side side;
    side.becomeOpen();
    const auto connectsWhenPeerIs = [&](SessionState state) {
        side.peerState = state;
        return find<ConnectLaneZero>(side.beat()) != nullptr;
    };
    QVERIFY(!connectsWhenPeerIs(SessionState::Reconnecting)); // one may cross the healing
    QVERIFY(connectsWhenPeerIs(SessionState::Reconnecting));
    QVERIFY(side.machine.state() == SessionState::Open && side.machine.isOutgoingUp()); // the old one serves until then
    QVERIFY(!connectsWhenPeerIs(SessionState::Reconnecting));
    side.handle(OutgoingFailed{});
    QVERIFY(side.machine.state() == SessionState::Open);
    QVERIFY(connectsWhenPeerIs(SessionState::Reconnecting));
    side.handle(OutgoingUp{});
    QVERIFY(!connectsWhenPeerIs(SessionState::Reconnecting)); // once for one waiting
    QVERIFY(!connectsWhenPeerIs(SessionState::Open));
    QVERIFY(!connectsWhenPeerIs(SessionState::Reconnecting));
    QVERIFY(connectsWhenPeerIs(SessionState::Reconnecting));
}

void SessionLivenessTest::peerThatIsNotOpenIsLostAtOnce()
{
    Side side;
    side.becomeOpen();
    side.peerState = SessionState::Reconnecting;
    side.live(500ms);
    QVERIFY(side.machine.state() == SessionState::Open);
    const auto lost = side.tick(20ms);
    QVERIFY(side.machine.state() == SessionState::StandBy);
    QVERIFY(find<SessionLost>(lost)->diagnosis.cause == LossCause::HeartbeatLost);
    QVERIFY(find<SessionLost>(lost)->diagnosis.peerState == SessionState::Reconnecting);
}

void SessionLivenessTest::retriesFiftyMillisecondsAfterTheLastFailure()
{
    Side side;
    side.becomeOpen();
    QVERIFY(find<ConnectLaneZero>(side.handle(OutgoingLost{ProbeResult::NotProbed, "reset"})) != nullptr); // at once
    for (int attempt = 0; attempt < 5; ++attempt) {
        side.tick(30ms); // the attempt takes its time
        QVERIFY(side.handle(OutgoingFailed{ProbeResult::ConnectionRefused, "refused"}).empty());
        QVERIFY(find<ConnectLaneZero>(side.tick(50ms - 1ns)) == nullptr);
        QVERIFY(find<ConnectLaneZero>(side.tick(1ns)) != nullptr);
        QVERIFY(find<ConnectLaneZero>(side.tick()) == nullptr);
    }
}

void SessionLivenessTest::connectsAgainAfterSilenceThoughTheLaneLooksWhole()
{
    Side side;
    side.becomeOpen();
    QVERIFY(find<ConnectLaneZero>(side.tick(110ms)) != nullptr);
    QVERIFY(side.machine.isOutgoingUp());
    side.pass(5ms);
    QCOMPARE(wordsOf(side.handle(OutgoingUp{})), std::string("Heartbeat")); // the new one says at once how things stand
}

void SessionLivenessTest::connectsOnlyWhatItConnectedBefore()
{
    Side side;
    side.becomeOpen();
    const auto actions = side.handle(IncomingLost{"reset"});
    QVERIFY(side.machine.state() == SessionState::Reconnecting);
    QVERIFY(find<ConnectLaneZero>(actions) == nullptr); // the peer connects its own
}

void SessionLivenessTest::healsWhenBothLanesStandAndAHeartbeatCame()
{
    Side side;
    side.becomeOpen();
    side.handle(OutgoingLost{ProbeResult::NotProbed, "reset"});
    side.handle(IncomingLost{"reset"});
    side.tick(40ms);
    side.handle(OutgoingUp{});
    side.beat(); // heard while the peer's lane 0 is still missing, on the other path
    QVERIFY(side.machine.state() == SessionState::Reconnecting);
    side.handle(IncomingUp{});
    QVERIFY(side.machine.state() == SessionState::Reconnecting);
    side.pass(2ms);
    const auto healed = side.beat();
    QVERIFY(side.machine.state() == SessionState::Open);
    QVERIFY(find<SessionInterrupted>(healed)->duration == 42ms);
    QVERIFY(findSent<protocol::Heartbeat>(healed)->epoch == 2);
}

void SessionLivenessTest::doesNotHealWithAPeerThatNeverOpened()
{
    // Our lane broke with ChannelOpened on it; the peer waits in the dialogue, and beats.
    Side side;
    side.becomeOpen();
    side.handle(OutgoingLost{ProbeResult::NotProbed, "reset"});
    side.handle(OutgoingUp{});
    side.peerState = SessionState::Opening;
    for (int beats = 0; beats < 24; ++beats) {
        side.tick(20ms);
        QCOMPARE(wordsOf(side.beat()), std::string());
        QVERIFY(side.machine.state() == SessionState::Reconnecting);
    }
    QVERIFY(find<SessionLost>(side.tick(20ms))->diagnosis.cause == LossCause::ConnectionLost);
}

void SessionLivenessTest::healsWithoutABrokenConnection()
{
    Side side;
    side.becomeReconnecting();
    side.pass(60ms);
    QVERIFY(find<SessionInterrupted>(side.beat())->duration == 60ms);
    QVERIFY(side.machine.state() == SessionState::Open);
    side.handle(OutgoingUp{}); // the attempt that was in hand ends after the healing
    side.live(300ms);
    QVERIFY(side.machine.state() == SessionState::Open);
}

void SessionLivenessTest::replacedLaneDoesNotDisturb()
{
    Side side;
    side.becomeOpen();
    QVERIFY(side.handle(IncomingUp{}).empty()); // an Attach of a lane that is attached
    QVERIFY(side.machine.state() == SessionState::Open);
}

void SessionLivenessTest::goesToStandByWhenReconnectHasPassed()
{
    Side side;
    side.becomeReconnecting();
    side.tick(500ms - 1ns);
    QVERIFY(side.machine.state() == SessionState::Reconnecting);
    const auto lost = side.tick(1ns);
    QCOMPARE(wordsOf(lost).substr(wordsOf(lost).find("DiscardAll")), std::string("DiscardAll CloseLanes Lost:HeartbeatLost"));
    QVERIFY(side.machine.state() == SessionState::StandBy);
    QCOMPARE(find<SessionLost>(lost)->incident, IncidentId{100});
    QVERIFY(!side.machine.nextDeadline());
}

void SessionLivenessTest::stallDiscardsEverything()
{
    Side side;
    side.becomeOpen();
    side.pass(80ms);
    QCOMPARE(wordsOf(side.handle(Stalled{80ms})), std::string("DiscardAll Heartbeat"));
    QVERIFY(side.machine.state() == SessionState::Reconnecting);
    QVERIFY(raisedTo(side, 2));
    side.beat();
    QVERIFY(side.machine.state() == SessionState::Open);
    side.pass(80ms);
    side.handle(Stalled{80ms});
    QVERIFY(find<SessionLost>(side.tick(500ms))->diagnosis.cause == LossCause::LocalStall);
}

void SessionLivenessTest::stallInReconnectingDiscardsAgain()
{
    Side side;
    side.becomeReconnecting();
    side.pass(80ms);
    QCOMPARE(wordsOf(side.handle(Stalled{80ms})), std::string("DiscardAll"));
    QVERIFY(side.machine.state() == SessionState::Reconnecting);
}

void SessionLivenessTest::epochRisesWithEveryPermissionThatEnds()
{
    Side side;
    side.becomeOpen();
    QVERIFY(raisedTo(side, 1)); // the first opening does not raise it
    side.tick(110ms);
    QVERIFY(raisedTo(side, 2));
    side.beat();
    QVERIFY(raisedTo(side, 2)); // healed: nothing new
    side.machine.revoke(side.now);
    QVERIFY(raisedTo(side, 3));
    side.handle(ViolationFound{"origin"});
    const auto inStandBy = side.machine.guard().epoch();
    QVERIFY(inStandBy >= 3);
    side.handle(ReopenRequested{200});
    side.handle(OutgoingUp{});
    side.handle(IncomingUp{});
    side.handle(side.commit(true));
    QVERIFY(side.machine.state() == SessionState::Open);
    QVERIFY(side.machine.guard().epoch() > inStandBy);
}

void SessionLivenessTest::revocationIsSaidAtOnce()
{
    Side side;
    side.becomeOpen();
    side.pass(3ms);
    const auto said = side.machine.revoke(side.now);
    QCOMPARE(findSent<protocol::Heartbeat>(said)->epoch, 2U);
    QCOMPARE(wordsOf(side.tick(16ms)), std::string()); // and the beat goes on as it was
    QCOMPARE(wordsOf(side.tick(1ms)), std::string("Heartbeat"));
}

void SessionLivenessTest::controlWaitsForAHeartbeatOfThisSession()
{
    Side side;
    side.becomeOpening();
    side.handle(side.commit());
    QVERIFY(!side.machine.stamper().ready());
    side.beat();
    QVERIFY(side.machine.stamper().ready());
    side.handle(ViolationFound{"origin"});
    side.handle(ReopenRequested{200});
    QVERIFY(!side.machine.stamper().ready());
}

void SessionLivenessTest::otherEndsIncidentEndsTheSession()
{
    Side side;
    side.becomeOpen();
    QCOMPARE(wordsOf(side.handle(IncidentHeld{100})), std::string("DiscardAll CloseLanes Lost:ConnectionLost"));
    QVERIFY(side.machine.state() == SessionState::StandBy);
    side.handle(IncidentGone{});
    QVERIFY(side.machine.state() == SessionState::Closed && side.machine.incident() == 0);
}

void SessionLivenessTest::diagnosisTellsWhatWasHeard()
{
    Side side;
    side.becomeOpen();
    side.live(2s);
    side.peerState = SessionState::Suspect;
    side.beat();
    side.tick(110ms);
    side.handle(OutgoingLost{ProbeResult::NotProbed, "reset"});
    const auto lost = side.tick(500ms);
    const auto& diagnosis = find<SessionLost>(lost)->diagnosis;
    QVERIFY(diagnosis.cause == LossCause::HeartbeatLost);
    QVERIFY(diagnosis.silence == 610ms);
    QCOMPARE(diagnosis.heartbeatsExpected, std::uint64_t{50});
    QVERIFY(diagnosis.heartbeatsReceived >= 44 && diagnosis.heartbeatsReceived <= 46);
    QVERIFY(diagnosis.peerState == SessionState::Suspect);
    QVERIFY(!diagnosis.toPeerConnected && diagnosis.fromPeerConnected);
    QCOMPARE(diagnosis.since.ns, side.now.wall.ns - 500'000'000ULL);
}

QTEST_APPLESS_MAIN(SessionLivenessTest)
#include "session_liveness_test.moc"
