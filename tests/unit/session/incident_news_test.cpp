// How much news of incidents one neighbour may bring: what somebody invents is not handed on without a bound.
#include "ledger_actions.hpp"

#include <QTest>

#include <algorithm>

using namespace liena;
using namespace liena::session;
using namespace liena::test;
using namespace std::chrono_literals;

namespace {

constexpr std::size_t devices = 4;
constexpr std::uint64_t most = 256 * (devices + 2); ///< of a kind, at once

Now after(std::chrono::nanoseconds time) { return {now.mono + time, now.wall}; }

template <typename T>
std::size_t count(const LedgerActions& actions)
{
    return static_cast<std::size_t>(
        std::count_if(actions.begin(), actions.end(), [](const auto& action) { return std::holds_alternative<T>(action); }));
}

/// Ends nothing that anybody holds.
protocol::ChannelReOpened invented(std::uint64_t number) { return {100000 + number, 500000 + number, xray, cockpit}; }

struct Sum {
    std::size_t handedOn = 0;
    std::size_t told = 0;
    std::size_t notHandedOn = 0;

    void add(const LedgerActions& actions)
    {
        handedOn += count<Broadcast>(actions);
        told += count<Tell>(actions);
        notHandedOn += count<NewsNotHandedOn>(actions);
    }
};

} // namespace

class IncidentNewsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void inventedReopeningsAreBounded();
    void anotherNeighbourBringsWhatWasNotHandedOn();
    void oneKindTakesNoRoomOfAnother();
    void reportsAreKeptLongerThanTheyAreHandedOn();
    void incidentsThatComeAndGoAreBounded();
    void whatEndsAnIncidentIsAlwaysHandedOn();
    void aWholeSystemInStandByIsHandedOn();
    void whatANeighbourHandsOnDoesNotSilenceIt();
    void comesAgainWithTime();
};

void IncidentNewsTest::inventedReopeningsAreBounded()
{
    StandByLedger ledger(robot, devices);
    Sum sum;
    for (std::uint64_t i = 0; i < 10 * most; ++i)
        sum.add(ledger.heard(xray, invented(i), now));
    QCOMPARE(sum.handedOn, std::size_t{most});
    QCOMPARE(sum.notHandedOn, std::size_t{9 * most});
}

void IncidentNewsTest::anotherNeighbourBringsWhatWasNotHandedOn()
{
    StandByLedger ledger(robot, devices);
    for (std::uint64_t i = 0; i < most; ++i)
        ledger.heard(xray, invented(i), now);
    QCOMPARE(count<Broadcast>(ledger.heard(xray, invented(most), now)), std::size_t{0});
    QCOMPARE(count<Broadcast>(ledger.heard(arm, invented(most), now)), std::size_t{1});
    QVERIFY(ledger.heard(arm, invented(0), now).empty()); // known: it is neither news nor too much
}

void IncidentNewsTest::oneKindTakesNoRoomOfAnother()
{
    StandByLedger ledger(robot, devices);
    for (std::uint64_t i = 0; i < 10 * most; ++i)
        ledger.heard(xray, invented(i), now);
    const auto raised = ledger.heard(xray, protocol::StandBy{7, xray, cockpit, LossCause::HeartbeatLost, 100, xray}, now);
    QVERIFY(count<Broadcast>(raised) == 1 && count<NewsNotHandedOn>(raised) == 0);
    QCOMPARE(count<Broadcast>(ledger.heard(xray, protocol::StandByReport{7, xray, true, 1}, now)), std::size_t{1});
}

/// This device goes on showing what its neighbour says, for a while.
void IncidentNewsTest::reportsAreKeptLongerThanTheyAreHandedOn()
{
    StandByLedger ledger(robot, devices);
    ledger.heard(xray, protocol::StandBy{7, xray, cockpit, LossCause::HeartbeatLost, 100, xray}, now);
    Sum sum;
    for (std::uint64_t i = 1; i <= 10 * most; ++i)
        sum.add(ledger.heard(xray, protocol::StandByReport{7, xray, i % 2 == 0, i}, now));
    QCOMPARE(sum.handedOn, std::size_t{most});
    QCOMPARE(sum.told, std::size_t{2 * most});
    QCOMPARE(sum.notHandedOn, std::size_t{9 * most});
    QVERIFY(ledger.find(7)->holds.size() == 1 && ledger.find(7)->holds[0].confirmed == Timestamp{2 * most});
}

void IncidentNewsTest::incidentsThatComeAndGoAreBounded()
{
    StandByLedger ledger(robot, devices);
    Sum sum;
    for (IncidentId id = 1; id <= 3 * most; ++id) {
        sum.add(ledger.heard(xray, protocol::StandBy{id, xray, cockpit, LossCause::HeartbeatLost, 100, xray}, now));
        ledger.heard(xray, protocol::IncidentDismissed{id, xray, {"gone"}}, now);
    }
    QCOMPARE(sum.handedOn, std::size_t{most});
    QCOMPARE(sum.notHandedOn, std::size_t{2 * most});
    QVERIFY(!ledger.standsBy());
}

void IncidentNewsTest::whatEndsAnIncidentIsAlwaysHandedOn()
{
    StandByLedger ledger(robot, devices);
    ledger.heard(arm, protocol::StandBy{7, xray, cockpit, LossCause::HeartbeatLost, 100, xray}, now);
    for (std::uint64_t i = 0; i < 10 * most; ++i)
        ledger.heard(xray, invented(i), now);
    const auto ended = ledger.heard(xray, protocol::ChannelReOpened{3, 7, xray, cockpit}, now);
    QVERIFY(count<Broadcast>(ended) == 1 && count<NewsNotHandedOn>(ended) == 0);
    QVERIFY(!ledger.standsBy());
}

/// Power fails in half of a large system: every link to it is an incident, and every device reports that it holds for each; all of it by
/// way of the one neighbour that is left.
void IncidentNewsTest::aWholeSystemInStandByIsHandedOn()
{
    constexpr std::uint32_t many = 64;
    const auto device = [](std::uint32_t at) { return DeviceId((at + 1) << 9U); };
    StandByLedger ledger(robot, many);
    Sum sum;
    for (std::uint64_t id = 1; id <= 256; ++id)
        for (const auto end : {xray, cockpit})
            sum.add(ledger.heard(arm, protocol::StandBy{id, xray, cockpit, LossCause::ConnectionLost, 100, end}, now));
    QCOMPARE(sum.handedOn, std::size_t{2 * 256});
    for (std::uint64_t id = 1; id <= 256; ++id)
        for (std::uint32_t i = 0; i < many; ++i)
            sum.add(ledger.heard(arm, protocol::StandByReport{id, device(i), true, 1}, now));
    QCOMPARE(sum.handedOn, std::size_t{(2 + many) * 256});
    for (std::uint64_t id = 1; id <= 256; ++id)
        sum.add(ledger.heard(arm, protocol::ChannelReOpened{1000 + id, id, xray, cockpit}, now));
    QCOMPARE(sum.handedOn, std::size_t{(2 + many + 1) * 256});
    QCOMPARE(sum.notHandedOn, std::size_t{0});
    QVERIFY(!ledger.standsBy());
}

/// Between a hostile device and this one stands an honest neighbour, which hands on as much as it may.
void IncidentNewsTest::whatANeighbourHandsOnDoesNotSilenceIt()
{
    StandByLedger between(arm, devices);
    StandByLedger ledger(robot, devices);
    const auto bring = [&](std::uint64_t number, Now at) {
        for (const auto& action : between.heard(xray, invented(number), at))
            if (const auto* broadcast = std::get_if<Broadcast>(&action))
                ledger.heard(arm, std::get<protocol::ChannelReOpened>(broadcast->message), at);
    };
    for (std::uint64_t i = 0; i < 20000; ++i)
        bring(i, after(i * 500us)); // ten seconds
    const auto honest = ledger.heard(arm, protocol::ChannelReOpened{3, 7, arm, cockpit}, after(10s));
    QVERIFY(count<Broadcast>(honest) == 1 && count<NewsNotHandedOn>(honest) == 0);
}

void IncidentNewsTest::comesAgainWithTime()
{
    StandByLedger ledger(robot, devices);
    for (std::uint64_t i = 0; i < 10 * most; ++i)
        ledger.heard(xray, invented(i), now);
    QCOMPARE(count<Broadcast>(ledger.heard(xray, invented(90000), after(7s))), std::size_t{0});
    Sum sum;
    for (std::uint64_t i = 0; i < 10 * most; ++i)
        sum.add(ledger.heard(xray, invented(100000 + i), after(1h)));
    QCOMPARE(sum.handedOn, std::size_t{most});
}

QTEST_APPLESS_MAIN(IncidentNewsTest)
#include "incident_news_test.moc"
