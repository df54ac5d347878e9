// What had been sent by some moment, looked up by when.
#include "tasks/path_memory.hpp"

#include <QTest>

using namespace liena::tasks;
using namespace std::chrono_literals;

namespace {

constexpr std::chrono::nanoseconds roundTrip = 2ms;
const PathDepartures::Instant start{1h};

/// Ten thousand bytes in each millisecond, noted at its end.
PathDepartures tenMilliseconds()
{
    PathDepartures departures;
    for (int i = 0; i <= 10; ++i)
        departures.note({start + i * 1ms, static_cast<std::uint64_t>(i) * 10'000}, roundTrip);
    return departures;
}

} // namespace

class PathDeparturesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void ofNothingNotedNothingIsKnown()
    {
        QVERIFY(!PathDepartures().until(start));
        QVERIFY(!PathDepartures().about(start));
    }

    void whatWasBeforeTheFirstIsNotKnown()
    {
        const auto departures = tenMilliseconds();
        QVERIFY(!departures.until(start - 1ns));
        QVERIFY(!departures.about(start - 1ns));
        QCOMPARE(departures.until(start).value(), std::uint64_t{0});
        QCOMPARE(departures.about(start).value(), 0.0);
    }

    void betweenTwoOneIsTheLeastAndTheOtherTheLikeliest()
    {
        const auto departures = tenMilliseconds();
        QCOMPARE(departures.until(start + 3750us).value(), std::uint64_t{30'000});
        QCOMPARE(departures.about(start + 3750us).value(), 37'500.0);
        QCOMPARE(departures.about(start + 4ms).value(), 40'000.0);
    }

    void afterTheNewestItIsThat()
    {
        const auto departures = tenMilliseconds();
        QCOMPARE(departures.until(start + 1s).value(), std::uint64_t{100'000});
        QCOMPARE(departures.about(start + 1s).value(), 100'000.0);
    }

    /// So that those of some round trips have room.
    void whatComesWithinAPartOfARoundTripIsNotNoted()
    {
        auto departures = tenMilliseconds();
        departures.note({start + 10ms + roundTrip / 40, 200'000}, roundTrip);
        QCOMPARE(departures.until(start + 11ms).value(), std::uint64_t{100'000});
        departures.note({start + 10ms + roundTrip / 30, 200'000}, roundTrip);
        QCOMPARE(departures.until(start + 11ms).value(), std::uint64_t{200'000});
    }
};

QTEST_APPLESS_MAIN(PathDeparturesTest)
#include "path_departures_test.moc"
