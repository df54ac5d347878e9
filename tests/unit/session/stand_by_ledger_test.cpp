// How incidents rise, spread, end and are remembered (section 8, rulings A8 and B20).
#include "session/stand_by_ledger.hpp"

#include <QTest>

using namespace liena;
using namespace liena::session;
using namespace std::chrono_literals;
using Kind = SessionEvent::Kind;

namespace {

constexpr DeviceId robot(0x00008208U);
constexpr DeviceId xray(0x20010208U);
constexpr DeviceId cockpit(0x40018208U);
constexpr DeviceId arm(0x60008208U);
constexpr Now now{Instant(1h), Timestamp{5000}};

template <typename T>
std::vector<T> all(const LedgerActions& actions)
{
    std::vector<T> found;
    for (const auto& action : actions)
        if (const auto* one = std::get_if<T>(&action))
            found.push_back(*one);
    return found;
}

std::vector<Kind> told(const LedgerActions& actions)
{
    std::vector<Kind> kinds;
    for (const auto& tell : all<Tell>(actions))
        kinds.push_back(tell.event.kind);
    return kinds;
}

/// The broadcasts of message type T, each with the neighbour that is left out.
template <typename T>
std::vector<std::pair<T, std::optional<DeviceId>>> broadcasts(const LedgerActions& actions)
{
    std::vector<std::pair<T, std::optional<DeviceId>>> found;
    for (const auto& broadcast : all<Broadcast>(actions))
        if (const auto* message = std::get_if<T>(&broadcast.message))
            found.emplace_back(*message, broadcast.except);
    return found;
}

template <typename T>
std::vector<T> answers(const LedgerActions& actions, DeviceId to)
{
    std::vector<T> found;
    for (const auto& answer : all<Answer>(actions))
        if (const auto* message = std::get_if<T>(&answer.message); message != nullptr && answer.to == to)
            found.push_back(*message);
    return found;
}

/// As the end with the higher id says it.
protocol::StandBy standBy(IncidentId id, DeviceId a, DeviceId b, std::uint64_t since = 100)
{
    return {id, a, b, LossCause::HeartbeatLost, since, b};
}

} // namespace

class StandByLedgerTest : public QObject {
    Q_OBJECT

private slots:
    void ownLossIsToldToAll();
    void ownLossThatIsKnownAlreadyOnlyNamesThePair();
    void causesOfBothEndsAreKeptAndHandedOnOnce();
    void anotherPairWithTheSameIncidentChangesNothing();
    void othersIncidentIsHandedOnButNotBack();
    void sameIncidentIsHandedOnOnce();
    void incidentOfOurPairNamesTheLink();
    void standByBeginsOnceAndEndsOnce();
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
    void holdIsToldForEveryIncident();
    void newestHoldCountsAlsoAfterTheClockWasSetBack();
    void holdIsToldForLaterIncidentsToo();
    void onlyNewestHoldReportCounts();
    void holdOfUnknownIncidentIsPassedOver();
    void othersCannotSpeakForUs();
    void greetsWithEverythingHeld();
    void takesNoMoreThanItsBound();
    void refusesIncidentThatCannotBe_data();
    void refusesIncidentThatCannotBe();
    void remembersABoundedNumberOfEnds();
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

void StandByLedgerTest::endedIncidentIsAnsweredNotTakenUp_data()
{
    QTest::addColumn<bool>("dismissed");
    QTest::newRow("by a re-opening") << false;
    QTest::newRow("by a dismissal") << true;
}

void StandByLedgerTest::endedIncidentIsAnsweredNotTakenUp()
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

void StandByLedgerTest::answerNamesTheIncidentThatWasAskedAbout()
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

void StandByLedgerTest::endedIncidentIsForgottenAfterADay()
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

void StandByLedgerTest::ownReopeningEndsEveryIncidentOfThePair()
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

void StandByLedgerTest::heardReopeningEndsTheIncidentThatItNames()
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

void StandByLedgerTest::reopeningIsHandedOnOnce()
{
    StandByLedger ledger(arm);
    const protocol::ChannelReOpened message{8, 7, robot, cockpit};
    QCOMPARE(broadcasts<protocol::ChannelReOpened>(ledger.heard(xray, message, now)).size(), std::size_t{1});
    QVERIFY(ledger.heard(robot, message, now).empty());
    StandByLedger own(robot);
    own.reopened(cockpit, 8, 7, now);
    QVERIFY(own.heard(arm, message, now).empty());
}

void StandByLedgerTest::reopeningOfAnotherPairIsHandedOnOnce()
{
    // It names an incident that is held, and stays so: handed on each time it would travel round three devices for ever.
    StandByLedger ledger(arm);
    ledger.heard(xray, standBy(9, robot, xray), now);
    const protocol::ChannelReOpened message{8, 9, robot, cockpit};
    QCOMPARE(broadcasts<protocol::ChannelReOpened>(ledger.heard(xray, message, now)).size(), std::size_t{1});
    QVERIFY(ledger.heard(robot, message, now).empty());
    QVERIFY(ledger.find(9) != nullptr);
}

void StandByLedgerTest::reopeningNeverEndsTheLossOfItsOwnSession()
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

void StandByLedgerTest::answerAboutAnOldIncidentDoesNotEndANewerOne()
{
    // The arm was away. It still holds 6, and has heard of 7 on the same link; a neighbour answers its 6 with what ended that long ago.
    StandByLedger ledger(arm);
    ledger.heard(xray, standBy(6, robot, cockpit, 100), now);
    ledger.heard(xray, standBy(7, robot, cockpit, 5000), now);
    ledger.heard(robot, protocol::ChannelReOpened{77, 6, robot, cockpit}, now);
    QVERIFY(ledger.find(6) == nullptr);
    QVERIFY(ledger.find(7) != nullptr);
}

void StandByLedgerTest::bothEndsMayNameDifferentIncidents()
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

void StandByLedgerTest::dismissalEndsOneIncident()
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

void StandByLedgerTest::dismissingWhatIsNotHeldDoesNothing()
{
    StandByLedger ledger(robot);
    QVERIFY(ledger.dismiss(7, "gone", now).empty());
    QVERIFY(ledger.heard(arm, protocol::IncidentDismissed{7, cockpit, {"gone"}}, now).empty());
}

void StandByLedgerTest::heardDismissalIsHandedOn()
{
    StandByLedger ledger(arm);
    ledger.heard(xray, standBy(6, robot, cockpit), now);
    const auto actions = ledger.heard(xray, protocol::IncidentDismissed{6, cockpit, {"gone"}}, now);
    QVERIFY(!ledger.standsBy());
    QVERIFY(broadcasts<protocol::IncidentDismissed>(actions).front().second == xray);
    QVERIFY(all<Tell>(actions)[0].event.dismissed);
}

void StandByLedgerTest::holdIsToldForEveryIncident()
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

void StandByLedgerTest::newestHoldCountsAlsoAfterTheClockWasSetBack()
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

void StandByLedgerTest::holdIsToldForLaterIncidentsToo()
{
    StandByLedger ledger(robot);
    QVERIFY(broadcasts<protocol::StandByReport>(ledger.confirmHold(true, now)).empty());
    const auto actions = ledger.heard(arm, standBy(6, xray, cockpit), now);
    QCOMPARE(broadcasts<protocol::StandByReport>(actions).size(), std::size_t{1});
    QVERIFY(!broadcasts<protocol::StandByReport>(actions)[0].second); // the teller does not know it either
    QCOMPARE(ledger.find(6)->holds.size(), std::size_t{1});
}

void StandByLedgerTest::onlyNewestHoldReportCounts()
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

void StandByLedgerTest::holdOfUnknownIncidentIsPassedOver()
{
    StandByLedger ledger(robot);
    QVERIFY(ledger.heard(arm, protocol::StandByReport{6, xray, true, 200}, now).empty());
}

void StandByLedgerTest::othersCannotSpeakForUs()
{
    StandByLedger ledger(robot);
    ledger.heard(arm, standBy(6, xray, cockpit), now);
    QVERIFY(ledger.heard(arm, protocol::StandByReport{6, robot, true, 200}, now).empty());
    QVERIFY(ledger.find(6)->holds.empty());
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

void StandByLedgerTest::remembersABoundedNumberOfEnds()
{
    StandByLedger ledger(arm);
    for (IncidentId id = 1; id <= 4097; ++id) {
        ledger.heard(xray, standBy(id, robot, cockpit), now);
        ledger.dismiss(id, "gone", now);
    }
    QCOMPARE(answers<protocol::IncidentDismissed>(ledger.heard(xray, standBy(2, robot, cockpit), now), xray).size(), std::size_t{1});
    QVERIFY(!all<Broadcast>(ledger.heard(xray, standBy(1, robot, cockpit), now)).empty()); // the oldest is forgotten: taken up again
}

QTEST_APPLESS_MAIN(StandByLedgerTest)
#include "stand_by_ledger_test.moc"
