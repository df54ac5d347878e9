// The bulk lanes of one session before one bottleneck, in virtual time: frames that overlap, each by its own clock.
#include "support/virtual_lanes.hpp"
#include "tasks/path_memory.hpp"

#include <QTest>

#include <algorithm>

using namespace liena::tasks;
using namespace std::chrono_literals;
using Nanoseconds = std::chrono::nanoseconds;
using Lanes = liena::test::VirtualLanes;
using Stream = liena::test::VirtualLane::Stream;

namespace {

constexpr double gigabit = 125e6; // bytes per second
constexpr double mebibyte = 1 << 20;
constexpr auto pictureTime = 33'333us;
constexpr Stream endless{1e12, pictureTime, 0us};

QByteArray milliseconds(Nanoseconds time) { return QByteArray::number(static_cast<double>(time.count()) / 1e6) + " ms"; }

QByteArray number(double value) { return QByteArray::number(value); }

/// From the fourth second on.
Lanes running(double capacity, Nanoseconds roundTrip, const std::vector<Stream>& streams)
{
    Lanes path(capacity, roundTrip, streams);
    path.run(4s);
    path.forget();
    return path;
}

} // namespace

class LanesOfASessionTest : public QObject {
    Q_OBJECT

    static void paths()
    {
        QTest::addColumn<double>("capacity");
        QTest::addColumn<int>("microseconds");
        QTest::addColumn<int>("longestUs");
        QTest::newRow("1 Gbit/s, 0.2 ms") << gigabit << 200 << 1500;
        QTest::newRow("1 Gbit/s, 2 ms") << gigabit << 2000 << 2000;
        QTest::newRow("400 Mbit/s, 0.2 ms") << 0.4 * gigabit << 200 << 2000;
    }

private Q_SLOTS:
    void whatLeftBesideOthersCountsAsOften()
    {
        SharedBytes bytes;
        QCOMPARE(bytes.note({1000, 400}, 1).sent, 1000U);
        QCOMPARE(bytes.note({2000, 900}, 2).acknowledged, 900U); // two from here on
        const auto beside = bytes.note({2500, 2000}, 2);
        QCOMPARE(beside.sent, 3000U);
        QCOMPARE(beside.acknowledged, 2000U); // what left before is acknowledged only now, and counts once
        const auto alone = bytes.note({2600, 2300}, 1);
        QCOMPARE(alone.sent, 3200U);
        QCOMPARE(alone.acknowledged, 2600U);
        const auto all = bytes.note({2700, 2701}, 1); // TCP counts its SYN
        QCOMPARE(all.sent, 3300U);
        QCOMPARE(all.acknowledged, 3301U);
    }

    /// More often within a round trip than is remembered: it may be inexact, never less than before nor more than was sent.
    void howeverOftenOthersComeAndGoWhatIsAcknowledgedOnlyGrows()
    {
        SharedBytes bytes;
        std::uint64_t before = 0;
        for (std::uint64_t sent = 0; sent < 1'000'000; sent += 1000) {
            const auto now = bytes.note({sent, sent < 200'000 ? 0 : sent - 200'000}, 1 + sent / 1000 % 2);
            QVERIFY(now.acknowledged >= before);
            QVERIFY(now.acknowledged <= now.sent);
            before = now.acknowledged;
        }
    }

    void framesThatOverlapQueueNoLongerThanThoseOfOneStream_data() { paths(); }

    /// As many frames, but in two streams, of which one is a little faster than the other, so that they overlap by all there is. With each
    /// paced at the whole rate of the path the queue took up to 2.3 to 5 ms. Two that have half of it each while both send, and all of it
    /// else, take longer by what they overlap: of frames of the time T that meet anyhow in a period P that is T^2 / P in the mean.
    void framesThatOverlapQueueNoLongerThanThoseOfOneStream()
    {
        QFETCH(const double, capacity);
        QFETCH(const int, microseconds);
        QFETCH(const int, longestUs);
        const double frame = 2 * mebibyte * capacity / gigabit;
        auto one = running(capacity, std::chrono::microseconds(microseconds), {{frame, pictureTime, 0us}});
        one.run(8s);
        const auto alone = std::chrono::duration<double>(one.lane(0).tookInTheMean());
        const std::vector<Nanoseconds> beginnings{0ms, 3ms, 8ms, 13ms, 20ms};
        double took = 0;
        for (const auto begins : beginnings) {
            auto two = running(capacity, std::chrono::microseconds(microseconds), {{frame, 66'667us, 0us}, {frame, 70ms, begins}});
            two.run(8s);
            const auto segmentOfEach = two.carrying(2 * static_cast<double>(two.lane(0).rate.segment()));
            QVERIFY2(two.waitedFor(0.99) <= one.waitedFor(0.99) + segmentOfEach,
                     (milliseconds(two.waitedFor(0.99)) + ", alone " + milliseconds(one.waitedFor(0.99))).constData());
            QVERIFY2(two.waitedFor(1) < std::chrono::microseconds(longestUs), milliseconds(two.waitedFor(1)).constData());
            for (const std::size_t i : {0U, 1U})
                took += std::chrono::duration<double>(two.lane(i).tookInTheMean()).count() / 2 / static_cast<double>(beginnings.size());
        }
        const double shared = alone.count() * (1 + alone / 68'333us);
        QVERIFY2(took < 1.12 * shared, number(took / shared).constData());
    }

    void twoThatFillThePathHaveHalfOfItEach_data() { paths(); }

    /// Thirty frames a second each are a little more than fits: what does not is left out. Whose frame is just in time for the next one
    /// leaves out fewer, which for some seconds may be the same stream: over several beginnings it is either.
    void twoThatFillThePathHaveHalfOfItEach()
    {
        QFETCH(const double, capacity);
        QFETCH(const int, microseconds);
        const double frame = 2 * mebibyte * capacity / gigabit;
        const std::vector<Nanoseconds> beginnings{5ms, 8ms, 11ms, 14ms, 17ms, 20ms, 23ms, 26ms};
        double first = 0;
        double second = 0;
        for (const auto begins : beginnings) {
            auto path =
                running(capacity, std::chrono::microseconds(microseconds), {{frame, pictureTime, 0us}, {frame, pictureTime, begins}});
            path.run(8s);
            for (std::size_t i : {0U, 1U}) {
                const double part = path.lane(i).delivered / capacity / 8;
                QVERIFY2(part > 0.35, number(part).constData());
                (i == 0 ? first : second) += part / static_cast<double>(beginnings.size());
            }
            QVERIFY2(path.waitedFor(0.99) < 1200us, milliseconds(path.waitedFor(0.99)).constData());
            const auto known = path.lane(0).rate.known();
            QVERIFY(known);
            // What its source can count on; the part of it that was left to it of late is 0.50 to 0.66.
            QVERIFY2(*known > 0.4 * capacity && *known < 0.7 * capacity, number(*known / capacity).constData());
        }
        QVERIFY2(first + second > 0.88, number(first + second).constData()); // each by itself: 0.75 to 0.77
        QVERIFY2(std::abs(first - second) < 0.05, (number(first) + " and " + number(second)).constData());
    }

    /// Of a long way it is not known at once what is its own unrest: whose neighbours are of its session answers as one alone does.
    void onALongWayTheyQueueNoLonger()
    {
        const double frame = 2 * mebibyte;
        auto drifting = running(gigabit, 40ms, {{frame, 66'667us, 0us}, {frame, 70ms, 8ms}});
        drifting.run(12s);
        QVERIFY2(drifting.waitedFor(0.99) < 800us, milliseconds(drifting.waitedFor(0.99)).constData());
        auto full = running(gigabit, 40ms, {{frame, pictureTime, 0us}, {frame, pictureTime, 8ms}});
        full.run(12s);
        QVERIFY2(full.waitedFor(0.99) < 3ms, milliseconds(full.waitedFor(0.99)).constData()); // as if they were strangers: 5 ms
    }

    void whoseNeighbourStopsHasTheWholePathWithinAFrame()
    {
        auto path = running(gigabit, 200us, {endless, endless});
        path.run(1s);
        QVERIFY2(path.lane(0).rate.rate() < 0.6 * gigabit, number(path.lane(0).rate.rate() / gigabit).constData());
        path.stop(1);
        path.run(pictureTime);
        path.forget();
        path.run(100ms);
        QVERIFY2(path.lane(0).delivered > 0.9 * gigabit * 0.1, number(path.lane(0).delivered / gigabit * 10).constData());
        QVERIFY2(path.waitedFor(1) < 1200us, milliseconds(path.waitedFor(1)).constData());
    }

    /// Each sends at half of what the path was known to carry, which proves nothing of it by itself.
    void bothTogetherFindThatThePathCarriesMore()
    {
        auto path = running(0.4 * gigabit, 200us, {endless, endless});
        path.capacity = gigabit;
        path.run(2s);
        path.forget();
        path.run(2s);
        const double used = (path.lane(0).delivered + path.lane(1).delivered) / gigabit / 2;
        QVERIFY2(used > 0.88, number(used).constData());
    }

    void bothYieldWhenThePathCollapsesToATenth()
    {
        const double frame = 2 * mebibyte;
        auto path = running(gigabit, 200us, {{frame, pictureTime, 0us}, {frame, pictureTime, 8ms}});
        path.capacity = gigabit / 10;
        path.run(300ms);
        path.forget();
        path.run(4s);
        QVERIFY2(path.lane(0).rate.rate() + path.lane(1).rate.rate() < 1.2 * path.capacity,
                 number((path.lane(0).rate.rate() + path.lane(1).rate.rate()) / path.capacity).constData());
        QVERIFY2(path.waitedFor(0.99) < 2ms, milliseconds(path.waitedFor(0.99)).constData());
        const double used = (path.lane(0).delivered + path.lane(1).delivered) / path.capacity / 4;
        QVERIFY2(used > 0.85, number(used).constData());
    }

    /// A message of one write is over before others could make room for it.
    void aStreamOfSmallMessagesTakesNoHalf()
    {
        auto alone = running(gigabit, 200us, {{mebibyte, pictureTime, 0us}});
        alone.run(4s);
        auto beside = running(gigabit, 200us, {{mebibyte, pictureTime, 0us}, {1000, 1ms, 500us}});
        beside.run(4s);
        QVERIFY2(beside.lane(0).tookFor(0.5) < 1.1 * alone.lane(0).tookFor(0.5), milliseconds(beside.lane(0).tookFor(0.5)).constData());
    }

    /// It begins with half of what is known (BulkLanes); growing from there by itself it would find out by a queue what the path carries.
    void aLaneThatBeginsBesideAnotherTakesWhatThatHasLearnt()
    {
        const double capacity = 0.4 * gigabit;
        Lanes path(capacity, 2ms, {endless, {1e12, 1h, 5s}});
        path.lane(1).rate.beginAt(PathRate::first);
        path.run(5s);
        path.forget();
        path.run(200ms);
        QVERIFY2(path.waitedFor(1) < 1900us, milliseconds(path.waitedFor(1)).constData()); // by itself: 2.2 ms
        QVERIFY2(path.lane(1).delivered > 0.4 * capacity * 0.2, number(path.lane(1).delivered / capacity / 0.2).constData());
    }

    void theOthersMakeRoomFromTheFirstByteOn_data()
    {
        QTest::addColumn<double>("megabits");
        QTest::addColumn<int>("roundTripUs");
        for (const double megabits : {4.0, 10.0, 20.0, 100.0})
            for (const int roundTrip : {200, 2000})
                QTest::addRow("%g Mbit/s, %d us", megabits, roundTrip) << megabits << roundTrip;
    }

    /// Long before a new connection's round trip tells anything.
    void theOthersMakeRoomFromTheFirstByteOn()
    {
        QFETCH(double, megabits);
        QFETCH(int, roundTripUs);
        const double capacity = megabits * 125'000;
        Lanes path(capacity, std::chrono::microseconds(roundTripUs), {endless, {1e12, 1h, 5s}});
        path.run(4999ms);
        path.lane(1).rate.beginAt(*path.lane(0).rate.known() / 2);
        path.run(1ms);
        path.forget();
        path.run(300ms);
        // 1.7 to 18 ms more, and 0.24 of a slow path, while the first lane learns of it 64 KiB later.
        const auto bound = 3 * std::chrono::duration<double>(2854 / capacity) + 1ms;
        QVERIFY2(path.waitedFor(1) < bound, milliseconds(path.waitedFor(1)).constData());
        QVERIFY2(path.lane(1).delivered > 0.38 * capacity * 0.3, number(path.lane(1).delivered / capacity / 0.3).constData());
    }

    void aLaneAloneIsPacedAsIfNobodyCouldShare()
    {
        const Stream stream{2 * mebibyte, pictureTime, 0us};
        Lanes shared(gigabit, 2ms, {stream});
        Lanes single(gigabit, 2ms, {stream});
        single.lane(0).rate.shareWith(nullptr);
        for (int i = 0; i < 400; ++i) {
            shared.run(10ms);
            single.run(10ms);
            QCOMPARE(shared.lane(0).rate.rate(), single.lane(0).rate.rate());
            QCOMPARE(shared.lane(0).rate.known(), single.lane(0).rate.known());
        }
    }
};

QTEST_GUILESS_MAIN(LanesOfASessionTest)
#include "lanes_of_a_session_test.moc"
