// The safety record's judgement: which control messages are delivered, which are dropped, and when they end the session.
#include "session/control_guard.hpp"
#include "support/hex.hpp"

#include <QTest>

#include <limits>

using namespace liena;
using namespace liena::protocol;
using namespace liena::session;
using namespace liena::test;
using namespace std::chrono_literals;

namespace {

constexpr Instant start{1h};
constexpr auto maxAge = 50ms;

/// A stamper and the guard that judges what it stamps; heartbeats reach the stamper without delay.
struct Link {
    ControlGuard guard{LinkTiming()};
    ControlStamper stamper;
    Instant now = start;
    std::uint32_t heartbeat = 0;
    std::vector<std::byte> fields = bytesOf("01 02 03");

    Link() { beat(); }

    void beat()
    {
        guard.sentHeartbeat(++heartbeat, now);
        stamper.heardHeartbeat(guard.epoch(), heartbeat);
    }

    DatagramHeader header(std::uint16_t number = 0x0101) const
    {
        return {{DeviceId(0x40018208U), number}, DeviceId(0x00008208U), Timestamp{42}, 0, false};
    }
    SafetyRecord stamp(std::uint16_t number = 0x0101) { return *stamper.next(header(number), fields); }

    /// As if the sender had composed this record.
    SafetyRecord forge(std::uint32_t epoch, std::uint32_t sequence, std::uint32_t echo) const
    {
        SafetyRecord record{epoch, sequence, echo, 0};
        record.crc = safetyCrc(header(), record, fields);
        return record;
    }

    ControlFault judge(const SafetyRecord& record, std::uint16_t number = 0x0101)
    {
        return guard.judge(header(number), record, fields, maxAge, now);
    }
};

} // namespace

class ControlGuardTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void sendsNothingBeforeAHeartbeat();
    void deliversWhatIsStamped();
    void countsSequencesPerMessageNumber();
    void beginsSequencesAnewWithTheEpoch();
    void endsWhenTheSequenceIsUsedUp();
    void refusesDamage();
    void refusesRepeatsAndOlderOnes();
    void takesGaps();
    void refusesAnotherNumbersRecord();
    void refusesOldEpoch();
    void refusesEpochNeverAnnounced();
    void refusesEchoOfNoHeartbeat_data();
    void refusesEchoOfNoHeartbeat();
    void judgesAgeByTheEchoedHeartbeat();
    void faultyMessageDoesNotMoveTheSequence();
    void epochNeverFalls();
    void endsAtTheEleventhFaultInASecond();
    void toleratesTenFaultsInASecond();
    void revocationIsNoFaultWhileItSpreads();
    void oldEpochCountsAfterLost();
    void burstWithinOneHeartbeatIsOneFault();
    void steadyLatenessEndsTheSession();
    void newSessionForgetsFaultsAndHeartbeats();
    void namesEveryFault();
};

void ControlGuardTest::sendsNothingBeforeAHeartbeat()
{
    ControlStamper stamper;
    QVERIFY(!stamper.ready());
    stamper.heardHeartbeat(3, 17);
    QVERIFY(stamper.ready());
    QCOMPARE(stamper.targetEpoch(), 3U);
    stamper.reset();
    QVERIFY(!stamper.ready());
}

void ControlGuardTest::deliversWhatIsStamped()
{
    Link link;
    const auto record = link.stamp();
    QCOMPARE(record.epoch, 1U);
    QCOMPARE(record.sequence, 1U);
    QCOMPARE(record.echo, 1U);
    QVERIFY(link.judge(record) == ControlFault::None);
    QVERIFY(link.judge(link.stamp()) == ControlFault::None);
}

void ControlGuardTest::countsSequencesPerMessageNumber()
{
    // Two message numbers over two paths overtake each other; neither may suffer (ruling A1).
    Link link;
    const auto motion = link.stamp(0x0101);
    const auto gripper = link.stamp(0x0103);
    QCOMPARE(motion.sequence, 1U);
    QCOMPARE(gripper.sequence, 1U);
    QVERIFY(link.judge(link.stamp(0x0103), 0x0103) == ControlFault::None);
    QVERIFY(link.judge(motion, 0x0101) == ControlFault::None);
    QVERIFY(link.judge(gripper, 0x0103) == ControlFault::NotNewer);
}

void ControlGuardTest::beginsSequencesAnewWithTheEpoch()
{
    Link link;
    QVERIFY(link.judge(link.stamp()) == ControlFault::None);
    link.guard.raiseEpoch(link.now);
    link.beat();
    const auto record = link.stamp();
    QCOMPARE(record.epoch, 2U);
    QCOMPARE(record.sequence, 1U);
    QVERIFY(link.judge(record) == ControlFault::None);
}

void ControlGuardTest::endsWhenTheSequenceIsUsedUp()
{
    Link link;
    const auto last = link.forge(1, std::numeric_limits<std::uint32_t>::max(), 1);
    QVERIFY(link.judge(last) == ControlFault::None);
    for (const std::uint32_t sequence : {0U, 1U, std::numeric_limits<std::uint32_t>::max()}) // it does not wrap
        QVERIFY(link.judge(link.forge(1, sequence, 1)) == ControlFault::NotNewer);
}

void ControlGuardTest::refusesDamage()
{
    Link link;
    auto record = link.stamp();
    record.crc ^= 1U;
    QVERIFY(link.judge(record) == ControlFault::Crc);
    record = link.stamp();
    link.fields.back() ^= std::byte{1};
    QVERIFY(link.judge(record) == ControlFault::Crc);
    auto otherTarget = link.header();
    otherTarget.target = DeviceId(0x60008208U);
    QVERIFY(link.guard.judge(otherTarget, link.stamp(), link.fields, maxAge, link.now) == ControlFault::Crc);
}

void ControlGuardTest::refusesRepeatsAndOlderOnes()
{
    Link link;
    const auto first = link.stamp();
    const auto second = link.stamp();
    QVERIFY(link.judge(second) == ControlFault::None);
    QVERIFY(link.judge(second) == ControlFault::NotNewer);
    QVERIFY(link.judge(first) == ControlFault::NotNewer);
    QVERIFY(link.judge(link.forge(1, 0, 1)) == ControlFault::NotNewer);
}

void ControlGuardTest::takesGaps()
{
    Link link;
    QVERIFY(link.judge(link.forge(1, 5, 1)) == ControlFault::None);
    QVERIFY(link.judge(link.forge(1, 500, 1)) == ControlFault::None);
    QVERIFY(link.judge(link.forge(1, 499, 1)) == ControlFault::NotNewer);
}

void ControlGuardTest::refusesAnotherNumbersRecord()
{
    Link link;
    QVERIFY(link.judge(link.stamp(0x0101), 0x0103) == ControlFault::Crc);
}

void ControlGuardTest::refusesOldEpoch()
{
    Link link;
    const auto before = link.stamp();
    link.guard.raiseEpoch(link.now);
    QVERIFY(link.judge(before) == ControlFault::OldEpoch);
}

void ControlGuardTest::refusesEpochNeverAnnounced()
{
    Link link;
    QVERIFY(link.judge(link.forge(2, 1, 1)) == ControlFault::WrongEpoch);
}

void ControlGuardTest::refusesEchoOfNoHeartbeat_data()
{
    QTest::addColumn<quint32>("echo");
    QTest::newRow("none") << 0U;
    QTest::newRow("not sent yet") << 2001U;
    QTest::newRow("on the place of one that was") << 976U + 2048U;
    QTest::newRow("long forgotten") << 2000U - 1024U;
}

void ControlGuardTest::refusesEchoOfNoHeartbeat()
{
    QFETCH(quint32, echo);
    Link link;
    while (link.heartbeat < 2000)
        link.beat();
    QVERIFY(link.judge(link.forge(1, 1, 2000)) == ControlFault::None);
    QVERIFY(link.judge(link.forge(1, 2, echo)) == ControlFault::UnknownEcho);
}

void ControlGuardTest::judgesAgeByTheEchoedHeartbeat()
{
    Link link;
    const auto first = link.stamp();
    const auto second = link.stamp();
    link.now += 50ms;
    QVERIFY(link.judge(first) == ControlFault::None);
    link.now += 1ns;
    QVERIFY(link.judge(second) == ControlFault::TooOld);
    link.beat();
    QVERIFY(link.judge(link.stamp()) == ControlFault::None);
}

void ControlGuardTest::faultyMessageDoesNotMoveTheSequence()
{
    Link link;
    auto damaged = link.forge(1, 100, 1);
    damaged.crc ^= 1U;
    QVERIFY(link.judge(damaged) == ControlFault::Crc);
    QVERIFY(link.judge(link.forge(1, 100, 99)) == ControlFault::UnknownEcho);
    QVERIFY(link.judge(link.forge(1, 1, 1)) == ControlFault::None);
}

void ControlGuardTest::epochNeverFalls()
{
    Link link;
    link.guard.raiseEpoch(link.now);
    link.guard.reset();
    QCOMPARE(link.guard.epoch(), 2U);
    link.guard.raiseEpoch(link.now);
    QCOMPARE(link.guard.epoch(), 3U);
}

void ControlGuardTest::endsAtTheEleventhFaultInASecond()
{
    Link link;
    for (int i = 0; i < 11; ++i) {
        QVERIFY(!link.guard.isExceeded(link.now));
        QVERIFY(link.judge(link.forge(9, 1, 1)) == ControlFault::WrongEpoch);
        link.now += 90ms;
    }
    link.now -= 90ms; // the moment of the eleventh, 900 ms after the first
    QVERIFY(link.guard.isExceeded(link.now));
}

void ControlGuardTest::toleratesTenFaultsInASecond()
{
    Link link;
    for (int i = 0; i < 100; ++i) {
        QVERIFY(link.judge(link.forge(9, 1, 1)) == ControlFault::WrongEpoch);
        QVERIFY(!link.guard.isExceeded(link.now));
        link.now += 101ms;
    }
}

void ControlGuardTest::revocationIsNoFaultWhileItSpreads()
{
    Link link;
    std::vector<SafetyRecord> crossing;
    for (int i = 0; i < 50; ++i)
        crossing.push_back(link.stamp());
    link.guard.raiseEpoch(link.now);
    for (const auto& record : crossing) {
        link.now += 2ms;
        QVERIFY(link.judge(record) == ControlFault::OldEpoch);
        QVERIFY(!link.guard.isExceeded(link.now));
    }
}

void ControlGuardTest::oldEpochCountsAfterLost()
{
    Link link;
    std::vector<SafetyRecord> late;
    for (int i = 0; i < 11; ++i)
        late.push_back(link.stamp());
    link.guard.raiseEpoch(link.now);
    link.now += 110ms + 1ns;
    for (const auto& record : late) {
        QVERIFY(!link.guard.isExceeded(link.now));
        QVERIFY(link.judge(record) == ControlFault::OldEpoch);
    }
    QVERIFY(link.guard.isExceeded(link.now));
}

void ControlGuardTest::burstWithinOneHeartbeatIsOneFault()
{
    Link link;
    for (int round = 0; round < 10; ++round) {
        link.beat();
        std::vector<SafetyRecord> burst;
        for (int i = 0; i < 30; ++i)
            burst.push_back(link.stamp());
        link.now += 80ms;
        for (const auto& record : burst) {
            QVERIFY(link.judge(record) == ControlFault::TooOld);
            QVERIFY(!link.guard.isExceeded(link.now));
        }
    }
}

void ControlGuardTest::steadyLatenessEndsTheSession()
{
    Link link;
    link.now += 60ms;
    int faults = 0;
    for (; faults < 100 && !link.guard.isExceeded(link.now); ++faults) {
        QVERIFY(link.judge(link.stamp()) == ControlFault::TooOld);
        link.now += 20ms;
    }
    QCOMPARE(faults, 11);
}

void ControlGuardTest::newSessionForgetsFaultsAndHeartbeats()
{
    Link link;
    const auto before = link.stamp();
    for (int i = 0; i < 11; ++i)
        link.judge(link.forge(9, 1, 1));
    QVERIFY(link.guard.isExceeded(link.now));
    link.guard.reset();
    QVERIFY(!link.guard.isExceeded(link.now));
    QVERIFY(link.judge(before) == ControlFault::UnknownEcho);
}

void ControlGuardTest::namesEveryFault()
{
    std::vector<std::string> names;
    for (int fault = 0; fault <= static_cast<int>(ControlFault::TooOld); ++fault)
        names.emplace_back(toString(static_cast<ControlFault>(fault)));
    std::sort(names.begin(), names.end());
    QVERIFY(std::adjacent_find(names.begin(), names.end()) == names.end());
}

QTEST_APPLESS_MAIN(ControlGuardTest)
#include "control_guard_test.moc"
