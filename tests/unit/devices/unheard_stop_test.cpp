// A stop said at the patient's side: sent until each robot names it.
#include "unheard_stop.hpp"

#include <QTest>

using namespace liena;
using namespace liena::devices;

namespace {

const DeviceId robot(0x00008208);
const DeviceId other(0x00008209);

} // namespace

class UnheardStopTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void goesOnUntilEachRobotHasNamedIt()
    {
        UnheardStop stop;
        QVERIFY(stop.robots().empty());
        stop.say(7, "smoke", {robot, other});
        QCOMPARE(stop.robots().size(), std::size_t{2});
        stop.reported(robot, 0);
        stop.reported(robot, 6); // another one, which may be reset
        QCOMPARE(stop.robots().size(), std::size_t{2});
        stop.reported(robot, 7);
        QVERIFY(stop.robots() == std::vector{other});
        stop.reported(other, 7);
        QVERIFY(stop.robots().empty());
    }

    void newestTakesThePlaceOfTheLast()
    {
        UnheardStop stop;
        stop.say(7, "smoke", {robot});
        stop.say(8, "fire", {robot});
        stop.reported(robot, 7);
        QVERIFY(stop.robots() == std::vector{robot});
        QCOMPARE(stop.token(), std::uint64_t{8});
        QCOMPARE(stop.reason(), std::string("fire"));
        stop.reported(robot, 8);
        QVERIFY(stop.robots().empty());
    }

    void goesOnceInASessionToARobotThatCannotNameIt()
    {
        UnheardStop stop;
        stop.say(7, "smoke", {robot, other}, {robot});
        QVERIFY((stop.due() == std::vector{robot, other}));
        stop.given(robot);
        stop.given(other);
        QVERIFY(stop.due() == std::vector{other});
        stop.sessionBegan(other);
        QVERIFY(stop.due() == std::vector{other});
        stop.sessionBegan(robot);
        QVERIFY((stop.due() == std::vector{robot, other}));
        stop.given(robot);
        stop.say(8, "fire", {robot, other}, {robot});
        QVERIFY((stop.due() == std::vector{robot, other}));
    }

    void sameTroubleIsToldOnce()
    {
        UnheardStop stop;
        stop.say(7, "smoke", {robot, other});
        QVERIFY(stop.isNews(robot, "not open"));
        QVERIFY(!stop.isNews(robot, "not open"));
        QVERIFY(stop.isNews(other, "not open"));
        QVERIFY(stop.isNews(robot, "the queue is full"));
        QVERIFY(!stop.isNews(robot, ""));
        QVERIFY(stop.isNews(robot, "the queue is full"));
        stop.say(8, "smoke", {robot});
        QVERIFY(stop.isNews(robot, "the queue is full"));
    }
};

QTEST_APPLESS_MAIN(UnheardStopTest)
#include "unheard_stop_test.moc"
