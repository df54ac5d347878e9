// Silence, heartbeats on time, the offset between two clocks, and a process that did not run.
#include "session/clock_offset.hpp"
#include "session/heartbeat_monitor.hpp"
#include "session/stall_watch.hpp"

#include <QTest>

#include <array>

using namespace liena;
using namespace liena::session;
using namespace std::chrono_literals;

namespace {

constexpr Instant start{1h};

HeartbeatMonitor monitor()
{
    HeartbeatMonitor heartbeats{LinkTiming()};
    heartbeats.start(start);
    return heartbeats;
}

/// Our monotonic clock when the other shows that: it began with it.
Instant atOurs(std::uint64_t wall) { return Instant(std::chrono::nanoseconds(static_cast<std::int64_t>(wall))); }

/// One exchange: there and back take `there` and `back`, the peer's clock is ahead by `offset`, and it holds the echo for 5 ms.
void exchange(ClockOffset& clock, std::uint64_t t1, std::int64_t there, std::int64_t back, std::int64_t offset)
{
    const auto t2 = static_cast<std::uint64_t>(static_cast<std::int64_t>(t1) + there + offset);
    const auto t3 = t2 + 5'000'000;
    const auto t4 = static_cast<std::uint64_t>(static_cast<std::int64_t>(t3) - offset + back);
    clock.add({atOurs(t1), {t2}, {t3}, {atOurs(t4), {t4}}});
}

constexpr std::uint64_t base = 1'700'000'000'000'000'000ULL;

} // namespace

class LifeSignsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void becomesSuspectAndLostAtTheLimits();
    void anyDatagramIsLife();
    void laneZeroMustSpeakItself();
    void peerThatIsNotOpenIsUnwellAfterReconnect();
    void tellsWhenTheNextAnswerChanges();
    void countsHeartbeatsOnTimeAndMissed();
    void countsTheLastSecondOnly();
    void needsEightSamples();
    void believesTheSampleOfLeastDelay();
    void forgetsSamplesBeyondTheWindow();
    void takesClocksOnEitherSide();
    void leavesOutSamplesOfASteppedClock();
    void bearsAnyTimeThatAPeerSays();
    void beginsAnewWhenAClockWasStepped();
    void takesALongDelayForNoStep();
    void takesDriftForNoStep_data();
    void takesDriftForNoStep();
    void findsAStepBetweenSlowSamples();
    void tellsTheNewestDelay();
    void beginsAnewAfterReset();
    void countsPacketsOfEightHeartbeats();
    void countsAtMost255Packets();
    void seesThatTheProcessDidNotRun();
    void isNotStalledWhilePaused();
};

void LifeSignsTest::becomesSuspectAndLostAtTheLimits()
{
    const auto heartbeats = monitor();
    QVERIFY(!heartbeats.isSuspect(start + 70ms - 1ns));
    QVERIFY(heartbeats.isSuspect(start + 70ms));
    QVERIFY(!heartbeats.isLost(start + 107ms - 1ns)); // 3 ms of the 110 is for the timer and the way here
    QVERIFY(heartbeats.isLost(start + 107ms));
}

void LifeSignsTest::anyDatagramIsLife()
{
    auto heartbeats = monitor();
    heartbeats.heard(start + 60ms, LifePath::BulkLane);
    QVERIFY(!heartbeats.isSuspect(start + 129ms));
    heartbeats.heard(start + 10ms, LifePath::LaneZero); // told late: time does not go back
    QVERIFY(heartbeats.lastHeard() == start + 60ms);
}

void LifeSignsTest::laneZeroMustSpeakItself()
{
    auto heartbeats = monitor();
    for (auto at = 20ms; at <= 600ms; at += 20ms)
        heartbeats.heard(start + at, LifePath::BulkLane);
    QVERIFY(!heartbeats.isSuspect(start + 600ms));
    QVERIFY(!heartbeats.isLaneZeroLost(start + 500ms - 1ns));
    QVERIFY(heartbeats.isLaneZeroLost(start + 500ms));
    heartbeats.heard(start + 610ms, LifePath::LaneZero);
    QVERIFY(!heartbeats.isLaneZeroLost(start + 620ms));
}

void LifeSignsTest::peerThatIsNotOpenIsUnwellAfterReconnect()
{
    auto heartbeats = monitor();
    std::uint32_t sequence = 0;
    auto begun = start;
    for (const auto bad : {SessionState::Opening, SessionState::Reconnecting, SessionState::StandBy, SessionState::Closing}) {
        begun += 10s;
        heartbeats.heartbeat(begun, ++sequence, bad);
        QVERIFY(!heartbeats.isUnwell(begun + 500ms - 1ns));
        QVERIFY(heartbeats.isUnwell(begun + 500ms));
        heartbeats.heartbeat(begun + 20ms, ++sequence, bad);
        QVERIFY(heartbeats.isUnwell(begun + 500ms));
        const auto well = bad == SessionState::StandBy ? SessionState::Suspect : SessionState::Open;
        heartbeats.heartbeat(begun + 40ms, ++sequence, well);
        QVERIFY(!heartbeats.isUnwell(begun + 5s));
    }
}

void LifeSignsTest::tellsWhenTheNextAnswerChanges()
{
    auto heartbeats = monitor();
    QVERIFY(heartbeats.nextChange(false) == start + 70ms);
    QVERIFY(heartbeats.nextChange(true) == start + 107ms);
    for (auto at = 20ms; at <= 460ms; at += 20ms)
        heartbeats.heard(start + at, LifePath::BulkLane);
    QVERIFY(heartbeats.nextChange(false) == start + 500ms); // lane 0
    heartbeats.heard(start + 460ms, LifePath::LaneZero);
    heartbeats.heartbeat(start + 20ms, 1, SessionState::Reconnecting);
    QVERIFY(heartbeats.nextChange(false) == start + 520ms); // unwell
}

void LifeSignsTest::countsHeartbeatsOnTimeAndMissed()
{
    auto heartbeats = monitor();
    auto at = start;
    std::uint32_t sequence = 0;
    for (int i = 0; i < 5; ++i)
        heartbeats.heartbeat(at += 20ms, ++sequence, SessionState::Open);
    QCOMPARE(heartbeats.onTimeRun(), 4U); // the first follows nothing
    QCOMPARE(heartbeats.received(), std::uint64_t{5});
    sequence += 3;
    heartbeats.heartbeat(at += 20ms, ++sequence, SessionState::Open);
    QCOMPARE(heartbeats.onTimeRun(), 0U);
    QCOMPARE(heartbeats.missed(), std::uint64_t{3});
    heartbeats.heartbeat(at += 20ms, ++sequence, SessionState::Open);
    QCOMPARE(heartbeats.onTimeRun(), 1U);
    heartbeats.heartbeat(at += 40ms, ++sequence, SessionState::Open); // complete, but late
    QCOMPARE(heartbeats.onTimeRun(), 0U);
    QCOMPARE(heartbeats.missed(), std::uint64_t{3});
}

void LifeSignsTest::countsTheLastSecondOnly()
{
    auto heartbeats = monitor();
    for (int i = 1; i <= 200; ++i)
        heartbeats.heartbeat(start + i * 20ms, static_cast<std::uint32_t>(i), SessionState::Open);
    QCOMPARE(heartbeats.receivedInLastSecond(start + 4s), std::uint64_t{51}); // both ends of the second count
    QCOMPARE(heartbeats.receivedInLastSecond(start + 4500ms), std::uint64_t{26});
    QCOMPARE(heartbeats.receivedInLastSecond(start + 6s), std::uint64_t{0});
}

void LifeSignsTest::needsEightSamples()
{
    ClockOffset clock;
    for (int i = 0; i < 7; ++i)
        exchange(clock, base + static_cast<std::uint64_t>(i), 1000, 1000, 500);
    QVERIFY(!clock.offset());
    QVERIFY(clock.uncertainty() == 0ns);
    exchange(clock, base + 7, 1000, 1000, 500);
    QVERIFY(clock.offset() == 500ns);
    QVERIFY(clock.uncertainty() == 1000ns);
    QCOMPARE(clock.samples(), std::size_t{8});
}

void LifeSignsTest::believesTheSampleOfLeastDelay()
{
    ClockOffset clock;
    for (int i = 0; i < 20; ++i)
        exchange(clock, base, 1'000'000 + i * 100'000, 9'000'000, 500);
    exchange(clock, base, 200'000, 300'000, 500);
    for (int i = 0; i < 20; ++i)
        exchange(clock, base, 9'000'000, 1'000'000, 500);
    QVERIFY(clock.offset() == 500ns - 50'000ns); // asymmetry shows as half the difference …
    QVERIFY(clock.uncertainty() == 250'000ns);   // … within half the delay
}

void LifeSignsTest::forgetsSamplesBeyondTheWindow()
{
    ClockOffset clock;
    exchange(clock, base, 10, 10, 7);
    for (int i = 0; i < 63; ++i)
        exchange(clock, base, 5000, 5000, 900);
    QVERIFY(clock.offset() == 7ns);
    exchange(clock, base, 5000, 5000, 900);
    QVERIFY(clock.offset() == 900ns);
    QCOMPARE(clock.samples(), std::size_t{64});
}

void LifeSignsTest::takesClocksOnEitherSide()
{
    constexpr std::int64_t hour = 3'600'000'000'000;
    for (const auto offset : {hour, -hour}) {
        ClockOffset clock;
        for (int i = 0; i < 8; ++i)
            exchange(clock, base, 1000, 1000, offset);
        QVERIFY(clock.offset() == std::chrono::nanoseconds(offset));
    }
}

void LifeSignsTest::leavesOutSamplesOfASteppedClock()
{
    ClockOffset clock;
    for (int i = 0; i < 8; ++i)
        exchange(clock, base, 1000, 1000, 500);
    const Now heard{atOurs(base) + 3000ns, {base + 3000}};
    QVERIFY(!clock.add({atOurs(base), {base + 1000}, {base + 3'600'000'000'000}, heard})); // forward: held for longer than we waited
    QVERIFY(!clock.add({atOurs(base), {base + 1000}, {base - 3'600'000'000'000}, heard})); // back: held for less than no time
    QVERIFY(!clock.add({atOurs(base), {base + 1000}, {base + 999}, heard}));
    QCOMPARE(clock.samples(), std::size_t{8});
    QVERIFY(clock.offset() == 500ns);
    QVERIFY(clock.lastDelay() == 2000ns);
}

/// A peer may say any time: the sums stay defined, and its clock and ours are still told apart.
void LifeSignsTest::bearsAnyTimeThatAPeerSays()
{
    constexpr std::array<std::uint64_t, 6> times{0, 1, base, std::uint64_t{1} << 63U, (std::uint64_t{1} << 63U) + base, ~std::uint64_t{0}};
    for (const auto ours : times)
        for (const auto t2 : times)
            for (const auto t3 : times) {
                ClockOffset clock;
                for (int i = 0; i < 8; ++i)
                    clock.add({start, {t2}, {t3}, {start + 1ms, {ours}}});
                QVERIFY(clock.uncertainty() >= 0ns);
                QVERIFY(!clock.offset() || std::chrono::abs(*clock.offset()) <= std::chrono::years(74));
            }
}

void LifeSignsTest::beginsAnewWhenAClockWasStepped()
{
    constexpr std::int64_t hour = 3'600'000'000'000;
    for (const auto step : {hour, -hour, hour / 3600 / 100}) { // down to 10 ms
        ClockOffset clock;
        for (int i = 0; i < 20; ++i)
            exchange(clock, base, 1000, 1000, 500);
        for (int i = 0; i < 7; ++i) {
            exchange(clock, base, 1000, 1000, 500 + step);
            QVERIFY(!clock.offset()); // never the offset of before
        }
        exchange(clock, base, 1000, 1000, 500 + step);
        QVERIFY(clock.offset() == std::chrono::nanoseconds(500 + step));
    }
}

void LifeSignsTest::takesALongDelayForNoStep()
{
    ClockOffset clock;
    for (int i = 0; i < 8; ++i)
        exchange(clock, base, 1000, 1000, 500);
    exchange(clock, base, 400'000'000, 1000, 500); // one way has become slow: half of it looks like an offset
    QVERIFY(clock.offset() == 500ns);
    QCOMPARE(clock.samples(), std::size_t{9});
}

void LifeSignsTest::takesDriftForNoStep_data()
{
    QTest::addColumn<int>("apart");
    QTest::addColumn<int>("drift");
    QTest::newRow("a second apart, free clocks") << 1000 << 50;
    QTest::newRow("a second apart, clocks that are set right slowly") << 1000 << -500;
    QTest::newRow("a tenth of a second apart") << 100 << 500;
    QTest::newRow("a usual heartbeat") << 20 << 500;
}

void LifeSignsTest::takesDriftForNoStep()
{
    QFETCH(int, apart); // milliseconds
    QFETCH(int, drift); // parts per million
    ClockOffset clock;
    for (int i = 0; i < 200; ++i) {
        exchange(clock, base + static_cast<std::uint64_t>(i * apart) * 1'000'000, 100'000, 100'000, std::int64_t{i} * apart * drift);
        QVERIFY2(clock.offset().has_value() == (i >= 7), std::to_string(i).c_str());
    }
}

void LifeSignsTest::findsAStepBetweenSlowSamples()
{
    constexpr std::uint64_t second = 1'000'000'000;
    ClockOffset clock;
    exchange(clock, base, 90'000, 90'000, 0); // the least delayed: long ago, when the step comes
    for (std::uint64_t i = 1; i < 60; ++i)
        exchange(clock, base + i * second, 100'000, 100'000, 0);
    for (std::uint64_t i = 60; i < 67; ++i) {
        exchange(clock, base + i * second, 100'000, 100'000, 10'000'000);
        QVERIFY(!clock.offset());
    }
    exchange(clock, base + 67 * second, 100'000, 100'000, 10'000'000);
    QVERIFY(clock.offset() == 10ms);
}

void LifeSignsTest::tellsTheNewestDelay()
{
    ClockOffset clock;
    QVERIFY(!clock.lastDelay());
    exchange(clock, base, 1000, 2000, 0);
    QVERIFY(clock.lastDelay() == 3000ns);
    exchange(clock, base, 4000, 2000, 0);
    QVERIFY(clock.lastDelay() == 6000ns);
}

void LifeSignsTest::beginsAnewAfterReset()
{
    ClockOffset clock;
    for (int i = 0; i < 9; ++i)
        exchange(clock, base, 1000, 1000, 500);
    clock.reset();
    QVERIFY(!clock.offset() && !clock.lastDelay() && clock.samples() == 0);
}

void LifeSignsTest::countsPacketsOfEightHeartbeats()
{
    auto heartbeats = monitor();
    QCOMPARE(heartbeats.packetsHeard(start), std::uint8_t{0});
    heartbeats.heard(start + 10ms, LifePath::Packet);
    heartbeats.heard(start + 20ms, LifePath::LaneZero);
    heartbeats.heard(start + 30ms, LifePath::Packet);
    QCOMPARE(heartbeats.packetsHeard(start + 30ms), std::uint8_t{2});
    QCOMPARE(heartbeats.packetsHeard(start + 10ms + 159ms), std::uint8_t{2});
    QCOMPARE(heartbeats.packetsHeard(start + 10ms + 160ms), std::uint8_t{1});
    QCOMPARE(heartbeats.packetsHeard(start + 30ms + 160ms), std::uint8_t{0});
}

void LifeSignsTest::countsAtMost255Packets()
{
    auto heartbeats = monitor();
    for (int i = 0; i < 1000; ++i)
        heartbeats.heard(start + 1ms, LifePath::Packet);
    QCOMPARE(heartbeats.packetsHeard(start + 2ms), std::uint8_t{255});
}

void LifeSignsTest::seesThatTheProcessDidNotRun()
{
    StallWatch watch;
    QVERIFY(!watch.isWatching());
    QVERIFY(watch.turn(start) == 0ns);
    QVERIFY(watch.isWatching());
    QVERIFY(watch.turn(start + 20ms) == 20ms);
    QVERIFY(watch.turn(start + 100ms) == 80ms);
    QVERIFY(watch.turn(start + 100ms) == 0ns);
}

void LifeSignsTest::isNotStalledWhilePaused()
{
    StallWatch watch;
    watch.turn(start);
    watch.pause();
    QVERIFY(!watch.isWatching());
    QVERIFY(watch.turn(start + 10s) == 0ns);
    QVERIFY(watch.turn(start + 10s + 5ms) == 5ms);
}

QTEST_APPLESS_MAIN(LifeSignsTest)
#include "life_signs_test.moc"
