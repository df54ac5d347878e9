// What a path did of late: the time of a piece that is in a round trip, and is gone when the path has healed.
#include "tasks/path_memory.hpp"

#include <QTest>

using namespace liena::tasks;
using namespace std::chrono_literals;

namespace {

constexpr PathPieces::Nanoseconds piece = 2400us; // of two packets, at 10 Mbit/s

struct Rig {
    PathPieces pieces;
    PathPieces::Instant now{1h};

    bool hears(PathPieces::Nanoseconds late, PathPieces::Nanoseconds time = 1s)
    {
        bool healed = false;
        for (const auto end = now + time; now < end; now += 10ms)
            healed = pieces.note(late, piece, now) || healed;
        return healed;
    }
};

} // namespace

class PathMemoryTest : public QObject {
    Q_OBJECT

private slots:
    void aPieceThatIsNoLongerSeenIsAHealedPath()
    {
        Rig rig;
        QVERIFY(!rig.hears(2300us, 2s));
        QVERIFY(!rig.hears(1000us)); // half as long: that may be chance
        QVERIFY(rig.hears(300us));
        QVERIFY(!rig.hears(300us)); // told once
    }

    void whatWasNeverSeenIsNotMissed()
    {
        Rig rig;
        QVERIFY(!rig.hears(300us, 10s));
    }

    /// As before a token bucket that is full now and then.
    void whatComesAndGoesTellsNothing()
    {
        Rig rig;
        for (int i = 0; i < 100; ++i) {
            QVERIFY(!rig.hears(2300us, 400ms));
            QVERIFY(!rig.hears(300us, 100ms));
        }
        QVERIFY(!rig.hears(2300us, 2s));
        QVERIFY(!rig.hears(300us, 30ms)); // too short
        QVERIFY(!rig.hears(2300us, 500ms));
        QVERIFY(!rig.hears(300us, 5s));
    }

    /// The smoothed round trip tells of a queue for a while after it is gone.
    void aQueueIsNoPiece()
    {
        Rig rig;
        rig.pieces.queued(rig.now);
        QVERIFY(!rig.hears(5ms, 290ms));
        QVERIFY(!rig.hears(200us, 5s));
    }

    void aSignThatWasNoneIsNotBelievedAgainForAWhile()
    {
        Rig rig;
        rig.hears(2300us, 2s);
        QVERIFY(rig.hears(300us));
        rig.hears(2300us, 2s);
        QVERIFY(!rig.hears(300us, 15s));
        rig.hears(2300us, 5s);
        QVERIFY(rig.hears(300us));
    }

    /// On a faster path everything else that makes round trips vary is longer than a piece.
    void shortPiecesTellNothing()
    {
        Rig rig;
        rig.hears(2300us, 2s);
        QVERIFY(!rig.pieces.note(0ns, 240us, rig.now));
    }

    void theShortestOfLateIsKnownAfterAWhile()
    {
        RoundTripOfLate ofLate;
        auto now = RoundTripOfLate::Instant{1h};
        for (const auto end = now + 3s; now < end; now += 100ms)
            QVERIFY(!ofLate.note(40ms, now));
        for (const auto end = now + 7s; now < end; now += 100ms)
            (void)ofLate.note(45ms, now);
        QVERIFY(ofLate.note(50ms, now) == 45ms);
        now += 10s; // nothing was sent
        QVERIFY(!ofLate.note(50ms, now));
    }
};

QTEST_APPLESS_MAIN(PathMemoryTest)
#include "path_memory_test.moc"
