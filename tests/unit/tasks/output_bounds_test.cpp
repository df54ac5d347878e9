// What a lane's queue takes, and what it refuses so that its memory stays bounded.
#include "unit/tasks/text_lane.hpp"

#include <QTest>

using namespace liena;
using namespace liena::tasks;
using namespace liena::test;

class OutputBoundsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void fullQueueRefuses_data();
    void fullQueueRefuses();
    void fullClassRefusesNoOther_data();
    void fullClassRefusesNoOther();
    void refusedMessageSupersedesNothing();
    void sessionManagementAlwaysFits();
    void sessionManagementTakesNoRoomOfStops();
    void whatIsNotAtItsEndWaits();
};

void OutputBoundsTest::fullQueueRefuses_data()
{
    QTest::addColumn<quint64>("messages");
    QTest::addColumn<quint64>("bytes");
    QTest::newRow("of messages") << quint64{2} << quint64{1000};
    QTest::newRow("of bytes") << quint64{1000} << quint64{5};
}

void OutputBoundsTest::fullQueueRefuses()
{
    QFETCH(quint64, messages);
    QFETCH(quint64, bytes);
    Lane lane({messages, bytes});
    QVERIFY(lane.push(0x0200, Rank::Status, "ab"));
    QVERIFY(lane.push(0x0200, Rank::Status, "cd"));
    QVERIFY(!lane.push(0x0200, Rank::Status, "ef"));
    QVERIFY(lane.reports.empty());
    QCOMPARE(lane.next(), std::string("ab"));
    QVERIFY(lane.push(0x0200, Rank::Status, "ef"));
}

void OutputBoundsTest::fullClassRefusesNoOther_data()
{
    QTest::addColumn<int>("full");
    QTest::addColumn<quint64>("messages");
    QTest::addColumn<quint64>("bytes");
    for (const auto& [name, rank] : {std::pair("reports", Rank::Status), std::pair("images", Rank::Bulk),
                                     std::pair("commands", Rank::Control), std::pair("stops", Rank::Safety)}) {
        QTest::addRow("of messages: %s", name) << static_cast<int>(rank) << quint64{2} << quint64{1000};
        QTest::addRow("of bytes: %s", name) << static_cast<int>(rank) << quint64{1000} << quint64{5};
    }
}

void OutputBoundsTest::fullClassRefusesNoOther()
{
    QFETCH(const int, full);
    QFETCH(const quint64, messages);
    QFETCH(const quint64, bytes);
    Lane lane({messages, bytes});
    for (const char* text : {"ab", "cd"})
        QVERIFY(lane.push(0x0200, static_cast<Rank>(full), text));
    for (const auto rank : {Rank::Safety, Rank::Control, Rank::Status, Rank::Bulk})
        QCOMPARE(lane.push(0x0201, rank, "ef"), rank != static_cast<Rank>(full));
    for (int left = 0; left < 5; ++left)
        lane.next();
    QVERIFY(lane.queue.empty());
    QVERIFY(lane.push(0x0200, static_cast<Rank>(full), "gh")); // there is room again
}

void OutputBoundsTest::refusedMessageSupersedesNothing()
{
    Lane lane({10, 4});
    QVERIFY(lane.push(0x0200, Rank::Status, "ab", 1));
    QVERIFY(!lane.push(0x0200, Rank::Status, "longer", 1));
    QVERIFY(lane.reports.empty());
    QCOMPARE(lane.next(), std::string("ab"));
    QVERIFY(lane.push(0x0200, Rank::Status, "abcd", 1));
    QVERIFY(lane.push(0x0200, Rank::Status, "efgh", 1)); // it takes the place of the one it supersedes
    QCOMPARE(lane.next(), std::string("efgh"));
}

void OutputBoundsTest::sessionManagementAlwaysFits()
{
    Lane lane({1, 4});
    QVERIFY(lane.push(0x0200, Rank::Status, "abcd"));
    QVERIFY(lane.push(0x0010, Rank::Safety, "heartbeat"));
    QCOMPARE(lane.next(), std::string("heartbeat"));
}

void OutputBoundsTest::sessionManagementTakesNoRoomOfStops()
{
    Lane lane({2, 8});
    for (int i = 0; i < 5; ++i)
        QVERIFY(lane.push(0x0040, Rank::Safety, "incident"));
    QVERIFY(lane.push(0x0104, Rank::Safety, "stop"));
    QVERIFY(lane.push(0x0104, Rank::Safety, "stop"));
    QVERIFY(!lane.push(0x0104, Rank::Safety, "stop"));
    lane.queue.discardApplication();
    QVERIFY(lane.push(0x0104, Rank::Safety, "stop"));
}

void OutputBoundsTest::whatIsNotAtItsEndWaits()
{
    constexpr std::uint16_t linkReport = 0x0050;
    Lane lane;
    QVERIFY(!lane.queue.waits(Rank::Safety, linkReport));
    lane.push(0x0010, Rank::Safety, "beat");
    lane.push(linkReport, Rank::Safety, "abcd");
    lane.push(0x0104, Rank::Safety, "stop");
    QVERIFY(lane.queue.waits(Rank::Safety, linkReport));
    QVERIFY(!lane.queue.waits(Rank::Control, linkReport));
    QCOMPARE(lane.next(), std::string("beat"));
    QCOMPARE(lane.next(2), std::string("ab+"));
    QVERIFY(lane.queue.waits(Rank::Safety, linkReport)); // of a lane that breaks now it leaves once more
    QCOMPARE(lane.next(2), std::string("cd"));
    QVERIFY(!lane.queue.waits(Rank::Safety, linkReport));
    QCOMPARE(lane.next(), std::string("stop"));
}

QTEST_APPLESS_MAIN(OutputBoundsTest)
#include "output_bounds_test.moc"
