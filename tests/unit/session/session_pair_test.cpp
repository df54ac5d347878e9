// Two machines against each other over lanes that delay, cut and go silent, in virtual time.
#include "session_pair.hpp"

#include <QTest>

using namespace liena;
using namespace liena::test;
using namespace liena::session;

class SessionPairTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void opensAndStaysOpen_data();
    void opensAndStaysOpen();
    void bothOpenAtOnce_data();
    void bothOpenAtOnce();
    void silenceHeals();
    void silenceOfOneSideHealsForBoth();
    void brokenLaneHeals_data();
    void brokenLaneHeals();
    void lossEndsInStandByAndAPersonReopens();
    void bothReopenAtOnce();
    void reopensAfterLossAtEveryMoment_data();
    void reopensAfterLossAtEveryMoment();
    void closes_data();
    void closes();
    void bothCloseAtOnce();
    void opensAgainAfterClose();
    void cannotOpenWhileThePeerIsAway();

private:
    static void lose(Pair& pair)
    {
        pair.robot.silent = pair.cockpit.silent = true;
        pair.robot.unreachable = pair.cockpit.unreachable = true;
        pair.run(700ms);
        pair.robot.silent = pair.cockpit.silent = false;
        pair.robot.unreachable = pair.cockpit.unreachable = false;
    }
};

void SessionPairTest::opensAndStaysOpen_data()
{
    QTest::addColumn<bool>("robotOpens");
    QTest::newRow("the lower id opens") << true;
    QTest::newRow("the higher id opens") << false;
}

void SessionPairTest::opensAndStaysOpen()
{
    QFETCH(bool, robotOpens);
    Pair pair;
    pair.open(robotOpens ? pair.robot : pair.cockpit);
    pair.run(20ms);
    QVERIFY(pair.bothAre(SessionState::Open));
    QCOMPARE(pair.robot.machine.token(), pair.cockpit.machine.token());
    pair.run(5s);
    QVERIFY(pair.bothAre(SessionState::Open));
    QCOMPARE(pair.robot.told, std::string("opened"));
    QCOMPARE(pair.cockpit.told, std::string("opened"));
    QVERIFY(pair.robot.machine.clock().offset() == 0ns);
    QVERIFY(pair.robot.machine.clock().uncertainty() == delay);
}

void SessionPairTest::bothOpenAtOnce_data()
{
    QTest::addColumn<bool>("robotFirst");
    QTest::addColumn<int>("apart"); // in half milliseconds
    for (int apart = 0; apart <= 20; ++apart)
        for (const bool robotFirst : {true, false})
            QTest::addRow("%s first, %d half ms apart", robotFirst ? "robot" : "cockpit", apart) << robotFirst << apart;
}

void SessionPairTest::bothOpenAtOnce()
{
    QFETCH(bool, robotFirst);
    QFETCH(int, apart);
    Pair pair;
    auto& first = robotFirst ? pair.robot : pair.cockpit;
    auto& second = robotFirst ? pair.cockpit : pair.robot;
    pair.open(first);
    pair.run(apart * 500us);
    pair.open(second);
    pair.run(200ms);
    QVERIFY(pair.bothAre(SessionState::Open));
    QCOMPARE(pair.robot.machine.token(), pair.cockpit.machine.token());
    QCOMPARE(pair.robot.told, std::string("opened"));
    QCOMPARE(pair.cockpit.told, std::string("opened"));
}

void SessionPairTest::silenceHeals()
{
    Pair pair;
    pair.open(pair.robot);
    pair.run(1s);
    pair.robot.silent = pair.cockpit.silent = true;
    pair.run(200ms);
    QVERIFY(pair.bothAre(SessionState::Reconnecting));
    pair.robot.silent = pair.cockpit.silent = false;
    pair.run(1s);
    QVERIFY(pair.bothAre(SessionState::Open));
    QCOMPARE(pair.robot.told, std::string("opened suspect reconnecting interrupted"));
    QCOMPARE(pair.cockpit.told, std::string("opened suspect reconnecting interrupted"));
    QCOMPARE(pair.robot.machine.guard().epoch(), 2U);
    QCOMPARE(pair.cockpit.machine.stamper().targetEpoch(), 2U);
}

void SessionPairTest::silenceOfOneSideHealsForBoth()
{
    Pair pair;
    pair.open(pair.robot);
    pair.run(1s);
    pair.cockpit.silent = true;
    pair.run(300ms);
    QVERIFY(pair.robot.machine.state() == SessionState::Reconnecting);
    QVERIFY(pair.cockpit.machine.state() == SessionState::Open); // it hears the robot, which says that it is not open
    pair.cockpit.silent = false;
    pair.run(2s);
    QVERIFY(pair.bothAre(SessionState::Open));
    QCOMPARE(pair.cockpit.machine.stamper().targetEpoch(), 2U); // so no command from before is delivered
}

void SessionPairTest::brokenLaneHeals_data() { opensAndStaysOpen_data(); }

void SessionPairTest::brokenLaneHeals()
{
    QFETCH(bool, robotOpens);
    Pair pair;
    pair.open(pair.robot);
    pair.run(1s);
    pair.cut(robotOpens ? pair.robot : pair.cockpit);
    pair.run(3ms);
    QVERIFY(pair.bothAre(SessionState::Reconnecting));
    pair.run(1s);
    QVERIFY(pair.bothAre(SessionState::Open));
    QCOMPARE(pair.robot.told, std::string("opened reconnecting interrupted"));
    QCOMPARE(pair.cockpit.told, std::string("opened reconnecting interrupted"));
}

void SessionPairTest::lossEndsInStandByAndAPersonReopens()
{
    Pair pair;
    pair.open(pair.robot);
    pair.run(1s);
    lose(pair);
    QVERIFY(pair.bothAre(SessionState::StandBy));
    QCOMPARE(pair.robot.machine.incident(), pair.cockpit.machine.incident());
    QCOMPARE(pair.robot.machine.incident(), IncidentId{100});
    pair.run(10s);
    QVERIFY(pair.bothAre(SessionState::StandBy)); // nothing comes back by itself
    pair.open(pair.cockpit);
    pair.run(1s);
    QVERIFY(pair.bothAre(SessionState::StandBy));
    const auto epoch = pair.robot.machine.guard().epoch();
    pair.reopen(pair.cockpit);
    pair.run(1s);
    QVERIFY(pair.bothAre(SessionState::Open));
    QCOMPARE(pair.robot.told, std::string("opened suspect reconnecting lost:HeartbeatLost reopened"));
    QCOMPARE(pair.cockpit.told, std::string("opened suspect reconnecting lost:HeartbeatLost reopened"));
    QVERIFY(pair.robot.machine.guard().epoch() > epoch);
    QCOMPARE(pair.robot.machine.incident(), IncidentId{0});
}

void SessionPairTest::bothReopenAtOnce()
{
    Pair pair;
    pair.open(pair.robot);
    pair.run(1s);
    lose(pair);
    pair.reopen(pair.cockpit);
    pair.reopen(pair.robot);
    pair.run(1s);
    QVERIFY(pair.bothAre(SessionState::Open));
    QCOMPARE(pair.robot.machine.token(), pair.cockpit.machine.token());
}

void SessionPairTest::reopensAfterLossAtEveryMoment_data()
{
    QTest::addColumn<int>("at"); // ms after the opening began
    for (int at = 0; at <= 14; ++at)
        QTest::addRow("cut after %d ms", at) << at;
}

/// Whatever moment of an opening the network goes away: both end in a state from which a person brings them together again.
void SessionPairTest::reopensAfterLossAtEveryMoment()
{
    QFETCH(int, at);
    Pair pair;
    pair.open(pair.robot);
    pair.run(at * 1ms + 1us);
    pair.cut(pair.robot);
    pair.cut(pair.cockpit);
    lose(pair);
    pair.run(3s);
    for (int person = 0; person < 3 && !pair.bothAre(SessionState::Open); ++person)
        for (auto* node : {&pair.robot, &pair.cockpit}) {
            if (node->machine.state() == SessionState::Closed)
                pair.open(*node);
            else if (node->machine.state() == SessionState::StandBy)
                pair.reopen(*node);
            pair.run(4s);
        }
    QVERIFY2(pair.bothAre(SessionState::Open), (pair.robot.told + " / " + pair.cockpit.told).c_str());
    QCOMPARE(pair.robot.machine.token(), pair.cockpit.machine.token());
}

void SessionPairTest::closes_data() { opensAndStaysOpen_data(); }

void SessionPairTest::closes()
{
    QFETCH(bool, robotOpens);
    Pair pair;
    pair.open(pair.robot);
    pair.run(1s);
    auto& closing = robotOpens ? pair.robot : pair.cockpit;
    auto& closed = robotOpens ? pair.cockpit : pair.robot;
    pair.close(closing);
    pair.run(50ms);
    QVERIFY(pair.bothAre(SessionState::Closed));
    QCOMPARE(closing.told, std::string("opened closed"));
    QCOMPARE(closed.told, std::string("opened closed-by-peer"));
}

void SessionPairTest::bothCloseAtOnce()
{
    Pair pair;
    pair.open(pair.robot);
    pair.run(1s);
    pair.close(pair.robot);
    pair.close(pair.cockpit);
    pair.run(2s);
    QVERIFY(pair.bothAre(SessionState::Closed));
    QVERIFY(pair.robot.machine.incident() == 0 && pair.cockpit.machine.incident() == 0);
}

void SessionPairTest::opensAgainAfterClose()
{
    Pair pair;
    for (int round = 0; round < 5; ++round) {
        pair.open(round % 2 == 0 ? pair.robot : pair.cockpit);
        pair.run(1s);
        QVERIFY(pair.bothAre(SessionState::Open));
        pair.close(round % 2 == 0 ? pair.cockpit : pair.robot);
        pair.run(1s);
        QVERIFY(pair.bothAre(SessionState::Closed));
    }
    QCOMPARE(pair.robot.machine.guard().epoch(), 5U); // every opening after the first raised it
}

void SessionPairTest::cannotOpenWhileThePeerIsAway()
{
    Pair pair;
    pair.cockpit.unreachable = true;
    pair.open(pair.robot);
    pair.run(5s);
    QVERIFY(pair.bothAre(SessionState::Closed));
    QCOMPARE(pair.robot.told, std::string("failed:None"));
}

QTEST_APPLESS_MAIN(SessionPairTest)
#include "session_pair_test.moc"
