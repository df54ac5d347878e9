// A run of pictures: whether any are due, what stands there when none are, and for how long they were live.
#include "model/picture_state.hpp"
#include "model/xray_state.hpp"

#include <QTest>

using namespace console;
using namespace std::chrono_literals;

namespace {

const Instant start = Instant{} + 1h;

/// A picture that is `age` old when it is painted.
PictureStamp stamp(quint32 frame, Instant painted, Duration age)
{
    PictureStamp s;
    s.frame = frame;
    s.acquisition = 1;
    s.source = PictureSource::Simulated;
    s.captureNs = frame;
    s.captured = painted - age;
    s.arrived = painted - 30ms;
    s.painted = painted;
    return s;
}

AcquisitionStatus statusOf(bool beamOn)
{
    AcquisitionStatus status;
    status.beamOn = beamOn;
    status.pulseRate = 7.5;
    return status;
}

} // namespace

class TestPictureRun : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void picturesAreDueUntilTheBeamIsReportedOff()
    {
        XraySystemState xray;
        QCOMPARE(picturesDue(xray, LinkState::Open), 0.0); // nothing was ever reported
        xray.receive(statusOf(true), start);
        for (const LinkState link : {LinkState::Open, LinkState::Suspect, LinkState::Reconnecting, LinkState::StandBy})
            QCOMPARE(picturesDue(xray, link), 7.5);
        QCOMPARE(picturesDue(xray, LinkState::Closed), 0.0);
        xray.receive(statusOf(false), start + 100ms);
        QCOMPARE(picturesDue(xray, LinkState::Open), 0.0);
        QCOMPARE(picturesDue(xray, LinkState::StandBy), 0.0);
    }

    void picturesAreDueWhileThePedalIsDownHere()
    {
        XraySystemState xray;
        xray.setRequestedRate(15);
        xray.setPedal(true);
        QCOMPARE(picturesDue(xray, LinkState::Closed), 15.0);
        xray.receive(statusOf(false), start);
        QCOMPARE(picturesDue(xray, LinkState::Open), 15.0);
        xray.receive(statusOf(true), start);
        QCOMPARE(picturesDue(xray, LinkState::Open), 7.5); // the rate that it has
        xray.setPedal(false);
        QCOMPARE(picturesDue(xray, LinkState::Closed), 0.0);
    }

    /// The link is open, another one's pedal is down, and the X-ray program stands still.
    void picturesThatStopWithTheReportsAreFrozen()
    {
        XraySystemState xray;
        PictureState state;
        state.setLinkUp(true);
        xray.receive(statusOf(true), start);
        state.expect(picturesDue(xray, LinkState::Open), start);
        state.notePainted(stamp(1, start, 80ms));
        const auto later = start + XraySystemState::statusLimit + 100ms;
        QVERIFY(!xray.fresh(later));
        state.expect(picturesDue(xray, LinkState::Open), later);
        QCOMPARE(state.reading(later).condition, PictureCondition::Frozen);
        xray.receive(statusOf(false), later);
        state.expect(picturesDue(xray, LinkState::Open), later);
        QCOMPARE(state.reading(later).condition, PictureCondition::Held);
    }

    void aLinkThatGoesAfterTheRunIsNoFaultOfThePicture()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(15, start);
        state.notePainted(stamp(1, start, 80ms));
        state.expect(0, start + 66ms);
        state.setLinkUp(false);
        QCOMPARE(state.reading(start + 5s).condition, PictureCondition::Held);
    }

    /// Each run is owed pictures of its own, whatever was painted in the ones before.
    void aRunWhosePicturesAreAllRefusedIsOverdueAlsoAfterAnother()
    {
        PictureState state;
        state.setLinkUp(true);
        state.expect(15, start);
        state.notePainted(stamp(1, start + 80ms, 80ms));
        QVERIFY(!state.reading(start + 5s).overdue); // that one froze: it had begun
        state.expect(0, start + 5s);
        QVERIFY(!state.reading(start + 60s).overdue);
        const auto next = start + 60s;
        state.expect(15, next);
        state.noteRefused(QStringLiteral("17 bits are not known"));
        QVERIFY(!state.reading(next + 1s).overdue);
        const auto late = state.reading(next + 1001ms);
        QVERIFY(late.overdue);
        QCOMPARE(late.condition, PictureCondition::Frozen); // what stands there is of the run before
        QCOMPARE(late.refusal, QStringLiteral("17 bits are not known"));
        state.notePainted(stamp(2, next + 1100ms, 80ms));
        QVERIFY(!state.reading(next + 1100ms).overdue);
        QCOMPARE(state.reading(next + 1100ms).refusal, QString());
    }

    void aPictureThatIsFrozenBeforeEachNextOneIsLiveForNoTime_data()
    {
        QTest::addColumn<int>("ageMs");
        QTest::addColumn<bool>("isUnbroken");
        QTest::newRow("never frozen") << 117 << true; // 117 + 133 is the limit
        QTest::newRow("frozen for 8 ms of 133") << 125 << false;
        QTest::newRow("frozen for most of the time") << 200 << false;
    }

    /// The limit is passed between two pictures, though neither is too old when it is painted.
    void aPictureThatIsFrozenBeforeEachNextOneIsLiveForNoTime()
    {
        QFETCH(int, ageMs);
        QFETCH(bool, isUnbroken);
        PictureState state;
        state.setLinkUp(true);
        state.expect(7.5, start);
        auto at = start;
        for (quint32 frame = 1; at <= start + 3s; ++frame, at += 133ms) {
            state.notePainted(stamp(frame, at, std::chrono::milliseconds(ageMs)));
            QCOMPARE(state.reading(at).condition, PictureCondition::Live);
            QCOMPARE(state.reading(at + 132ms).condition == PictureCondition::Live, ageMs + 132 <= 250);
        }
        const auto last = at - 133ms;
        QVERIFY(state.reading(last).atRate);
        QCOMPARE(state.reading(last).liveFor, isUnbroken ? Duration(last - start) : Duration::zero());
    }
};

QTEST_GUILESS_MAIN(TestPictureRun)
#include "test_picture_run.moc"
