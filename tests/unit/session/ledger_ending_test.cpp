// How incidents end, by a re-opening or a dismissal, and what is answered about those that ended (section 8, rulings A8 and B20).
#include "ledger_actions.hpp"

#include <QTest>

using namespace liena;
using namespace liena::session;
using namespace liena::test;
using namespace std::chrono_literals;

class LedgerEndingTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void endedIncidentIsAnsweredNotTakenUp_data();
    void endedIncidentIsAnsweredNotTakenUp();
    void answerNamesTheIncidentThatWasAskedAbout();
    void endedIncidentIsForgottenAfterADay();
    void ownReopeningEndsEveryIncidentOfThePair();
    void heardReopeningEndsTheIncidentThatItNames();
    void reopeningIsHandedOnOnce();
    void reopeningOfAnotherPairIsHandedOnOnce();
    void reopeningNeverEndsTheLossOfItsOwnSession();
    void answerAboutAnOldIncidentDoesNotEndANewerOne();
    void bothEndsMayNameDifferentIncidents();
    void dismissalEndsOneIncident();
    void dismissingWhatIsNotHeldDoesNothing();
    void heardDismissalIsHandedOn();
    void remembersABoundedNumberOfEnds();
};

void LedgerEndingTest::endedIncidentIsAnsweredNotTakenUp_data()
{
    QTest::addColumn<bool>("dismissed");
    QTest::newRow("by a re-opening") << false;
    QTest::newRow("by a dismissal") << true;
}

void LedgerEndingTest::endedIncidentIsAnsweredNotTakenUp()
{
    QFETCH(bool, dismissed);
    StandByLedger ledger(robot);
    ledger.lost(cockpit, 7, LossCause::HeartbeatLost, Timestamp{100}, now);
    if (dismissed)
        ledger.dismiss(7, "gone", now);
    else
        ledger.reopened(cockpit, 8, 7, now);
    const auto actions = ledger.heard(arm, standBy(7, robot, cockpit), now);
    QCOMPARE(actions.size(), std::size_t{1});
    QVERIFY(!ledger.standsBy());
    if (dismissed)
        QVERIFY((answers<protocol::IncidentDismissed>(actions, arm) == std::vector{protocol::IncidentDismissed{7, robot, {"gone"}}}));
    else
        QVERIFY((answers<protocol::ChannelReOpened>(actions, arm) == std::vector{protocol::ChannelReOpened{8, 7, robot, cockpit}}));
}

void LedgerEndingTest::answerNamesTheIncidentThatWasAskedAbout()
{
    // The cockpit re-opened as 8 and lost that at once; the robot never heard of it, held 7, and re-opened as 9, naming 7. Then the news
    // of 8 comes to the robot after all: the cockpit's answer has to end 8 there, although 9 is known.
    StandByLedger cockpitLedger(cockpit);
    cockpitLedger.lost(robot, 8, LossCause::ConnectionLost, Timestamp{200}, now);
    cockpitLedger.reopened(robot, 9, 7, now);
    QVERIFY(!cockpitLedger.standsBy());
    StandByLedger robotLedger(robot);
    robotLedger.lost(cockpit, 7, LossCause::HeartbeatLost, Timestamp{100}, now);
    robotLedger.reopened(cockpit, 9, 7, now);
    robotLedger.heard(arm, standBy(8, robot, cockpit, 200), now);
    QVERIFY(robotLedger.standsBy());
    const auto answer = answers<protocol::ChannelReOpened>(cockpitLedger.heard(robot, standBy(8, robot, cockpit, 200), now), robot);
    QCOMPARE(answer.size(), std::size_t{1});
    QVERIFY((answer[0] == protocol::ChannelReOpened{9, 8, robot, cockpit}));
    robotLedger.heard(cockpit, answer[0], now);
    QVERIFY(!robotLedger.standsBy());
}

void LedgerEndingTest::endedIncidentIsForgottenAfterADay()
{
    StandByLedger ledger(robot);
    ledger.lost(cockpit, 7, LossCause::HeartbeatLost, Timestamp{100}, now);
    ledger.dismiss(7, "gone", now);
    auto later = now;
    later.mono += 24h - 1s;
    QVERIFY(!answers<protocol::IncidentDismissed>(ledger.heard(arm, standBy(7, robot, cockpit), later), arm).empty());
    later.mono += 2s;
    QVERIFY(answers<protocol::IncidentDismissed>(ledger.heard(arm, standBy(7, robot, cockpit), later), arm).empty());
    QVERIFY(ledger.standsBy());
}

void LedgerEndingTest::ownReopeningEndsEveryIncidentOfThePair()
{
    StandByLedger ledger(robot);
    ledger.lost(cockpit, 7, LossCause::HeartbeatLost, Timestamp{100}, now);
    ledger.heard(arm, standBy(6, robot, cockpit, 50), now);
    ledger.heard(arm, standBy(9, xray, cockpit), now);
    const auto actions = ledger.reopened(cockpit, 8, 7, now);
    QCOMPARE(ledger.size(), std::size_t{1});
    QVERIFY(ledger.find(9) != nullptr);
    const auto sent = broadcasts<protocol::ChannelReOpened>(actions); // one for each that ended
    QVERIFY(sent.size() == 2 && !sent[0].second && !sent[1].second);
    QVERIFY((sent[0].first == protocol::ChannelReOpened{8, 6, robot, cockpit}));
    QVERIFY((sent[1].first == protocol::ChannelReOpened{8, 7, robot, cockpit}));
    QVERIFY(all<PairChanged>(actions).back().incident == 0);
    StandByLedger restarted(robot); // it holds nothing, and was told what the peer holds
    const auto told = broadcasts<protocol::ChannelReOpened>(restarted.reopened(cockpit, 8, 7, now));
    QVERIFY(told.size() == 1 && told[0].first == (protocol::ChannelReOpened{8, 7, robot, cockpit}));
}

void LedgerEndingTest::heardReopeningEndsTheIncidentThatItNames()
{
    // The loss 5 came after the re-opening of 6, by a clock that is an hour behind: no wall clock says which was first.
    StandByLedger ledger(arm);
    ledger.heard(xray, standBy(6, robot, cockpit, 5000), now);
    ledger.heard(xray, standBy(5, robot, cockpit, 100), now);
    ledger.heard(xray, standBy(9, robot, xray, 100), now);
    const auto actions = ledger.heard(xray, protocol::ChannelReOpened{8, 6, robot, cockpit}, now);
    QVERIFY(ledger.find(6) == nullptr);
    QVERIFY(ledger.find(5) != nullptr);
    QVERIFY(ledger.find(9) != nullptr);
    QVERIFY(broadcasts<protocol::ChannelReOpened>(actions).front().second == xray);
    QVERIFY(all<Tell>(actions)[0].event.peer == xray);
    QVERIFY(!all<Tell>(actions)[0].event.dismissed);
    ledger.heard(xray, protocol::ChannelReOpened{8, 9, robot, cockpit}, now); // of another pair
    QVERIFY(ledger.find(9) != nullptr);
}

void LedgerEndingTest::reopeningIsHandedOnOnce()
{
    StandByLedger ledger(arm);
    const protocol::ChannelReOpened message{8, 7, robot, cockpit};
    QCOMPARE(broadcasts<protocol::ChannelReOpened>(ledger.heard(xray, message, now)).size(), std::size_t{1});
    QVERIFY(ledger.heard(robot, message, now).empty());
    StandByLedger own(robot);
    own.reopened(cockpit, 8, 7, now);
    QVERIFY(own.heard(arm, message, now).empty());
}

void LedgerEndingTest::reopeningOfAnotherPairIsHandedOnOnce()
{
    // It names an incident that is held, and stays so: handed on each time it would travel round three devices for ever.
    StandByLedger ledger(arm);
    ledger.heard(xray, standBy(9, robot, xray), now);
    const protocol::ChannelReOpened message{8, 9, robot, cockpit};
    QCOMPARE(broadcasts<protocol::ChannelReOpened>(ledger.heard(xray, message, now)).size(), std::size_t{1});
    QVERIFY(ledger.heard(robot, message, now).empty());
    QVERIFY(ledger.find(9) != nullptr);
}

void LedgerEndingTest::reopeningNeverEndsTheLossOfItsOwnSession()
{
    // The session with token 8 was re-opened and lost again before the news of its opening came here, on a clock that is ahead.
    StandByLedger ledger(arm);
    ledger.heard(xray, standBy(8, robot, cockpit, 900), now);
    ledger.heard(xray, protocol::ChannelReOpened{8, 7, robot, cockpit}, now);
    QVERIFY(ledger.find(8) != nullptr);
    QVERIFY(ledger.standsBy());
    // Nor does an end of the pair, which is told of the loss before it reads of the opening.
    StandByLedger own(robot);
    own.heard(arm, standBy(8, robot, cockpit, 900), now);
    own.reopened(cockpit, 8, 8, now);
    QVERIFY(own.find(8) != nullptr);
    QVERIFY(answers<protocol::ChannelReOpened>(own.heard(arm, standBy(8, robot, cockpit, 900), now), arm).empty());
}

void LedgerEndingTest::answerAboutAnOldIncidentDoesNotEndANewerOne()
{
    // The arm was away. It still holds 6, and has heard of 7 on the same link; a neighbour answers its 6 with what ended that long ago.
    StandByLedger ledger(arm);
    ledger.heard(xray, standBy(6, robot, cockpit, 100), now);
    ledger.heard(xray, standBy(7, robot, cockpit, 5000), now);
    ledger.heard(robot, protocol::ChannelReOpened{77, 6, robot, cockpit}, now);
    QVERIFY(ledger.find(6) == nullptr);
    QVERIFY(ledger.find(7) != nullptr);
}

void LedgerEndingTest::bothEndsMayNameDifferentIncidents()
{
    StandByLedger ledger(arm);
    ledger.heard(xray, standBy(6, robot, cockpit, 100), now);
    ledger.heard(xray, standBy(7, robot, cockpit, 200), now);
    ledger.heard(robot, protocol::ChannelReOpened{77, 6, robot, cockpit}, now);
    const auto second = ledger.heard(cockpit, protocol::ChannelReOpened{77, 7, robot, cockpit}, now);
    QVERIFY(!ledger.standsBy());
    QCOMPARE(broadcasts<protocol::ChannelReOpened>(second).size(), std::size_t{1});
    QVERIFY(ledger.heard(cockpit, protocol::ChannelReOpened{77, 7, robot, cockpit}, now).empty());
}

void LedgerEndingTest::dismissalEndsOneIncident()
{
    StandByLedger ledger(robot);
    ledger.lost(cockpit, 7, LossCause::HeartbeatLost, Timestamp{100}, now);
    ledger.heard(arm, standBy(6, robot, cockpit), now);
    const auto actions = ledger.dismiss(7, "sent to repair", now);
    QCOMPARE(ledger.size(), std::size_t{1});
    QVERIFY((broadcasts<protocol::IncidentDismissed>(actions).front().first == protocol::IncidentDismissed{7, robot, {"sent to repair"}}));
    const auto ended = all<Tell>(actions)[0].event;
    QVERIFY(ended.dismissed && ended.detail == "sent to repair" && ended.incident.id == 7);
    QCOMPARE(all<PairChanged>(actions).front().incident, IncidentId{6}); // the link still has one
    QCOMPARE(all<PairChanged>(actions).front().ended, IncidentId{7});
}

void LedgerEndingTest::dismissingWhatIsNotHeldDoesNothing()
{
    StandByLedger ledger(robot);
    QVERIFY(ledger.dismiss(7, "gone", now).empty());
    QVERIFY(ledger.heard(arm, protocol::IncidentDismissed{7, cockpit, {"gone"}}, now).empty());
}

void LedgerEndingTest::heardDismissalIsHandedOn()
{
    StandByLedger ledger(arm);
    ledger.heard(xray, standBy(6, robot, cockpit), now);
    const auto actions = ledger.heard(xray, protocol::IncidentDismissed{6, cockpit, {"gone"}}, now);
    QVERIFY(!ledger.standsBy());
    QVERIFY(broadcasts<protocol::IncidentDismissed>(actions).front().second == xray);
    QVERIFY(all<Tell>(actions)[0].event.dismissed);
}

void LedgerEndingTest::remembersABoundedNumberOfEnds()
{
    StandByLedger ledger(arm);
    for (IncidentId id = 1; id <= 4097; ++id) {
        ledger.heard(xray, standBy(id, robot, cockpit), now);
        ledger.dismiss(id, "gone", now);
    }
    QCOMPARE(answers<protocol::IncidentDismissed>(ledger.heard(xray, standBy(2, robot, cockpit), now), xray).size(), std::size_t{1});
    QVERIFY(!all<Broadcast>(ledger.heard(xray, standBy(1, robot, cockpit), now)).empty()); // the oldest is forgotten: taken up again
}

QTEST_APPLESS_MAIN(LedgerEndingTest)
#include "ledger_ending_test.moc"
