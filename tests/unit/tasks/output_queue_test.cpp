// Order, history and lifespan of what waits to leave on a lane.
#include "unit/tasks/text_lane.hpp"

#include <QTest>

using namespace liena;
using namespace liena::tasks;
using namespace liena::test;
using namespace std::chrono_literals;
using Fate = OutputQueue::Fate;

class OutputQueueTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void ranksAsPrioritiesSay();
    void higherClassLeavesFirst();
    void streamKeepsItsOrder();
    void higherClassPassesBetweenSegments();
    void streamsOfAClassTakeTurns();
    void smallMessagesShareATurn();
    void streamOfLongMessagesOwesNothing();
    void controlKeepsTheOrderOfAllItsMessages();
    void noHeartbeatWaitsBehindIncidents();
    void whatHasNoHasteIsNotUrgent();
    void bothPartialsBeginAgainOnAnotherConnection();
    void newerSupersedesUndelivered();
    void historyKeepsThatMany();
    void historyIsPerTargetAndNumber();
    void messageThatHasBegunIsNotSuperseded();
    void expiredIsNotSent();
    void messageThatHasBegunIsAbandonedWhenItExpires();
    void messageThatHasBegunIsAbandonedWhenItIsDiscarded();
    void controlMessageLeavesInOneSegment_data();
    void controlMessageLeavesInOneSegment();
    void countsBytesAndMessages();
    void restartSendsCutMessageFromItsBeginning();
    void discardsOneClass();
    void discardsAllButSessionManagement();
};

void OutputQueueTest::ranksAsPrioritiesSay()
{
    QVERIFY(rankOf(Priority::Safety) == Rank::Safety && rankOf(Priority::Control) == Rank::Control);
    QVERIFY(rankOf(Priority::Status) == Rank::Status && rankOf(Priority::Bulk) == Rank::Bulk);
}

void OutputQueueTest::higherClassLeavesFirst()
{
    Lane lane;
    lane.push(0x0021, Rank::Last, "last");
    lane.push(0x0062, Rank::Measuring, "measuring");
    lane.push(0x0202, Rank::Bulk, "bulk");
    lane.push(0x0200, Rank::Status, "status");
    lane.push(0x0040, Rank::Incident, "incident");
    lane.push(0x0101, Rank::Control, "control");
    lane.push(0x0104, Rank::Safety, "safety");
    for (const char* expected : {"safety", "control", "incident", "status", "bulk", "measuring", "last", "-"})
        QCOMPARE(lane.next(), std::string(expected));
}

void OutputQueueTest::streamKeepsItsOrder()
{
    Lane lane;
    for (const char* text : {"a", "b", "c"})
        lane.push(0x0200, Rank::Status, text);
    for (const char* expected : {"a", "b", "c"})
        QCOMPARE(lane.next(), std::string(expected));
}

void OutputQueueTest::higherClassPassesBetweenSegments()
{
    Lane lane;
    lane.push(0x0202, Rank::Bulk, "aabbcc");
    QCOMPARE(lane.next(2), std::string("aa+"));
    lane.push(0x0101, Rank::Control, "go");
    QCOMPARE(lane.next(2), std::string("go"));
    QCOMPARE(lane.next(2), std::string("bb+"));
    lane.push(0x0202, Rank::Bulk, "dd");
    QCOMPARE(lane.next(2), std::string("cc"));
    QCOMPARE(lane.next(2), std::string("dd"));
    QVERIFY(lane.queue.empty());
}

void OutputQueueTest::streamsOfAClassTakeTurns()
{
    Lane lane;
    lane.push(0x0202, Rank::Bulk, "aabbccdd");
    lane.push(0x0202, Rank::Bulk, "ee");
    lane.push(0x0241, Rank::Bulk, "1122");
    lane.push(0x0242, Rank::Bulk, "xx");
    for (const char* expected : {"aa+", "11+", "xx", "bb+", "22", "cc+", "dd", "ee", "-"})
        QCOMPARE(lane.next(2), std::string(expected));
}

/// A turn is a segment's worth of bytes with its header, not a message.
void OutputQueueTest::smallMessagesShareATurn()
{
    Lane lane;
    const std::string large(1000, 'L');
    lane.push(0x0202, Rank::Status, large);
    for (int i = 0; i < 100; ++i)
        lane.push(0x0241, Rank::Status, std::string(32, 's')); // 52 bytes with the header
    QCOMPARE(lane.next(500), large.substr(0, 500) + "+");
    for (int i = 0; i < 10; ++i)
        QCOMPARE(lane.next(500), std::string(32, 's'));
    QCOMPARE(lane.next(500), large.substr(500));
}

/// What it sends afterwards has whole turns, however many full segments went before.
void OutputQueueTest::streamOfLongMessagesOwesNothing()
{
    constexpr int segments = 60;
    Lane lane;
    lane.push(0x0202, Rank::Bulk, std::string(500 * segments, 'L'));
    for (int i = 0; i < 20; ++i)
        lane.push(0x0202, Rank::Bulk, std::string(32, 's')); // 52 bytes with the header
    lane.push(0x0241, Rank::Bulk, std::string(500 * segments * 2, 'O'));
    for (int i = 0; i < segments; ++i)
        for (const char letter : {'L', 'O'})
            QCOMPARE(lane.next(500), std::string(500, letter) + (i == segments - 1 && letter == 'L' ? "" : "+"));
    for (int turn = 0; turn < 2; ++turn) {
        for (int i = 0; i < 10; ++i)
            QCOMPARE(lane.next(500), std::string(32, 's'));
        QCOMPARE(lane.next(500), std::string(500, 'O') + "+");
    }
}

/// What a hand did happens in the order in which it did it, whichever messages say so.
void OutputQueueTest::controlKeepsTheOrderOfAllItsMessages()
{
    Lane lane;
    for (const auto& [number, text] : {std::pair(0x0101, "1"), std::pair(0x0101, "2"), std::pair(0x0103, "3"), std::pair(0x0101, "4")})
        lane.push(static_cast<std::uint16_t>(number), Rank::Control, text);
    for (const char* expected : {"1", "2", "3", "4"})
        QCOMPARE(lane.next(1), std::string(expected));
}

/// However many there are, and whichever messages say so: incidents keep their order, and what the session lives by passes them.
void OutputQueueTest::noHeartbeatWaitsBehindIncidents()
{
    Lane lane;
    for (const auto& [number, text] : {std::pair(0x0040, "1"), std::pair(0x0032, "2"), std::pair(0x0040, "3"), std::pair(0x0041, "4")})
        lane.push(static_cast<std::uint16_t>(number), Rank::Incident, text);
    QCOMPARE(lane.next(), std::string("1"));
    lane.push(0x0010, Rank::Safety, "old", 1);
    lane.push(0x0010, Rank::Safety, "heartbeat", 1);
    lane.push(0x0101, Rank::Control, "command");
    for (const char* expected : {"heartbeat", "command", "2", "3", "4", "-"})
        QCOMPARE(lane.next(), std::string(expected));
}

void OutputQueueTest::whatHasNoHasteIsNotUrgent()
{
    Lane lane;
    for (const auto rank : {Rank::Status, Rank::Bulk, Rank::Last})
        lane.push(0x0200, rank, "patient");
    QVERIFY(!lane.queue.hasUrgent());
    for (const auto rank : {Rank::Safety, Rank::Control, Rank::Incident}) {
        lane.push(0x0101, rank, "urgent");
        QVERIFY(lane.queue.hasUrgent());
        QCOMPARE(lane.next(), std::string("urgent"));
        QVERIFY(!lane.queue.hasUrgent());
    }
}

void OutputQueueTest::bothPartialsBeginAgainOnAnotherConnection()
{
    Lane lane;
    lane.push(0x0202, Rank::Bulk, "aabb");
    lane.push(0x0241, Rank::Bulk, "1122");
    QCOMPARE(lane.next(2), std::string("aa+"));
    QCOMPARE(lane.next(2), std::string("11+"));
    lane.queue.restart();
    for (const char* expected : {"aa+", "11+", "bb", "22", "-"})
        QCOMPARE(lane.next(2), std::string(expected));
}

void OutputQueueTest::newerSupersedesUndelivered()
{
    Lane lane;
    lane.push(0x0101, Rank::Control, "old", 1);
    lane.push(0x0103, Rank::Control, "other", 1);
    lane.push(0x0101, Rank::Control, "new", 1);
    QVERIFY((lane.reports == std::vector{std::pair(std::uint16_t{0x0101}, Fate::Superseded)}));
    QCOMPARE(lane.next(), std::string("other"));
    QCOMPARE(lane.next(), std::string("new"));
    QCOMPARE(lane.next(), std::string("-"));
}

void OutputQueueTest::historyKeepsThatMany()
{
    Lane lane;
    for (const char* text : {"1", "2", "3", "4", "5"})
        lane.push(0x0200, Rank::Status, text, 3);
    QCOMPARE(lane.reports.size(), std::size_t{2});
    for (const char* expected : {"3", "4", "5", "-"})
        QCOMPARE(lane.next(), std::string(expected));
}

void OutputQueueTest::historyIsPerTargetAndNumber()
{
    Lane lane;
    lane.queue.push(Lane::entry(0x0200, Rank::Status, "here", 1));
    lane.queue.push(Lane::entry(0x0200, Rank::Status, "there", 1, DeviceId(0x60008208U)));
    lane.queue.push(Lane::entry(0x0201, Rank::Status, "else", 1));
    QVERIFY(lane.reports.empty());
    QCOMPARE(lane.queue.size(), std::size_t{3});
}

void OutputQueueTest::messageThatHasBegunIsNotSuperseded()
{
    Lane lane;
    lane.push(0x0202, Rank::Bulk, "aabb", 1);
    QCOMPARE(lane.next(2), std::string("aa+"));
    lane.push(0x0202, Rank::Bulk, "cc", 1);
    lane.push(0x0202, Rank::Bulk, "dd", 1);
    QCOMPARE(lane.reports.size(), std::size_t{1});
    QCOMPARE(lane.next(2), std::string("bb"));
    QCOMPARE(lane.next(2), std::string("dd"));
}

void OutputQueueTest::expiredIsNotSent()
{
    Lane lane;
    auto entry = Lane::entry(0x0101, Rank::Control, "late");
    entry.expires = now + 50ms;
    lane.queue.push(OutputQueue::Entry(entry));
    lane.queue.push(OutputQueue::Entry(entry));
    lane.push(0x0200, Rank::Status, "status");
    QCOMPARE(lane.next(100, now + 50ms - 1ns), std::string("late"));
    QCOMPARE(lane.next(100, now + 50ms), std::string("status"));
    QVERIFY((lane.reports == std::vector{std::pair(std::uint16_t{0x0101}, Fate::Expired)}));
    QVERIFY(lane.queue.empty() && lane.queue.bytes() == 0);
}

void OutputQueueTest::messageThatHasBegunIsAbandonedWhenItExpires()
{
    Lane lane;
    auto entry = Lane::entry(0x0202, Rank::Bulk, "aabbcc");
    entry.expires = now + 50ms;
    lane.queue.push(OutputQueue::Entry(entry));
    QCOMPARE(lane.next(2), std::string("aa+"));
    QCOMPARE(lane.next(2, now + 49ms), std::string("bb+"));
    lane.push(0x0241, Rank::Bulk, "next");
    QCOMPARE(lane.next(2, now + 50ms), std::string("A\x02"));
    QVERIFY((lane.reports == std::vector{std::pair(std::uint16_t{0x0202}, Fate::Expired)}));
    QCOMPARE(lane.next(9, now + 50ms), std::string("next"));
    QVERIFY(lane.queue.empty());
}

void OutputQueueTest::messageThatHasBegunIsAbandonedWhenItIsDiscarded()
{
    Lane lane;
    lane.push(0x0202, Rank::Bulk, "aabb");
    lane.push(0x0241, Rank::Bulk, "whole");
    QCOMPARE(lane.next(2), std::string("aa+"));
    lane.queue.discardApplication();
    QCOMPARE(lane.reports.size(), std::size_t{2});
    QCOMPARE(lane.next(2), std::string("A\x02"));
    QCOMPARE(lane.next(), std::string("-"));
}

void OutputQueueTest::controlMessageLeavesInOneSegment_data()
{
    QTest::addColumn<int>("size");
    QTest::newRow("empty") << 0;
    QTest::newRow("as a segment") << 100;
    QTest::newRow("longer than a segment") << 101;
    QTest::newRow("as long as it may be") << 32'767;
}

void OutputQueueTest::controlMessageLeavesInOneSegment()
{
    QFETCH(const int, size);
    const std::string settings(static_cast<std::size_t>(size), 'c');
    const std::string report(150, 's');
    Lane lane;
    lane.push(0x0200, Rank::Status, report);
    QCOMPARE(lane.next(), report.substr(0, 100) + "+");
    lane.push(0x0106, Rank::Control, settings);
    lane.push(0x0101, Rank::Control, "move");
    QVERIFY(lane.next() == settings);
    QCOMPARE(lane.next(), std::string("move"));
    QCOMPARE(lane.next(), report.substr(100));
    QVERIFY(lane.queue.empty() && lane.queue.bytes() == 0);
}

void OutputQueueTest::countsBytesAndMessages()
{
    Lane lane;
    QVERIFY(lane.queue.empty());
    lane.push(0x0200, Rank::Status, "abc");
    lane.push(0x0202, Rank::Bulk, "defgh");
    QCOMPARE(lane.queue.size(), std::size_t{2});
    QCOMPARE(lane.queue.bytes(), std::size_t{8});
    lane.next();
    QCOMPARE(lane.queue.bytes(), std::size_t{5});
    lane.next(2);
    QCOMPARE(lane.queue.size(), std::size_t{1}); // until its last segment has left
    lane.push(0x0040, Rank::Incident, "x");
    lane.push(0x0041, Rank::Incident, "y");
    QCOMPARE(lane.queue.waiting(Rank::Incident), std::size_t{2});
    QCOMPARE(lane.queue.waiting(Rank::Bulk), std::size_t{1});
    QCOMPARE(lane.queue.waiting(Rank::Safety), std::size_t{0});
    lane.next();
    QCOMPARE(lane.queue.waiting(Rank::Incident), std::size_t{1});
}

void OutputQueueTest::restartSendsCutMessageFromItsBeginning()
{
    Lane lane;
    lane.push(0x0202, Rank::Bulk, "aabb");
    QCOMPARE(lane.next(2), std::string("aa+"));
    lane.queue.restart();
    QCOMPARE(lane.next(2), std::string("aa+"));
    QCOMPARE(lane.next(2), std::string("bb"));
}

void OutputQueueTest::discardsOneClass()
{
    Lane lane;
    lane.push(0x0104, Rank::Safety, "stop");
    lane.push(0x0101, Rank::Control, "move");
    lane.push(0x0103, Rank::Control, "grip");
    lane.push(0x0200, Rank::Status, "status");
    lane.queue.discard(Rank::Control);
    QVERIFY((lane.reports ==
             std::vector{std::pair(std::uint16_t{0x0101}, Fate::Discarded), std::pair(std::uint16_t{0x0103}, Fate::Discarded)}));
    QCOMPARE(lane.next(), std::string("stop"));
    QCOMPARE(lane.next(), std::string("status"));
    QCOMPARE(lane.queue.bytes(), std::size_t{0});
}

void OutputQueueTest::discardsAllButSessionManagement()
{
    Lane lane;
    lane.push(0x0007, Rank::Safety, "rejected");
    lane.push(0x0104, Rank::Safety, "stop");
    lane.push(0x0101, Rank::Control, "move");
    lane.push(0x0202, Rank::Bulk, "aabb");
    lane.push(0x0021, Rank::Last, "commit");
    lane.queue.discardApplication();
    QCOMPARE(lane.reports.size(), std::size_t{3});
    QCOMPARE(lane.next(), std::string("rejected"));
    QCOMPARE(lane.next(), std::string("commit"));
    QCOMPARE(lane.next(), std::string("-"));
}

QTEST_APPLESS_MAIN(OutputQueueTest)
#include "output_queue_test.moc"
