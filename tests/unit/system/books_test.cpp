// What a link counts and tells: traffic by window and cause, and deadlines missed.
#include "system/deadline_watch.hpp"
#include "system/traffic_books.hpp"

#include <QTest>

using namespace liena;
using namespace liena::system;
using namespace std::chrono_literals;

namespace {

constexpr TrafficBooks::Instant start{1h};

MessageDefinition definition(std::uint16_t number, std::optional<std::chrono::nanoseconds> deadline)
{
    MessageDefinition made;
    made.number = number;
    made.deadline = deadline;
    return made;
}

std::vector<std::uint16_t> missed(DeadlineWatch& watch, DeadlineWatch::Instant now)
{
    std::vector<std::uint16_t> numbers;
    watch.check(now, [&](std::uint16_t number, const std::string&) { numbers.push_back(number); });
    return numbers;
}

} // namespace

class BooksTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void firstDropOfACauseIsToldAtOnce();
    void causesAndNumbersAreToldApart();
    void distinctCausesDoNotFillTheBooks();
    void reportsAreNoMoreFrequentThanHeartbeats();
    void reportCountsItsWindowOnly();
    void reportCountsWhatIsSkippedByItsSegments();
    void reportsTheMedianLatency_data();
    void reportsTheMedianLatency();
    void reportsTheBacklogWithinItsField();
    void totalsGoOn();
    void missedDeadlineIsToldOncePerGap();
    void deadlineBeginsWithTheFirstMessage();
    void watchesEachStreamByItself();
    void forgetsStreamsOfAnEndedSession();
};

void BooksTest::firstDropOfACauseIsToldAtOnce()
{
    TrafficBooks books;
    QVERIFY(books.dropped("malformed", 0x0200, start) == std::uint64_t{1});
    for (int i = 1; i < 1000; ++i)
        QVERIFY(!books.dropped("malformed", 0x0200, start + i * 9ms));
    QVERIFY(!books.dropped("malformed", 0x0200, start + 10s - 1ns));
    QVERIFY(books.dropped("malformed", 0x0200, start + 10s) == std::uint64_t{1001}); // those that were not told, and this one
    QVERIFY(!books.dropped("malformed", 0x0200, start + 11s));
}

void BooksTest::distinctCausesDoNotFillTheBooks()
{
    base::CauseBooks books(64);
    std::uint64_t told = 0;
    for (std::uint32_t i = 0; i < 10000; ++i)
        if (const auto count = books.count("cause " + std::to_string(i), i, start))
            told += *count;
    QCOMPARE(books.size(), std::size_t{65}); // the 64, and one for all the others
    QCOMPARE(told, std::uint64_t{65});
    QVERIFY(books.count("cause 20000", 0, start + 10s) == std::uint64_t{10000 - 65 + 1});
    QVERIFY(books.count("cause 3", 3, start + 10s) == std::uint64_t{1});
}

void BooksTest::causesAndNumbersAreToldApart()
{
    TrafficBooks books;
    QVERIFY(books.dropped("malformed", 0x0200, start));
    QVERIFY(books.dropped("malformed", 0x0201, start));
    QVERIFY(books.dropped("not open", 0x0200, start));
    QVERIFY(!books.dropped("not open", 0x0200, start));
    QCOMPARE(books.messagesDropped(), std::uint64_t{4});
}

void BooksTest::reportsAreNoMoreFrequentThanHeartbeats()
{
    QCOMPARE(reportPeriod(20ms), std::chrono::nanoseconds(200ms));
    QCOMPARE(reportPeriod(200ms), std::chrono::nanoseconds(200ms));
    QCOMPARE(reportPeriod(1s), std::chrono::nanoseconds(1s));
}

void BooksTest::reportCountsItsWindowOnly()
{
    TrafficBooks books;
    static_cast<void>(books.takeReport(start, 0));
    books.received(100);
    books.received(50);
    books.delivered(3ms);
    books.late();
    static_cast<void>(books.dropped("older than its lifespan", 0x0200, start));
    const auto report = books.takeReport(start + 200ms, 12);
    QCOMPARE(report.windowUs, 200000U);
    QCOMPARE(report.receivedBytes, std::uint64_t{150});
    QCOMPARE(report.receivedMessages, std::uint64_t{2});
    QCOMPARE(report.deliveredMessages, std::uint64_t{1});
    QCOMPARE(report.lateMessages, std::uint64_t{1});
    QCOMPARE(report.droppedMessages, std::uint64_t{1});
    QCOMPARE(report.oneWayNs, std::uint64_t{3000000});
    QCOMPARE(report.backlogBytes, 12U);
    QVERIFY((books.takeReport(start + 400ms, 0) == protocol::LinkReport{200000, 0, 0, 0, 0, 0, 0, 0}));
}

void BooksTest::reportCountsWhatIsSkippedByItsSegments()
{
    TrafficBooks books;
    books.receivedSegment(1000, false);
    books.receivedSegment(1000, false);
    books.receivedSegment(30, true);
    const auto report = books.takeReport(start, 0);
    QCOMPARE(report.receivedBytes, std::uint64_t{2030});
    QCOMPARE(report.receivedMessages, std::uint64_t{1});
    QCOMPARE(books.messagesReceived(), std::uint64_t{1});
}

void BooksTest::reportsTheMedianLatency_data()
{
    QTest::addColumn<QList<qint64>>("latencies");
    QTest::addColumn<quint64>("median");
    QTest::newRow("none") << QList<qint64>{} << quint64{0};
    QTest::newRow("one") << QList<qint64>{700} << quint64{700};
    QTest::newRow("an outlier") << QList<qint64>{100, 90000, 200, 300, 50} << quint64{200};
    QTest::newRow("negative") << QList<qint64>{-5, -6, -7} << quint64{1};
    QTest::newRow("zero") << QList<qint64>{0} << quint64{1}; // 0 says unknown
}

void BooksTest::reportsTheMedianLatency()
{
    QFETCH(QList<qint64>, latencies);
    QFETCH(quint64, median);
    TrafficBooks books;
    for (const auto latency : latencies)
        books.delivered(std::chrono::nanoseconds(latency));
    books.delivered(std::nullopt);
    QCOMPARE(books.takeReport(start, 0).oneWayNs, std::uint64_t{median});
}

void BooksTest::reportsTheBacklogWithinItsField()
{
    TrafficBooks books;
    QCOMPARE(books.takeReport(start, std::size_t{1} << 40U).backlogBytes, 0xFFFFFFFFU);
}

void BooksTest::totalsGoOn()
{
    TrafficBooks books;
    for (int i = 0; i < 3; ++i) {
        books.received(1);
        books.sent();
        static_cast<void>(books.takeReport(start + i * 200ms, 0));
    }
    QCOMPARE(books.messagesReceived(), std::uint64_t{3});
    QCOMPARE(books.messagesSent(), std::uint64_t{3});
}

void BooksTest::missedDeadlineIsToldOncePerGap()
{
    DeadlineWatch watch;
    const auto status = definition(0x0200, 50ms);
    watch.arrived(status, start);
    QVERIFY(missed(watch, start + 50ms).empty());
    QVERIFY(missed(watch, start + 50ms + 1ns) == std::vector<std::uint16_t>{0x0200});
    QVERIFY(missed(watch, start + 10s).empty());
    watch.arrived(status, start + 11s);
    QVERIFY(missed(watch, start + 11s + 20ms).empty());
    QVERIFY(missed(watch, start + 12s) == std::vector<std::uint16_t>{0x0200});
}

void BooksTest::deadlineBeginsWithTheFirstMessage()
{
    DeadlineWatch watch;
    const auto without = definition(0x0201, std::nullopt);
    watch.arrived(without, start);
    QVERIFY(missed(watch, start + 1h).empty());
}

void BooksTest::watchesEachStreamByItself()
{
    DeadlineWatch watch;
    const auto fast = definition(0x0200, 50ms);
    const auto slow = definition(0x0202, 100ms);
    watch.arrived(fast, start);
    watch.arrived(slow, start);
    QVERIFY(missed(watch, start + 80ms) == std::vector<std::uint16_t>{0x0200});
    watch.arrived(fast, start + 90ms);
    QVERIFY(missed(watch, start + 120ms) == std::vector<std::uint16_t>{0x0202});
}

void BooksTest::forgetsStreamsOfAnEndedSession()
{
    DeadlineWatch watch;
    const auto status = definition(0x0200, 50ms);
    watch.arrived(status, start);
    watch.reset();
    QVERIFY(missed(watch, start + 1h).empty());
}

QTEST_APPLESS_MAIN(BooksTest)
#include "books_test.moc"
