// Live, frozen or held: the rule for the picture on the screen.
#include "picture_stamps.hpp"

#include <QSignalSpy>
#include <QTest>

using namespace console;
using namespace console::test;
using namespace std::chrono_literals;

class TestPictureState : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void thereIsNoPictureAtFirst()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(15, start);
        QCOMPARE(state.reading(start).condition, PictureCondition::None);
        QVERIFY(!state.reading(start).age);
    }

    void leavesRoomForTheFilterWithinTheLimit()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(10, start);
        QCOMPARE(state.filterRoom(), Duration::zero()); // nothing is known yet
        state.notePainted(stamp(1, start + 10ms, 80ms));
        QCOMPARE(state.filterRoom(), Duration(230ms - 80ms)); // of the limit 20 ms are kept free
        state.setProfile(PictureProfile::Coronary);
        QCOMPARE(state.filterRoom(), Duration(380ms - 80ms));
        auto filtered = stamp(2, start + 110ms, 80ms);
        filtered.filterDelay = 90ms;
        state.notePainted(filtered);
        QCOMPARE(state.filterRoom(), Duration(380ms - 80ms)); // the delay itself takes nothing of its room
        state.notePainted(stamp(3, start + 210ms, 410ms));
        QCOMPARE(state.filterRoom(), Duration::zero());
        state.notePainted(stamp(4, start + 310ms, std::nullopt));
        QCOMPARE(state.filterRoom(), Duration::zero()); // age unknown
    }

    void filterThatStaysInItsRoomNeverFreezesThePicture()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(10, start);
        state.notePainted(stamp(1, start, 80ms));
        auto filtered = stamp(2, start + 100ms, 80ms);
        filtered.filterDelay = state.filterRoom() - 100ms; // as the chain does: for as long as it will stand
        state.notePainted(filtered);
        QCOMPARE(state.reading(start + 200ms).condition, PictureCondition::Live); // when the next one is due
        QCOMPARE(state.reading(start + 220ms).condition, PictureCondition::Live); // and is a little late
        QCOMPARE(state.reading(start + 221ms).condition, PictureCondition::Frozen);
    }

    void uncertainClockMakesAPictureOlder_data()
    {
        QTest::addColumn<int>("uncertaintyMs");
        QTest::addColumn<int>("ageMs");
        QTest::addColumn<PictureCondition>("expected");
        QTest::newRow("within the limit either way") << 10 << 240 << PictureCondition::Live;
        QTest::newRow("perhaps beyond it") << 10 << 241 << PictureCondition::Frozen;
        QTest::newRow("as uncertain as may be") << 125 << 125 << PictureCondition::Live;
        QTest::newRow("too uncertain to say") << 126 << 10 << PictureCondition::Unknown;
        QTest::newRow("not compared at all") << 1000000 << 10 << PictureCondition::Unknown;
    }

    /// Whichever way the clocks err, a picture that is trusted is younger than the limit.
    void uncertainClockMakesAPictureOlder()
    {
        QFETCH(int, uncertaintyMs);
        QFETCH(int, ageMs);
        QFETCH(PictureCondition, expected);
        PictureState state;
        state.setLinkUp(true);
        state.expect(15, start);
        auto one = stamp(1, start + 10ms, 0ms);
        one.uncertainty = std::chrono::milliseconds(uncertaintyMs);
        state.notePainted(one);
        const auto reading = state.reading(start + 10ms + std::chrono::milliseconds(ageMs));
        QCOMPARE(reading.condition, expected);
        QCOMPARE(reading.age.has_value(), expected != PictureCondition::Unknown);
        QCOMPARE(reading.network.has_value(), expected != PictureCondition::Unknown);
        QCOMPARE(state.shownAtEarliest().has_value(), expected != PictureCondition::Unknown);
        if (expected == PictureCondition::Unknown)
            QCOMPARE(state.filterRoom(), Duration::zero());
    }

    void aRecordingGuidesInARehearsalOnly_data()
    {
        QTest::addColumn<PictureSource>("source");
        QTest::addColumn<bool>("rehearsal");
        QTest::addColumn<bool>("guides");
        QTest::newRow("live") << PictureSource::Live << false << true;
        QTest::newRow("live, in a rehearsal") << PictureSource::Live << true << true;
        QTest::newRow("simulated") << PictureSource::Simulated << false << true;
        QTest::newRow("simulated, in a rehearsal") << PictureSource::Simulated << true << true;
        QTest::newRow("recorded") << PictureSource::Recorded << false << false;
        QTest::newRow("recorded, in a rehearsal") << PictureSource::Recorded << true << true;
    }

    /// It may be as young as any other: whether instruments may be moved by it is another question than whether it is live.
    void aRecordingGuidesInARehearsalOnly()
    {
        QFETCH(PictureSource, source);
        QFETCH(bool, rehearsal);
        QFETCH(bool, guides);
        PictureState state;
        QVERIFY(!state.isRehearsal()); // nobody has to say that it is none
        if (rehearsal)
            state.setRehearsal(true);
        state.setLinkUp(true);
        state.expect(15, start);
        QVERIFY(!state.reading(start).mayGuide); // there is no picture
        auto one = stamp(1, start + 10ms);
        one.source = source;
        state.notePainted(one);
        QCOMPARE(state.mayGuide(source), guides);
        QCOMPARE(state.reading(start + 10ms).condition, PictureCondition::Live);
        QCOMPARE(state.reading(start + 10ms).mayGuide, guides);
        state.setRehearsal(false);
        QCOMPARE(state.reading(start + 10ms).mayGuide, source != PictureSource::Recorded);
    }

    void takesNoPictureThatIsHeldOrReviewed()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(15, start);
        for (const PictureRole role : {PictureRole::Hold, PictureRole::Review, PictureRole::Roadmap}) {
            auto old = stamp(1, start + 10ms, 1ms);
            old.role = role;
            state.notePainted(old);
            QCOMPARE(state.reading(start + 10ms).condition, PictureCondition::None);
        }
        QCOMPARE(state.paintedCount(), quint64(0));
    }

    void isLiveUntilTheLimitAndThenFrozen_data()
    {
        QTest::addColumn<PictureProfile>("profile");
        QTest::addColumn<int>("ageMs");
        QTest::addColumn<PictureCondition>("expected");
        QTest::newRow("neuro, at the limit") << PictureProfile::Neuro << 250 << PictureCondition::Live;
        QTest::newRow("neuro, over it") << PictureProfile::Neuro << 251 << PictureCondition::Frozen;
        QTest::newRow("coronary, at the limit") << PictureProfile::Coronary << 400 << PictureCondition::Live;
        QTest::newRow("coronary, over it") << PictureProfile::Coronary << 401 << PictureCondition::Frozen;
    }

    void isLiveUntilTheLimitAndThenFrozen()
    {
        QFETCH(PictureProfile, profile);
        QFETCH(int, ageMs);
        QFETCH(PictureCondition, expected);
        PictureState state;
        state.setProfile(profile);
        state.setLinkUp(true);
        state.expect(15, start);
        state.notePainted(stamp(1, start + 10ms, 0ms));
        const auto now = start + 10ms + std::chrono::milliseconds(ageMs);
        const auto reading = state.reading(now);
        QCOMPARE(reading.condition, expected);
        QCOMPARE(*reading.age, Duration(std::chrono::milliseconds(ageMs)));
        QCOMPARE(reading.frozenFor.has_value(), expected == PictureCondition::Frozen);
    }

    void isHeldWhenNothingIsExpected()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(15, start);
        const auto last = play(state, start, 1s);
        state.expect(0, last);
        QCOMPARE(state.reading(last + 1s).condition, PictureCondition::Held);
        QCOMPARE(state.reading(last + 1s).liveFor, Duration::zero());
    }

    void newRunMayTakeASecondForItsFirstPicture()
    {
        PictureState state;
        state.setLinkUp(true);
        state.notePainted(stamp(1, start));
        state.expect(15, start + 5s);
        QCOMPARE(state.reading(start + 6s).condition, PictureCondition::Held);
        QCOMPARE(state.reading(start + 6s + 1ms).condition, PictureCondition::Frozen);
    }

    void isFrozenWithoutALinkHoweverYoung()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(15, start);
        const auto last = play(state, start, 1s);
        QCOMPARE(state.reading(last).condition, PictureCondition::Live);
        state.setLinkUp(false);
        QCOMPARE(state.reading(last).condition, PictureCondition::Frozen);
    }

    void isUnknownWithoutComparedClocks()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(15, start);
        state.notePainted(stamp(1, start, std::nullopt));
        QCOMPARE(state.reading(start + 10ms).condition, PictureCondition::Unknown);
        QVERIFY(!state.reading(start + 10ms).age);
        QCOMPARE(state.reading(start + 300ms).condition, PictureCondition::Frozen);
    }

    void tellsSinceWhenTheAgeIsUnknown()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(15, start);
        for (unsigned i = 1; i <= 10; ++i)
            state.notePainted(stamp(i, start + i * 60ms, std::nullopt));
        QCOMPARE(state.reading(start + 600ms).unknownFor, std::optional<Duration>(540ms));
        state.expect(0, start + 600ms);
        QVERIFY(!state.reading(start + 700ms).unknownFor);
        state.expect(15, start + 10s); // another run, perhaps of another session
        state.notePainted(stamp(11, start + 10'060ms, std::nullopt));
        QCOMPARE(state.reading(start + 10'100ms).unknownFor, std::optional<Duration>(100ms));
        state.notePainted(stamp(12, start + 10'120ms, 20ms));
        QVERIFY(!state.reading(start + 10'130ms).unknownFor);
        state.notePainted(stamp(13, start + 10'180ms, std::nullopt));
        QCOMPARE(state.reading(start + 10'200ms).unknownFor, std::optional<Duration>(20ms));
    }

    void filterMakesThePictureOlder()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(15, start);
        auto slow = stamp(1, start, 80ms);
        slow.filterDelay = 100ms;
        state.notePainted(slow);
        const auto reading = state.reading(start);
        QCOMPARE(*reading.age, Duration(180ms));
        QCOMPARE(reading.processing, Duration(130ms));
        QCOMPARE(*reading.network, Duration(50ms));
    }

    /// A slow X-ray system is not a slow way.
    void netIsTheWayAlone()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(15, start);
        auto late = stamp(1, start, 80ms);
        late.beforeSending = 35ms;
        state.notePainted(late);
        const auto reading = state.reading(start);
        QCOMPARE(*reading.network, Duration(15ms));
        QCOMPARE(*reading.age, Duration(80ms)); // it makes the picture old all the same
    }

    void samePicturePaintedAgainIsNotANewOne()
    {
        PictureState state;
        QSignalSpy painted(&state, &PictureState::painted);
        const auto one = stamp(1, start);
        state.notePainted(one);
        auto again = one;
        again.painted = start + 1s;
        state.notePainted(again);
        QCOMPARE(state.paintedCount(), quint64(1));
        QCOMPARE(painted.size(), 1);
    }

    void runIsLiveForAsLongAsItIsUnbroken()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(15, start);
        auto last = play(state, start, 2s);
        QCOMPARE(state.reading(last).liveFor, Duration(last - start));
        const auto again = last + 300ms; // longer than the limit: the run begins anew
        state.notePainted(stamp(100, again));
        QVERIFY(state.reading(again).liveFor < 1ms);
        last = play(state, again + 66ms, 1s);
        QCOMPARE(state.reading(last).liveFor, Duration(last - again));
    }

    void fewerPicturesThanExpectedAreNotLiveForAnyTime()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(30, start);
        const auto last = play(state, start, 3s);
        QCOMPARE(state.reading(last).condition, PictureCondition::Live);
        QCOMPARE(state.reading(last).liveFor, Duration::zero());
    }
};

QTEST_GUILESS_MAIN(TestPictureState)
#include "test_picture_state.moc"
