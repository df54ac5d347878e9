// How incidents rise, spread and are remembered (section 8, rulings A8 and B20).
#include "ledger_actions.hpp"

#include <QTest>

using namespace liena;
using namespace liena::session;
using namespace liena::test;
using Kind = SessionEvent::Kind;

class StandByLedgerTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void ownLossIsToldToAll();
    void ownLossThatIsKnownAlreadyOnlyNamesThePair();
    void causesOfBothEndsAreKeptAndHandedOnOnce();
    void anotherPairWithTheSameIncidentChangesNothing();
    void othersIncidentIsHandedOnButNotBack();
    void sameIncidentIsHandedOnOnce();
    void incidentOfOurPairNamesTheLink();
    void standByBeginsOnceAndEndsOnce();
    void greetsWithEverythingHeld();
    void takesNoMoreThanItsBound();
    void refusesIncidentThatCannotBe_data();
    void refusesIncidentThatCannotBe();
};

void StandByLedgerTest::ownLossIsToldToAll()
{
    StandByLedger ledger(robot);
    QVERIFY(!ledger.standsBy());
    const auto actions = ledger.lost(cockpit, 7, LossCause::ConnectionLost, Timestamp{100}, now);
    QVERIFY(ledger.standsBy());
    const auto sent = broadcasts<protocol::StandBy>(actions);
    QCOMPARE(sent.size(), std::size_t{1});
    QVERIFY((sent[0].first == protocol::StandBy{7, robot, cockpit, LossCause::ConnectionLost, 100, robot}));
    QVERIFY(!sent[0].second);
    QVERIFY((told(actions) == std::vector{Kind::IncidentRaised, Kind::StandByBegan}));
    const auto pairs = all<PairChanged>(actions);
    QVERIFY(pairs.size() == 1 && pairs[0].peer == cockpit && pairs[0].incident == 7);
    QVERIFY(ledger.find(7)->a == robot && ledger.find(7)->b == cockpit);
    StandByLedger other(cockpit);
    other.lost(robot, 7, LossCause::HeartbeatLost, Timestamp{90}, now);
    QVERIFY(other.find(7)->a == robot && other.find(7)->b == cockpit);
}

void StandByLedgerTest::ownLossThatIsKnownAlreadyOnlyNamesThePair()
{
    StandByLedger ledger(robot);
    ledger.heard(arm, standBy(7, robot, cockpit), now);
    const auto actions = ledger.lost(cockpit, 7, LossCause::ConnectionLost, Timestamp{200}, now);
    QCOMPARE(all<PairChanged>(actions).size(), std::size_t{1});
    QVERIFY((told(actions) == std::vector{Kind::CauseReported}));
    QVERIFY(ledger.find(7)->since == Timestamp{100}); // of the end that first said so
    QVERIFY(ledger.find(7)->cause == LossCause::HeartbeatLost);
    QVERIFY(ledger.find(7)->causeOfA == LossCause::ConnectionLost && ledger.find(7)->causeOfB == LossCause::HeartbeatLost);
    const auto sent = broadcasts<protocol::StandBy>(actions);
    QVERIFY(sent.size() == 1 && (sent[0].first == protocol::StandBy{7, robot, cockpit, LossCause::ConnectionLost, 200, robot}));
}

void StandByLedgerTest::causesOfBothEndsAreKeptAndHandedOnOnce()
{
    StandByLedger ledger(arm);
    ledger.heard(cockpit, standBy(7, robot, cockpit), now);
    auto other = standBy(7, robot, cockpit, 130);
    other.device = robot;
    other.cause = LossCause::LocalStall;
    const auto actions = ledger.heard(xray, other, now);
    QVERIFY((told(actions) == std::vector{Kind::CauseReported}));
    const auto sent = broadcasts<protocol::StandBy>(actions);
    QVERIFY(sent.size() == 1 && sent[0].first == other && sent[0].second == xray);
    QVERIFY(ledger.find(7)->cause == LossCause::HeartbeatLost); // of the end that first said so
    QVERIFY(ledger.find(7)->causeOfA == LossCause::LocalStall && ledger.find(7)->causeOfB == LossCause::HeartbeatLost);
    QVERIFY(ledger.heard(robot, other, now).empty());
    other.cause = LossCause::ConnectionLost; // nobody changes its mind
    QVERIFY(ledger.heard(robot, other, now).empty());
    QCOMPARE(answers<protocol::StandBy>(ledger.greet(robot), robot).size(), std::size_t{2});
}

void StandByLedgerTest::anotherPairWithTheSameIncidentChangesNothing()
{
    StandByLedger ledger(arm);
    ledger.heard(cockpit, standBy(7, robot, cockpit), now);
    auto other = standBy(7, robot, xray, 130);
    other.device = robot;
    QVERIFY(ledger.heard(xray, other, now).empty());
    QVERIFY(ledger.find(7)->causeOfA == LossCause::None);
}

void StandByLedgerTest::othersIncidentIsHandedOnButNotBack()
{
    StandByLedger ledger(robot);
    const auto actions = ledger.heard(arm, standBy(7, xray, cockpit), now);
    const auto sent = broadcasts<protocol::StandBy>(actions);
    QCOMPARE(sent.size(), std::size_t{1});
    QVERIFY(sent[0].first == standBy(7, xray, cockpit));
    QVERIFY(sent[0].second == arm);
    QVERIFY(ledger.standsBy());
    QVERIFY(all<PairChanged>(actions).empty());
    QVERIFY(all<Tell>(actions)[0].event.peer == arm);
}

void StandByLedgerTest::sameIncidentIsHandedOnOnce()
{
    StandByLedger ledger(robot);
    ledger.heard(arm, standBy(7, xray, cockpit), now);
    QVERIFY(ledger.heard(arm, standBy(7, xray, cockpit), now).empty());
    QVERIFY(ledger.heard(xray, standBy(7, xray, cockpit), now).empty());
    QCOMPARE(ledger.size(), std::size_t{1});
}

void StandByLedgerTest::incidentOfOurPairNamesTheLink()
{
    StandByLedger ledger(cockpit);
    const auto pairs = all<PairChanged>(ledger.heard(arm, standBy(7, robot, cockpit), now));
    QVERIFY(pairs.size() == 1 && pairs[0].peer == robot && pairs[0].incident == 7);
}

void StandByLedgerTest::standByBeginsOnceAndEndsOnce()
{
    StandByLedger ledger(robot);
    QVERIFY((told(ledger.heard(arm, standBy(1, xray, cockpit), now)) == std::vector{Kind::IncidentRaised, Kind::StandByBegan}));
    QVERIFY((told(ledger.heard(arm, standBy(2, robot, xray), now)) == std::vector{Kind::IncidentRaised}));
    const auto first = ledger.heard(arm, protocol::IncidentDismissed{1, cockpit, {"gone"}}, now);
    QVERIFY((told(first) == std::vector{Kind::IncidentEnded}));
    QVERIFY(ledger.standsBy());
    const auto second = ledger.dismiss(2, "gone", now);
    QVERIFY((told(second) == std::vector{Kind::IncidentEnded, Kind::StandByEnded}));
    QVERIFY(!ledger.standsBy());
}

void StandByLedgerTest::greetsWithEverythingHeld()
{
    StandByLedger ledger(robot);
    QVERIFY(ledger.greet(arm).empty());
    ledger.lost(cockpit, 7, LossCause::HeartbeatLost, Timestamp{100}, now);
    ledger.heard(xray, standBy(6, xray, cockpit, 50), now);
    ledger.heard(xray, protocol::StandByReport{6, xray, true, 200}, now);
    const auto actions = ledger.greet(arm);
    QCOMPARE(answers<protocol::StandBy>(actions, arm).size(), std::size_t{2});
    QVERIFY((answers<protocol::StandByReport>(actions, arm) == std::vector{protocol::StandByReport{6, xray, true, 200}}));
    const auto incidents = ledger.incidents();
    QVERIFY(incidents[0].id == 6 && incidents[1].id == 7); // oldest first
}

void StandByLedgerTest::takesNoMoreThanItsBound()
{
    StandByLedger ledger(robot);
    for (IncidentId id = 1; id <= 256; ++id)
        QVERIFY(all<IncidentNotKept>(ledger.heard(arm, standBy(id, xray, cockpit), now)).empty());
    const auto actions = ledger.heard(arm, standBy(257, xray, cockpit), now);
    QVERIFY(actions.size() == 1 && all<IncidentNotKept>(actions)[0].teller == arm); // which may be honest, and only hands it on
    QCOMPARE(ledger.size(), std::size_t{256});
    ledger.lost(cockpit, 1000, LossCause::HeartbeatLost, Timestamp{100}, now); // our own loss is never kept back
    QVERIFY(ledger.find(1000) != nullptr);
}

void StandByLedgerTest::refusesIncidentThatCannotBe_data()
{
    QTest::addColumn<quint64>("id");
    QTest::addColumn<quint32>("a");
    QTest::addColumn<quint32>("b");
    QTest::newRow("no name") << quint64{0} << robot.value() << cockpit.value();
    QTest::newRow("pair the wrong way round") << quint64{7} << cockpit.value() << robot.value();
    QTest::newRow("one device alone") << quint64{7} << robot.value() << robot.value();
}

void StandByLedgerTest::refusesIncidentThatCannotBe()
{
    QFETCH(quint64, id);
    QFETCH(quint32, a);
    QFETCH(quint32, b);
    StandByLedger ledger(arm);
    const auto actions = ledger.heard(xray, standBy(id, DeviceId(a), DeviceId(b)), now);
    QCOMPARE(all<LedgerViolation>(actions).size(), std::size_t{1});
    QVERIFY(!ledger.standsBy());
    auto stranger = standBy(7, robot, cockpit);
    stranger.device = xray; // no end of the pair
    QCOMPARE(all<LedgerViolation>(ledger.heard(xray, stranger, now)).size(), std::size_t{1});
    QVERIFY(!ledger.standsBy());
}

QTEST_APPLESS_MAIN(StandByLedgerTest)
#include "stand_by_ledger_test.moc"
