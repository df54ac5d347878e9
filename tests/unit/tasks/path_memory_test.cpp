// What a path did of late: its rate, its shortest round trip, and whether that acknowledgements are late is its own.
#include "tasks/path_memory.hpp"

#include <QTest>

using namespace liena::tasks;
using namespace std::chrono_literals;
using Nanoseconds = std::chrono::nanoseconds;
using Says = StandingWait::Says;

namespace {

const RoundTripOfLate::Instant start{1h};

/// One look each 10 ms.
struct RoundTrips {
    std::optional<Nanoseconds> note(Nanoseconds roundTrip, Nanoseconds after = 10ms)
    {
        now += after;
        return ofLate.note(roundTrip, now);
    }

    /// True: so much was told all the while, or nothing.
    bool tellsFor(Nanoseconds span, std::optional<Nanoseconds> told, Nanoseconds roundTrip = usual)
    {
        bool always = true;
        for (const auto end = now + span; now < end;)
            always = note(roundTrip) == told && always;
        return always;
    }

    void pass(Nanoseconds span, Nanoseconds roundTrip = usual) { tellsFor(span, std::nullopt, roundTrip); }

    static constexpr Nanoseconds usual = 20ms;
    static constexpr Nanoseconds shorter = 12ms;
    RoundTripOfLate ofLate;
    RoundTripOfLate::Instant now = start;
};

constexpr Nanoseconds roundTrip = 60ms;
constexpr Nanoseconds late = 20ms;
constexpr double carried = 1e6; // bytes per second
constexpr std::uint64_t enough = 32'768;

/// Since bulk yielded, when 100 kB were under way.
StandingWait::Seen seen(Nanoseconds after, std::uint64_t sent, std::uint64_t came, Nanoseconds waiting = late)
{
    return {start + after, waiting, 1'000'000 + sent, 900'000 + came};
}

StandingWait yielded()
{
    StandingWait standing;
    standing.yielded(seen(0ms, 0, 0), carried);
    return standing;
}

Says look(StandingWait standing, const StandingWait::Seen& seen) { return standing.look(seen, roundTrip); }

/// A tenth of a second, in which one wait is as long.
void tenth(UsualWait& usualWait, UsualWait::Instant& now, Nanoseconds longest, int place)
{
    for (int i = 0; i <= 10; ++i, now += 10ms)
        usualWait.note(i == place ? longest : 100us, now);
}

/// Windows of 10 ms, the first of which brings 1000 bytes and each later one 1000 more.
struct Windows {
    double next(Nanoseconds span)
    {
        const PathPoint beginning = now;
        now = {now.at + 10ms, now.bytes + ++count * 1000};
        return course.rate(beginning, now, span);
    }

    PathCourse course;
    PathPoint now{start, 0};
    std::uint64_t count = 0;
};

} // namespace

class PathMemoryTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aRateIsThatSinceTheNewestBeginningThatIsOldEnough()
    {
        Windows windows;
        for (int i = 0; i < 9; ++i)
            windows.next(10ms);
        QCOMPARE(windows.next(10ms), 10e3 / 0.01);
        QCOMPARE(windows.course.since(), windows.now.at - 10ms);
        QCOMPARE(windows.next(20ms), 21e3 / 0.02);
        QCOMPARE(windows.course.since(), windows.now.at - 20ms);
        QCOMPARE(windows.next(20ms + 1ns), 33e3 / 0.03);
        QCOMPARE(windows.course.since(), windows.now.at - 30ms);
    }

    void whereNoneIsOldEnoughItIsSinceTheOldestThatIsKnown()
    {
        Windows windows;
        windows.next(1s);
        windows.next(1s);
        QCOMPARE(windows.next(1s), 6e3 / 0.03);
        QCOMPARE(windows.course.since(), start);
        for (int i = 0; i < 40; ++i)
            windows.next(1s);
        QCOMPARE(windows.course.since(), windows.now.at - 320ms); // of 32
        windows.course.forget();
        windows.next(1s);
        QCOMPARE(windows.course.since(), windows.now.at - 10ms);
    }

    void whatHadBeenSentFourRoundTripsAgoIsKnown()
    {
        PathDepartures departures;
        auto now = start;
        for (std::uint64_t sent = 0; sent < 100'000; sent += 10, now += 10us)
            departures.note({now, sent}, 2ms);
        for (std::uint64_t ago = 7000; ago <= 8000; ago += 10) {
            const auto until = departures.until(now - std::chrono::microseconds(ago)).value_or(0);
            QVERIFY(until <= 100'000 - ago && until + 70 > 100'000 - ago); // to a part of a round trip
        }
    }

    void noRoundTripIsToldBeforeASpanIsWhole()
    {
        RoundTrips trips;
        QVERIFY(trips.tellsFor(2990ms, std::nullopt));
        trips.pass(30ms);
        QVERIFY(trips.tellsFor(10s, trips.usual));
    }

    void theShortestOfThreeToSixSecondsIsTold()
    {
        for (auto before = 0ms; before <= 3s; before += 100ms) {
            RoundTrips trips;
            trips.pass(7s + before);
            trips.note(trips.shorter);
            QVERIFY(trips.tellsFor(2990ms, trips.shorter));
            trips.pass(3050ms);
            QVERIFY(trips.tellsFor(5s, trips.usual));
        }
    }

    void aShorterRoundTripCountsAtOnce()
    {
        RoundTrips trips;
        trips.pass(4s);
        QCOMPARE(trips.note(trips.shorter).value(), trips.shorter);
        QCOMPARE(trips.note(trips.usual).value(), trips.shorter);
    }

    void aPauseForgetsNoRoundTripOnceASpanWasWhole()
    {
        RoundTrips inTheSpanBefore;
        inTheSpanBefore.note(RoundTrips::shorter);
        inTheSpanBefore.pass(4s);
        RoundTrips inThisSpan;
        inThisSpan.pass(4s);
        inThisSpan.note(RoundTrips::shorter);
        for (auto* trips : {&inTheSpanBefore, &inThisSpan}) {
            QCOMPARE(trips->note(trips->usual, 7s).value(), trips->shorter);
            QCOMPARE(trips->note(trips->usual, 60s).value(), trips->shorter); // between them was too little to know
            QVERIFY(trips->tellsFor(2990ms, trips->shorter));
            trips->pass(30ms);
            QVERIFY(trips->tellsFor(5s, trips->usual));
        }
    }

    void afterAPauseNoRoundTripIsToldWhereNoSpanWasWhole()
    {
        RoundTrips trips;
        trips.pass(2s);
        for (int i = 0; i < 20; ++i)
            QVERIFY(!trips.note(trips.usual, 7s));
        QVERIFY(trips.tellsFor(2990ms, std::nullopt));
        trips.pass(20ms);
        QVERIFY(trips.tellsFor(1s, trips.usual));
    }

    void whatIsProvenIsToldAtOnceAndForSixSeconds()
    {
        RoundTrips trips;
        trips.pass(4s, 10ms);
        QVERIFY(!trips.ofLate.isProven());
        trips.ofLate.prove(30ms, trips.now);
        QVERIFY(trips.ofLate.isProven());
        QVERIFY(trips.tellsFor(5990ms, 30ms, 31ms) && trips.ofLate.isProven());
        QVERIFY2(trips.tellsFor(1s, 31ms, 31ms), "the shorter ones were before");
        QVERIFY(!trips.ofLate.isProven());
    }

    void whatWasProvenLapsesWhereNothingElseIsKnown()
    {
        RoundTrips trips;
        trips.ofLate.prove(30ms, trips.now);
        QCOMPARE(trips.note(31ms, 5990ms).value(), Nanoseconds(30ms));
        QVERIFY(!trips.note(31ms));
    }

    void aShorterRoundTripLowersWhatIsProven()
    {
        RoundTrips trips;
        trips.ofLate.prove(30ms, trips.now);
        QCOMPARE(trips.note(25ms).value(), Nanoseconds(25ms));
        QVERIFY(trips.tellsFor(1s, 25ms, 31ms));
        trips.ofLate.prove(40ms, trips.now);
        QVERIFY2(trips.tellsFor(5990ms, 40ms, 41ms), "what is proven last counts");
    }

    void beforeBulkYieldsNothingIsSaidOfAWait() { QCOMPARE(look({}, seen(1s, enough, enough)), Says::Nothing); }

    void whatStaysAsLateWhileAllComesIsThePaths()
    {
        QCOMPARE(look(yielded(), seen(90ms, enough, enough)), Says::OfThePath);
        QCOMPARE(look(yielded(), seen(89ms, enough, enough)), Says::NotYet);
        QCOMPARE(look(yielded(), seen(90ms, enough - 1, enough - 1)), Says::NotYet);
        QCOMPARE(yielded().look(seen(129ms, enough, enough), 100ms), Says::NotYet);
        QCOMPARE(yielded().look(seen(130ms, enough, enough), 100ms), Says::OfThePath);
    }

    void aWaitThatChangesByMoreThanAnEighthIsAQueue()
    {
        for (const Nanoseconds same : {17500us, 22500us})
            QCOMPARE(look(yielded(), seen(90ms, enough, enough, same)), Says::OfThePath);
        for (const Nanoseconds other : {17499us, 22501us}) {
            auto standing = yielded();
            QCOMPARE(standing.look(seen(50ms, 0, 0, other), roundTrip), Says::Nothing);
            QCOMPARE(standing.look(seen(90ms, enough, enough), roundTrip), Says::Nothing); // for good
        }
    }

    void ofWhatWasSentNearlyAllMustHaveCome()
    {
        auto standing = yielded();
        QCOMPARE(standing.look(seen(50ms, 10'000, 8'499), roundTrip), Says::Nothing);
        QCOMPARE(standing.look(seen(60ms, 10'000, 8'500), roundTrip), Says::NotYet);
        QCOMPARE(standing.look(seen(90ms, 40'000, 33'999), roundTrip), Says::Nothing);
        QCOMPARE(standing.look(seen(91ms, 40'000, 34'000), roundTrip), Says::OfThePath);
    }

    /// TCP may still send as fast as the path carries, behind a full queue.
    void itIsStillToBeSeenWhileMuchLessLeaves()
    {
        auto standing = yielded();
        QCOMPARE(standing.look(seen(1ms, 0, 0), roundTrip), Says::NotYet);
        QCOMPARE(standing.look(seen(20ms, 18'191, 18'191), roundTrip), Says::NotYet); // half of what came, and 8 kB
        QCOMPARE(standing.look(seen(20ms, 18'193, 18'193), roundTrip), Says::Nothing);
        QCOMPARE(standing.look(seen(30ms, 18'193, 18'193), roundTrip), Says::NotYet);
    }

    void ofAWaitOnlyTheFirstYieldingCounts()
    {
        auto standing = yielded();
        standing.yielded(seen(40ms, 20'000, 20'000, 10ms), 1);
        QCOMPARE(standing.look(seen(50ms, 20'000, 20'000), roundTrip), Says::NotYet);
        QCOMPARE(standing.look(seen(90ms, enough, enough), roundTrip), Says::OfThePath);
        QCOMPARE(standing.look(seen(91ms, enough, enough), roundTrip), Says::Nothing); // it is said once
        standing.yielded(seen(100ms, 40'000, 40'000), carried);
        QCOMPARE(standing.look(seen(110ms, 40'000, 40'000), roundTrip), Says::NotYet);
        standing.forget();
        QCOMPARE(standing.look(seen(111ms, 40'000, 40'000), roundTrip), Says::Nothing);
    }

    void theUsualWaitIsTheLongestOfTheCalmestTenth()
    {
        for (const int place : {0, 5, 10}) {
            UsualWait usual;
            auto now = start;
            tenth(usual, now, 3ms, place);
            QVERIFY(!usual.calmest());
            tenth(usual, now, 1ms, place);
            QCOMPARE(usual.calmest().value(), Nanoseconds(3ms));
            tenth(usual, now, 2ms, place);
            QCOMPARE(usual.calmest().value(), Nanoseconds(1ms));
            tenth(usual, now, 500us, place);
            QCOMPARE(usual.calmest().value(), Nanoseconds(1ms));
        }
    }

    void afterItIsForgottenAnotherTenthIsLookedAt()
    {
        UsualWait usual;
        auto now = start;
        tenth(usual, now, 1ms, 5);
        tenth(usual, now, 1ms, 5);
        usual.forget();
        QVERIFY(!usual.calmest());
        tenth(usual, now, 2ms, 5);
        QVERIFY(!usual.calmest());
        tenth(usual, now, 2ms, 5);
        QCOMPARE(usual.calmest().value(), Nanoseconds(2ms));
    }
};

QTEST_APPLESS_MAIN(PathMemoryTest)
#include "path_memory_test.moc"
