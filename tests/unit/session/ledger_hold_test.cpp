// Who says that it holds, and to whom that is told (section 8).
#include "ledger_actions.hpp"

#include <QTest>

using namespace liena;
using namespace liena::session;
using namespace liena::test;
using namespace std::chrono_literals;
using Kind = SessionEvent::Kind;

class LedgerHoldTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void holdIsToldForEveryIncident();
    void newestHoldCountsAlsoAfterTheClockWasSetBack();
    void holdIsToldForLaterIncidentsToo();
    void onlyNewestHoldReportCounts();
    void holdOfUnknownIncidentIsPassedOver();
    void othersCannotSpeakForUs();
};

void LedgerHoldTest::holdIsToldForEveryIncident()
{
    StandByLedger ledger(robot);
    ledger.lost(cockpit, 7, LossCause::HeartbeatLost, Timestamp{100}, now);
    ledger.heard(arm, standBy(6, xray, cockpit), now);
    const auto actions = ledger.confirmHold(true, now);
    QCOMPARE(broadcasts<protocol::StandByReport>(actions).size(), std::size_t{2});
    QVERIFY((broadcasts<protocol::StandByReport>(actions)[0].first == protocol::StandByReport{6, robot, true, now.wall.ns}));
    QVERIFY((told(actions) == std::vector{Kind::HoldReported, Kind::HoldReported}));
    QVERIFY(ledger.confirmHold(true, now).empty());
    QVERIFY(ledger.find(7)->holds.size() == 1 && ledger.find(7)->holds[0].holding);
    QCOMPARE(broadcasts<protocol::StandByReport>(ledger.confirmHold(false, now)).size(), std::size_t{2});
    QVERIFY(ledger.find(7)->holds.size() == 1 && !ledger.find(7)->holds[0].holding);
}

void LedgerHoldTest::newestHoldCountsAlsoAfterTheClockWasSetBack()
{
    constexpr auto at = [](std::chrono::seconds wall) {
        return Now{now.mono, Timestamp{std::uint64_t(std::chrono::nanoseconds(wall).count())}};
    };
    StandByLedger ours(xray);
    StandByLedger theirs(robot);
    ours.heard(cockpit, standBy(6, robot, cockpit), now);
    theirs.heard(cockpit, standBy(6, robot, cockpit), now);
    for (const auto& [holding, wall] : {std::pair(true, 100s), std::pair(false, 95s), std::pair(true, 95s), std::pair(false, 96s)}) {
        const auto reports = broadcasts<protocol::StandByReport>(ours.confirmHold(holding, at(wall)));
        QCOMPARE(reports.size(), std::size_t{1});
        theirs.heard(xray, reports[0].first, now);
        QCOMPARE(theirs.find(6)->holds[0].holding, holding);
    }
}

void LedgerHoldTest::holdIsToldForLaterIncidentsToo()
{
    StandByLedger ledger(robot);
    QVERIFY(broadcasts<protocol::StandByReport>(ledger.confirmHold(true, now)).empty());
    const auto actions = ledger.heard(arm, standBy(6, xray, cockpit), now);
    QCOMPARE(broadcasts<protocol::StandByReport>(actions).size(), std::size_t{1});
    QVERIFY(!broadcasts<protocol::StandByReport>(actions)[0].second); // the teller does not know it either
    QCOMPARE(ledger.find(6)->holds.size(), std::size_t{1});
}

void LedgerHoldTest::onlyNewestHoldReportCounts()
{
    StandByLedger ledger(robot);
    ledger.heard(arm, standBy(6, xray, cockpit), now);
    const auto actions = ledger.heard(arm, protocol::StandByReport{6, xray, true, 200}, now);
    QVERIFY(broadcasts<protocol::StandByReport>(actions).front().second == arm);
    QVERIFY((told(actions) == std::vector{Kind::HoldReported}));
    QVERIFY(ledger.heard(cockpit, protocol::StandByReport{6, xray, true, 200}, now).empty());
    QVERIFY(ledger.heard(cockpit, protocol::StandByReport{6, xray, false, 199}, now).empty());
    QVERIFY(ledger.find(6)->holds[0].holding);
    QVERIFY(!ledger.heard(cockpit, protocol::StandByReport{6, xray, false, 201}, now).empty());
    QVERIFY(ledger.find(6)->holds.size() == 1 && !ledger.find(6)->holds[0].holding);
}

void LedgerHoldTest::holdOfUnknownIncidentIsPassedOver()
{
    StandByLedger ledger(robot);
    QVERIFY(ledger.heard(arm, protocol::StandByReport{6, xray, true, 200}, now).empty());
}

void LedgerHoldTest::othersCannotSpeakForUs()
{
    StandByLedger ledger(robot);
    ledger.heard(arm, standBy(6, xray, cockpit), now);
    QVERIFY(ledger.heard(arm, protocol::StandByReport{6, robot, true, 200}, now).empty());
    QVERIFY(ledger.find(6)->holds.empty());
}

QTEST_APPLESS_MAIN(LedgerHoldTest)
#include "ledger_hold_test.moc"
